"""DXF of the body plates, to cut them by laser instead of printing them. Lengths in mm, seen from the outside.

Layer `CUT` holds the outline and every hole, `ENGRAVE` the name. What is higher than a plate (the motor's socket) is
not in a flat drawing; it is printed and glued onto a cut plate.
Blind bores of axles are cut through: cut plates need axles with clips or nuts (`bought.retention`).
"""

import io
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jumpcad.parts.part import Part
from jumpcad.robot.plates.thing import ENGRAVING_MM
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import Stack

if TYPE_CHECKING:
    from ezdxf.layouts.layout import Modelspace

CUT, ENGRAVE = "CUT", "ENGRAVE"
RED, BLUE = 1, 5
MILLIMETRES = 4
"""DXF's code of the unit."""
PLATES = ("body_plate_left", "body_plate_right")


def dxf_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and content of every body plate's drawing."""
    lateral = robot.layout.lateral
    thick = dict(zip(PLATES, (lateral.left_plate, lateral.right_plate), strict=True))
    for part in (part for part in robot.parts if part.name in thick):
        yield f"dxf/{part.name}.dxf", write_dxf(*sheet(part, thick[part.name][1] - thick[part.name][0]))


def sheet(part: Part, thickness_mm: float) -> tuple[Region, Region]:
    """Return the region of a plate half way through it, and what is engraved into its outside, seen from there."""
    shape = part.shape
    assert isinstance(shape, Stack)
    region, engraved = shape.regions_at([thickness_mm / 2.0, 0.99 * ENGRAVING_MM])
    # the outside lies on the bed
    return region.mirror((1.0, 0.0)), (region - engraved).mirror((1.0, 0.0))


def write_dxf(cut: Region, engraved: Region) -> str:
    """Return a DXF document with closed polylines, the same text for the same regions."""

    def draw(space: "Modelspace") -> None:
        for layer, region in ((CUT, cut), (ENGRAVE, engraved)):
            for contour in region.to_polygons():
                space.add_lwpolyline(contour.tolist(), close=True, dxfattribs={"layer": layer})

    return dxf_document({CUT: RED, ENGRAVE: BLUE}, draw)


def dxf_document(layers: Mapping[str, int], draw: "Callable[[Modelspace], None]") -> str:
    """Return a DXF document (R2010, mm) with layers, by name and colour, and what is drawn into its space."""
    from ezdxf.filemanagement import new  # takes 0.2 s

    with _fixed_metadata():
        document = new("R2010", units=MILLIMETRES)
        for layer, colour in layers.items():
            document.layers.add(layer, color=colour)
        draw(document.modelspace())
        stream = io.StringIO()
        # ezdxf would register the classes in use in the order of a set, which differs between processes
        for name in sorted(document.entitydb.dxf_types_in_use()):
            document.classes.add_class(name)
        document.write(stream)
    return stream.getvalue()


@contextmanager
def _fixed_metadata() -> Iterator[None]:
    """Keep ezdxf from writing the time of day and random identifiers."""
    import ezdxf

    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
