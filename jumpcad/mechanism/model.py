"""`Mechanism`: the five-bar as a `Multibody`, the input of simulation, URDF, MJCF, SDF and feasibility. SI units.

Frames follow REP-103: x forward (the jump), y left, z up; all joint axes are +y, so a positive angle turns a link's
nose downwards. The frame of `body` lies midway between its two pivots with x through both, from the main leg's to the
front link's. Each leg's frame lies at its pivot with x along the link; the foot's frame lies at the ankle with x
towards the front eye. All joint angles are zero in the assembled pose (springs at rest), where the foot is flat.
Loading the springs flattens the legs: negative angles of the `leg` joint.
"""

import cmath
import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.multibody import Body as Body
from jumpcad.mechanism.multibody import ContactSphere as ContactSphere
from jumpcad.mechanism.multibody import Friction as Friction
from jumpcad.mechanism.multibody import Joint as Joint
from jumpcad.mechanism.multibody import Loop as Loop
from jumpcad.mechanism.multibody import Multibody as Multibody
from jumpcad.mechanism.multibody import RollerOff as RollerOff
from jumpcad.mechanism.multibody import Spring as Spring
from jumpcad.mechanism.multibody import Stop as Stop
from jumpcad.mechanism.multibody import Surface as Surface
from jumpcad.transforms import Array, ByValue, pose_at, rotation_about_y

BodyName = Literal["body", "main_leg", "front_link", "foot"]
JointName = Literal["leg", "front", "ankle"]
JOINT_NAMES: tuple[JointName, ...] = ("leg", "front", "ankle")
BODY, MAIN_LEG, FRONT_LINK, FOOT = BODY_NAMES = ("body", "main_leg", "front_link", "foot")
JOINT_SPEED_RAD_S = 300.0
"""To which simulators may hold joints: well above what releases reach, 120 rad/s of best-compact (measured)."""
RANGE_POINTS = 33
"""Leg angles at which the ranges of the other joints are computed."""


@dataclass(frozen=True, repr=False, eq=False)
class Mechanism(Multibody):
    """The planar five-bar of one jumping robot: four rigid bodies, three joints, one loop, the springs on the leg.

    `foot_depth_m` is the distance from the line through ankle and front eye down to the ground on a flat foot.
    """

    design: Design
    foot_depth_m: float

    @property
    def loop(self) -> Loop:
        """Where front link and foot meet."""
        return self.loops[0]

    @property
    def spring(self) -> Spring:
        """The springs of the leg joint."""
        return self.springs[0]

    @property
    def order(self) -> tuple[str, ...]:
        """`BODY_NAMES`."""
        return BODY_NAMES

    @property
    def main(self) -> str:
        """`body`."""
        return BODY

    @property
    def length_m(self) -> float:
        """The longest link (m)."""
        return self.design.l_max_mm / 1000.0

    @property
    def spring_energy_j(self) -> float:
        """What the springs hold in the loaded pose, less what they hold at rest (J)."""
        return self.spring.energy_j

    @cached_property
    def linkage(self) -> Linkage:
        """The four-bar that the mechanism is while its foot stands on the ground."""
        return Linkage(self.design)


def five_bar(
    linkage: Linkage, leg_range_rad: tuple[float, float], effort_nm: float = 0.0
) -> tuple[tuple[Joint, ...], Loop, Spring]:
    """Return joints, loop and spring of a mechanism; they do not depend on how its bodies are made."""
    design = linkage.design
    l1, l2, l3, l4 = (length / 1000.0 for length in (design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm))
    rest = math.radians(design.rest_angle_deg)
    leg, front, ankle = _ranges(linkage, leg_range_rad)

    def hinge(
        name: str, parent: str, child: str, x: float, angle: float, reach: tuple[float, float], effort: float
    ) -> Joint:
        return Joint(name, parent, child, np.array([x, 0.0, 0.0]), angle, *reach, effort, JOINT_SPEED_RAD_S)

    joints = (
        hinge("leg", BODY, MAIN_LEG, -l1 / 2, rest, leg, effort_nm),
        hinge("front", BODY, FRONT_LINK, l1 / 2, rest, front, 0.0),
        hinge("ankle", MAIN_LEG, FOOT, l2, design.beta_rad - rest, ankle, 0.0),
    )
    loop = Loop(FRONT_LINK, np.array([l3, 0.0, 0.0]), FOOT, np.array([l4, 0.0, 0.0]))
    return joints, loop, Spring("leg", design.stiffness_nm_per_rad, design.compression_rad)


def _ranges(linkage: Linkage, leg_range_rad: tuple[float, float]) -> list[tuple[float, float]]:
    """Return how far leg, front and ankle joint turn while the leg goes through its range.

    A loop that does not close all the way (an infeasible design) has no such ranges; its joints get the leg's.
    """
    try:
        pose = linkage.pose(np.linspace(*leg_range_rad, RANGE_POINTS))
    except CannotBuildError:
        return [leg_range_rad] * 3
    turns = (pose.leg_rad, pose.front_rad, pose.ankle_rad)
    return [(float(turn.min()), float(turn.max())) for turn in turns]


@dataclass(frozen=True, eq=False)
class ReleasePose(ByValue):
    """The robot at release: loops closed, foot flat and still on the ground, a five-bar's ankle above the origin.

    `joint_rad` holds the coordinate of every joint by name; the frame of the joints' root, `body`, lies at
    `body_position_m` (3,), turned about the world's y axis by `body_pitch_rad`. `joint_rad_s`, `body_m_s` (3,) and
    `body_rad_s`, about y, are the rates of these, zero where the springs are released instantly.
    """

    joint_rad: dict[str, float]
    body_position_m: Array
    body_pitch_rad: float
    joint_rad_s: dict[str, float] = field(default_factory=lambda: dict.fromkeys(JOINT_NAMES, 0.0))
    body_m_s: Array = field(default_factory=lambda: np.zeros(3))
    body_rad_s: float = 0.0


def release_pose(mechanism: Multibody) -> ReleasePose:
    """Return pose and rates where the jump begins: where the roller has left the cam, or at rest with loaded springs.

    That of a five-bar is in closed form, that of others found, see `Multibody.loaded`.
    """
    if not isinstance(mechanism, Mechanism):
        height_m, pitch_rad, *angles = mechanism.loaded.tolist()
        names = [joint.name for joint in mechanism.joints]
        place_m, still = np.array([0.0, 0.0, height_m]), dict.fromkeys(names, 0.0)
        return ReleasePose(dict(zip(names, angles, strict=True)), place_m, pitch_rad, still)
    off = mechanism.roller_off
    return standing(mechanism, 1.0) if off is None else _moving(mechanism, off.leg_rad, off.leg_rad_s)


def standing(mechanism: Mechanism, loaded: float) -> ReleasePose:
    """Return the pose, foot flat on the ground, with the springs loaded by a share (0 at rest … 1)."""
    return _at(mechanism, -loaded * mechanism.spring.wind_rad)


def _moving(mechanism: Mechanism, leg_rad: float, leg_rad_s: float) -> ReleasePose:
    """Return pose and rates of a robot whose leg joint turns while its foot stands still.

    In the world the ankle is fixed, so the body moves against the ankle's motion in the body's frame, and turns against
    the foot's.
    """
    pose, (foot, front, ankle_mm) = _at(mechanism, leg_rad), mechanism.linkage.rates(leg_rad)
    l1_m, l2_m = mechanism.linkage.l1 / 1000.0, mechanism.linkage.l2 / 1000.0
    ankle_m = -l1_m / 2.0 + l2_m * cmath.exp(-1j * (mechanism.linkage.rest_rad + leg_rad))
    across = -(ankle_mm / 1000.0 + 1j * foot * ankle_m) * cmath.exp(-1j * pose.body_pitch_rad) * leg_rad_s
    rates = {"leg": leg_rad_s, "front": front * leg_rad_s, "ankle": (foot - 1.0) * leg_rad_s}
    velocity = np.array([across.real, 0.0, across.imag])
    return ReleasePose(pose.joint_rad, pose.body_position_m, pose.body_pitch_rad, rates, velocity, -foot * leg_rad_s)


def _at(mechanism: Mechanism, leg_rad: float) -> ReleasePose:
    pose = mechanism.linkage.pose([leg_rad])
    pitch = -float(pose.foot_rad[0])
    cos, sin = math.cos(pitch), math.sin(pitch)
    x, z = pose.ankle_mm[0] / 1000.0
    position = np.array([-cos * x - sin * z, 0.0, mechanism.foot_depth_m + sin * x - cos * z])
    joints = {"leg": pose.leg_rad, "front": pose.front_rad, "ankle": pose.ankle_rad}
    return ReleasePose({name: float(angle[0]) for name, angle in joints.items()}, position, pitch)


def body_poses(mechanism: Mechanism, loaded: float = 0.0) -> dict[str, Array]:
    """Return the pose (4, 4) of every body's frame in the world (m) of a standing robot."""
    stance = standing(mechanism, loaded)
    root = pose_at(rotation_about_y(stance.body_pitch_rad), stance.body_position_m)
    return mechanism.poses(root, [stance.joint_rad.get(joint.name, 0.0) for joint in mechanism.joints])
