"""The manifest's entries on release, stop and joints, against the robot's own figures in degrees."""

import math
from typing import Any

import pytest
from support.built import built
from support.decimals import decimals

from jumpcad.bundle.facts import joint_facts, release_facts, stop_facts
from jumpcad.checks.sideways import play_rad, rolls
from jumpcad.parts.holes import HoleSizes

DEGREES = 180.0 / math.pi


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_release_is_said_in_degrees_and_newton_metres(name: str) -> None:
    """To six decimals; angles by 180/π."""
    release = built(name).release
    facts = release_facts(release)
    expected: dict[str, Any] = {
        "energy_ratio": release.energy_ratio, "energy_ratio_rounded": release.rounded_ratio,
        "energy_ratio_with_bending": release.off.energy_ratio, "bending_ratio": release.bending_ratio,
        "leg_deg": DEGREES * release.off.leg_rad, "leg_rad_s": release.off.leg_rad_s, "kick_nm": release.kick_nm,
        "kick_limit_nm": release.kick_limit_nm, "blow_at_cam_nm": release.blow_nm, "gear_ratio": release.gear_ratio,
        "push_off_s": release.push_off_s, "free_play_deg": DEGREES * release.free_play_rad,
        "roll_over_deg": DEGREES * release.roll_over_rad,
    }  # fmt: skip
    assert {key: value for key, value in facts.items() if key in expected} == pytest.approx(expected, abs=5.1e-7)
    assert facts["window_deg"] == pytest.approx([DEGREES * angle for angle in release.window_rad], abs=5.1e-7)
    assert set(facts) == {*expected, "window_deg", "assumed"}
    assert facts["gear_ratio"] == pytest.approx(release.gear_ratio, abs=5.1e-10)  # gives the reflected inertia
    assert decimals(facts["gear_ratio"]) <= 9
    long = {key for key, value in facts.items() if decimals(value) > 6}
    assert long <= {"gear_ratio", "assumed"}
    assert len(facts["assumed"]) == len(release.parts) == 2
    for one, parts in zip(facts["assumed"], release.parts, strict=True):
        angles = {"backlash_deg": DEGREES * parts.backlash_rad}
        known = {key: angles.get(key, getattr(parts, key, math.nan)) for key in one}
        assert one == pytest.approx(known, rel=1e-8)
        assert len(one) == 11


def test_the_stop_is_said_with_its_pad() -> None:
    """The default workshop's stop stands 3° past rest; the pad gives by an arc of its radius."""
    robot = built("kenan-2.0")
    facts = stop_facts(robot)
    assert facts["angle_deg"] == pytest.approx(robot.workshop.body.stop_deg)
    assert facts["give_mm"] == pytest.approx(facts["radius_mm"] * facts["give_deg"] / DEGREES, rel=0.02)
    assert facts["pad"] == robot.workshop.body.stop_pad
    assert (facts["blow_j"], facts["torque_nm"]) == (robot.stop_blow.energy_j, robot.stop_blow.torque_nm)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_manifest_has_the_roll_in_degrees(name: str) -> None:
    """Standing, the body rolls by its play; the foot stands up to the stance."""
    robot = built(name)
    facts = joint_facts(robot)
    play = math.degrees(play_rad(robot.layout, HoleSizes.of(robot.workshop, robot.layout.hub_bearing)))
    assert facts["play_deg"] == pytest.approx(play, abs=6e-4)
    assert facts["play_deg"] == facts["roll_deg"]["at rest"]["play"]
    for roll in rolls(robot):
        assert facts["roll_deg"][roll.state] == pytest.approx(
            {"stance": roll.stance_deg, "play": roll.play_deg}, abs=6e-4
        )
    assert facts["axle_mm"] == robot.workshop.bought.axle_mm
    assert facts["pinion_rib_mm"] == robot.workshop.fits.rib_mm
    assert facts["toe_half_width_mm"] == pytest.approx(robot.layout.toe_half_width_mm, abs=6e-4)
    assert (facts["retention"], facts["axle"]) == (robot.workshop.bought.retention, robot.workshop.bought.axle)
