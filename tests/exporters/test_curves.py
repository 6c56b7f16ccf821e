"""Polygons taken for the curves that they were drawn from."""

import math

import numpy as np
import pytest

from jumpcad.exporters.curves import Arc, Circle, Curve, Line, curves_of
from jumpcad.solids.outline import disc, hole, rectangle, stadium


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
