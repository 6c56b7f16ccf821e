"""What is measured when things arrive: springs on a kitchen scale."""

import math
from typing import Any

from jumpcad.bundle.drawings.spring_sheet import scale_in_words
from jumpcad.bundle.springs import early_torque_share, least_energy_share, torque_shares
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.drive import TorsionSpring
from jumpcad.robot.robot import Robot

REAMED_MM = 0.1
"""Of a reamed bore over its rod, in diameter."""


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
    return {
        "reamed_mm": robot.layout.axle_mm + REAMED_MM,
        "drawn_scale": scale_in_words(spring),
        "shank_mm": math.floor(2.0 * spring.mandrel_mm) / 2.0,
        "grams": loaded_grams(spring),
        "least_share": least,
        "most_share": most,
        "early_share": early_torque_share(robot),
        "weak_share": least_energy_share(robot),
        "scale_kg": scale_range_kg(robot),
    }
