"""The guide's section on what to check when things arrive: springs on a kitchen scale, fits, rods, electrics."""

import math
from collections.abc import Iterator

from jumpcad.bundle.springs import arms_off_deg
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


def scale_range_kg(robot: Robot) -> float:
    """Return the range of a scale for the springs' test, in whole kilograms: the stiffest spring that is accepted."""
    scatter = robot.workshop.safety.spring_rate_scatter
    most = max(grams_at(robot.layout.drive.spring, angle) for angle in AT_DEG)
    return math.ceil((1.0 + scatter) * most / 1000.0)


def arrival_lines(robot: Robot) -> Iterator[str]:
    """Yield the section."""
    spring, scatter = robot.layout.drive.spring, robot.workshop.safety.spring_rate_scatter
    lever = spring.arms.lever_mm
    free, wound = math.degrees(spring.free_arm_angle_rad), math.degrees(spring.wound_rad)
    preload = math.degrees(spring.preload_rad)
    narrower, wider = arms_off_deg(robot)
    less, more = (
        (max(0.0, wound + by) ** 2 - max(0.0, preload + by) ** 2) / (wound**2 - preload**2) for by in (-narrower, wider)
    )
    shank = math.floor(2.0 * spring.mandrel_mm) / 2.0
    yield from ("", "## When things arrive", "")
    yield from (
        f"**Springs.** Glasses on. Relaxed, the arms are {free - narrower:.0f} to {free + wider:.0f}° apart "
        "(protractor, or the drawing in order/ at 3:1). Of several take the nearest to "
        f"{free:.0f}°: both springs {narrower:.0f}° narrower store {100.0 * (1.0 - less):.0f} % less energy, "
        f"{wider:.0f}° wider {100.0 * (more - 1.0):.0f} % more, with {100.0 * wider / wound:.0f} % more torque. Wider "
        f"ones are not used: the parts' reserve for strong springs is {100.0 * scatter:.0f} %.",
        "",
        f"Rate: clamp the shank of a drill, {shank:g} mm or a little less, level in a vice and put the coil on it, a "
        "nail beside one arm so that it cannot turn. The other arm points level to the side and leaves the coil at "
        "its underside. Below it, on a kitchen scale, stands a block with a smooth, oiled edge, which touches the arm "
        f"{lever:.1f} mm to the side of the drill's middle. Raise the scale until the arm has turned by an angle of "
        "the table (draw it on card behind the arm): the spring closes. Read:",
    )
    yield from ("", "| turned by | scale, as computed | accept |", "|--:|--:|--:|")
    for angle in AT_DEG:
        if angle <= math.degrees(spring.wound_rad) + 1e-9:
            grams = grams_at(spring, angle)
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
        "bill says; its plus must meet the plus of the robot's plug. **Motor.** With 3 V at its leads (two "
        f"AA cells) the shaft turns; its flat is {robot.layout.drive.train.motor.shaft_flat_mm:g} mm thick."
    )
