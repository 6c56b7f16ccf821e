"""Gears measured on their own polygons, as a caliper, pins and a rack would."""

import math

import numpy as np
import pytest
from manifold3d import CrossSection
from scipy.optimize import brentq

from jumpcad.drive.gears import Gear, GearPair, gear_pair, inverse_involute, least_shift
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
    thick = gear.module_mm * (math.pi / 2 + 2 * gear.shift * math.tan(math.radians(20))) - gear.thinning_mm
    half_gap = (math.pi * gear.module_mm - thick) / (2 * gear.pitch_radius_mm)
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


def tip_clearance_mm(pair: GearPair) -> float:
    reach = (
        pair.pinion.tip_radius_mm + pair.wheel.root_radius_mm,
        pair.wheel.tip_radius_mm + pair.pinion.root_radius_mm,
    )
    return pair.centre_distance_mm - max(reach)


@pytest.mark.parametrize(("pinion", "wheel", "module"), [(12, 21, 1.0), (13, 45, 1.25), (18, 18, 1.5), (12, 12, 1.0)])
def test_a_pair_turns_through_a_pitch_without_touching_more_than_its_backlash_allows(pinion, wheel, module):
    backlash = 0.15
    pair = gear_pair(pinion, wheel, module, 5.0, backlash)
    working = backlash * math.cos(math.radians(20)) / math.cos(pair.working_angle_rad)
    pitch = 2 * math.pi / pinion
    fixed = CrossSection([pair.wheel.profile_mm])

    def overlap(turn, play):
        """The pinion's gap faces the wheel's tooth on +x at turn 0."""
        pinion_turn = math.pi + math.pi / pinion - turn * wheel / pinion + play
        turned = CrossSection([pair.pinion.profile_mm]).rotate(math.degrees(pinion_turn))
        mate = turned.translate((pair.centre_distance_mm, 0.0))
        return (fixed.rotate(math.degrees(turn)) ^ mate).area()

    for share in np.linspace(0, 1, 13):
        turn = share * pitch * pinion / wheel
        radius = pair.centre_distance_mm * pinion / (pinion + wheel)
        free = 0.5 * working / radius
        assert overlap(turn, 0.0) == 0
        assert overlap(turn, 0.95 * free) < 1e-4
        assert overlap(turn, -0.95 * free) < 1e-4
        assert overlap(turn, 1.15 * free) > 0
        assert overlap(turn, -1.15 * free) > 0
    assert pair.contact_ratio > 1.1
    assert pair.involute_margin_mm > 0
    assert tip_clearance_mm(pair) == pytest.approx(0.25 * module, abs=1e-9)


def test_contact_ratio_grows_to_that_of_two_racks():
    # Two racks with addenda of one module: 2/(pi·sin 20°·cos 20°) = 1.981, the handbooks' limit for 20°.
    pair = GearPair(Gear(50000, 1.0, 0.0, 5), Gear(50000, 1.0, 0.0, 5), 50000.0)
    assert pair.contact_ratio == pytest.approx(1.981, abs=1e-3)


def test_a_cut_tip_leaves_its_share_of_the_straight_flank():
    """The cutter's flank is straight as deep as a rack's tip reaches: 0; contact leans by 20° to the pitch line.

    Of two gears the one with less counts.
    """
    for cut, mate_cut, left in ((0.0, 0.0, 0.0), (0.1, 0.1, 0.1 / math.sin(math.radians(20))), (0.1, 0.0, 0.0)):
        gears = [Gear(50000, 1.0, 0.0, 5, tip_cut_mm=one) for one in (cut, mate_cut)]
        assert GearPair(*gears, 50000.0).involute_margin_mm == pytest.approx(left, abs=1e-3)


def test_the_centre_distance_is_that_of_a_worked_example():
    # m = 1, z = 12 and 21: inv(working angle) = inv(20°) + 2·tan(20°)·x/33, with the least shift of the pinion alone
    pair = gear_pair(12, 21, 1.0, 5.0, 0.0)
    working = pair.working_angle_rad
    shift = pair.pinion.shift + pair.wheel.shift
    involute = math.tan(working) - working
    expected = math.tan(math.radians(20)) - math.radians(20) + 2 * math.tan(math.radians(20)) * shift / 33
    assert involute == pytest.approx(expected, abs=1e-12)
    assert pair.centre_distance_mm == pytest.approx(16.5 * math.cos(math.radians(20)) / math.cos(working))
    assert 16.5 < pair.centre_distance_mm < 16.5 + shift  # less than the sum of the shifts: the tips are cut


@pytest.mark.parametrize(("cuts", "clearance"), [((0.1, 0.0), 0.25), ((0.0, 0.1), 0.25), ((0.1, 0.2), 0.35)])
def test_the_tips_of_each_gear_reach_into_the_roots_of_the_other(cuts, clearance):
    pair = GearPair(
        *(Gear(teeth, 1.0, 0.0, 5, tip_cut_mm=cut) for teeth, cut in zip((20, 60), cuts, strict=True)), 40.0
    )
    assert tip_clearance_mm(pair) == pytest.approx(clearance, abs=1e-9)
