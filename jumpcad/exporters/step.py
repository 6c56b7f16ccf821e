"""STEP (ISO 10303-214): parts for CAD programs. Needs the extra `step`.

A part that is a stack of extruded outlines is exact: flat faces, and cylinders where its outlines are circles or arcs
(see `jumpcad.exporters.curves`). A part that is not keeps the flat facets of its mesh.
"""

import io
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.exporters.curves import Arc, Circle, Curve, Line, curves_of
from jumpcad.parts.part import Drawing
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import Region
from jumpcad.solids.slab import Slab
from jumpcad.solids.stack import Stack

if TYPE_CHECKING:
    from build123d import Edge, Shape, Solid, Wire

FIXED_DATE = "1980-01-01T00:00:00"
SLIVER_MM = 1e-3
"""Faces narrower than this are closed where a solid is not valid with them; half of what outlines leave of a circle."""
FUZZY_MM = (0.0, 1e-4, 1e-3)
"""Distances up to which two faces count as one; tried in this order until the solid closes."""


def is_installed() -> bool:
    """Tell whether the library that writes STEP is installed."""
    return find_spec("build123d") is not None


def require_step() -> None:
    """Require the library that writes STEP."""
    if not is_installed():
        raise JumpcadError('STEP needs build123d, which is not installed: pip install "jumpcad[step]"')


def step_files(robot: Robot) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every printed part's file."""
    for part in robot.parts:
        yield f"step/{part.name}.step", write_step(part.drawing)


def write_step(drawing: Drawing) -> bytes:
    """Return the STEP file of a part in printing orientation; the same part gives the same bytes."""
    from build123d import export_step

    tries = _stacked(drawing.shape) if isinstance(drawing.shape, Stack) else _faceted(drawing)
    for solid in tries:
        solid.label = drawing.name
        buffer = io.BytesIO()
        if (
            _is_sound(solid)
            and export_step(solid, buffer, timestamp=FIXED_DATE)
            and _is_sound(_read(buffer.getvalue()))
        ):
            return buffer.getvalue()
    raise CannotBuildError(f"part {drawing.name} is no valid solid as STEP: build without --step")


def _is_sound(shape: "Shape[Any]") -> bool:
    return len(shape.solids()) == 1 and bool(shape.is_valid)


def _read(data: bytes) -> "Shape[Any]":
    """Return what a file holds: faces that are valid where they were made may not be when they are read."""
    from build123d import import_step

    with TemporaryDirectory() as folder:
        path = Path(folder) / "part.step"
        path.write_bytes(data)
        return import_step(path)


def _stacked(stack: Stack) -> "Iterator[Shape[Any]]":
    """Yield a stack as one solid of flat and cylindrical faces, for each tolerance of `FUZZY_MM` as made and healed.

    The arc of one slab and the circle of another that it lies on may differ by a micron, and leave slivers between.
    """
    first, *others = (solid for slab in stack.slabs for solid in _extruded(slab))
    if not others:
        yield first
        return
    for tolerance in FUZZY_MM:
        solid = first.fuse(*others, tol=tolerance).clean()
        yield solid
        yield _without_slivers(solid)


def _without_slivers(solid: "Shape[Any]") -> "Shape[Any]":
    """Return a solid without faces narrower than `SLIVER_MM`."""
    from OCP.ShapeFix import ShapeFix_FixSmallFace

    fix = ShapeFix_FixSmallFace()
    fix.Init(solid.wrapped)
    fix.SetPrecision(SLIVER_MM)
    fix.SetMaxTolerance(2.0 * SLIVER_MM)
    fix.Perform()
    return type(solid).cast(fix.FixShape())


def _extruded(slab: Slab) -> "list[Solid]":
    from build123d import Face, Solid

    made = []
    for piece in slab.region.decompose():
        outer, *inner = sorted(_wires(piece, slab.z0_mm), key=lambda wire: -wire.bounding_box().diagonal)
        made.append(Solid.extrude(Face(outer, inner), (0.0, 0.0, slab.height_mm)))
    return made


def _wires(region: Region, z_mm: float) -> "list[Wire]":
    from build123d import Wire

    return [Wire([_edge(curve, z_mm) for curve in curves_of(contour)]) for contour in region.to_polygons()]


def _edge(curve: Curve, z_mm: float) -> "Edge":
    from build123d import Edge, Plane

    match curve:
        case Line(start, end):
            return Edge.make_line((*start, z_mm), (*end, z_mm))
        case Arc(start, middle, end):
            return Edge.make_three_point_arc((*start, z_mm), (*middle, z_mm), (*end, z_mm))
        case Circle(centre, radius):
            return Edge.make_circle(radius, Plane((*centre, z_mm)))


def _faceted(drawing: Drawing) -> "Iterator[Shape[Any]]":
    """Yield the mesh of a part as one solid; triangles that lie in one plane become one face."""
    from build123d import Face, Shell, Solid, Wire

    triangles = drawing.mesh.triangles
    faces = [Face(Wire.make_polygon([tuple(corner) for corner in triangle])) for triangle in triangles.tolist()]
    yield Solid(Shell(faces)).clean()
