"""The manifest's entries about the rest stop."""

import math
from typing import Any

from jumpcad.robot import Robot

DIGITS = 6


def stop_facts(robot: Robot) -> dict[str, Any]:
    """Return the stop's angle past rest, energy and torque of the leg's impact, and the pad with its compression."""
    stop, blow = robot.layout.stop, robot.stop_blow
    return {
        "angle_deg": round(math.degrees(stop.angle_rad), DIGITS),
        "blow_j": blow.energy_j,
        "torque_nm": blow.torque_nm,
        "pad": stop.pad.name,
        "give_mm": blow.give_mm,
        "give_deg": round(math.degrees(blow.give_rad), DIGITS),
        "radius_mm": stop.radius_mm,
    }
