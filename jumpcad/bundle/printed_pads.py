"""What the guide says of printed pads: which files, of what, how, and the glue for them."""

from collections.abc import Iterator

from jumpcad.exporters.threemf import pad_plates
from jumpcad.files.markdown import plain
from jumpcad.parts.pads import printed_pads
from jumpcad.printing.project import PADS_HOW
from jumpcad.robot import Robot


def pad_rows(robot: Robot) -> Iterator[str]:
    """Yield the rows of pads in the table of plates, and below it how they are printed."""
    pads = printed_pads(robot.hardware, robot.workshop)
    kinds = {one.material: one.pad.description for one in pads}
    for plate in pad_plates(pads, robot.workshop):
        named = ", ".join(item.part.name for item in plate.items)
        yield f"| print/{plate.name}.3mf | {plain(kinds[plate.material])} | {named} |"
    if pads:
        files = ", ".join(f"stl/{one.name}.stl" for one in pads)
        yield from ("", f"Pads (print/pads-…): {PADS_HOW}. One of each is needed; one by one they are {files}.")


def pads_order(robot: Robot) -> Iterator[str]:
    """Yield the filament of each kind of printed pad, and the glue."""
    pads = printed_pads(robot.hardware, robot.workshop)
    for kind in sorted({one.pad.description for one in pads}):
        grams = sum(1000.0 * one.item.mass_kg for one in pads if one.pad.description == kind)
        yield f"- filament for the printed pads, {plain(kind)}: {grams:.1f} g, and what the printer needs to begin"
    if pads:
        yield (
            "- super glue (cyanoacrylate), one that stays flexible if you can get it, for the printed pads "
            "(judgement): try it on two pieces of waste first, and peel"
        )
