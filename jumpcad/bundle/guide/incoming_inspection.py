"""What is measured when things arrive: springs on a kitchen scale."""

import math
from typing import Any

from jumpcad.bundle.drawings.spring_sheet import scale_in_words
from jumpcad.bundle.springs import allowable_mpa, early_torque_share, least_energy_share, torque_shares
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.drive import TorsionSpring
from jumpcad.robot import Robot

REAMED_MM = 0.1
"""Of a reamed bore over its rod, in diameter."""
AT_DEG = (10.0, 20.0)
"""Angles of the springs' test. With more the arm slides along the edge, and friction there counts."""


def grams_at(spring: TorsionSpring, angle_deg: float) -> float:
    """Return what a scale reads below an arm that leaves the coil at its underside and has turned by an angle.

    The edge stays at a distance L to the side of the coil's axis, and its force is normal to the arm. The arm's point
    on the coil is r·sin(angle) nearer, so that the force's lever is (L - r·sin)/cos of it; the scale reads the force's
    upright part: M·cos²/(L - r·sin).
    """
    turned = math.radians(angle_deg)
    lever = spring.arms.lever_mm - spring.arms.mean_mm / 2.0 * math.sin(turned)
    torque = spring.rate_nmm_per_deg * angle_deg
    return 1000.0 * torque * math.cos(turned) ** 2 / lever / GRAVITY_M_S2


def loaded_grams(spring: TorsionSpring) -> float:
    """Return what a scale reads below an arm that is level and loaded as at the end of the lift."""
    return 1000.0 * spring.torque_nmm / spring.arms.lever_mm / GRAVITY_M_S2


def scale_range_kg(robot: Robot) -> float:
    """Return the range of a scale for the springs' test, in whole kilograms: a stiff spring's reading."""
    scatter = robot.workshop.safety.spring_rate_scatter
    return math.ceil((1.0 + scatter) * loaded_grams(robot.layout.drive.spring) / 1000.0)


def inspection_values(robot: Robot) -> dict[str, Any]:
    """Return what accepts a spring (g, °, mm, MPa), by the names that templates use."""
    spring, (least, most) = robot.layout.drive.spring, torque_shares(robot)
    wound = math.degrees(spring.wound_rad)
    return {
        "reamed_mm": robot.layout.axle_mm + REAMED_MM,
        "drawn_scale": scale_in_words(spring),
        "shank_mm": math.floor(2.0 * spring.mandrel_mm) / 2.0,
        "grams": loaded_grams(spring),
        "least_share": least,
        "most_share": most,
        "most_mpa": allowable_mpa(robot),
        "early_share": early_torque_share(robot),
        "weak_share": least_energy_share(robot),
        "scale_rows": [(angle, grams_at(spring, angle)) for angle in AT_DEG if angle <= wound + 1e-9],
        "scale_kg": scale_range_kg(robot),
    }
