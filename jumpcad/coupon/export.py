"""The fit coupon's folder: STL and 3MF files, instructions, and a file for the readings.

It is a bundle like a robot's, with a manifest and with the workshop for which it was made.
"""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from jumpcad.bundle.atomic_write import require_place, write_folder
from jumpcad.bundle.manifest import Bundle
from jumpcad.coupon.joints import joint_pieces, seats, steps_mm
from jumpcad.coupon.pieces import PEGS_MM, Piece, coupon_holes, engraved, pieces
from jumpcad.coupon.readings import JOINT_KEYS, floor_breaks_n
from jumpcad.exporters.threemf import plate_files
from jumpcad.files.rendering import render
from jumpcad.parts.holes import HoleSizes
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.solids.finish import require_part
from jumpcad.solids.stl import write_stl
from jumpcad.workshop import Workshop

READINGS = "readings.toml"


def export_coupon(workshop: Workshop, folder: str | Path, force: bool = False) -> Bundle:
    """Write the coupon of a workshop: a gauge in every material of the robot, gears in the gears' material.

    Raises
    ------
    JumpcadError
        If the folder holds anything but a coupon, or one whose readings were filled in (unless `force`), or cannot be
        written.
    CannotBuildError
        If a piece does not fit the bed, or its file is not one closed solid.
    """
    require_place(folder)
    holes = coupon_holes(workshop)
    made = pieces(holes, list(workshop.materials), workshop.material_name("gears")) + joint_pieces(workshop, holes)
    kg = [_mass_kg(piece, workshop) for piece in made]
    masses = [
        {
            "kind": "printed",
            "name": piece.name,
            "quantity": piece.quantity,
            "material": piece.material,
            "mass_kg": mass_kg,
            "source": "printed",
        }
        for piece, mass_kg in zip(made, kg, strict=True)
    ]
    facts = {"mass_kg": sum(kg), "masses": masses}
    return write_folder(folder, "coupon", facts, _contents(workshop, holes, made), force)


def _contents(workshop: Workshop, holes: HoleSizes, made: Sequence[Piece]) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every file, except the manifest."""
    yield "workshop.toml", workshop.to_toml()
    for piece in made:
        stl = write_stl(piece.mesh)
        require_part(piece.name, stl)
        yield f"stl/{piece.name}.stl", stl
    yield from plate_files(made, workshop)
    yield "coupon.md", _guide(workshop, holes)
    yield READINGS, _template(workshop, holes)


def _mass_kg(piece: Piece, workshop: Workshop) -> float:
    density = workshop.materials[piece.material].density_g_cm3
    return mass_properties(piece.shape, density, workshop.process, workshop.printer.nozzle_mm).mass_kg


def _guide(workshop: Workshop, holes: HoleSizes) -> str:
    """Return the instructions."""
    stronger = [one.name for one in seats(workshop)]
    return render(
        "guides/coupon.md.j2",
        {
            "materials": list(workshop.materials),
            "gears": workshop.material_name("gears"),
            "body": workshop.material_name("body"),
            "links": workshop.material_name("links"),
            "screws": workshop.bought.retention == "nuts",
            "axle_mm": workshop.bought.axle_mm,
            "hole_mm": holes.axle_mm,
            "bearing": holes.bearing and holes.bearing.name,
            "bearings": [*([holes.bearing.name] if holes.bearing else []), *stronger],
            "seats": stronger,
            "lying": [engraved(step) for step in steps_mm(workshop.fits.lying_mm)],
            "readings": READINGS,
            "floor_n": math.ceil(floor_breaks_n(workshop)),
        },
    )


def _template(workshop: Workshop, holes: HoleSizes) -> str:
    """Return the file for the readings: every key as a comment, with the workshop's present value."""
    fits = workshop.fits
    lines = [
        "# Readings of the coupon; see coupon.md. Remove the # of a line and write what you found, in mm as engraved.",
        "",
        f"axle_mm = {workshop.bought.axle_mm:g}  # the rods that this coupon is made for: leave it",
    ]
    for name in workshop.materials:
        lines += [
            "",
            f"[gauge.{name}]",
            f"# axle_press_mm = {fits.press_mm:.2f}",
            f"# axle_sliding_mm = {fits.sliding_mm:.2f}",
            f"# axle_loose_mm = {fits.loose_mm:.2f}",
        ]
        if holes.bearing:
            lines.append(f"# bearing_press_mm = {fits.press_mm:.2f}")
        lines.append(f"# pegs_mm = [{', '.join(f'{peg:.2f}' for peg in PEGS_MM)}]")
    lines += ["", "[joints]"]
    lines += [f"# {key} = {getattr(fits, fit):.2f}" for key, (fit, _) in JOINT_KEYS.items()]
    lines.append(f"# floor_n = {math.ceil(floor_breaks_n(workshop))}")
    lines += ["", "[gears]", f"# turns_freely_mm = {fits.backlash_circumferential_mm:.2f}", ""]
    return "\n".join(lines)
