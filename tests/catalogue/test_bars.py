"""Sections of strips and tubes by the tables of any handbook; holes in which they fit."""

import itertools
import math

import pytest
from support.decimals import decimals

from jumpcad.catalogue import load_catalogue
from jumpcad.catalogue.bars import Clip, LegBar, Rod

BARS = load_catalogue().bars
TUBE, STRIP = BARS["carbon-tube-6x4"], BARS["carbon-strip-3x6"]


def test_a_strip_is_a_rectangle() -> None:
    assert STRIP.area_mm2 == 18.0
    assert STRIP.around_mm == 18.0
    assert STRIP.second_moment_mm4 == pytest.approx(3.0 * 6.0**3 / 12.0)
    assert STRIP.sideways_mm4 == pytest.approx(6.0 * 3.0**3 / 12.0)
    assert STRIP.mass_g(1000.0) == pytest.approx(18.0 * STRIP.density_g_cm3)
    assert STRIP.slabs_mm() == [(-1.5, 1.5, 6.0)]
    assert STRIP.slabs_mm(0.1) == [(-1.6, 1.6, pytest.approx(6.2))]


def test_a_tube_is_a_ring() -> None:
    assert TUBE.area_mm2 == pytest.approx(math.pi / 4.0 * (36.0 - 16.0))
    assert TUBE.around_mm == pytest.approx(6.0 * math.pi)
    second = math.pi / 64.0 * (6.0**4 - 4.0**4)
    assert (TUBE.second_moment_mm4, TUBE.sideways_mm4) == pytest.approx((second, second))


def test_a_round_bar_fits_the_steps_of_its_hole() -> None:
    """Every corner of a hole's steps is outside of the circle; the bar's own have the circle's area to 2 %."""
    bar, wide = TUBE.slabs_mm(), TUBE.slabs_mm(0.1)
    assert decimals(wide) == 6  # nanometres
    for slabs, radius in ((bar, 3.0), (wide, 3.1)):
        assert (slabs[0][0], slabs[-1][1]) == pytest.approx((-radius, radius))
        assert all(one[1] == other[0] for one, other in itertools.pairwise(slabs))
    for low, high, height in wide:
        assert min(math.hypot(y, height / 2.0) for y in (low, high)) >= 3.1 - 1e-5
    area = sum((high - low) * height for low, high, height in bar)
    assert area == pytest.approx(9.0 * math.pi, rel=0.02)


@pytest.mark.parametrize("ledge_mm", [0.9, 0.54, 0.3])
def test_no_step_of_a_hole_stands_out_farther_than_is_asked_for(ledge_mm: float) -> None:
    """Half of the difference of two chords, up to the middle; a hole of steps still holds the bar."""
    wide = TUBE.slabs_mm(0.07, ledge_mm)
    heights = [height for *_, height in wide]
    assert max(abs(one - other) / 2.0 for one, other in itertools.pairwise(heights)) <= ledge_mm
    for low, high, height in wide:
        assert min(math.hypot(y, height / 2.0) for y in (low, high)) >= 3.07 - 1e-5
    assert TUBE.slabs_mm(0.07, 0.9) == TUBE.slabs_mm(0.07)


def test_bars_that_cannot_be_are_refused() -> None:
    tube = TUBE.model_dump() | {"name": "x"}
    for changed, key in (
        ({"height_mm": 5.0}, "height_mm"), ({"bore_mm": 6.0}, "bore_mm"), ({"bore_mm": 5.9}, None),
    ):  # fmt: skip
        found = [(where, value) for where, value, _ in LegBar(**tube | changed).contradictions()]
        assert found == ([((key,), changed[key])] if key else [])
    flat = STRIP.model_dump() | {"name": "x", "bore_mm": 3.0}
    assert [where for where, *_ in LegBar(**flat).contradictions()] == [("bore_mm",)]


def test_a_rod_is_solid_where_no_bore_is_said() -> None:
    """Of the shipped ones the tube alone is bored: 3 x 0.5 mm has a bore of 2 mm."""
    plain = Rod(name="own", source="a label", description="rod", density_g_cm3=7.85, yield_mpa=400.0, grooves=True)
    assert plain.bore_share == 0.0
    bored = {name: rod.bore_share for name, rod in load_catalogue().rods.items() if rod.bore_share}
    assert bored == {"steel-tube": pytest.approx(2.0 / 3.0, rel=1e-3)}


def test_a_clip_is_wider_than_its_shaft_and_the_shaft_than_the_groove() -> None:
    """2.3 mm in a shaft of 3 mm, under a ring of 6.3 mm (DIN 6799)."""
    clip = load_catalogue().clips["2.3"]
    for groove, shaft, outer, refused in (
        (2.3, 3.0, 6.3, False), (3.0, 3.0, 6.3, True), (2.3, 6.3, 6.3, True), (2.3, 7.0, 6.3, True),
    ):  # fmt: skip
        sizes = {"name": "own", "groove_mm": groove, "shaft_mm": shaft, "outer_mm": outer}
        found = [place for place, *_ in Clip(**clip.model_dump() | sizes).contradictions()]
        assert found == [("groove_mm",)] * refused
