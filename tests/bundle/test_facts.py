"""The manifest's entries on release, stop and joints, against the robot's own figures in degrees."""

import math

import pytest
from support.built import built

from jumpcad.bundle.facts import stop_facts

DEGREES = 180.0 / math.pi


def test_the_stop_is_said_with_its_pad() -> None:
    """The default workshop's stop stands 3° past rest; the pad gives by an arc of its radius."""
    robot = built("kenan-2.0")
    facts = stop_facts(robot)
    assert facts["angle_deg"] == pytest.approx(robot.workshop.body.stop_deg)
    assert facts["give_mm"] == pytest.approx(facts["radius_mm"] * facts["give_deg"] / DEGREES, rel=0.02)
    assert facts["pad"] == robot.workshop.body.stop_pad
    assert (facts["blow_j"], facts["torque_nm"]) == (robot.stop_blow.energy_j, robot.stop_blow.torque_nm)
