"""Polygons taken for the curves that they were drawn from."""

import math

import numpy as np
import pytest

from jumpcad.drive.gear_pair import gear_pair
from jumpcad.exporters.curves import Arc, Circle, Curve, Line, _is_arc, curves_of
from jumpcad.solids.outline import Region, disc, hole, polygon, rectangle, rounded, stadium


def kinds(region: Region) -> list[list[type[Curve]]]:
    return [sorted({type(curve) for curve in curves_of(p)}, key=str) for p in region.to_polygons()]


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


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_points_of_a_circle_are_an_arc_only_in_order(sign: float) -> None:
    turns = sign * np.radians(np.arange(0.0, 60.0, 5.0))
    assert _is_arc(4.0 * np.column_stack([np.cos(turns), np.sin(turns)]))
    chord = np.append(turns, turns[-1] + sign * math.radians(50.0))
    assert not _is_arc(4.0 * np.column_stack([np.cos(chord), np.sin(chord)]))  # its last side is none of an arc's
    turns[[4, 5]] = turns[[5, 4]]
    assert not _is_arc(4.0 * np.column_stack([np.cos(turns), np.sin(turns)]))


@pytest.mark.parametrize(("whole_deg", "arc"), [(345.0, True), (355.0, False)])
def test_an_arc_is_no_full_circle(whole_deg: float, arc: bool) -> None:
    """Three points give no circle where the first and the last are nearly one."""
    turns = np.radians(np.arange(0.0, whole_deg + 1.0, 5.0))
    assert _is_arc(4.0 * np.column_stack([np.cos(turns), np.sin(turns)])) is arc


def test_corners_stay_corners() -> None:
    assert kinds(rectangle((30.0, 20.0))) == [[Line]]
    hexagon = [(math.cos(turn), math.sin(turn)) for turn in np.arange(6) * math.pi / 3.0]
    assert kinds(polygon(np.array(hexagon) * 4.0)) == [[Line]]
    (curves,) = [curves_of(p) for p in rounded(rectangle((30.0, 20.0)), 4.0).to_polygons()]
    assert sorted(type(curve).__name__ for curve in curves) == ["Arc"] * 4 + ["Line"] * 4


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


def test_corners_that_are_one_make_no_edge() -> None:
    """Offsets of chamfers leave corners 1e-8 mm apart, between which no CAD program has an edge."""
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.5e-8), (4.0, 4.0), (0.0, 4.0)]
    curves = curves_of(square)
    assert len(curves) == 4
    assert min(float(np.hypot(*(curve.end - curve.start))) for curve in curves if isinstance(curve, Line)) > 3.999


def regular(count: int, sides: int | None = None, radius_mm: float = 10.0) -> np.ndarray:
    """Corners of a regular polygon, or of so many of its sides that go on to its middle."""
    turns = 2.0 * math.pi * np.arange((sides or count - 1) + 1) / count
    points = radius_mm * np.column_stack([np.cos(turns), np.sin(turns)])
    return points if sides is None else np.vstack([points, [[0.0, 0.0]]])


@pytest.mark.parametrize(("count", "round_"), [(6, False), (24, False), (36, True), (64, True)])
def test_only_polygons_of_short_sides_are_circles(count: int, round_: bool) -> None:
    """Sides of 15° are meant as corners, those of 10° as an approximation; circles are drawn with 64 or more."""
    assert {type(curve) for curve in curves_of(regular(count))} == ({Circle} if round_ else {Line})


@pytest.mark.parametrize(("count", "sides", "arcs"), [(64, 5, 0), (64, 6, 1), (64, 40, 1), (24, 8, 0)])
def test_an_arc_has_six_short_sides_or_more(count: int, sides: int, arcs: int) -> None:
    curves = curves_of(regular(count, sides))
    assert sum(isinstance(curve, Arc) for curve in curves) == arcs
    for arc in curves:
        if isinstance(arc, Arc):
            assert radius(arc) == pytest.approx(10.0, abs=1e-6)
            chord = 2.0 * 10.0 * math.sin(math.pi * sides / count)
            assert math.dist(arc.start, arc.end) == pytest.approx(chord, abs=1e-6)


@pytest.mark.parametrize(("off_mm", "round_"), [(1e-3, True), (0.02, False)])
def test_corners_off_the_circle_are_no_part_of_it(off_mm: float, round_: bool) -> None:
    """Outlines are cut on a grid of 0.2 µm: 1 µm off is on the circle, 20 µm is not."""
    points = regular(64)
    points[10] *= 1.0 + off_mm / 10.0
    assert (curves_of(points)[0].__class__ is Circle) == round_


@pytest.mark.parametrize(("wide_deg", "round_"), [(5.01, True), (5.013, False), (5.2, False)])
def test_corners_on_a_circle_at_uneven_steps_are_not_what_a_circle_was_drawn_with(
    wide_deg: float, round_: bool
) -> None:
    """Sides of two lengths in turn, which differ by more than the 4 µm that corners 2 µm off allow."""
    steps = np.tile([wide_deg, 10.0 - wide_deg], 36)
    turns = np.radians(np.cumsum(steps))
    points = 10.0 * np.column_stack([np.cos(turns), np.sin(turns)])
    assert (curves_of(points)[0].__class__ is Circle) == round_


def test_the_flats_of_a_disc_are_lines_between_two_arcs() -> None:
    """Its flats are chords of the circle, too long to be sides of an arc."""
    (contour,) = (disc(12.0) ^ rectangle((20.0, 10.0))).to_polygons()
    curves = curves_of(contour)
    assert sum(isinstance(curve, Arc) for curve in curves) == 2
    flats = [size for curve in curves if isinstance(curve, Line) and (size := math.dist(*ends(curve))) > 1.0]
    assert flats == pytest.approx([2.0 * math.sqrt(6.0**2 - 5.0**2)] * 2, abs=0.1)
