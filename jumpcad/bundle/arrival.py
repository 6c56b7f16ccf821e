"""The guide's section on what to check when things arrive: springs on a kitchen scale, fits, rods, electrics."""

import math
from collections.abc import Iterator

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.robot import Robot

REAMED_MM = 0.1
"""Of a reamed bore over its rod, in diameter."""
AT_DEG = (10.0, 20.0, 30.0)


def arrival_lines(robot: Robot) -> Iterator[str]:
    """Yield the section."""
    spring, scatter = robot.layout.drive.spring, robot.workshop.safety.spring_rate_scatter
    lever = spring.arms.lever_mm
    yield from ("", "## When things arrive", "")
    yield (
        "**Springs.** Hold a rod that fills the coil level in a vice, a nail beside one arm so that it cannot turn. "
        "Lay the other arm level on a block on a kitchen scale, so that it touches "
        f"{lever:.1f} mm along the arm from where it leaves the coil. Raise the scale until the arm has turned by an "
        "angle of the table, in the closing direction (draw the angle on card behind it), and read:"
    )
    yield from ("", "| turned by | scale, as computed | accept |", "|--:|--:|--:|")
    for angle in AT_DEG:
        if angle <= math.degrees(spring.wound_rad) + 1e-9:
            grams = 1000.0 * spring.rate_nmm_per_deg * angle / lever / GRAVITY_M_S2
            low, high = (1.0 - scatter) * grams, (1.0 + scatter) * grams
            yield f"| {angle:.0f}° | {grams:.0f} g | {low:.0f} to {high:.0f} g |"
    yield from (
        "",
        "Both springs must agree within 5 %. Hands: held upright, the wire in front of a right-hand coil rises to the "
        "right, like the thread of a usual screw.",
        "",
    )
    yield (
        f"**Fits.** A rod of {robot.layout.axle_mm:g} mm must drop through the spacers and turn in the plates' bores; "
        "the motor must slide into its socket without force. A bore that is too tight: turn a drill or reamer of "
        f"{robot.layout.axle_mm + REAMED_MM:g} mm through it by hand. One in which a rod rocks by more than 0.3 mm, "
        "or a bearing that falls out of its seat: a thin coat of super glue on the wall, left to harden before the "
        "rod goes in. More than a few such: the printer's fits differ from those computed. Print the fit coupon "
        "(`jumpcad coupon -o coupon`), write its readings into `coupon/readings.toml`, then "
        "`jumpcad coupon --measured coupon/readings.toml --workshop workshop.toml -o mine.toml` and "
        "`jumpcad build design.toml --workshop mine.toml`: workshop.toml and design.toml are in this folder."
    )
    yield ""
    battery = chosen_parts(robot.workshop).battery
    yield (
        f"**Battery.** {battery.range_v[0]:g} to {battery.range_v[1]:g} V at its plug, not swollen, no larger than the "
        "bill says; its plus must meet the plus of the robot's plug. **Motor.** With 3 V at its leads the shaft "
        f"turns; its flat is {robot.layout.drive.train.motor.shaft_flat_mm:g} mm thick."
    )
