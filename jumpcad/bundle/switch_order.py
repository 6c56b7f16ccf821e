"""What a slide switch must be like, and the nearest article: shops sell many of one name."""

from collections.abc import Iterator

from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.parts.fittings import KNOB_MM, SWITCH_SCREWS_MM
from jumpcad.parts.wired import SWITCH_EAR_MM
from jumpcad.robot import Robot

SIMILAR_SWITCH, SIMILAR_A = "SS-12F15 G5", 0.5
"""A slide switch of that size, and what sellers rate it at most (0.3 or 0.5 A at 50 V). Sizes as public bills of
material state them (several projects, the same figures); holes and height behind the ears: BOM.md of
github.com/morria/pocket-cat, which scaled the distance of the holes off the maker's drawing."""
SIMILAR_SLIDER_MM = 5.0
SIMILAR_FITS = (
    "19.8 x 5.6 mm (0.2 mm longer than drawn, which the room around it bears), 5.0 mm high behind its ears, slider 3 x "
    f"3 x {SIMILAR_SLIDER_MM:g} mm that goes 3 mm. The holes of its ears, 2.2 mm "
    "without thread, are 14.4 mm apart as scaled off a drawing: the screws, each with a nut, then pass with no play "
    "left; where they do not, open the plate's holes to 2.8 mm with a drill. Not tried; no price with a date is known"
)
NO_SWITCH = (
    ". Found none: leave the switch and "
    "its two screws out, and solder the wires of switch 2 to those of switch 1. The battery's plug is then the "
    "switch: solder the robot's half to leads of 50 mm that come out between the plates, with a loop of 60 mm of cord "
    "tied "
    "behind the battery's half to pull it by. Where this guide says switch on, plug it in; where it says switch off, "
    "pull it out; currents are read with the multimeter in place of its red wire"
)
"""For one cell; judgement."""
NEEDS_SWITCH = (
    ". The kit of two cells is not built without a switch: its plug would spark and leave no quick way to stop. Found "
    "none that fits the plate: any small one of that current and voltage, soldered to the same leads, its terminals "
    "under heat-shrink tube, held on the front standoff by two cable ties, clear of leg and gears; its two screws are "
    "left out"
)
"""For more cells; judgement."""
SLIDER_MM = 1.5
"""Of a switch's slider outside the plate, for a fingertip; judgement."""


def switch_order(robot: Robot) -> Iterator[str]:
    """Yield the guide's line on the switch, if the robot has one."""
    fittings, lateral = robot.layout.fittings, robot.layout.lateral
    if fittings.switch is None or fittings.switch_mm is None:
        return
    switch, plate = fittings.switch, lateral.inside[0] - lateral.outside[0]
    chosen, motor, safety = chosen_parts(robot.workshop), robot.layout.drive.train.motor, robot.workshop.safety
    supply = supply_of(chosen)
    blocked_a = supply.driven(motor, supply.full_v, safety.motor_torque_max_nm).stall_current_a
    needed_mm = plate + SLIDER_MM
    short = ". Its slider is too short for this plate: a smaller body.plate_mm, or another switch"
    enough = f"one rated {SIMILAR_A:g} A bears that" if blocked_a <= SIMILAR_A else "too little for this motor"
    yield (
        f"- slide switch: {2.0 * SWITCH_SCREWS_MM:g} mm between the holes of its ears, at most {switch.length_mm:g} x "
        f"{switch.width_mm:g} mm, {switch.height_mm:g} mm high behind its ears, {switch.rated_a:g} A or more at "
        f"{supply.full_v:g} V (the blocked motor draws {blocked_a:.2f} A). Its "
        f"slider passes a slot of {KNOB_MM[0]:g} x {KNOB_MM[1]:g} mm, both positions, in a plate of {plate:.1f} mm: it "
        f"must stand out of the ears by {needed_mm:.1f} mm or more. Ears without thread: two screws "
        f"{nutted_screw(robot)} and two nuts M2 in place of the bill's screws. No article with all of it is known "
        f"here. The nearest is {SIMILAR_SWITCH}, which sellers rate 0.3 or {SIMILAR_A:g} A at 50 V ({enough}): "
        f"{SIMILAR_FITS}"
        f"{short if needed_mm > SIMILAR_SLIDER_MM else ''}"
        f"{NO_SWITCH if chosen.battery.cells == 1 else NEEDS_SWITCH}"
    )


def nutted_screw(robot: Robot) -> str:
    """Return the screws that hold a switch whose ears have no thread: through plate and ear, with a nut behind."""
    catalogue, lateral = robot.workshop.catalogue, robot.layout.lateral
    screw, plate = catalogue.screws["M2"], lateral.inside[0] - lateral.outside[0]
    return f"M2 x {screw.length_for(plate + SWITCH_EAR_MM + catalogue.nuts['M2'].height_mm):g} {screw.norm}"
