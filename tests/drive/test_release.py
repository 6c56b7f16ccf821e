"""The release against conservation of energy and momentum, and its limits; simulated in tests/clients."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad import build, load_design, load_workshop
from jumpcad.drive.corner import roll_over
from jumpcad.drive.release import Release
from jumpcad.drive.rolling import ReleaseParts, Rolled, roll
from jumpcad.errors import JumpcadError
from jumpcad.robot import Robot
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
    assert release.kick_nm <= release.kick_limit_nm
    assert math.degrees(release.free_play_rad) == pytest.approx(math.degrees(release.roll_over_rad) + 3.0, abs=1e-3)
    assert release.window_rad[0] < release.free_play_rad < release.window_rad[1]


@pytest.mark.parametrize("name", ["best-bo", "best-ga"])
def test_the_bent_lever_costs_its_own_share(name: str) -> None:
    """The leg is wound less by kδ/K, K the lever's stiffness at the joint: 2·k/K of the energy, less for its weight."""
    robot = built(name)
    release, parts = robot.release, robot.release.parts[0]
    share = 2.0 * robot.spring.stiffness_nm_per_rad / parts.lever_nm_per_rad
    assert 1.0 - release.bending_ratio == pytest.approx(share, rel=0.25)
    assert release.off.energy_ratio == pytest.approx(release.bending_ratio * release.energy_ratio, rel=2e-3)


def test_what_bent_the_lever_drives_the_cam() -> None:
    """Without friction and mass of the roller, the cam gets the energy of the lever, and the leg keeps the rest."""
    robot = built("best-ga")
    rolled, parts = released(robot, friction_mm=0.0, cam_rad_s=0.1, roller_kg_m2=0.0)
    wound = robot.spring.wind_rad
    torque = robot.spring.torque_nm(-wound) + float(parts.leg.at(np.array(wound))[2])
    bent_j = 0.5 * torque**2 / parts.lever_nm_per_rad
    speed = rolled.blow_nm / math.sqrt(
        parts.train_nm_per_rad * parts.cam_kg_m2 * parts.gear_kg_m2 / (parts.cam_kg_m2 + parts.gear_kg_m2)
    )
    gained = 0.5 * parts.cam_kg_m2 * speed**2
    assert gained == pytest.approx(bent_j, rel=0.03)
    assert rolled.kept_j == pytest.approx(rolled.held_j, rel=1e-3)


def test_a_stiffer_lever_kicks_less() -> None:
    robot = built("best-ga")
    usual, parts = released(robot)
    stiff, _ = released(robot, lever_nm_per_rad=4.0 * parts.lever_nm_per_rad)
    assert stiff.kick_nm == pytest.approx(usual.kick_nm / 2.0, rel=0.12)  # a fourth of the energy
    assert stiff.kept_j > usual.kept_j


def test_a_heavy_rotor_is_met_with_the_momentum_of_cam_and_gear() -> None:
    """Without rebound, speed times J/(J + Jg), then the torque that stops both in the train's spring."""
    robot = built("best-ga")
    rolled, parts = released(robot, rotor_kg_m2=1e3, rebound=0.0)
    cam, gear = parts.cam_kg_m2, parts.gear_kg_m2
    assert rolled.kick_nm == pytest.approx(rolled.blow_nm * math.sqrt(cam / gear), rel=1e-6)
    thrown, _ = released(robot, rotor_kg_m2=1e3, rebound=0.6)
    assert thrown.kick_nm == pytest.approx(1.6 * rolled.blow_nm * math.sqrt(cam / (cam + gear)), rel=1e-6)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga"])
def test_a_rigid_key_and_too_little_play_lose_what_the_dog_keeps(name: str) -> None:
    robot = built(name)
    for play_deg in (0.0, 3.0, 5.0):
        rolled, _ = released(robot, play_rad=math.radians(play_deg), cam_rad_s=0.2)
        assert rolled.kept_j < 0.95 * rolled.held_j


def test_a_rigid_key_fails_its_checks() -> None:
    release: Release = build(load_design("best-bo"), workshop(play_deg=0.0)).release
    assert release.free_play_rad == 0.0
    failed = {finding.name for finding in release.findings if finding.severity == "error"}
    assert {"release_energy", "release_kick"} <= failed
    assert all("play_deg" in finding.remedy for finding in release.findings)


def test_a_play_beyond_the_window_fails_its_check() -> None:
    release = built("best-bo").release
    (found,) = [finding for finding in release.findings if finding.name == "release_window"]
    assert found.value < found.limit
    with pytest.raises(
        JumpcadError, match=r"roller's fall, with the dog's play.*release\.play_deg|smaller bought.roller"
    ):
        build(load_design("kenan-2.0"), workshop(play_deg=60.0))


@pytest.mark.parametrize("play_deg", [0.5, 5.0, 11.9])
def test_a_play_that_is_worse_than_none_is_refused(play_deg: float) -> None:
    with pytest.raises(JumpcadError, match=r'release\.play_deg.*at least 12, 0 \(rigid\), or "auto"'):
        workshop(play_deg=play_deg)


def test_ranges_ascend() -> None:
    with pytest.raises(JumpcadError, match=r"release\.backlash_deg.*must be at most 2"):
        workshop(backlash_deg=(5.0, 2.0))


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
