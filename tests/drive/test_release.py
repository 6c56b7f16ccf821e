"""The release against conservation of energy and momentum, and its limits; simulated in tests/clients."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, geared
from support.decimals import decimals
from support.said import well_told
from support.strengths import with_motor_of

from jumpcad import build, load_design, load_workshop
from jumpcad.building.bodies import release_of
from jumpcad.drive.corner import roll_over
from jumpcad.drive.release import Release, _kick_limit_nm
from jumpcad.drive.rolling import ReleaseParts, Rolled, roll
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable")


def released(robot: Robot, **other: float) -> tuple[Rolled, ReleaseParts]:
    """The release over the sharp corner with the heavier rotor, some of its parts replaced."""
    parts = replace(robot.release.parts[1], **other)
    corner = roll_over(robot.layout.drive.cam.geometry)
    return roll(corner, parts, float(corner.wind_rad.max())), parts


def workshop(**release: object) -> Workshop:
    shop = load_workshop()
    return Workshop(**(shop.model_dump() | {"release": shop.release.model_dump() | release}))


@pytest.mark.parametrize("name", TEMPLATES)
def test_every_template_keeps_its_energy_and_its_motor(name: str) -> None:
    release = built(name).release
    assert min(release.energy_ratio, release.rounded_ratio) >= 0.97
    assert 1.1 * release.kick_nm <= release.kick_limit_nm
    assert math.degrees(release.free_play_rad) == pytest.approx(math.degrees(release.roll_over_rad) + 3.0, abs=1e-3)
    assert release.window_rad[0] < release.free_play_rad < release.window_rad[1]
    assert all(map(well_told, release.findings))


def test_a_simulation_starts_with_figures_that_do_not_differ_between_processors() -> None:
    """Angles and shares to nine decimals, rates to six."""
    offs = [built(name).release.off for name in TEMPLATES]
    assert decimals([(off.leg_rad, off.energy_ratio) for off in offs]) == 9
    assert decimals([off.leg_rad_s for off in offs]) == 6


def test_the_kick_is_limited_by_the_teeth_of_the_pinion_that_bears_least() -> None:
    """At the limit, without one of the motor, the worst pinion has the allowed stress; each gets what is before it."""
    robot = geared()
    shop, drive = robot.workshop, robot.layout.drive
    limit = _kick_limit_nm(drive, with_motor_of(shop, 1e6))
    first, second = drive.train.stages
    stresses = [first.pinion.lewis_stress_mpa(limit), second.pinion.lewis_stress_mpa(limit * first.ratio)]
    teeth_mpa = shop.material("gears").strength_in_plane_mpa / shop.safety.printed_factor
    assert max(stresses) == pytest.approx(teeth_mpa)
    assert _kick_limit_nm(drive, with_motor_of(shop, 0.9 * limit)) == pytest.approx(0.9 * limit)


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_quick_motor_turns_the_cam_as_it_does_on_a_full_battery(name: str) -> None:
    """Speed is proportional to voltage: of a full cell's 4.2 V the motor's driver takes less than half a volt."""
    robot = built(name)
    train = robot.layout.drive.train
    free_rad_s = train.motor.no_load_rpm * 2.0 * math.pi / 60.0 / train.ratio
    volts = robot.release.parts[0].cam_rad_s / free_rad_s * train.motor.voltage_v
    assert 3.7 < volts < 4.2


@pytest.mark.parametrize("name", ["best-bo", "best-ga"])
def test_the_bent_lever_costs_its_own_share(name: str) -> None:
    """The leg is wound less by kδ/K, K the stiffness of lever and contact: 2·k/K of the energy, less for its weight."""
    robot = built(name)
    release, parts = robot.release, robot.release.parts[0]
    softness = 1.0 / parts.lever_nm_per_rad + 1.0 / parts.contact_nm_per_rad
    share = 2.0 * robot.spring.stiffness_nm_per_rad * softness
    assert 1.0 - release.bending_ratio == pytest.approx(share, rel=0.25)
    assert release.off.energy_ratio == pytest.approx(release.bending_ratio * release.energy_ratio, rel=2e-3)


def test_what_bent_the_lever_drives_the_cam() -> None:
    """Without friction and mass of the roller, the cam gets the energy of the lever, and the leg keeps the rest.

    A train without rebound or losses turns the cam's speed into the torque v·√(k·J·Jg/(J + Jg)).
    """
    robot = built("best-ga")
    rolled, parts = released(
        robot, friction_mm=0.0, cam_rad_s=0.1, roller_kg_m2=0.0, contact_nm_per_rad=1e9, rebound=1.0
    )
    wound = robot.spring.wind_rad
    torque = robot.spring.torque_nm(-wound) + float(parts.leg.at(np.array(wound))[2])
    bent_j = 0.5 * torque**2 / parts.lever_nm_per_rad
    speed = 0.1 + rolled.blow_nm / math.sqrt(
        parts.train_nm_per_rad * parts.cam_kg_m2 * parts.gear_kg_m2 / (parts.cam_kg_m2 + parts.gear_kg_m2)
    )
    gained = 0.5 * parts.cam_kg_m2 * speed**2
    assert gained == pytest.approx(bent_j, rel=0.03)
    assert rolled.kept_j == pytest.approx(rolled.held_j, rel=1e-3)


def test_a_stiffer_lever_kicks_less() -> None:
    robot = built("best-ga")
    usual, parts = released(robot, contact_nm_per_rad=1e9)
    stiff, _ = released(robot, contact_nm_per_rad=1e9, lever_nm_per_rad=4.0 * parts.lever_nm_per_rad)
    assert stiff.kick_nm == pytest.approx(usual.kick_nm / 2.0, rel=0.12)  # a fourth of the energy
    assert stiff.kept_j > usual.kept_j


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_release_is_the_worst_of_its_cases(name: str) -> None:
    """Over a sharp corner and over a rounded one, with either motor: least energy kept, largest blow and kick."""
    robot = built(name)
    found, geometry = robot.release, robot.layout.drive.cam.geometry
    wound = float(roll_over(geometry).wind_rad.max())
    corners = roll_over(geometry), roll_over(geometry, robot.workshop.release.corner_radius_mm)
    sharp, rounded = ([roll(corner, parts, wound) for parts in found.parts] for corner in corners)
    for ratio, rolled in ((found.energy_ratio, sharp), (found.rounded_ratio, rounded)):
        assert ratio == pytest.approx(min(one.kept_j for one in rolled) / rolled[0].held_j, rel=1e-3)
    (energy,) = (finding for finding in found.findings if finding.name == "release_energy")
    assert energy.value == pytest.approx(100.0 * min(found.energy_ratio, found.rounded_ratio))
    assert found.energy_ratio != found.rounded_ratio
    assert found.blow_nm == max(one.blow_nm for one in (*sharp, *rounded))
    assert found.kick_nm == pytest.approx(max(one.kick_nm for one in (*sharp, *rounded)) / found.gear_ratio)


def test_lever_and_contact_are_springs_in_series() -> None:
    robot = built("best-ga")
    parts = robot.release.parts[1]
    both, _ = released(robot)
    alone, _ = released(robot, lever_nm_per_rad=parts.held_nm_per_rad, contact_nm_per_rad=1e12)
    assert both.kick_nm == pytest.approx(alone.kick_nm, rel=1e-6)
    assert 1.0 / parts.held_nm_per_rad == pytest.approx(1.0 / parts.lever_nm_per_rad + 1.0 / parts.contact_nm_per_rad)


def axial_kg_m2(robot: Robot, name: str) -> float:
    """Return a gear's moment of inertia about its own axis, upright as it is printed."""
    (part,) = (part for part in robot.parts if part.name == name)
    return float(part.mass.inertia_kg_m2[2, 2])


@pytest.mark.parametrize("pairs", [1, 2])
def test_the_motor_counts_as_seen_from_the_cam(pairs: int) -> None:
    """Rotor and pinion by the square of the ratio, backlash by the ratio; friction in the cam's bore at its radius."""
    robot = built("kenan-2.0") if pairs == 1 else geared()
    table, train = robot.workshop.release, robot.layout.drive.train
    assert len(train.stages) == pairs
    bore = robot.layout.axle_mm + 2.0 * robot.workshop.fits.sliding_mm
    pinion, wheel = (axial_kg_m2(robot, name) for name in ("motor_pinion", "cam_gear"))
    for parts, rotor, play in zip(robot.release.parts, table.rotor_kg_m2, table.backlash_deg, strict=True):
        assert parts.rotor_kg_m2 == pytest.approx(rotor * (train.motor.ratio * train.ratio) ** 2)
        assert parts.gear_kg_m2 == pytest.approx(wheel + pinion * train.ratio**2, rel=1e-3)
        assert parts.backlash_rad == pytest.approx(math.radians(play) / train.ratio)
        assert parts.friction_mm == pytest.approx(table.friction * bore / 2.0)


def test_the_reserve_is_added_to_the_kick() -> None:
    robot = built("best-ga")
    shop = load_workshop()
    larger = Workshop(**(shop.model_dump() | {"safety": shop.safety.model_dump() | {"kick_reserve": 0.5}}))
    for reserve, found in ((0.1, robot.release), (0.5, build(load_design("best-ga"), larger).release)):
        (kick,) = [finding for finding in found.findings if finding.name == "release_kick"]
        assert kick.value == pytest.approx(1000.0 * (1.0 + reserve) * found.kick_nm)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga"])
def test_a_rigid_key_and_too_little_play_lose_what_the_dog_keeps(name: str) -> None:
    robot = built(name)
    for play_deg in (0.0, 3.0, 5.0):
        rolled, _ = released(robot, play_rad=math.radians(play_deg), cam_rad_s=0.2)
        assert rolled.kept_j < 0.95 * rolled.held_j
        assert rolled.wind_rad_s < 0.0, "towards rest, although the roller bounced"


def test_a_rigid_key_fails_its_checks() -> None:
    release: Release = build(load_design("best-bo"), workshop(play_deg=0.0)).release
    assert release.free_play_rad == 0.0
    failed = {finding.name for finding in release.findings if finding.severity == "error"}
    assert {"release_energy", "release_kick"} <= failed
    assert all("play_deg" in finding.remedy for finding in release.findings)
    (energy,) = (finding for finding in release.findings if finding.name == "release_energy")
    enough = round(math.degrees(release.roll_over_rad) + 3.0)  # as by "auto"
    assert f'release.play_deg = "auto" or more than {enough},' in energy.remedy


def test_a_play_beyond_the_window_fails_its_check() -> None:
    release = built("best-bo").release
    (found,) = [finding for finding in release.findings if finding.name == "release_window"]
    assert found.value < found.limit
    turned = built("best-bo").layout.drive.train.cam_speed_rad_s * release.push_off_s
    assert found.value == pytest.approx(math.degrees(release.free_play_rad + turned) + 3.0)
    assert found.limit == pytest.approx(math.degrees(release.window_rad[1]))
    with pytest.raises(
        JumpcadError, match=r"roller's fall, with the dog's play.*release\.play_deg|smaller bought.roller"
    ):
        build(load_design("kenan-2.0"), workshop(play_deg=60.0))


@pytest.mark.parametrize("play_deg", [0.5, 5.0, 11.9])
def test_a_play_that_is_worse_than_none_is_refused(play_deg: float) -> None:
    with pytest.raises(JumpcadError, match=r'release\.play_deg.*at least 12, 0 \(rigid\), or "auto"'):
        workshop(play_deg=play_deg)


def test_the_result_does_not_hang_on_the_places_along_the_corner(monkeypatch: pytest.MonkeyPatch) -> None:
    robot = built("best-ga")
    usual, _ = released(robot)
    monkeypatch.setattr("jumpcad.drive.corner.POSITIONS", 6401)
    fine, _ = released(robot)
    assert usual.kept_j == pytest.approx(fine.kept_j, rel=5e-4)
    assert usual.kick_nm == pytest.approx(fine.kick_nm, rel=0.03)


@pytest.mark.parametrize("name", TEMPLATES)
def test_jumps_start_where_the_roller_leaves(name: str) -> None:
    robot = built(name)
    assert robot.roller_off == robot.release.off
    assert -robot.spring.wind_rad < robot.release.off.leg_rad < -0.95 * robot.spring.wind_rad
    assert np.isfinite(robot.release.off.leg_rad_s)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga"])
def test_the_contact_is_as_stiff_about_the_pivot_as_its_lever_arm_says(name: str) -> None:
    """Stiffness times the arm's square; the arm is the springs' torque at the lift's end over the contact force."""
    robot = built(name)
    arm_m = robot.spring.peak_torque_nm / robot.layout.drive.cam.peak_contact_n
    expected = 1000.0 * robot.workshop.release.contact_n_per_mm * arm_m**2
    for parts in robot.release.parts:
        assert parts.contact_nm_per_rad == pytest.approx(expected, rel=0.05)


def test_a_motor_as_quick_as_a_fan_brings_the_next_lift_under_the_roller() -> None:
    robot = built("kenan-2.0")
    train = robot.layout.drive.train
    quick = replace(train, cam_speed_rad_s=10.0 * train.cam_speed_rad_s)
    layout = replace(robot.layout, drive=replace(robot.layout.drive, train=quick))
    found = release_of(layout, robot.workshop, robot.parts, robot.hardware, robot.bodies, robot.spring)
    assert [finding.name for finding in errors(found.findings)] == ["release_window"]


def test_a_corner_wears_until_its_contact_shakes_down() -> None:
    """Hertz: p² = N·E'/(π·b)·(1/ρ + 1/R) on that radius is (4·k)², k = σ/√3, of PETG of 45 MPa and 2 GPa."""
    robot = built("best-bo")
    cam, width = robot.layout.drive.cam, 4.0
    flat = 2000.0 / (1.0 - 0.38**2) * cam.peak_contact_n / (math.pi * width)
    pressure = math.sqrt(flat * (1.0 / cam.worn_mm + 1.0 / cam.geometry.roller_radius_mm))
    assert pressure == pytest.approx(4.0 * 45.0 / math.sqrt(3.0), rel=1e-3)
    assert 0.0 < robot.release.worn_rad < math.radians(10.0)
    sharp, worn = (next(one.value for one in robot.release.findings if one.name == name) for name in NAMES)
    assert 97.0 < (worn or 0.0) < (sharp or 0.0)


NAMES = ("release_energy", "cam_corner")
