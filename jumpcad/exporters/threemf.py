"""3MF: one print plate per file, every part a named object (3MF Core Specification 1.3), picture and print settings.

Written without a library: fixed dates and a fixed order give the same bytes, and strict readers report nothing. The
settings are in the two files in which PrusaSlicer keeps those of a project. Other slicers read the geometry alone, so
`print/README.md` has the settings in words.
"""

import io
import zipfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from html import escape  # xml.sax.saxutils imports all of HTTP and TLS
from typing import Any

import numpy as np
import numpy.typing as npt
import trimesh

from jumpcad.catalogue import Pad
from jumpcad.exporters.xml import allowed
from jumpcad.files import templates_folder
from jumpcad.files.templates import fill, render
from jumpcad.parts.plates import Printable, PrintPlate, brim_mm, packed
from jumpcad.printing.prusaslicer import project_settings
from jumpcad.robot.foot.pads import PrintedPad, printed_pads
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.scene.renderer import Renderer, View, png_of
from jumpcad.scene.visuals import PRINTED_COLOURS, Colour
from jumpcad.transforms import in_metres
from jumpcad.workshop import Workshop

FIXED_DATE = (1980, 1, 1, 0, 0, 0)
PICTURE, VIEW = (256, 256), View(yaw_deg=-70.0, pitch_deg=48.0)
BED_MM = 1.0
BED: Colour = (0.80, 0.81, 0.83)


@decided_once
def print_plates(robot: Robot) -> tuple[PrintPlate, ...]:
    """Return a robot's print plates, packed on its workshop's bed, those of pads last."""
    pads = printed_pads(robot.hardware, robot.workshop)
    plates = _packed(robot.parts, robot.workshop)
    return (*plates, *(replace(plate, kind="pads") for plate in _packed(pads, robot.workshop)))


def threemf_files(robot: Robot) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every print plate of a robot, and of `print/README.md`."""
    yield from _files(print_plates(robot), robot.workshop)


def plate_files(parts: Iterable[Printable], workshop: Workshop) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of the print plates of parts, and of `print/README.md`."""
    yield from _files(_packed(parts, workshop), workshop)


def _packed(parts: Iterable[Printable], workshop: Workshop) -> list[PrintPlate]:
    return packed(parts, workshop.printer.bed_mm, workshop.process.part_spacing_mm)


def _files(plates: Sequence[PrintPlate], workshop: Workshop) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of print plates, and of `print/README.md`."""
    printer, process = workshop.printer, workshop.process
    for plate in plates:
        pad = _pad(plate)
        material = pad or workshop.materials[plate.material]
        settings = project_settings(printer, process, material, pad.name if pad else plate.material)
        yield f"print/{plate.name}.3mf", write_threemf(plate, settings, thumbnail(plate, printer.bed_mm))
    yield "print/README.md", _in_words(plates, workshop)


def _pad(plate: PrintPlate) -> Pad | None:
    """Return the kind of pad that a plate has; None for one of parts."""
    first = plate.items[0].part
    return first.pad if isinstance(first, PrintedPad) else None


def write_threemf(plate: PrintPlate, settings: Mapping[str, str], picture: bytes) -> bytes:
    """Return the 3MF file of a plate with PrusaSlicer's settings and a PNG picture; equal inputs give equal bytes."""
    copies = Counter(placed.part.name for placed in plate.items)
    parts = {placed.part.name: placed.part for placed in plate.items}
    objects = [_object(number, part, copies[name]) for number, (name, part) in enumerate(parts.items(), start=1)]
    numbers = {name: number for number, name in enumerate(parts, start=1)}
    # 3MF multiplies row vectors, so poses are written transposed
    items = [(numbers[one.part.name], one.T_bed_part[:3].T.ravel().tolist()) for one in plate.items]
    values = {"title": allowed(plate.name), "objects": objects, "items": items}
    buffer, fixed = io.BytesIO(), templates_folder() / "print"
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as package:
        for name, content in (
            ("[Content_Types].xml", (fixed / "content_types.xml").read_bytes()),
            ("_rels/.rels", (fixed / "relationships.xml").read_bytes()),
            ("3D/3dmodel.model", fill("print/model.xml.j2", values)),
            ("Metadata/thumbnail.png", picture),
            ("Metadata/Slic3r_PE.config", "".join(f"; {key} = {value}\n" for key, value in settings.items())),
            ("Metadata/Slic3r_PE_model.config", fill("print/objects.xml.j2", values)),
        ):
            entry = zipfile.ZipInfo(name, FIXED_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            package.writestr(entry, content)
    return buffer.getvalue()


def _object(number: int, part: Printable, copies: int) -> dict[str, Any]:
    """Return a part as an object; nine digits hold a 32-bit float exactly."""
    return {
        "number": number, "name": escape(allowed(part.name)), "copies": copies, "brim_mm": brim_mm(part),
        "vertices": _lines('<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', part.mesh.vertices.astype(np.float32)),
        "triangles": _lines('<triangle v1="%d" v2="%d" v3="%d"/>\n', part.mesh.faces), "last": len(part.mesh.faces) - 1,
    }  # fmt: skip


def _in_words(plates: Sequence[PrintPlate], workshop: Workshop) -> str:
    """Return the text of `print/README.md`."""
    told = [
        {
            "name": plate.name,
            "material": plate.material,
            "pad": _pad(plate),
            "heats": workshop.materials.get(plate.material),
            "copies": Counter(placed.part.name for placed in plate.items),
        }
        for plate in plates
    ]
    parts = {placed.part.name: placed.part for plate in plates for placed in plate.items}
    brims = {name: brim for name, part in parts.items() if (brim := brim_mm(part))}
    values = {"printer": workshop.printer, "process": workshop.process, "plates": told, "brims": brims}
    return render("print/README.md.j2", values)


def _lines(line: str, rows: npt.NDArray[np.generic]) -> str:
    """Return a line for every row (n, 3), all formatted at once, which is faster than one by one."""
    return line * len(rows) % tuple(rows.ravel().tolist())


def thumbnail(plate: PrintPlate, bed_mm: Sequence[float]) -> bytes:
    """Return the PNG file of a plate on a bed (mm); the same plate gives the same bytes."""
    width, depth = bed_mm[:2]
    bed = trimesh.creation.box((width, depth, BED_MM))
    bed.apply_translation((width / 2.0, depth / 2.0, -BED_MM / 2.0))
    things = [(bed, BED), *((placed.part.shown_mesh, PRINTED_COLOURS["links"]) for placed in plate.items)]
    poses = [np.eye(4), *(in_metres(placed.T_bed_part) for placed in plate.items)]
    return png_of(Renderer(things).picture(poses, PICTURE, VIEW, bed.vertices / 1000.0))
