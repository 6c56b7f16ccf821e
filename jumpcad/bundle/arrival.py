"""The guide's section on what to check when things arrive: springs on a kitchen scale, fits, rods, electrics."""

import math
from collections.abc import Iterator

from jumpcad.bundle.spring_sheet import scale_in_words
from jumpcad.bundle.springs import (
    PAIR_PERCENT,
    allowable_mpa,
    arms_off_deg,
    early_torque_share,
    least_energy_share,
    loaded_arms,
    torque_shares,
)
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.drive import TorsionSpring
from jumpcad.electronics.chosen import chosen_parts
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


def arrival_lines(robot: Robot) -> Iterator[str]:
    """Yield the section."""
    yield from ("", "## When things arrive", "")
    yield from _springs(robot)
    yield (
        f"**Fits.** A rod of {robot.layout.axle_mm:g} mm must drop through the spacers and turn in the plates' bores; "
        "the motor must slide into its socket without force. A bore that is too tight: turn a drill or reamer of "
        f"{robot.layout.axle_mm + REAMED_MM:g} mm through it by hand. One in which a rod rocks by more than 0.3 mm, "
        "or a bearing that falls out of its seat: a thin coat of super glue on the wall, left to harden before the "
        "rod goes in. More than a few such: the printer's fits differ from those computed. Print the fit coupon "
        "(`jumpcad coupon --workshop workshop.toml -o coupon`), write its readings into `coupon/readings.toml`, then "
        "`jumpcad coupon --measured coupon/readings.toml --workshop workshop.toml -o mine.toml` and "
        "`jumpcad build design.toml --workshop mine.toml`: workshop.toml and design.toml are in this folder."
    )
    yield ""
    battery = chosen_parts(robot.workshop).battery
    yield (
        f"**Battery.** {battery.range_v[0]:g} to {battery.range_v[1]:g} V at its plug, not swollen, no larger than the "
        "bill says; its plus must meet the plus of the robot's plug. **Motor.** With 3 V at its leads (two "
        f"AA cells) the shaft turns; its flat is {robot.layout.drive.train.motor.shaft_flat_mm:g} mm thick."
    )


def _springs(robot: Robot) -> Iterator[str]:
    """Yield how a spring is accepted: by one reading, its torque where the robot loads it."""
    spring, scatter = robot.layout.drive.spring, robot.workshop.safety.spring_rate_scatter
    lever, grams, wound = spring.arms.lever_mm, loaded_grams(spring), math.degrees(spring.wound_rad)
    least, most = torque_shares(robot)
    narrower, wider = arms_off_deg(robot)
    free = math.degrees(spring.free_arm_angle_rad)
    shank = math.floor(2.0 * spring.mandrel_mm) / 2.0
    yield from (
        f"**Springs.** Glasses on. Relaxed, the arms are {free - narrower:.0f} to {free + wider:.0f}° apart "
        f"(drawing in order/, {scale_in_words(spring)}, ordered {free:.0f}°). Wider ones are not used: they load the "
        f"motor at the beginning of the lift, {wider:.0f}° by up to "
        f"{100.0 * (early_torque_share(robot) - 1.0):.0f} % more than computed. One "
        "reading on a kitchen scale then accepts a spring: its torque with the arms where the loaded robot holds them, "
        "so that angle and rate count together.",
        "",
        f"Clamp a wooden board upright in a vice, bore a hole through it and push in the shank of a drill, {shank:g} "
        "mm or a little less, level and fast. Put the coil on it. Draw two "
        f"lines on a card on the board behind it, both touching a circle of {spring.arms.mean_mm:.1f} mm around "
        "the drill: one "
        "level to the side, from the circle's lowest point, and one as the arm at the nail stands when both are "
        f"{loaded_arms(robot)} (dashed in the drawing; turn it until its nearer arm is "
        "the level one). A nail in the board keeps that arm on its line, "
        f"{lever:.1f} mm from the circle. Below the level line, on the scale, stands a block with a smooth, oiled "
        f"edge, narrower than the coil is long, {lever:.1f} mm to the side of the drill's middle; set the scale to "
        "zero with the block on it. Raise the scale by pushing two wedges below it, from both sides: "
        "the edge lifts the other arm and the spring closes. Stop when the arm at the edge is on the level line, and "
        "read; go a little higher, come back to the line and read again. The mean of both is free of friction:",
        "",
        f"- **accept {least * grams:.0f} to {most * grams:.0f} g** ({grams:.0f} g as computed), and of several the "
        f"right-hand and the left-hand one nearest to {grams:.0f} g that agree within {PAIR_PERCENT} %",
        f"- more is not used: {most * grams:.0f} g are {100.0 * (most - 1.0):.0f} % more torque than computed, with "
        f"{most * spring.stress_mpa:.0f} MPa in the wire ({allowable_mpa(robot):.0f} allowed); the parts' reserve is "
        f"{100.0 * scatter:.0f} %",
        "- less harms nothing, the robot jumps shorter: a pair with the lowest rate and the narrowest arms stores "
        f"{100.0 * (1.0 - least_energy_share(robot)):.0f} % less energy",
        "",
        "The rate, for information: a rejected spring is stiff or has wide arms. Relaxed, the arm at the edge points "
        "level to the side; the nail holds the other one where it then is. Raised by an angle of the table, the scale "
        "reads:",
        "",
        f"| turned by | scale, as computed | rate within {100.0 * scatter:.0f} % |",
        "|--:|--:|--:|",
    )
    for angle in AT_DEG:
        if angle <= wound + 1e-9:
            read = grams_at(spring, angle)
            yield f"| {angle:.0f}° | {read:.0f} g | {(1.0 - scatter) * read:.0f} to {(1.0 + scatter) * read:.0f} g |"
    yield from (
        "",
        "Hands: held upright, the wire in front of a right-hand coil rises to the right, like the thread of a usual "
        "screw.",
        "",
    )
