"""`Mechanism`: the input of simulation, URDF, MJCF, SDF and feasibility. Plain data, SI units, engine-free.

Frames follow REP-103: x forward (the jump), y left, z up; all joint axes are +y, so a positive angle turns a link's
nose downwards. The frame of `body` lies midway between its two pivots with x through both, from the main leg's to the
front link's. Each leg's frame lies at its pivot with x along the link; the foot's frame lies at the ankle with x
towards the front eye. All joint angles are zero in the assembled pose (springs at rest), where the foot is flat.
Loading the springs flattens the legs: negative angles of the `leg` joint.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.transforms import Array, ByValue

Surface = Literal["foot", "body"]

BODY, MAIN_LEG, FRONT_LINK, FOOT = BODY_NAMES = ("body", "main_leg", "front_link", "foot")
JOINT_SPEED_RAD_S = 100.0
"""Joint speed at which PyBullet limits joints; releases of light designs reach it (measured)."""
RANGE_POINTS = 33
"""Leg angles at which the ranges of the other joints are computed."""


@dataclass(frozen=True, eq=False)
class ContactSphere(ByValue):
    """A sphere that may touch the ground, in its body's frame; `surface` chooses the friction in the settings."""

    name: str
    centre_m: Array
    radius_m: float
    surface: Surface


@dataclass(frozen=True, eq=False)
class Body(ByValue):
    """A rigid body: mass, centre of mass (3,) and inertia tensor (3, 3) about it, both along the body frame's axes."""

    name: str
    mass_kg: float
    com_m: Array
    inertia_kg_m2: Array
    contacts: tuple[ContactSphere, ...] = ()

    @property
    def surface(self) -> Surface:
        """What of it touches the ground: `foot` if any sphere is of the foot."""
        return "foot" if any(contact.surface == "foot" for contact in self.contacts) else "body"


@dataclass(frozen=True, eq=False)
class Joint(ByValue):
    """A hinge about +y: the child frame lies at `origin_m` in the parent frame, turned by `rest_angle_rad` + q.

    `lower_rad` and `upper_rad` bound q as far as the mechanism goes (information for exporters, not a stop).
    `effort_nm` and `velocity_rad_s` are the joint's largest torque and speed, for the URDF's limits.
    """

    name: str
    parent: str
    child: str
    origin_m: Array
    rest_angle_rad: float
    lower_rad: float
    upper_rad: float
    effort_nm: float
    velocity_rad_s: float


@dataclass(frozen=True, eq=False)
class Loop(ByValue):
    """The closure of the five-bar: `point_a_m` of `body_a` is at `point_b_m` of `body_b`, each in its frame."""

    body_a: str
    point_a_m: Array
    body_b: str
    point_b_m: Array


@dataclass(frozen=True)
class Spring:
    """Both torsion springs together on one joint, loaded by q = -wind_rad before release.

    Attributes
    ----------
    joint
        Name of the joint on which they act.
    stiffness_nm_per_rad
        Of both springs together.
    wind_rad
        From the rest pose (q = 0) to the loaded one.
    preload_rad
        How far the springs are still loaded in the rest pose: their arms are free at q = preload_rad.
    one_sided
        The arms only push: beyond the angle at which they are free there is no torque.
    """

    joint: str
    stiffness_nm_per_rad: float
    wind_rad: float
    preload_rad: float = 0.0
    one_sided: bool = False

    @property
    def energy_j(self) -> float:
        """Energy that the springs give from the loaded to the rest pose, ½·k·((δ + p)² - p²) (J)."""
        return 0.5 * self.stiffness_nm_per_rad * self.wind_rad * (self.wind_rad + 2.0 * self.preload_rad)

    @property
    def peak_torque_nm(self) -> float:
        """Torque in the loaded pose, k·(δ + p) (N·m)."""
        return self.stiffness_nm_per_rad * (self.wind_rad + self.preload_rad)

    def torque_nm(self, joint_rad: float) -> float:
        """Return the torque on the joint at a coordinate of it (N·m)."""
        torque = self.stiffness_nm_per_rad * (self.preload_rad - joint_rad)
        return max(torque, 0.0) if self.one_sided else torque

    def stored_j(self, joint_rad: float) -> float:
        """Return the energy in the springs at a coordinate of the joint, less that at rest (J)."""
        deflection = self.preload_rad - joint_rad
        if self.one_sided:
            deflection = max(deflection, 0.0)
        return 0.5 * self.stiffness_nm_per_rad * (deflection * deflection - self.preload_rad * self.preload_rad)


@dataclass(frozen=True)
class Stop:
    """What stops a joint at q = angle_rad beyond rest: a pad, elastic until the joint stands still, without rebound."""

    joint: str
    angle_rad: float
    stiffness_nm_per_rad: float


@dataclass(frozen=True)
class RollerOff:
    """The state in which the roller has left the cam, where the jump begins: coordinate and rate of the leg joint.

    `energy_ratio` is the energy left in the springs there, plus the leg's kinetic energy, over the loaded energy.
    """

    leg_rad: float
    leg_rad_s: float
    energy_ratio: float


@dataclass(frozen=True)
class Friction:
    """Dry friction of a printed robot: coefficients of foot and body on the ground, and in the pins.

    `pin_radius_m` are the radii of the pins of leg, front, ankle and eye, 0 for one that runs in ball bearings: their
    friction, some 0.0015 of the bearing's load, is neglected.
    """

    foot: float
    body: float
    pin: float
    pin_radius_m: tuple[float, float, float, float]


@dataclass(frozen=True, repr=False, eq=False)
class Mechanism(ByValue):
    """The planar five-bar of one jumping robot: four rigid bodies, three joints, one loop, the springs.

    `foot_depth_m` is the distance from the line through ankle and front eye down to the ground on a flat foot.
    A printed robot has a `stop`, starts with `roller_off`, and has its own `friction`; the capsules of the study have
    none of them, and take friction from the study's settings. `outline_m` are the corners x + iz (k,) of the convex
    outline of each body's parts in its frame's x-z plane; without parts there is none.
    """

    name: str
    design: Design
    bodies: Mapping[str, Body]
    joints: tuple[Joint, ...]
    loop: Loop
    spring: Spring
    foot_depth_m: float
    stop: Stop | None = field(default=None, kw_only=True)
    roller_off: RollerOff | None = field(default=None, kw_only=True)
    friction: Friction | None = field(default=None, kw_only=True)
    outline_m: Mapping[str, npt.NDArray[np.complex128]] = field(default_factory=dict, kw_only=True, compare=False)

    @property
    def mass_kg(self) -> float:
        """Total mass (kg)."""
        return math.fsum(body.mass_kg for body in self.bodies.values())

    @property
    def lateral_offset_mm(self) -> float:
        """How far the centre of mass lies beside the leg, to the left (mm), the same in every pose."""
        return 1000.0 * sum(body.mass_kg * float(body.com_m[1]) for body in self.bodies.values()) / self.mass_kg

    def joint(self, name: str) -> Joint:
        """Return a joint by its name."""
        return next(joint for joint in self.joints if joint.name == name)

    @cached_property
    def linkage(self) -> Linkage:
        """The four-bar that the mechanism is while its foot stands on the ground."""
        return Linkage(self.design)

    def __repr__(self) -> str:
        name = repr(self.name[:40]) if self.name else "without a name"
        return (
            f"<{type(self).__name__} {name}: {1000.0 * self.mass_kg:.1f} g, spring energy {self.spring.energy_j:.3f} J>"
        )


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
    spring = Spring("leg", design.stiffness_nm_per_rad, design.compression_rad)
    return joints, loop, spring


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
