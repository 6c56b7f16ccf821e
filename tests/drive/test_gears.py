"""Gears measured on their own polygons, as a caliper, pins and a rack would."""

import math

import numpy as np
import pytest
from manifold3d import CrossSection
from scipy.optimize import brentq

from jumpcad.drive.gears import Gear, inverse_involute, least_shift
from jumpcad.errors import JumpcadError

GEARS = [Gear(20, 1.0, 0.0, 5), Gear(12, 1.25, 0.35, 5, 0.08), Gear(31, 1.5, -0.1, 6, 0.05), Gear(17, 1.0, 0.2, 5)]


def named(gears):
    return [pytest.param(gear, id=f"z{gear.teeth}x{gear.shift}") for gear in gears]


def span_mm(gear, teeth):
    """Return the base tangent length over some teeth (DIN 3960)."""
    angle = math.radians(20)
    turns = (teeth - 0.5) * math.pi + gear.teeth * (math.tan(angle) - angle)
    along = gear.module_mm * turns - gear.thinning_mm
    return along * math.cos(angle) + 2 * gear.shift * gear.module_mm * math.sin(angle)


def over_pins_mm(gear, pin_mm):
    """Return the size over two pins of a diameter, in opposite gaps (DIN 3960)."""
    half_gap = (math.pi * gear.module_mm - gear.pitch_thickness_mm) / (2 * gear.pitch_radius_mm)
    involute = math.tan(math.radians(20)) - math.radians(20) + pin_mm / (2 * gear.base_radius_mm) - half_gap
    centre = gear.base_radius_mm / math.cos(float(inverse_involute(involute)))
    return 2 * centre * (math.cos(math.pi / (2 * gear.teeth)) if gear.teeth % 2 else 1.0) + pin_mm


def region(gear, turn_rad=0.0, x=0.0):
    return CrossSection([gear.profile_mm]).rotate(math.degrees(turn_rad)).translate((x, 0.0))


def distance_to(points, polygon):
    start, edge = polygon, np.roll(polygon, -1, axis=0) - polygon
    offset = points[:, None] - start
    along = np.clip((offset * edge).sum(-1) / (edge**2).sum(-1), 0, 1)
    return np.hypot(*np.moveaxis(offset - along[..., None] * edge, -1, 0)).min(axis=1)


@pytest.mark.parametrize("gear", named(GEARS))
def test_a_caliper_over_teeth_reads_the_span(gear):
    """Jaws across k teeth touch involutes whose normals lie along the jaws: the largest extent of those teeth."""
    teeth = round(gear.teeth * 20 / 180 + 0.5)
    middle = (teeth - 1) * math.pi / gear.teeth
    across = np.array([-math.sin(middle), math.cos(middle)])
    angle = np.arctan2(gear.profile_mm[:, 1], gear.profile_mm[:, 0])
    pitch = 2 * math.pi / gear.teeth
    flanks = np.hypot(*gear.profile_mm.T) > gear.form_radius_mm
    first = gear.profile_mm[flanks & (np.abs(angle) < pitch / 2)]
    last = gear.profile_mm[
        flanks & (np.abs(np.mod(angle - (teeth - 1) * pitch + math.pi, 2 * math.pi) - math.pi) < pitch / 2)
    ]
    span = (last @ across).max() - (first @ across).min()
    assert span == pytest.approx(span_mm(gear, teeth), abs=0.004)


def test_the_inverse_involute_finds_every_angle_back():
    """Handbooks: inv 20° = 0.014904, inv 45° = 0.214602."""
    assert np.degrees(inverse_involute([0.014904, 0.214602])) == pytest.approx([20.0, 45.0], abs=1e-3)
    angles = np.radians([1.0, 10.0, 30.0, 60.0, 75.0, 85.0])
    np.testing.assert_allclose(inverse_involute(np.tan(angles) - angles), angles, rtol=1e-12)


def test_span_of_a_handbook_gear():
    # DIN 3960 tables: z = 30, m = 1, no shift, over 4 teeth: 10.7526 mm.
    assert span_mm(Gear(30, 1.0, 0.0, 5), 4) == pytest.approx(10.7526, abs=1e-4)


@pytest.mark.parametrize("gear", named(GEARS))
def test_pins_in_the_gaps_read_the_size_over_pins(gear):
    pin = 1.728 * gear.module_mm
    bisector = math.pi / gear.teeth
    direction = np.array([math.cos(bisector), math.sin(bisector)])

    def gap(radius):
        return distance_to((radius * direction)[None], gear.profile_mm)[0] - pin / 2

    centre = brentq(gap, gear.pitch_radius_mm, gear.tip_radius_mm + pin)
    half_turns = gear.teeth // 2 * 2 * math.pi / gear.teeth
    opposite = np.array([math.cos(bisector + half_turns), math.sin(bisector + half_turns)])
    over = np.linalg.norm(centre * (direction - opposite)) + pin
    assert over == pytest.approx(over_pins_mm(gear, pin), abs=0.02)


@pytest.mark.parametrize("gear", named(GEARS))
def test_the_rack_of_iso_53_rolls_through_the_teeth_without_cutting_any_more(gear):
    """The rack tooth, drawn from the standard and rolled on the pitch circle, touches the profile and never enters."""
    m, tan = gear.module_mm, math.tan(math.radians(20))
    arc = np.linspace(-math.pi / 2, math.radians(-20), 12)
    level = -(1.25 - 0.38) * m
    half = math.pi * m / 4 + gear.thinning_mm / 2
    centre = half + level * tan - 0.38 * m / math.cos(math.radians(20))
    corner = np.stack([centre + 0.38 * m * np.cos(arc), level + 0.38 * m * np.sin(arc)], axis=-1)
    right = np.vstack([corner, [[half + 1.2 * m * tan, 1.2 * m]]])
    rack = np.vstack([right, right[::-1] * [-1, 1]])
    gear_area = region(gear, math.pi / 2 + math.pi / gear.teeth)
    for roll in np.linspace(-1.2, 1.2, 41) * 2 * m:
        tool = CrossSection([rack]).translate((roll, gear.pitch_radius_mm + gear.shift * m))
        turned = gear_area.rotate(-math.degrees(roll / gear.pitch_radius_mm))
        # Chords across the hollow of the fillet stay inside it: slivers of a few micrometres.
        assert (tool ^ turned).area() < 3e-3 * m**2
        if abs(roll) < m:
            assert (tool.offset(0.02, circular_segments=32) ^ turned).area() > 1e-3


@pytest.mark.parametrize(
    ("teeth", "factor"), [(18, 0.309), (20, 0.322), (22, 0.331), (26, 0.346), (30, 0.359), (43, 0.397), (60, 0.422)]
)
def test_the_tooths_own_form_factor_is_near_lewis_table(teeth, factor):
    # Shigley, Mechanical Engineering Design, table 14-2: 20° full-depth teeth, load at the tip.
    assert Gear(teeth, 1.0, 0.0, 5).lewis_factor == pytest.approx(factor, rel=0.05)


def test_undercut_begins_at_17_teeth():
    assert least_shift(17) == pytest.approx(0.006, abs=1e-3)
    assert least_shift(18) < 0
    with pytest.raises(JumpcadError, match="12 teeth and shift 0 would be undercut"):
        Gear(12, 1.0, 0.0, 5)
    for teeth in (8, 12, 16):  # from 17 teeth less by 1/17 a tooth, as in ISO 53's basic rack
        least = least_shift(teeth)
        assert least == pytest.approx((17 - teeth) / 17, abs=0.01)
        assert Gear(teeth, 1.0, least, 5).shift == least
        with pytest.raises(JumpcadError, match=f"by at least {least:.3f}"):
            Gear(teeth, 1.0, least - 0.001, 5)


@pytest.mark.parametrize("gear", named(GEARS))
def test_the_top_land_is_the_textbooks(gear):
    """s_a = d_a·(s/d + inv(a) - inv(a_a)), cos(a_a) = d_b/d_a; s = m·(pi/2 + 2·x·tan(a)) less thinning (ISO 21771)."""
    alpha, d = math.radians(20), gear.module_mm * gear.teeth
    tip = d + 2 * gear.module_mm * (1 + gear.shift)
    at_tip = math.acos(d * math.cos(alpha) / tip)
    s = gear.module_mm * (math.pi / 2 + 2 * gear.shift * math.tan(alpha)) - gear.thinning_mm
    inv = [math.tan(angle) - angle for angle in (alpha, at_tip)]
    assert gear.tip_thickness_mm == pytest.approx(tip * (s / d + inv[0] - inv[1]), abs=1e-6)
    angles, radii = np.arctan2(gear.profile_mm[:, 1], gear.profile_mm[:, 0]), np.hypot(*gear.profile_mm.T)
    land = angles[(radii > tip / 2 - 1e-6) & (np.abs(angles) < math.pi / gear.teeth)]
    assert np.ptp(land) * tip / 2 == pytest.approx(gear.tip_thickness_mm, abs=1e-6)


def test_a_newton_metre_on_a_pitch_radius_of_10_mm_is_100_newtons() -> None:
    """Lewis: force by face width, module and form factor."""
    gear = Gear(20, 1.0, 0.0, 5)
    stress = gear.lewis_stress_mpa(1.0)
    assert stress * gear.face_width_mm * gear.module_mm * gear.lewis_factor == pytest.approx(100.0)
