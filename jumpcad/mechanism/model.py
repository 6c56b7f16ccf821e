"""`Mechanism`: the five-bar as a `Multibody`, the input of simulation, URDF, MJCF, SDF and feasibility. SI units.

Frames follow REP-103: x forward (the jump), y left, z up; all joint axes are +y, so a positive angle turns a link's
nose downwards. The frame of `body` lies midway between its two pivots with x through both, from the main leg's to the
front link's. Each leg's frame lies at its pivot with x along the link; the foot's frame lies at the ankle with x
towards the front eye. All joint angles are zero in the assembled pose (springs at rest), where the foot is flat.
Loading the springs flattens the legs: negative angles of the `leg` joint.
"""

import math
from dataclasses import dataclass
from functools import cached_property

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

BODY, MAIN_LEG, FRONT_LINK, FOOT = BODY_NAMES = ("body", "main_leg", "front_link", "foot")
JOINT_SPEED_RAD_S = 100.0
"""Joint speed at which PyBullet limits joints; releases of light designs reach it (measured)."""
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
