"""What a blocked motor does to teeth and dog."""

from dataclasses import replace

import pytest
from support.built import built, geared
from support.said import well_told
from support.strengths import changed

from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.train.limits import BLOCKED_FACTOR, blocked_findings


@pytest.mark.parametrize("pairs", [1, 2])
def test_the_last_pinion_gets_the_motors_torque_and_the_dog_all_of_the_ratio(pairs: int) -> None:
    """Lewis: F/(b·m·Y), F the torque over the pinion's pitch radius; a jaw's stress grows evenly with the torque."""
    robot = built("kenan-2.0") if pairs == 1 else geared()
    teeth, dog = blocked_findings(robot)
    assert (teeth.name, dog.name) == ("gear_blocked", "cam_dog_blocked")
    supply, train = supply_of(chosen_parts(robot.workshop)), robot.layout.drive.train
    stall = supply.driven(train.motor, supply.full_v, robot.workshop.safety.motor_torque_max_nm).stall_torque_nm
    stresses, torque = [], stall
    for pair in train.stages:
        gear = pair.pinion
        stresses.append(1000.0 * torque / (gear.module_mm * gear.teeth / 2.0) / (gear.face_width_mm * gear.module_mm))
        stresses[-1] /= gear.lewis_factor
        torque *= pair.wheel.teeth / pair.pinion.teeth
    assert teeth.value == pytest.approx(max(stresses))
    assert dog.value == pytest.approx(LoadCase(robot).dog_stress_mpa(1.0) * torque)
    gears = robot.workshop.material("gears")
    assert teeth.limit == pytest.approx(gears.strength_in_plane_mpa / BLOCKED_FACTOR)
    assert dog.limit == pytest.approx(gears.strength_interlayer_mpa / BLOCKED_FACTOR)
    assert well_told(teeth)
    assert well_told(dog)


@pytest.mark.parametrize("weak", [0, 1])
def test_of_two_pairs_the_one_with_the_larger_stress_is_told(weak: int) -> None:
    """A face of a tenth of the width has ten times the stress of teeth, in the first pair or in the last."""
    robot = geared()
    layout, train = robot.layout, robot.layout.drive.train
    first, last = (
        replace(pair, pinion=replace(pair.pinion, face_width_mm=0.5 if number == weak else 50.0))
        for number, pair in enumerate(train.stages)
    )
    drive = replace(layout.drive, train=replace(train, stages=(first, last)))
    teeth, _ = blocked_findings(replace(robot, layout=replace(layout, drive=drive)))
    supply, allowed = supply_of(chosen_parts(robot.workshop)), robot.workshop.safety.motor_torque_max_nm
    torque = supply.driven(train.motor, supply.full_v, allowed).stall_torque_nm
    expected = last.pinion.lewis_stress_mpa(torque * first.ratio) if weak else first.pinion.lewis_stress_mpa(torque)
    assert teeth.value == pytest.approx(expected)


def test_weak_gears_do_not_bear_a_blocked_motor() -> None:
    robot = built("kenan-2.0")
    teeth, dog = (finding.value for finding in blocked_findings(robot))
    assert min(teeth, dog) > 0.0
    weak = changed(robot, "gears", strength_in_plane_mpa=1.01 * teeth, strength_interlayer_mpa=1.01 * dog)
    assert [found.severity for found in blocked_findings(weak)] == ["warning"] * 2
    held = changed(robot, "gears", strength_in_plane_mpa=1.6 * teeth, strength_interlayer_mpa=1.6 * dog)
    assert [found.severity for found in blocked_findings(held)] == ["info"] * 2
    # the firmware's PWM keeps the torque: with a lower limit there is less of it
    gentle = robot.workshop.safety.model_copy(update={"motor_torque_max_nm": 0.05})
    soft = replace(robot, workshop=robot.workshop.model_copy(update={"safety": gentle}))
    assert next(iter(blocked_findings(soft))).value < 0.4 * teeth
    gentlest = robot.workshop.safety.model_copy(update={"motor_torque_max_nm": 0.01})
    softest = replace(robot, workshop=robot.workshop.model_copy(update={"safety": gentlest}))
    supply, motor = supply_of(chosen_parts(robot.workshop)), robot.layout.drive.train.motor
    usual = robot.workshop.safety.motor_torque_max_nm
    stalls = [supply.driven(motor, supply.full_v, most).stall_torque_nm for most in (0.01, usual)]
    few, more = blocked_findings(softest)
    assert few.value < 1.0
    assert (few.value / teeth, more.value / dog) == pytest.approx((stalls[0] / stalls[1],) * 2)
