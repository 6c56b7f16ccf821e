"""The guide's section on tools."""

import math
from collections.abc import Iterator

from jumpcad.bundle.arrival import REAMED_MM, scale_range_kg
from jumpcad.bundle.operation import charger
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files.markdown import plain
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import Step

ROD_ROOM_MM = 0.5
"""By which a rod is thinner than the hole that it passes, at least."""
PLUG_ROOM_MM = 0.5
"""By which the body of a USB plug is smaller than its window."""


def tool_lines(robot: Robot, steps: list[Step]) -> Iterator[str]:
    """Yield the guide's section on tools."""
    names = sorted({placed.move.tool.name for step in steps for placed in step.placed if placed.move.tool})
    yield from ("", "## Tools", "")
    yield f"- {', '.join(names)}"
    yield (
        f"- drill or reamer {robot.layout.axle_mm + REAMED_MM:g} mm, drill 2.8 mm for a switch's screws with nuts, tap "
        "M3, vice with flat jaws, small flat "
        "screwdriver, side cutters"
    )
    chosen = chosen_parts(robot.workshop)
    needed = ""
    if not chosen.charged_by_usb:
        adapter = f" and an adapter to {plain(chosen.battery.plug)}" if chosen.battery.plug else ""
        needed = f", LiPo {charger(chosen.battery)}{adapter}"
    plug = robot.layout.fittings.usb_size_mm if robot.layout.fittings.usb_mm is not None else None
    body = "" if plug is None else f", plug body at most {plug[0] - PLUG_ROOM_MM:g} x {plug[1] - PLUG_ROOM_MM:g} mm"
    yield (
        "- soldering iron, wire stripper, heat gun or lighter for the tube, multimeter with a 10 A range, two leads "
        "with crocodile clips, computer, "
        f"USB cable with data lines{body}{needed}"
    )
    yield "- on the computer: Python with `pip install esptool mpremote` (firmware/README.md)"
    yield (
        f"- kitchen scale to 1 g or better, up to {scale_range_kg(robot):g} kg; pocket scale to 0.1 g or better, for "
        "the printed parts; caliper, protractor, two AA cells in a holder"
    )
    yield (
        "- for the springs' test: a wooden board, 20 mm or thicker, that the vice holds upright, with its drill and a "
        "nail in it, card, a block with a smooth edge, two wedges below the scale, a drop of oil"
    )
    if any(", grooves " in item.article for item in robot.hardware):
        yield (
            "- for the clips' grooves, where nobody turns them: drill with a chuck, held down by a clamp, thin cut-off "
            "disc or file (Order and cut)"
        )
    if robot.layout.leg_bar is not None:
        yield (
            "- for the legs' bars: fine saw, sandpaper, mask (FFP2), gloves, epoxy, a flat plate, baking paper under "
            "the joints, two rods of the axles' diameter through the eyes, caliper"
        )
    rod = math.floor(2.0 * (robot.layout.pin_hole.diameter_mm - ROD_ROOM_MM)) / 2.0
    yield (
        f"- rod of at most {rod:g} mm, 60 mm or longer, for the springs' pin through its hole in the left plate; block "
        "of wood that supports the motor while the pinion is pressed on; super glue"
    )
    yield (
        "- cut-off disc, file, fine emery cloth, fine saw, knife, tweezers, 1 m of cord, thin wooden stick, glasses "
        "that "
        "close at the sides"
    )
