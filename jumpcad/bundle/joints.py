"""The manifest's entries about axle retention, and about the robot's roll on its foot."""

import math
from typing import Any

from jumpcad.checks.sideways import play_rad, rolls
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot import Robot

DIGITS = 3


def joint_facts(robot: Robot) -> dict[str, Any]:
    """Return the retention of axles and pins, the pinion's fit, and the roll in every state (mm, °).

    `play_deg` is the roll of the body on its foot to either side, as drawn. `pinion_rib_mm` is the overlap of the ribs
    in the pinion's bore with the motor's shaft (a press fit without play).
    """
    layout, workshop = robot.layout, robot.workshop
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    return {
        "retention": layout.retention,
        "axle": workshop.bought.axle,
        "axle_mm": layout.axle_mm,
        "pinion_rib_mm": workshop.fits.rib_mm,
        "play_deg": round(math.degrees(play_rad(layout, holes)), DIGITS),
        "toe_half_width_mm": round(layout.toe_half_width_mm, DIGITS),
        "roll_deg": {
            roll.state: {"stance": round(roll.stance_deg, DIGITS), "play": round(roll.play_deg, DIGITS)}
            for roll in rolls(robot)
        },
    }
