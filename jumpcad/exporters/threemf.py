"""3MF: one plate per file, every part a named object (3MF Core Specification 1.3).

Written here and not by a library: fixed dates and a fixed order give the same bytes, and strict readers report nothing.
"""

import io
import zipfile
from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import numpy.typing as npt

from jumpcad.exporters.xml import allowed
from jumpcad.printing.plates import Placed, Printable, PrintPlate, packed
from jumpcad.robot import Robot

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
FIXED_DATE = (1980, 1, 1, 0, 0, 0)

CONTENT_TYPES = (
    f'{XML}<Types xmlns="{PACKAGE}/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
    "</Types>\n"
)
RELATIONSHIPS = (
    f'{XML}<Relationships xmlns="{PACKAGE}/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="rel0" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
    "</Relationships>\n"
)


def threemf_files(robot: Robot) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every print plate, the parts packed on the workshop's bed."""
    bed, spacing = robot.workshop.printer.bed_mm, robot.workshop.process.part_spacing_mm
    for plate in packed(robot.parts, bed, spacing):
        yield f"print/{plate.name}.3mf", write_threemf(plate)


def write_threemf(plate: PrintPlate) -> bytes:
    """Return the 3MF file of a plate; the same plate gives the same bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in (
            ("[Content_Types].xml", CONTENT_TYPES),
            ("_rels/.rels", RELATIONSHIPS),
            ("3D/3dmodel.model", _model(plate)),
        ):
            entry = zipfile.ZipInfo(name, FIXED_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            package.writestr(entry, text)
    return buffer.getvalue()


def _model(plate: PrintPlate) -> str:
    """Return the model: each part once as an object, each copy as an item to build."""
    numbers: dict[str, int] = {}
    objects, items = [], []
    for placed in plate.items:
        name = placed.part.name
        if name not in numbers:
            numbers[name] = len(numbers) + 1
            objects.append(_object(numbers[name], placed.part))
        items.append(_item(numbers[name], placed))
    return (
        f'{XML}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}">\n'
        f'<metadata name="Title">{escape(allowed(plate.name))}</metadata>\n'
        '<metadata name="Application">jumpcad</metadata>\n'
        f"<resources>\n{''.join(objects)}</resources>\n<build>\n{''.join(items)}</build>\n</model>\n"
    )


def _object(number: int, part: Printable) -> str:
    """Return a part as an object; nine digits hold a 32-bit float exactly."""
    vertices = _lines('<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', part.mesh.vertices.astype(np.float32))
    triangles = _lines('<triangle v1="%d" v2="%d" v3="%d"/>\n', part.mesh.faces)
    return (
        f'<object id="{number}" type="model" name={quoteattr(allowed(part.name))}>\n<mesh>\n'
        f"<vertices>\n{vertices}</vertices>\n<triangles>\n{triangles}</triangles>\n</mesh>\n</object>\n"
    )


def _lines(line: str, rows: npt.NDArray[np.generic]) -> str:
    """Return a line for every row of three numbers, all formatted at once, which is faster than one by one."""
    return line * len(rows) % tuple(rows.ravel().tolist())


def _item(number: int, placed: Placed) -> str:
    """Return a copy to build; 3MF multiplies row vectors, so the pose is written transposed."""
    rows = placed.T_bed_part[:3].T.ravel().tolist()
    return f'<item objectid="{number}" transform="{" ".join(f"{value:.9g}" for value in rows)}"/>\n'
