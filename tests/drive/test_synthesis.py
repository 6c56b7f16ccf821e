"""The whole drive over the search bounds: always a drive within its limits, or an error that names the reason."""

import dataclasses
import math

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.dimensions import CLEAR_MM, SPACER_RADIUS_MM
from jumpcad.drive import synthesis, synthesise
from jumpcad.drive.corner import clear_window_rad
from jumpcad.drive.motor import FACE_WIDTHS_MM
from jumpcad.errors import CannotBuildError

LIMITS = default_limits()


def random_designs(count, seed):
    rng = np.random.default_rng(seed)
    bounds = list(SEARCH_BOUNDS.values())
    lower, upper = np.array([b.lower for b in bounds]), np.array([b.upper for b in bounds])
    designs = []
    while len(designs) < count:
        design = Design.from_vector(list(lower + (upper - lower) * rng.random(len(bounds))))
        if design.assembly_margin_mm > 0:
            designs.append(design)
    return designs


def check(design, drive):
    """The parts agree with the design and with each other."""
    assert all(finding.margin > -1e-6 for finding in drive.findings)
    spring, cam, train = drive.spring, drive.cam, drive.train
    assert 2 * spring.stiffness_nm_per_rad == pytest.approx(design.stiffness_nm_per_rad)
    assert cam.law.wind_rad(cam.law.lift_rad) == pytest.approx(design.compression_rad)
    assert cam.law.energy_j == pytest.approx(design.spring_energy_j)
    play_deg = max(12.0, math.degrees(cam.roll_over_rad) + 3.0)
    assert math.degrees(drive.dog.play_rad) == pytest.approx(round(play_deg, 3), abs=1e-9)
    axis = math.hypot(*cam.geometry.axis_mm)
    assert axis - cam.outer_radius_mm - spring.outer_diameter_mm / 2 >= LIMITS.cam.clearance_mm - 1e-6
    assert axis - train.stages[-1].wheel.tip_radius_mm >= SPACER_RADIUS_MM + CLEAR_MM - 1e-6
    for pair in train.stages[1:]:
        idler = pair.centre_distance_mm - cam.outer_radius_mm
        assert idler >= SPACER_RADIUS_MM + CLEAR_MM - 1e-6, "the idler's axle crosses the cam"
    assert train.electrical_j * train.efficiency > design.spring_energy_j
    ahead = train.motor.no_load_rpm * math.pi / 30 / train.ratio * LIMITS.fall_s + drive.dog.play_rad
    assert ahead + math.radians(3.0) <= clear_window_rad(cam.geometry)[1] + 1e-4


def test_the_searched_box_is_drivable_nearly_everywhere():
    refused = []
    for design in random_designs(200, seed=3):
        try:
            check(design, synthesise(design, LIMITS))
        except CannotBuildError:
            refused.append(math.degrees(design.compression_rad))
    assert len(refused) <= 10
    assert all(compression_deg > 55 for compression_deg in refused)


def test_what_cannot_be_driven_is_refused_with_a_parameter_to_change():
    design = load_design("best-bo").model_copy(update={"compression_ratio": 0.98, "rest_angle_deg": 88.0})
    with pytest.raises(CannotBuildError, match=r"(compression_ratio|stiffness_nmm_per_deg)"):
        synthesise(design, LIMITS)
    flat = load_design("kenan-2.0").model_copy(update={"c_coef": 0.3, "d_coef": 0.6, "rest_angle_deg": 40.0})
    with pytest.raises(
        CannotBuildError, match=r"loaded by -3\.9\d°, less than 0\.5°: raise compression_ratio"
    ) as refused:
        synthesise(flat, LIMITS)
    assert (refused.value.limit, refused.value.unit) == ("compression", "°")
    assert refused.value.margin == pytest.approx(math.degrees(flat.compression_rad) - 0.5)
    wide = dataclasses.replace(LIMITS.cam, hub_radius_mm=50.5)
    with pytest.raises(CannotBuildError, match=r"no lever from 56\.\d mm .* to 45 mm"):
        synthesise(load_design("kenan-2.0"), dataclasses.replace(LIMITS, cam=wide))


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_the_published_designs_have_a_drive(name):
    design = load_design(name)
    check(design, synthesise(design, LIMITS))


def test_the_cam_gives_way_to_a_thick_spring():
    limits = dataclasses.replace(
        LIMITS, spring=dataclasses.replace(LIMITS.spring, mandrel_min_mm=14.0, outer_max_mm=30.0)
    )
    drive = synthesise(load_design("best-bo"), limits)
    radius = drive.spring.outer_diameter_mm / 2
    assert radius > 8
    gap = math.hypot(*drive.cam.geometry.axis_mm) - drive.cam.outer_radius_mm - radius
    assert gap == pytest.approx(LIMITS.cam.clearance_mm, abs=0.01)


def test_a_fast_motor_is_geared_down_for_the_leg_to_fall_in_time():
    drive = synthesise(load_design("kenan-2.0"), dataclasses.replace(LIMITS, motors=("n20-75",)))
    slow = synthesise(load_design("kenan-2.0"), LIMITS)
    assert drive.train.ratio > 2.0 * slow.train.ratio
    check(load_design("kenan-2.0"), drive)


def test_a_cam_as_large_as_a_hand_is_turned_by_one_pair_or_by_two_whose_axle_passes_it():
    """Wound far against a strong spring, beside a thick hub; so large a cam is far from the leg's axle, as its gear."""
    design = Design.from_vector([99.797, 1.028, 0.8, 0.924, 0.823, 70.182, 27.5, 36.353])
    thick_hub = dataclasses.replace(LIMITS, cam=dataclasses.replace(LIMITS.cam, hub_radius_mm=8.4))
    smaller_gear = dataclasses.replace(thick_hub, train=dataclasses.replace(LIMITS.train, cam_gear_tip_max_mm=48.0))
    for limits, pairs in ((thick_hub, 1), (smaller_gear, 2)):
        drive = synthesise(design, limits)
        check(design, drive)
        assert drive.cam.outer_radius_mm > 40.0
        assert len(drive.train.stages) == pairs


def test_torque_at_the_cam_is_what_the_design_note_says():
    # Energy over lift without a ramp: 22 mN·m for 0.133 J, 121 mN·m for 0.72 J; the ramp and the drop add to it.
    for name, plain in (("kenan-2.0", 0.022), ("best-bo", 0.121)):
        cam = synthesise(load_design(name), LIMITS).cam
        assert 1.0 < cam.law.peak_torque_nm / plain < 1.2


def test_a_stronger_spring_never_needs_less_torque():
    designs = (load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": k}) for k in (8.0, 16.0))
    weak, strong = (synthesise(design, LIMITS) for design in designs)
    assert strong.cam.law.peak_torque_nm == pytest.approx(2 * weak.cam.law.peak_torque_nm)
    assert strong.spring.wire_mm >= weak.spring.wire_mm
    assert strong.train.ratio >= weak.train.ratio


def test_limits_reach_the_parts_that_they_are_for():
    wide = dataclasses.replace(LIMITS, cam=dataclasses.replace(LIMITS.cam, core_radius_mm=8.0), motors=("n20-250",))
    drive = synthesise(load_design("kenan-2.0"), wide)
    assert drive.cam.core_radius_mm >= 8.0 - 1e-6
    assert drive.train.motor.name == "n20-250"
    gentle = dataclasses.replace(LIMITS, cam=dataclasses.replace(LIMITS.cam, roller_load_n=60.0))
    assert synthesise(load_design("best-bo"), LIMITS).cam.peak_contact_n > 75
    assert synthesise(load_design("best-bo"), gentle).cam.peak_contact_n <= 60.0 + 1e-6


def test_the_same_design_gives_the_same_drive():
    design = load_design("best-bo")
    first, second = synthesise(design, LIMITS), synthesise(design, LIMITS)
    assert first.cam.profile_mm.tobytes() == second.cam.profile_mm.tobytes()
    assert first.spring == second.spring
    assert first.train == second.train


def test_gears_widen_where_their_teeth_are_too_weak():
    """The Lewis stress falls as the face widens, so that a material of half the strength still turns the cam."""
    design = load_design("best-bo")
    trains = {}
    for stress in (10.0, 2.0, 1.5):
        limits = dataclasses.replace(LIMITS, train=dataclasses.replace(LIMITS.train, stress_mpa=stress))
        trains[stress] = synthesise(design, limits).train
    assert [train.stages[0].wheel.face_width_mm for train in trains.values()] == sorted(FACE_WIDTHS_MM)
    for stress, train in trains.items():
        pinion = train.stages[0].pinion
        # what the pair loses to friction does not bend its teeth
        force = 2000.0 * LIMITS.train.pair_efficiency * train.motor_torque_nm / (pinion.module_mm * pinion.teeth)
        lewis = force / (train.stages[0].wheel.face_width_mm * pinion.module_mm * pinion.lewis_factor)
        assert lewis <= stress
    with pytest.raises(CannotBuildError, match=r"1.2 MPa in teeth 8 mm wide\): lower stiffness_nmm_per_deg"):
        synthesise(design, dataclasses.replace(LIMITS, train=dataclasses.replace(LIMITS.train, stress_mpa=1.2)))


@pytest.mark.parametrize(("name", "motors"), [("kenan-2.0", ("n20-100",)), ("best-bo", LIMITS.motors)])
def test_the_cams_axis_makes_room_for_one_pair_at_the_least_gap_that_is_enough(name, motors):
    """Two pairs where the cam is as near as it can be; each gap alone, the first with one pair is what is found."""
    limits, design = dataclasses.replace(LIMITS, motors=motors), load_design(name)
    alone = [synthesise(design, dataclasses.replace(limits, more_gap_mm=(gap,))) for gap in limits.more_gap_mm]
    assert len(alone[0].train.stages) == 2
    first = next(drive for drive in alone if len(drive.train.stages) == 1)
    found = synthesise(design, limits)
    assert found.train == first.train
    assert found.cam.geometry.axis_mm.tolist() == first.cam.geometry.axis_mm.tolist()


def test_of_cams_that_need_two_pairs_the_nearest_is_taken(monkeypatch):
    """However often a farther axis is tried for one pair: a farther one is larger and heavier."""
    design = Design.from_vector([99.797, 1.028, 0.8, 0.924, 0.823, 70.182, 27.5, 36.353])
    cam = dataclasses.replace(LIMITS.cam, hub_radius_mm=8.4)
    train = dataclasses.replace(LIMITS.train, cam_gear_tip_max_mm=48.0)
    limits = dataclasses.replace(LIMITS, cam=cam, train=train)
    only = synthesise(design, dataclasses.replace(limits, more_gap_mm=(0.0,)))
    monkeypatch.setattr(synthesis, "least_tip_mm", lambda *_: 0.0)  # as if one pair were always possible
    tried = synthesise(design, dataclasses.replace(limits, more_gap_mm=(0.0, 14.0)))
    assert len(only.train.stages) == len(tried.train.stages) == 2
    farther = synthesise(design, dataclasses.replace(limits, more_gap_mm=(14.0,)))
    assert tried.cam.geometry.axis_distance_mm == only.cam.geometry.axis_distance_mm
    assert tried.cam.geometry.axis_distance_mm < farther.cam.geometry.axis_distance_mm
