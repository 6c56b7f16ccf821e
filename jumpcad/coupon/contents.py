"""The fit coupon's files: STL and 3MF, pictures, instructions, and a file for the readings."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from jumpcad.building.bom import mass_facts
from jumpcad.coupon.joints import joint_pieces, seats, steps_mm
from jumpcad.coupon.pictures import coupon_pictures
from jumpcad.coupon.pieces import PEGS_MM, Piece, coupon_holes, engraved, pieces
from jumpcad.coupon.readings import JOINT_KEYS, floor_breaks_n
from jumpcad.exporters.threemf import plate_files
from jumpcad.files.rendering import fill, render
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.mass_line import MassLine
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.solids.finish import require_part
from jumpcad.solids.stl import write_stl
from jumpcad.workshop import Workshop

READINGS = "readings.toml"


def coupon_pieces(workshop: Workshop) -> list[Piece]:
    """Return what is printed: a gauge in every material of the robot, gears in the gears' material, the joints."""
    holes = coupon_holes(workshop)
    return pieces(holes, list(workshop.materials), workshop.material_name("gears")) + joint_pieces(workshop, holes)


def coupon_masses(made: Sequence[Piece], workshop: Workshop) -> dict[str, Any]:
    """Return a manifest's entries about the masses of the pieces."""
    masses = [
        MassLine("printed", one.name, one.quantity, one.material, _mass_kg(one, workshop), "printed") for one in made
    ]
    return {"mass_kg": sum(line.mass_kg for line in masses), "masses": mass_facts(masses)}


def coupon_files(workshop: Workshop, made: Sequence[Piece], pictures: bool = True) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every file of the coupon.

    Raises
    ------
    CannotBuildError
        If a piece does not fit the bed, or its file is not one closed solid.
    """
    holes = coupon_holes(workshop)
    for piece in made:
        stl = write_stl(piece.mesh)
        require_part(piece.name, stl)
        yield f"stl/{piece.name}.stl", stl
    yield from plate_files(made, workshop)
    shown = coupon_pictures(made, holes) if pictures else {}
    for name, png in shown.items():
        yield f"pictures/{name}.png", png
    values = {**coupon_values(workshop, holes), "pictures": list(shown)}
    yield "coupon.md", render("guides/coupon.md.j2", values)
    yield READINGS, fill("guides/readings.toml.j2", values)


def _mass_kg(piece: Piece, workshop: Workshop) -> float:
    density = workshop.materials[piece.material].density_g_cm3
    return mass_properties(piece.shape, density, workshop.process, workshop.printer.nozzle_mm).mass_kg


def coupon_values(workshop: Workshop, holes: HoleSizes) -> dict[str, Any]:
    """Return what the templates of the instructions and of the file for the readings say."""
    stronger = [one.name for one in seats(workshop)]
    return {
        "materials": list(workshop.materials),
        **{role: workshop.material_name(role) for role in ("gears", "body", "links")},
        "screws": workshop.bought.retention == "nuts",
        "axle_mm": workshop.bought.axle_mm,
        "hole_mm": holes.axle_mm,
        "bearing": holes.bearing and holes.bearing.name,
        "bearings": [*([holes.bearing.name] if holes.bearing else []), *stronger],
        "seats": stronger,
        "lying": [engraved(step) for step in steps_mm(holes.fits.lying_mm)],
        "readings": READINGS,
        "floor_n": math.ceil(floor_breaks_n(workshop)),
        "fits": holes.fits,
        "press_hole": engraved(holes.fits.press_mm),
        "pegs_mm": PEGS_MM,
        "joints": {key: fit for key, (fit, _) in JOINT_KEYS.items()},
    }
