"""The manifest's entries on release, stop and joints, against the robot's own figures in degrees."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.built import built
from support.workshops import workshop_with

from jumpcad.bundle.facts import (
    allowable_mpa,
    arms_off_deg,
    early_torque_share,
    flight_facts,
    least_energy_share,
    loaded_arms,
    spring_facts,
    stop_facts,
    torque_shares,
)
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate

DEGREES = 180.0 / math.pi


def test_the_stop_is_said_with_its_pad() -> None:
    """The default workshop's stop stands 3° past rest; the pad gives by an arc of its radius."""
    robot = built("kenan-2.0")
    facts = stop_facts(robot)
    assert facts["angle_deg"] == pytest.approx(robot.workshop.body.stop_deg)
    assert facts["give_mm"] == pytest.approx(facts["radius_mm"] * facts["give_deg"] / DEGREES, rel=0.02)
    assert facts["pad"] == robot.workshop.body.stop_pad
    assert (facts["blow_j"], facts["torque_nm"]) == (robot.stop_blow.energy_j, robot.stop_blow.torque_nm)


def test_the_flight_is_that_of_the_other_engine_and_the_offset_that_of_the_bodies(
    bundle_of: Callable[..., Path],
) -> None:
    needs.package("mujoco")
    manifest = json.loads((bundle_of("kenan-2.0") / "manifest.json").read_text())
    flight, bodies = manifest["flight"], manifest["bodies"].values()
    other = simulate(built("kenan-2.0"), engine="mujoco")
    assert flight["turn_deg"] == pytest.approx(other.turn_deg, abs=1.0)
    assert flight["touchdown_pitch_deg"] == pytest.approx(other.touchdown_pitch_deg, abs=1.0)
    aside_m = sum(body["mass_kg"] * body["com_m"][1] for body in bodies) / manifest["mass_kg"]
    assert flight["lateral_offset_mm"] == pytest.approx(1000.0 * aside_m, abs=1e-3)
    assert flight_facts(simulate(built("kenan-2.0"), Settings(spring_efficiency=0.1))) is None


def test_the_torque_that_is_accepted_is_between_weak_and_strong(robot: Robot) -> None:
    """Least: 10 % softer and 10° narrower, rounded up; most: 10 % more, or what the wire bears without its reserve."""
    spring = robot.layout.drive.spring
    wound = math.degrees(spring.wound_rad)
    least, most = torque_shares(robot)
    assert 0.0 <= 100.0 * (least - 0.9 * (1.0 - 10.0 / wound)) < 1.0
    assert allowable_mpa(robot) == pytest.approx(1.05 * spring.allowable_mpa)
    assert 0.0 <= 100.0 * (min(1.1, allowable_mpa(robot) / spring.stress_mpa) - most) < 1.0
    assert arms_off_deg(robot) == (10.0, math.floor(0.1 * wound))


def test_the_wire_bears_what_is_in_reserve_for_stress_and_for_nothing_else(robot: Robot) -> None:
    """20 % more than it is sized for, whatever the motor's torque has in reserve."""
    reserves = {"stress_reserve": 0.2, "motor_torque_reserve": 0.4, "kick_reserve": 0.3}
    other = replace(robot, workshop=workshop_with(robot.workshop, safety=reserves))
    assert allowable_mpa(other) == pytest.approx(1.2 * robot.layout.drive.spring.allowable_mpa)


@pytest.mark.parametrize(
    ("angle", "said"),
    [(30.0, "30.0° apart"), (0.6, "0.6° apart"), (-0.6, "crossed by 0.6°"), (-25.0, "crossed by 25.0°")],
)
def test_loaded_arms_are_apart_until_they_are_parallel_and_crossed_beyond(angle: float, said: str) -> None:
    """Relaxed arms stand apart by half a turn, less the part of a turn beyond whole ones."""
    robot = built("kenan-2.0")
    drive = robot.layout.drive
    free = angle + math.degrees(drive.spring.wound_rad)
    spring = replace(drive.spring, turns=4.0 + (180.0 - free) % 360.0 / 360.0)
    turned = replace(robot, layout=replace(robot.layout, drive=replace(drive, spring=spring)))
    assert loaded_arms(turned) == said


def test_the_manifest_has_both_springs_with_their_pins(robot: Robot) -> None:
    """The robot's left has the right-hand one; pins lie at one distance from the hub, as far as the arms reach."""
    spring = robot.layout.drive.spring
    left, right = spring_facts(robot)
    assert (left["side"], left["hand"]) == ("left", "right")
    assert (right["side"], right["hand"]) == ("right", "left")
    different = {key for key in left if left[key] != right[key]}
    assert different == {"side", "hand"}
    radius = math.hypot((spring.arms.mean_mm + spring.wire_mm + spring.arms.pin_mm) / 2.0, spring.arms.lever_mm)
    for key, angle in (("plate_pin_mm", spring.plate_pin_rad), ("leg_pin_mm", spring.leg_pin_rad)):
        assert math.hypot(*left[key]) == pytest.approx(radius, abs=1e-5)
        assert math.remainder(math.atan2(*left[key][::-1]) - angle, 2 * math.pi) == pytest.approx(0.0, abs=1e-6)
    assert left["rate_nmm_per_deg"] == pytest.approx(500 * math.pi / 180 * robot.spring.stiffness_nm_per_rad, rel=1e-5)
    assert left["inside_diameter_mm"] == pytest.approx(spring.arms.mean_mm - spring.wire_mm, abs=1e-5)
    assert left["arm_length_mm"] == pytest.approx(spring.arms.lever_mm + 2.0, abs=1e-5)
    assert (left["preload_deg"], left["pin_diameter_mm"]) == (0.0, 3.0)


def test_the_wire_bears_the_largest_torque_that_is_accepted(robot: Robot) -> None:
    """EN 13906-3: 32·M/(pi·d³) with q = (4w² - w - 1)/(4w(w - 1)) of the inner fibre, w = D/d of the loaded coil."""
    spring = robot.layout.drive.spring
    index = spring.arms.mean_mm / spring.wire_mm
    inner = (4.0 * index**2 - index - 1.0) / (4.0 * index * (index - 1.0))
    stress = inner * 32.0 * spring.torque_nmm / (math.pi * spring.wire_mm**3)
    assert spring.stress_mpa == pytest.approx(stress, rel=0.03)
    assert allowable_mpa(robot) == pytest.approx((1.0 + robot.workshop.safety.stress_reserve) * spring.allowable_mpa)
    assert torque_shares(robot)[1] * spring.stress_mpa <= allowable_mpa(robot)


@pytest.mark.parametrize("preload_deg", [0.0, 4.0, 15.0])
def test_the_weakest_springs_that_are_accepted_give_the_area_under_their_torque(preload_deg: float) -> None:
    """10 % softer, and slack for the 10° by which their arms are narrower; those preloaded by more push from the start.

    The stiffest and widest have the largest torque accepted where they are loaded most, and at the ramp's end by
    Hooke's law.
    """
    robot, preload = built("best-bo"), math.radians(preload_deg)
    drive = robot.layout.drive
    spring = replace(drive.spring, preload_rad=preload, wound_rad=drive.spring.wound_rad + preload)
    law = replace(drive.cam.law, preload_rad=preload)
    cam = replace(drive.cam, geometry=replace(drive.cam.geometry, law=law))
    changed = replace(robot, layout=replace(robot.layout, drive=replace(drive, spring=spring, cam=cam)))
    turns = np.linspace(preload, spring.wound_rad, 4001)
    weak = 0.9 * np.maximum(turns - math.radians(10.0), 0.0)
    assert least_energy_share(changed) == pytest.approx(
        np.trapezoid(weak, turns) / np.trapezoid(turns, turns), rel=1e-5
    )
    wider = math.radians(arms_off_deg(changed)[1])
    rate = torque_shares(changed)[1] * spring.wound_rad / (spring.wound_rad + wider)
    early = float(law.wind_rad(law.ramp_rad)) + preload
    assert early_torque_share(changed) == pytest.approx(rate * (early + wider) / early)
