"""Polygons taken for the curves that they were drawn from."""

import math

import numpy as np
import pytest

from jumpcad.drive.gear_pair import gear_pair
from jumpcad.exporters.curves import Arc, Circle, Curve, Line, curves_of
from jumpcad.solids.outline import Region, disc, hole, polygon, rectangle, rounded, stadium


def radius(arc: Arc) -> float:
    """Return the radius of an arc from its sides and Heron's formula."""
    a, b, c = (math.dist(*pair) for pair in ((arc.start, arc.middle), (arc.middle, arc.end), (arc.end, arc.start)))
    s = (a + b + c) / 2.0
    return a * b * c / (4.0 * math.sqrt(s * (s - a) * (s - b) * (s - c)))


def ends(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    assert not isinstance(curve, Circle)
    return curve.start, curve.end


@pytest.mark.parametrize("diameter", [1.6, 3.2, 22.0, 180.0])
def test_discs_and_holes_have_the_diameter_that_was_asked_for(diameter: float) -> None:
    place = (12.345, -6.789)
    region = rectangle((400.0, 400.0)) - hole(diameter, place)
    (outer,) = map(curves_of, disc(diameter, place).to_polygons())
    assert [type(curve) for curve in outer] == [Circle]
    inner = next(curves for curves in map(curves_of, region.to_polygons()) if isinstance(curves[0], Circle))
    for (circle,) in (outer, inner):
        assert isinstance(circle, Circle)
        assert 2.0 * circle.radius_mm == pytest.approx(diameter, abs=2e-4)
    assert outer[0].centre == pytest.approx(place, abs=1e-4)


def test_a_bar_with_round_ends_is_two_lines_and_two_arcs() -> None:
    (contour,) = stadium((0.0, 0.0), (40.0, 15.0), 9.0).to_polygons()
    curves = curves_of(contour)
    assert sorted(type(curve).__name__ for curve in curves) == ["Arc", "Arc", "Line", "Line"]
    assert [radius(curve) for curve in curves if isinstance(curve, Arc)] == pytest.approx([4.5, 4.5], abs=1e-3)
    lines = [math.dist(*ends(curve)) for curve in curves if isinstance(curve, Line)]
    assert lines == pytest.approx([math.hypot(40.0, 15.0)] * 2, abs=0.5)  # to within a side of the arcs


@pytest.mark.parametrize(
    "region",
    [
        stadium((0.0, 0.0), (40.0, 15.0), 9.0),
        rounded(rectangle((30.0, 20.0)) - disc(14.0, (15.0, 10.0)), 2.0),
        polygon(gear_pair(12, 40, 1.25, 5.0, 0.1).wheel.profile_mm) - hole(3.0),
    ],
    ids=["bar", "bite", "gear"],
)
def test_curves_follow_each_other_and_keep_to_their_polygon(region: Region) -> None:
    for contour in region.to_polygons():
        curves = curves_of(contour)
        if isinstance(curves[0], Circle):
            continue
        for one, other in zip(curves, [*curves[1:], curves[0]], strict=True):
            np.testing.assert_array_equal(ends(one)[1], ends(other)[0])
        for curve in curves:
            for point in (curve.start, curve.end, *([curve.middle] if isinstance(curve, Arc) else [])):
                assert np.hypot(*(np.asarray(contour) - point).T).min() == 0.0
        # what the arcs add to or take from the polygon of their ends and middles is what the polygon's corners do
        assert sum(_swept(curve) for curve in curves) == pytest.approx(_area(np.asarray(contour)), rel=2e-3)


def _area(points: np.ndarray) -> float:
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _swept(curve: Curve) -> float:
    """Return the area that the line from the origin to a point on the curve sweeps."""
    start, end = ends(curve)
    triangle = 0.5 * float(start[0] * end[1] - start[1] * end[0])
    if isinstance(curve, Line):
        return triangle
    size = radius(curve)
    way = curve.middle - start
    side = math.copysign(1.0, float(way[0] * (end - start)[1] - way[1] * (end - start)[0]))
    half = sum(2.0 * math.asin(min(1.0, math.dist(*pair) / 2.0 / size))
               for pair in ((start, curve.middle), (curve.middle, end)))  # fmt: skip
    return triangle + side * size**2 / 2.0 * (half - math.sin(half))


def test_the_flats_of_a_disc_are_lines_between_two_arcs() -> None:
    """Its flats are chords of the circle, too long to be sides of an arc."""
    (contour,) = (disc(12.0) ^ rectangle((20.0, 10.0))).to_polygons()
    curves = curves_of(contour)
    assert sum(isinstance(curve, Arc) for curve in curves) == 2
    flats = [size for curve in curves if isinstance(curve, Line) and (size := math.dist(*ends(curve))) > 1.0]
    assert flats == pytest.approx([2.0 * math.sqrt(6.0**2 - 5.0**2)] * 2, abs=0.1)
