"""Flat outlines against plane geometry."""

import math
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from jumpcad.errors import JumpcadError
from jumpcad.solids import outline
from jumpcad.solids.outline import text


def reach(region, centre=(0.0, 0.0)):
    """Return the distances of a single outline's corners and of its sides' middles from a centre."""
    (points,) = region.to_polygons()
    middles = (points + np.roll(points, -1, axis=0)) / 2.0
    return tuple(np.hypot(*(p - np.array(centre)).T) for p in (points, middles))


@pytest.mark.parametrize("diameter", [0.5, 3.0, 22.0, 180.0])
def test_discs_are_never_wider_and_holes_never_narrower_than_nominal(diameter):
    corners, _ = reach(outline.disc(diameter, (3.0, -2.0)), (3.0, -2.0))
    assert corners.max() == pytest.approx(diameter / 2.0, abs=1e-6)
    corners, middles = reach(outline.hole(diameter, (3.0, -2.0)), (3.0, -2.0))
    assert middles.min() == pytest.approx(diameter / 2.0, abs=1e-6)
    assert corners.max() - diameter / 2.0 <= 1.01 * outline.SAGITTA_MM
    assert len(corners) >= 64


def test_a_stadium_has_the_area_of_a_rectangle_and_a_circle():
    region = outline.stadium((1.0, 1.0), (31.0, 41.0), 8.0)
    assert region.area() == pytest.approx(50.0 * 8.0 + math.pi * 16.0, rel=2e-3)


def test_a_tapered_bar_touches_both_discs_with_tangents():
    # belt around two pulleys: area = sum of sectors and of the two trapezia between the tangent points
    big, small, length = 6.0, 3.0, 40.0
    lean = math.asin((big - small) / length)
    area = (math.pi / 2 + lean) * big**2 + (math.pi / 2 - lean) * small**2 + length * math.cos(lean) * (big + small)
    region = outline.tapered_bar((0.0, 0.0), (length, 0.0), 2 * big, 2 * small)
    assert region.area() == pytest.approx(area, rel=2e-3)


def test_a_d_bore_is_flat_on_one_side():
    region = outline.d_bore(3.0, 2.5, (10.0, 0.0))
    x0, y0, x1, y1 = region.bounds()
    assert (x1 - 10.0) == pytest.approx(1.0, abs=1e-6)
    assert (10.0 - x0, y1, -y0) == pytest.approx((1.5, 1.5, 1.5), abs=2e-3)
    angle = 2.0 * math.acos(1.0 / 1.5)
    assert region.area() == pytest.approx(math.pi * 1.5**2 - 1.5**2 / 2 * (angle - math.sin(angle)), rel=2e-3)


def test_rounded_corners_cost_a_square_less_a_circle():
    sharp, soft = outline.rectangle((20.0, 10.0)), outline.rectangle((20.0, 10.0), (5.0, 5.0), 2.0)
    assert sharp.area() == pytest.approx(200.0)
    assert soft.area() == pytest.approx(200.0 - (4.0 - math.pi) * 4.0, rel=1e-3)
    assert outline.rounded(sharp, 2.0).area() == pytest.approx(soft.area(), abs=0.05)
    assert soft.bounds() == pytest.approx((-5.0, 0.0, 15.0, 10.0), abs=1e-6)


def test_a_fillet_fills_an_inner_corner():
    corner = outline.rectangle((20.0, 20.0)) - outline.rectangle((20.0, 20.0), (10.0, 10.0))
    assert outline.filleted(corner, 3.0).area() - corner.area() == pytest.approx((1 - math.pi / 4) * 9.0, rel=0.02)


def test_contours_inside_others_are_holes_whatever_their_direction():
    square = np.array([[0, 0], [10, 0], [10, 10], [0, 10]])
    assert outline.polygon(square, 2 + square[::-1] / 5.0).area() == pytest.approx(96.0)
    assert outline.polygon(square[::-1], 2 + square / 5.0).area() == pytest.approx(96.0)


def test_impossible_sizes_are_refused():
    with pytest.raises(JumpcadError, match="diameter of 0 mm must be more than 0"):
        outline.disc(0.0)
    for across in (3.2, 3.0, 1.49):  # a flat beyond the shaft, or past its middle
        with pytest.raises(JumpcadError, match=rf"D-bore of 3 mm cannot be {across:g} mm"):
            outline.d_bore(3.0, across)
    assert outline.d_bore(3.0, 1.51).area() == pytest.approx(math.pi * 1.5**2 / 2.0, rel=0.01)


def test_what_a_ring_contains_is_between_its_circles():
    about = outline.ring(10.0, 4.0, (1.0, 2.0))
    distance = np.linspace(0.0, 8.0, 41)
    for angle in np.linspace(0.0, 2.0 * math.pi, 25):
        points = np.array([1.0, 2.0]) + distance[:, None] * np.array([math.cos(angle), math.sin(angle)])
        clear = (np.abs(distance - 2.0) > 0.05) & (np.abs(distance - 5.0) > 0.05)
        np.testing.assert_array_equal(
            outline.contained(about, points)[clear], ((distance > 2.0) & (distance < 5.0))[clear]
        )


@pytest.mark.parametrize("ends", [[(0.0, 0.0)], [(0.0, 0.0), (-20.0, 10.0)]])
def test_strips_have_square_ends_and_one_width(ends):
    """Every corner lies half of the width beside an end, square to the way to the other end."""
    start = np.array(ends)
    end = start + [[30.0, 40.0], [-7.0, 24.0]][: len(ends)]
    found = outline.strips(start, end, 4.0)
    assert found.area() == pytest.approx(4.0 * np.hypot(*(end - start).T).sum())
    for one, other in zip(start, end, strict=True):
        length = np.hypot(*(other - one))
        along = (other - one) / length
        (corners,) = outline.strips(one, other, 4.0).to_polygons()
        beside, ahead = (corners - one) @ [-along[1], along[0]], (corners - one) @ along
        assert np.sort(beside) == pytest.approx([-2.0, -2.0, 2.0, 2.0], abs=1e-6)
        assert np.sort(ahead) == pytest.approx([0.0, 0.0, length, length], abs=1e-6)
        assert (outline.strips(one, other, 4.0) - found).area() == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("radius", [0.5, 3.0, 20.0, 90.0])
def test_round_corners_are_within_five_micrometres_of_their_circles(radius):
    """Of a square that is grown: every corner and the middle of every side of an arc, and the straight sides."""
    (points,) = outline.grown(outline.rectangle((10.0, 10.0)), radius).to_polygons()
    for at in np.concatenate([points, (points + np.roll(points, -1, axis=0)) / 2.0]):
        beyond = np.maximum(np.abs(at) - 5.0, 0.0)
        assert np.hypot(*beyond) == pytest.approx(radius, abs=1.1 * outline.SAGITTA_MM)


@pytest.mark.parametrize("across_mm", [5.5, 4.0])
def test_a_hexagon_has_its_size_across_flats(across_mm):
    """Area √3/2·s²; corners on +x and -x, 2/√3 of the size apart (ISO 4032: 5.5 mm for M3)."""
    region = outline.hexagon(across_mm)
    assert region.area() == pytest.approx(math.sqrt(3.0) / 2.0 * across_mm**2)
    corner = across_mm / math.sqrt(3.0)
    assert region.bounds() == pytest.approx((-corner, -across_mm / 2.0, corner, across_mm / 2.0))
    corners, middles = reach(region)
    assert corners == pytest.approx(np.full(6, corner))
    assert middles == pytest.approx(np.full(6, across_mm / 2.0))


@pytest.mark.parametrize(("wide_mm", "kept"), [(0.015, False), (0.03, True)])
def test_gaps_and_walls_of_a_fiftieth_of_a_millimetre_are_slivers(wide_mm, kept):
    """Two blocks, a gap, and a wall beside one of them; the corners of blocks stay where they are."""
    blocks = [outline.rectangle((10.0, 4.0), (x, 0.0)) for x in (-5.0, 5.0 + wide_mm)]
    assert len(outline.without_slivers(outline.union(blocks)).to_polygons()) == (2 if kept else 1)
    walled = outline.union([blocks[0], outline.rectangle((wide_mm, 2.0), (3.0, 0.0))])
    clean = outline.without_slivers(walled)
    assert clean.area() == pytest.approx(40.0 + 2.0 * wide_mm * kept, abs=1e-3)
    assert outline.without_slivers(blocks[0]).bounds() == pytest.approx((-10.0, -2.0, 0.0, 2.0), abs=1e-6)


def test_capitals_have_the_height_asked_for_and_stand_on_the_line():
    _, low, _, high = text("HEH", 5.0).bounds()
    assert (low, high) == pytest.approx((0.0, 5.0), abs=0.01)


def test_letters_have_their_holes():
    assert len(text("o", 5.0).to_polygons()) == 2
    assert len(text("B8", 5.0).to_polygons()) == 6
    assert text("o", 5.0).area() < text("o", 5.0).hull().area()


def test_what_cannot_be_engraved_is_refused():
    for label, height in (("", 3.0), ("  ", 3.0), ("leg", 0.0)):
        with pytest.raises(JumpcadError, match="cannot be engraved"):
            text(label, height)


def test_letters_are_the_same_when_threads_trace_them_at_once():
    # a bundle draws its coupon and its pictures in two threads; a font that both load from ends in a crash
    trace = outline._letter.__wrapped__
    letters = [chr(code) for code in (*range(33, 127), *range(0x3B1, 0x3C9))]
    alone = [trace(letter) for letter in letters]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(4) as threads:
            several = list(threads.map(lambda _: [trace(letter) for letter in letters], range(8)))
    finally:
        sys.setswitchinterval(interval)
    for traced in several:
        assert [advance for advance, _ in traced] == [advance for advance, _ in alone]
        assert all(
            np.array_equal(a, b)
            for (_, a), (_, b) in zip(traced, alone, strict=True)
            for a, b in zip(a, b, strict=True)
        )
