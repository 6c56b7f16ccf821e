"""Straight lines, arcs and circles recovered from polygons (mm).

Parts are drawn with polygons fine enough to print (`jumpcad.solids.outline`); CAD programs need the curves that these
approximate. A chain of corners on one circle, close together, is an arc. The sides of holes touch their circle; the
corners of outer contours lie on it.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

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
