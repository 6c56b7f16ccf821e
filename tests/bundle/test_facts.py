"""The manifest's entries on release, stop and joints, against the robot's own figures in degrees."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest
from support import needs
from support.built import built

from jumpcad.bundle.facts import flight_facts, stop_facts
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
