"""Choosing gears against a brute-force search, and against the value of winding time."""

import dataclasses
import itertools
import math

import pytest
from support.limits import default_limits, law_of

from jumpcad.catalogue import load_catalogue
from jumpcad.drive.gear_choice import _printable, by_cost, least_tip_mm
from jumpcad.drive.gears import Gear, gear_pair, least_shift
from jumpcad.drive.motor import winding_s
from jumpcad.drive.train import NoTrainError, synthesise_train

MOTORS = list(load_catalogue().motors.values())
SHARE = 0.25 * 0.95 / 1.1
"""Of the stall torque: a quarter, 5 % of it in reserve, for springs that may be 10 % stiffer."""
LIMITS = default_limits().train


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_no_lighter_single_pair_would_do(name):
    law = law_of(name)
    motor = load_catalogue().motors["n20-298"]
    limits = dataclasses.replace(LIMITS, modules_mm=(1.25,), seconds_per_gram=1e9)
    train = synthesise_train(law, [motor], limits)
    (chosen,) = train.stages
    needed = law.peak_torque_nm / (0.85 * 0.9) / (SHARE * motor.stall_torque_nm)
    size = chosen.pinion.teeth**2 + chosen.wheel.teeth**2
    for pinion, wheel in itertools.product(range(12, 40), range(13, 60)):
        if wheel < pinion or pinion**2 + wheel**2 >= size or wheel / pinion < needed:
            continue
        pair = gear_pair(pinion, wheel, 1.25, 5.0, 0.15)
        stress = pair.pinion.lewis_stress_mpa(law.peak_torque_nm / 0.85 / pair.ratio)
        assert (
            pair.centre_distance_mm < limits.motor_distance_min_mm
            or stress > limits.stress_mpa
            or pair.pinion.tip_thickness_mm < limits.tip_min_mm
            or pair.wheel.root_radius_mm < limits.cam_gear_root_min_mm
            or motor.no_load_rpm * math.pi / 30 / pair.ratio > limits.cam_speed_max_rad_s
        ), f"{pinion}:{wheel} is smaller"


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga", "best-bo"])
def test_who_is_in_a_hurry_gets_heavier_gears(name):
    """The seconds of winding accepted per gram of gears decide between motors of one winding, and between ratios.

    Among all windings the strongest can be both the quickest and the one with the lightest gears.
    """
    low_power = [motor for motor in MOTORS if motor.stall_current_a == 0.36]
    hurry, patience = (
        synthesise_train(law_of(name), low_power, dataclasses.replace(LIMITS, seconds_per_gram=seconds))
        for seconds in (0.01, 1e6)
    )
    gears = [
        sum(p.pinion.module_mm**2 * (p.pinion.teeth**2 + p.wheel.teeth**2) for p in t.stages) for t in (hurry, patience)
    ]
    assert hurry.winding_s < patience.winding_s
    assert gears[0] > gears[1]


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga", "best-bo"])
def test_the_least_cam_gear_turns_the_cam_alone_and_none_smaller_does(name):
    tip = least_tip_mm(law_of(name), MOTORS, LIMITS)
    assert least_tip_mm(law_of(name), MOTORS, dataclasses.replace(LIMITS, cam_gear_tip_max_mm=tip - 1.0)) == tip
    just, too_small = (dataclasses.replace(LIMITS, cam_gear_tip_max_mm=tip + more) for more in (1e-6, -1e-6))
    train = synthesise_train(law_of(name), MOTORS, just)
    assert len(train.stages) == 1
    assert train.stages[-1].wheel.tip_radius_mm <= tip + 1e-6
    try:
        assert len(synthesise_train(law_of(name), MOTORS, too_small).stages) == 2
    except NoTrainError:  # around the cam's dog no smaller wheel keeps a wall
        assert tip - 2.25 * max(LIMITS.modules_mm) < LIMITS.cam_gear_root_min_mm


def test_the_least_cam_gear_is_that_of_the_motor_which_asks_for_least():
    """A larger motor of the same figures needs more distance, wherever it stands in the list."""
    law, small = law_of("kenan-2.0"), load_catalogue().motors["n20-298"]
    large = small.model_copy(update={"width_mm": 80.0, "height_mm": 80.0})
    tips = [least_tip_mm(law, motors, LIMITS) for motors in ([small], [large], [small, large], [large, small])]
    assert tips[1] > tips[0] + 1.0
    assert tips[2:] == [tips[0]] * 2


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_a_motor_that_must_be_farther_away_asks_for_a_larger_cam_gear(name):
    """Of all single pairs that keep 40 mm to the motor, the one with the smallest cam gear."""
    far = dataclasses.replace(LIMITS, motor_distance_min_mm=40.0)
    tip = least_tip_mm(law_of(name), MOTORS, far)
    assert tip > least_tip_mm(law_of(name), MOTORS, LIMITS) + 1.0
    any_size = dataclasses.replace(far, cam_gear_tip_max_mm=1.2 * tip)
    tips = [pair.wheel.tip_radius_mm for _, (pair,) in by_cost(law_of(name), MOTORS, any_size, 1)]
    assert min(tips) == pytest.approx(tip)


@pytest.mark.parametrize(("seconds_per_gram", "count"), [(2.0, 1), (0.5, 1), (2.0, 2), (0.2, 2)])
def test_gears_come_in_the_order_of_their_mass_and_of_what_time_is_worth(seconds_per_gram, count):
    """Solid discs of PETG, 1.27 g/cm³, as wide as the teeth, over their pitch circles; and the motors' own mass."""
    motors = [motor.model_copy(update={"mass_g": 8.0 + number % 3}) for number, motor in enumerate(MOTORS)]
    law, limits = law_of("best-bo"), dataclasses.replace(LIMITS, seconds_per_gram=seconds_per_gram)
    costs = []
    for motor, stages in by_cost(law, motors, limits, count):
        radii = [gear.pitch_radius_mm / 10.0 for pair in stages for gear in (pair.pinion, pair.wheel)]
        grams = 1.27 * math.pi * sum(radius**2 for radius in radii) * limits.face_width_mm / 10.0
        seconds = winding_s(law, motor, math.prod(pair.ratio for pair in stages), limits.efficiency(count))
        costs.append(motor.mass_g + grams + seconds / seconds_per_gram)
    assert len(costs) > 12
    assert costs == pytest.approx(sorted(costs))


def test_of_two_pairs_every_pinion_bears_the_torque_with_the_losses_behind_it():
    """From the cam towards the motor: 0.85 of cam and roller, 0.9 of the last pair; Lewis stress at the pinion."""
    law, nearest = law_of("best-bo"), 0.0
    for stress in (2.0, 3.0, 4.0, 6.0, 8.0):
        limits = dataclasses.replace(LIMITS, stress_mpa=stress)
        for _, (first, last) in itertools.islice(by_cost(law, MOTORS, limits, 2), 60):
            at_wheel = law.peak_torque_nm / 0.85
            of_last = last.pinion.lewis_stress_mpa(at_wheel / last.ratio)
            of_first = first.pinion.lewis_stress_mpa(at_wheel / last.ratio / 0.9 / first.ratio)
            assert max(of_last, of_first) <= stress * (1.0 + 1e-9)
            nearest = max(nearest, of_first / stress)
    assert nearest > 0.85  # some are near the limit


def test_of_two_pairs_the_idlers_wheel_passes_beside_the_cams_axle():
    """Its tips keep the radius of the axle with its spacers from the cam's axis, as large as that may be."""
    law = law_of("best-bo")
    for axle, idler, motor in ((3.0, 0.0, 12.0), (8.0, 25.0, 45.0), (12.0, 35.0, 60.0)):
        limits = dataclasses.replace(LIMITS, axle_mm=axle, idler_distance_min_mm=idler, motor_distance_min_mm=motor)
        nearest = math.inf
        for _, (first, last) in itertools.islice(by_cost(law, MOTORS, limits, 2), 60):
            room = last.centre_distance_mm - first.wheel.tip_radius_mm - axle
            assert room >= -1e-9
            assert last.centre_distance_mm >= limits.idler_distance_min_mm
            assert first.centre_distance_mm + last.centre_distance_mm >= limits.motor_distance_min_mm
            nearest = min(nearest, room, math.inf if not idler else last.centre_distance_mm - idler)
        assert nearest < 2.0, axle  # some are near the limit


@pytest.mark.parametrize("far_mm", [22.0, 28.0])
def test_one_pair_keeps_the_motor_as_far_from_the_cam_as_it_must_be(far_mm):
    """Some are near that distance; the cam gear's tips and root are within their limits too."""
    limits, nearest = dataclasses.replace(LIMITS, motor_distance_min_mm=far_mm), math.inf
    for motor, (pair,) in by_cost(law_of("kenan-2.0"), MOTORS, limits, 1):
        least = limits.beside(motor).motor_distance_min_mm
        assert pair.centre_distance_mm >= least - 1e-9
        assert pair.wheel.tip_radius_mm <= limits.cam_gear_tip_max_mm
        assert pair.wheel.root_radius_mm >= limits.cam_gear_root_min_mm
        nearest = min(nearest, pair.centre_distance_mm - least)
    assert nearest < 1.0


def test_the_table_of_pairs_has_the_circles_of_their_gears():
    table = _printable((1.0, 1.25), 0.15, 0.45, 2.9)
    with pytest.raises(ValueError, match="read-only"):  # it is kept for the next robot
        table["wheel"][0] = 1.0
    rows = getattr(table, "table", table)
    for row in rows[:: len(rows) // 60]:
        module, teeth = float(row["module"]), int(row["wheel"])
        wheel = Gear(teeth, module, max(0.0, least_shift(teeth)), 1.0, 0.075)
        assert row["tip_mm"] == pytest.approx(wheel.tip_radius_mm)
        assert row["root_mm"] == pytest.approx(wheel.root_radius_mm)
        pinion = Gear(int(row["pinion"]), module, max(0.0, least_shift(int(row["pinion"]))), 1.0, 0.075)
        assert row["lewis"] == pytest.approx(pinion.lewis_factor)
        assert row["pinion"] >= row["least_teeth"]
        pair = gear_pair(pinion.teeth, teeth, module, 1.0, 0.15)
        assert row["distance_mm"] == pytest.approx(pair.centre_distance_mm)


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("changed", [{"pinion_root_min_mm": 7.0}, {"tip_min_mm": 0.6}, {"modules_mm": (1.5,)}])
def test_gears_that_are_offered_print_and_hold_their_shafts(count, changed):
    """Tips as wide, roots as thick, and modules such as the limits have them."""
    limits, offered = dataclasses.replace(LIMITS, **changed), 0
    for motor, stages in by_cost(law_of("kenan-2.0"), MOTORS, limits, count):
        for pair in stages:
            assert pair.pinion.root_radius_mm >= limits.beside(motor).pinion_root_min_mm - 1e-9
            assert Gear(pair.pinion.teeth, pair.pinion.module_mm, pair.pinion.shift, 1.0, 0.075).tip_thickness_mm >= (
                limits.tip_min_mm
            )
            assert pair.pinion.module_mm in limits.modules_mm
            offered += 1
    assert offered
