"""The drive's findings: those of its synthesis, an error where a limit is violated."""

import math
from dataclasses import replace

import pytest
from support.built import built, geared
from support.each import each
from support.said import well_told
from support.strengths import changed
from support.workshops import workshop_with

from jumpcad.electronics.supply import chosen_parts, supply_of
from jumpcad.findings import errors
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.robot.train.thing import BLOCKED_FACTOR, blocked_findings, drive_findings


def test_a_margin_that_is_not_a_number_is_an_error(kenan: Robot) -> None:
    lost = replace(kenan.release.findings[0], margin=math.nan)
    release = replace(kenan.release, findings=(lost, *kenan.release.findings[1:]))
    (error,) = errors(drive_findings(replace(kenan, release=release)))
    assert error.name == lost.name


@each("name", sorted({finding.name for finding in built("kenan-2.0").layout.drive.findings}))
def test_what_the_drive_violates_is_an_error(kenan: Robot, name: str) -> None:
    assert kenan.layout is not None
    drive = kenan.layout.drive
    findings = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.train.findings)
    spring = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.spring.findings)
    cam = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.cam.findings)
    springs, turned = replace(drive.spring, findings=spring), replace(drive.cam, findings=cam)
    violated = replace(drive, spring=springs, cam=turned, train=replace(drive.train, findings=findings))
    robot = replace(kenan, layout=replace(kenan.layout, drive=violated))
    assert [finding.name for finding in errors(drive_findings(robot))] == [name]


@pytest.mark.parametrize(
    ("margin", "told", "severity"),
    [(1e-9, 0.0, "info"), (-1e-9, 0.0, "info"), (-1e-5, -1e-5, "error"), (1e-5, 1e-5, "info"), (0.3, 0.3, "info")],
)
def test_a_cam_that_ends_on_its_limit_has_nothing_left_and_is_no_error(
    kenan: Robot, margin: float, told: float, severity: str
) -> None:
    """The cam's search ends on its limits, within 1e-9 of them."""
    cam = kenan.layout.drive.cam
    findings = (replace(cam.findings[0], margin=margin), *cam.findings[1:])
    drive = replace(kenan.layout.drive, cam=replace(cam, findings=findings))
    found = drive_findings(replace(kenan, layout=replace(kenan.layout, drive=drive)))
    (limit,) = (one for one in found if one.name == cam.findings[0].name)
    assert (limit.margin, limit.severity) == (told, severity)


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
    soft, softest = (
        replace(robot, workshop=workshop_with(robot.workshop, safety={"motor_torque_max_nm": most}))
        for most in (0.05, 0.01)
    )
    assert next(iter(blocked_findings(soft))).value < 0.4 * teeth
    supply, motor = supply_of(chosen_parts(robot.workshop)), robot.layout.drive.train.motor
    usual = robot.workshop.safety.motor_torque_max_nm
    stalls = [supply.driven(motor, supply.full_v, most).stall_torque_nm for most in (0.01, usual)]
    few, more = blocked_findings(softest)
    assert few.value < 1.0
    assert (few.value / teeth, more.value / dog) == pytest.approx((stalls[0] / stalls[1],) * 2)
