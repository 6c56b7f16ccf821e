"""The foot, and sideways tipping: toes' and nose's width, centre of mass, play of the joints.

On the ground two chains of joints connect body and foot, leg and front link; the one with less play counts. An
eye of length l whose bore is c wider than its pin tilts by c/l to either side.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from jumpcad.findings import Basis, Change, Finding, Ways, at_least, at_most, higher, lower
from jumpcad.mechanism.feasibility import centre_of_mass_on_foot_mm
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.foot import limits
from jumpcad.robot.foot.drawing import foot_and_toes
from jumpcad.robot.foot.pads import foot_hardware
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Check, Robot, Thing
from jumpcad.transforms import Array

POSITIONS = 9
WIDEST_MM, HALVINGS = 200, 12
"""Largest half width of the toes that is tried, the limit of the workshop's key; and bisection steps."""
WIDER_MM = 1.0
"""Added to the half width that the remedy names; judgement: wider bars are heavier."""
EYE_MM = 0.1
"""Play of an eye on either side at most: what is drawn wider came out smaller, and a drill 0.1 mm wider than the pin
opens it. Judgement: the drill, and its wobble by hand."""
LANDING_PLAYS = 2.0
"""Factor on the play at landing: the body lands tilted to one end of it and swings to the other."""
BASIS = {
    "sideways_tipping": Basis(
        "atan(w/h) - n·play ≥ safety.roll_reserve_deg (°), least of rest, springs loaded (n = 1) and landing (n = "
        "2); w from the centre of mass to the line from toe's tip to nose, h its height, play = least of leg's and "
        f"front link's Σ(bore - pin)/length of the eye, of an eye's play {EYE_MM:g} mm a side at most",
        "statics; reserve and twice the play at landing: judgement",
    ),
    "lateral_balance": Basis(
        "|centre of mass beside the leg| ≤ safety.lateral_offset_mm (mm), where that is not 0", "statics"
    ),
}


@dataclass(frozen=True)
class Roll:
    """Roll angles in a state, to the worse side (°): the one at which the robot tips, and the play of its joints."""

    state: str
    stance_deg: float
    play_deg: float

    @property
    def margin_deg(self) -> float:
        """What is left."""
        return self.stance_deg - self.play_deg


def sideways_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `sideways_tipping`, the least margin at rest, loaded and at landing, and `lateral_balance` if asked."""
    worst = min(rolls(robot), key=lambda roll: roll.margin_deg)
    reserve = robot.workshop.safety.roll_reserve_deg
    wider: Ways = higher("body.toe_half_width_mm")
    if worst.margin_deg < reserve:
        width = _width_mm(robot, reserve)
        wider = ("no body.toe_half_width_mm is enough: reduce the play",)
        if width:
            wider = (Change("body.toe_half_width_mm", "raise", value=round(width)),)
    yield at_least(
        "sideways_tipping", worst.margin_deg, reserve, "°",
        f"{worst.state}, the robot tips sideways at {worst.stance_deg:.1f}° of roll, of which play of the joints "
        f"takes {worst.play_deg:.1f}°; {worst.margin_deg:.1f}° are left, of {reserve:g}° at least",
        (*wider, *higher("e_coef", "ground_link_angle_deg", note="wider toes"),
         *lower("fits.eye_mm", note=f"not below {EYE_MM:g}")),
    )  # fmt: skip
    if limit := robot.workshop.safety.lateral_offset_mm:
        offset = robot.lateral_offset_mm
        side, way = ("left", higher("body.right_mm")) if offset > 0.0 else ("right", lower("body.right_mm"))
        yield at_most(
            "lateral_balance", abs(offset), limit, "mm",
            f"the centre of mass lies {abs(offset):.1f} mm to the {side} of the leg; {limit:g} mm are allowed",
            (*way, 'seats.battery = "balance" and seats.boards = "balance"'),
        )  # fmt: skip


def _width_mm(robot: Robot, reserve_deg: float) -> float | None:
    """Return a half width of the toes with which the reserve is left, in whole millimetres; None if there is none."""

    def holds(half_width_mm: float) -> bool:
        layout = replace(robot.layout, toe_half_width_mm=half_width_mm)
        return min(roll.margin_deg for roll in rolls(robot, layout)) >= reserve_deg

    low, high = robot.layout.toe_half_width_mm, float(WIDEST_MM)
    if not holds(high):
        return None
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        low, high = (low, middle) if holds(middle) else (middle, high)
    return min(math.ceil(high + WIDER_MM), WIDEST_MM)


def rolls(robot: Robot, layout: Layout | None = None) -> tuple[Roll, ...]:
    """Return how far the robot may roll standing at rest, with loaded springs, and in any pose between at landing.

    Another `layout` takes the place of the robot's, with its masses.
    """
    linkage, layout = robot.linkage, layout or robot.layout
    leg = np.linspace(*linkage.travel_rad, POSITIONS)
    com = centre_of_mass_on_foot_mm(robot, linkage, linkage.pose(leg))
    stance = stance_deg(layout, com, robot.lateral_offset_mm)
    fits = robot.workshop.fits.model_copy(update={"eye_mm": min(robot.workshop.fits.eye_mm, EYE_MM)})
    printed = replace(HoleSizes.of(robot.workshop, layout.hub_bearing), fits=fits)
    play = math.degrees(play_rad(layout, printed))
    return (
        Roll("at rest", float(stance[-1]), play),
        Roll("springs loaded", float(stance[0]), play),
        Roll("landing", float(stance.min()), LANDING_PLAYS * play),
    )


def stance_deg(layout: Layout, com_mm: Array, aside_mm: float) -> Array:
    """Return the roll (n,) at which centres of mass (n, 2), x-z in the foot's frame, are above the nearer edge.

    The edge runs from a toe's tip to the nose's lug on the same side.
    """
    back, front = float(toe_tip_mm(layout.design)[0]), layout.design.l4_mm
    wide, narrow = layout.toe_half_width_mm, layout.lateral.lug_left[1]
    slope = (narrow - wide) / (front - back)
    half = wide + slope * (com_mm[:, 0] - back) - abs(aside_mm)
    height = com_mm[:, 1] + layout.sections.ground_mm
    return np.asarray(np.degrees(np.arctan2(half / math.hypot(1.0, slope), height)))


def play_rad(layout: Layout, holes: HoleSizes) -> float:
    """Return by how much the body may roll on its foot to either side (rad): the chain with less play counts.

    Tilt of the ball bearings themselves and bending of pins and links are neglected.
    """
    pin, width = layout.axle_mm, layout.sections.thickness_mm
    eye, loose, lug = (size(pin) - pin for size in (holes.eye, holes.running, holes.lying))
    outside = layout.lateral.outside
    axle = loose / (outside[1] - outside[0] - 2.0 * layout.floor_mm)
    hub = loose / width if layout.hub_bearing is None else 0.0
    leg = eye / width + lug / (2.0 * layout.ankle_face_mm) + hub + axle
    front = 2.0 * eye / width + lug / (2.0 * layout.lateral.lug_left[1]) + axle
    return min(leg, front)


STRONG, CLEAR = Check(limits.toe_findings, limits.BASIS), Check(limits.ground_findings, limits.GROUND_BASIS)
FOOT = Thing(foot_and_toes, foot_hardware, (STRONG, CLEAR, Check(sideways_findings, BASIS)))
