"""STEP (ISO 10303-214): parts for CAD programs. Needs the extra `step`.

A part that is a stack of extruded outlines is exact: flat faces, and cylinders where its outlines are circles or arcs
(see `curves_of`). A part that is not keeps the flat facets of its mesh.

Parts are drawn with polygons fine enough to print (`jumpcad.solids.outline`). A chain of corners on one circle, close
together, is an arc. The sides of holes touch their circle; the corners of outer contours lie on it.
"""

import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.parts.part import Drawing
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import Region
from jumpcad.solids.slab import Slab
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array

ON_CIRCLE_MM = 2e-3
"""Largest distance of a corner from its circle: outlines are cut and offset on a grid of about a tenth of that."""
SAME_MM = 1e-6
"""Corners closer than this are merged: CAD kernels have a shortest edge (1e-7 mm in Open CASCADE)."""
LEAST_SIDES = 6
"""Fewer sides are corners, not an arc."""
WIDEST_SIDE_RAD = math.radians(12.0)
"""Largest angle that a side of an arc spans; circles have at least 64 sides, of 5.6 degrees."""


FULLEST_RAD = math.radians(350.0)
"""Largest angle of an arc, whose ends must be apart; a full circle is found before."""
STRAIGHT = 1e-3
"""Sine of the angle up to which three points count as collinear."""


@dataclass(frozen=True)
class Line:
    """A straight line between two points (2,)."""

    start: Array
    end: Array


@dataclass(frozen=True)
class Arc:
    """An arc by its start, a point in between, and its end, each (2,)."""

    start: Array
    middle: Array
    end: Array


@dataclass(frozen=True)
class Circle:
    """A full circle by centre (2,) and radius."""

    centre: Array
    radius_mm: float


Curve = Line | Arc | Circle


def curves_of(polygon: npt.ArrayLike) -> list[Curve]:
    """Return the curves of a closed polygon (n, 2), counter-clockwise around material and clockwise around holes.

    Each starts where the last one ends. Their distance from the polygon is at most that of the curves from which it
    was drawn.
    """
    points = np.asarray(polygon, dtype=float)
    points = points[np.hypot(*(np.roll(points, -1, axis=0) - points).T) > SAME_MM]
    count = len(points)
    if circle := _circle(points):
        return [circle]
    curves: list[Curve] = []
    lengths = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    points = np.roll(points, -int(np.argmax(lengths)), axis=0)  # the longest side is a line: no arc contains it
    closed = np.vstack([points, points[:1]])
    at = 0
    while at < count:
        sides = _arc_sides(closed[at:])
        if sides:
            curves.append(Arc(closed[at], closed[at + sides // 2], closed[at + sides]))
        else:
            curves.append(Line(closed[at], closed[at + 1]))
        at += sides or 1
    return curves


def _circle(points: Array) -> Circle | None:
    """Return the circle that a whole polygon approximates, if any."""
    sides = np.roll(points, -1, axis=0) - points
    if len(points) < 2.0 * math.pi / WIDEST_SIDE_RAD:
        return None
    centre = points.mean(axis=0)
    radii = np.hypot(*(points - centre).T)
    lengths = np.hypot(*sides.T)
    if np.ptp(radii) > ON_CIRCLE_MM or np.ptp(lengths) > 2.0 * ON_CIRCLE_MM:
        return None
    radius = float(radii.mean())
    inside = float(_cross(points, np.roll(points, -1, axis=0)).sum()) < 0.0
    return Circle(centre, radius * math.cos(math.pi / len(points)) if inside else radius)


def _arc_sides(points: Array) -> int:
    """Return how many of the first sides of an open chain of points (n, 2) make an arc; 0 if none do."""
    best, sides = 0, LEAST_SIDES
    while sides < len(points) and _is_arc(points[: sides + 1]):
        best = sides
        sides += 1
    return best


def _is_arc(points: Array) -> bool:
    """Tell whether points lie on one arc, close together and in order."""
    found = _through(points[0], points[len(points) // 2], points[-1])
    if found is None:
        return False
    centre, radius = found
    away = points - centre
    if np.abs(np.hypot(*away.T) - radius).max() > ON_CIRCLE_MM:
        return False
    steps = np.arctan2(_cross(away[:-1], away[1:]), np.sum(away[:-1] * away[1:], axis=1))
    one_way = bool(np.all(steps > 0.0) or np.all(steps < 0.0))
    return one_way and float(np.abs(steps).max()) < WIDEST_SIDE_RAD and float(np.abs(steps).sum()) < FULLEST_RAD


def _through(a: Array, b: Array, c: Array) -> tuple[Array, float] | None:
    """Return centre and radius of the circle through three points, or None if they are collinear."""
    ab, ac = b - a, c - a
    double = 2.0 * float(_cross(ab, ac))
    if abs(double) <= STRAIGHT * float(np.hypot(*ab) * np.hypot(*ac)):
        return None
    u = np.array([ac[1] * (ab @ ab) - ab[1] * (ac @ ac), ab[0] * (ac @ ac) - ac[0] * (ab @ ab)]) / double
    return a + u, float(np.hypot(*u))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


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
        yield f"step/{part.name}.step", write_step(part)


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


def _extruded(slab: Slab) -> "Iterator[Solid]":
    from build123d import Face, Solid

    for piece in slab.region.decompose():
        outer, *inner = sorted(_wires(piece, slab.z0_mm), key=lambda wire: -wire.bounding_box().diagonal)
        yield Solid.extrude(Face(outer, inner), (0.0, 0.0, slab.height_mm))


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
