"""The fit coupon's files: STL and 3MF, pictures, instructions, and a file for the readings."""

import math
import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from jumpcad.building.bom import mass_facts
from jumpcad.coupon import pieces as gauge
from jumpcad.coupon.joints import joint_pieces, seats, steps_mm
from jumpcad.coupon.readings import JOINT_KEYS, floor_breaks_n
from jumpcad.exporters.threemf import plate_files
from jumpcad.files.templates import fill, render
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import MassLine, Piece
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.scene.labels import labelled
from jumpcad.scene.renderer import COMPRESSION, MM, Renderer, View, aimed, paletted, png_of
from jumpcad.solids.stl import require_part, write_stl
from jumpcad.transforms import Array, Trimesh, pose_at
from jumpcad.workshop import Workshop

GROUPS = {
    "joints": {
        "taps": "m2_tap_mm", "shaft_bores": "rib_mm", "lying_holes": "lying_mm", "dog_jaws": "dog_sliding_mm",
        r"dog_pockets_.*": "", "motor_sockets": "socket_sliding_mm", "tray_slots": "tray_sliding_mm", "tray_tab": "",
        "seat": "seat_press_mm", "axle_floor": "floor_n",
    },
    "gears": {"gear_holder": "", "gear_wheel": "", r"pinion_.*": "turns_freely_mm"},
}  # fmt: skip
"""Pictures by name: patterns of their pieces' names, and the reading that each gives."""
ROWS = {"A": "axle: press, sliding, loose", "B": "bearing: press", "P": "pegs: callipers"}
COLOUR = (0.55, 0.66, 0.80)
ABOVE = View(yaw_deg=-90.0, pitch_deg=62.0)
WIDTH_MM, GAP_MM = 110.0, 8.0
"""Of a row of pieces, and between them."""
SIZE, MARGIN_PX = (620, 460), 230


def coupon_pictures(made: Sequence[Piece], holes: HoleSizes) -> dict[str, bytes]:
    """Return the PNG files by name: a gauge, the joints, the gears."""
    first = next(piece for piece in made if piece.name.startswith("gauge_"))
    rows = gauge.gauge_rows(holes, gauge.series_of(holes))
    peg_x = gauge.TITLE_MM + 2.0 * gauge.MARGIN_MM + max(row.size_mm for row in rows) / 2.0 + gauge.MARGIN_MM
    edge, peg = (first.mesh.bounds[1, 0], gauge.GAUGE_MM), (peg_x, gauge.GAUGE_MM + gauge.PEG_HEIGHT_MM / 2.0)
    points = [
        (f"{row.letter}, {ROWS[row.letter]}", np.insert(peg if row.pegs else edge, 1, middle))
        for row, middle in zip(rows, gauge.row_middles_mm(rows), strict=True)
        if row.letter
    ]
    pictures = {"gauge": _picture([first.shown_mesh], [np.zeros(3)], points)}
    for name, patterns in GROUPS.items():
        chosen = [
            (piece, reading) for piece in made for key, reading in patterns.items() if re.fullmatch(key, piece.name)
        ]
        places = _laid_out([piece.mesh for piece, _ in chosen])
        points = [
            (f"{piece.name}: {reading}" if reading else piece.name, place + piece.mesh.bounds.mean(axis=0))
            for (piece, reading), place in zip(chosen, places, strict=True)
        ]
        pictures[name] = _picture([piece.shown_mesh for piece, _ in chosen], places, points)
    return pictures


def _laid_out(meshes: Sequence[Trimesh]) -> list[Array]:
    """Return where meshes go (3,) so that they lie in rows, none over another (mm)."""
    x = y = deep = 0.0
    places = []
    for mesh in meshes:
        low, high = mesh.bounds
        if x and x + high[0] - low[0] > WIDTH_MM:
            x, y, deep = 0.0, y - deep - GAP_MM, 0.0
        places.append(np.array([x - low[0], y - high[1], -low[2]]))
        x, deep = x + float(high[0] - low[0]) + GAP_MM, max(deep, float(high[1] - low[1]))
    return places


def _picture(meshes: Sequence[Trimesh], places: Sequence[Array], points: Sequence[tuple[str, Array]]) -> bytes:
    corners = np.concatenate([mesh.bounds + place for mesh, place in zip(meshes, places, strict=True)])
    frame = np.round(MM * corners, 6)
    poses: list[Array | None] = [pose_at(np.eye(3), MM * place) for place in places]
    picture = Renderer([(mesh, COLOUR) for mesh in meshes]).picture(poses, SIZE, ABOVE, frame)
    camera = aimed(frame, ABOVE, SIZE[0] / SIZE[1])
    seen = np.round(camera.seen(MM * np.array([at for _, at in points]), SIZE)[0], 2)
    sheet = labelled(picture, [words for words, _ in points], seen, seen, MARGIN_PX)
    return png_of(paletted(sheet), compress_level=COMPRESSION)


READINGS = "readings.toml"


def coupon_pieces(workshop: Workshop) -> list[Piece]:
    """Return what is printed: a gauge in every material of the robot, gears in the gears' material, the joints."""
    holes = gauge.coupon_holes(workshop)
    gears = workshop.material_name("gears")
    return [*gauge.pieces(holes, list(workshop.materials), gears), *joint_pieces(workshop, holes)]


def coupon_masses(made: Sequence[Piece], workshop: Workshop) -> dict[str, Any]:
    """Return a manifest's entries about the masses of the pieces."""
    masses = []
    for one in made:
        density = workshop.materials[one.material].density_g_cm3
        found = mass_properties(one.shape, density, workshop.process, workshop.printer.nozzle_mm)
        masses.append(MassLine("printed", one.name, one.quantity, one.material, found.mass_kg, "printed"))
    return {"mass_kg": sum(line.mass_kg for line in masses), "masses": mass_facts(masses)}


def coupon_files(workshop: Workshop, made: Sequence[Piece], pictures: bool = True) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every file of the coupon."""
    holes = gauge.coupon_holes(workshop)
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


def coupon_values(workshop: Workshop, holes: HoleSizes) -> dict[str, Any]:
    """Return what the templates of the instructions and of the file for the readings say."""
    stronger = [one.name for one in seats(workshop)]
    return {
        "materials": list(workshop.materials),
        **{role: workshop.material_name(role) for role in ("gears", "body", "links")},
        "screws": workshop.bought.retention == "nuts", "axle_mm": workshop.bought.axle_mm, "hole_mm": holes.axle_mm,
        "bearing": holes.bearing and holes.bearing.name,
        "bearings": [*([holes.bearing.name] if holes.bearing else []), *stronger], "seats": stronger,
        "lying": [gauge.engraved(step) for step in steps_mm(holes.fits.lying_mm)], "readings": READINGS,
        "floor_n": math.ceil(floor_breaks_n(workshop)), "fits": holes.fits, "pegs_mm": gauge.PEGS_MM,
        "press_hole": gauge.engraved(holes.fits.press_mm), "joints": {key: fit for key, (fit, _) in JOINT_KEYS.items()},
    }  # fmt: skip
