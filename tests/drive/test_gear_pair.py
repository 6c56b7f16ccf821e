"""Two gears in mesh, turned through a pitch on their own polygons."""

import math

import numpy as np
import pytest
from manifold3d import CrossSection

from jumpcad.drive.gear_pair import GearPair, gear_pair
from jumpcad.drive.gears import Gear


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
