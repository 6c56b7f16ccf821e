"""The manifest's entries about retention and roll: angles in degrees, lengths in millimetres, as in the robot."""

import math

import pytest
from support.built import built

from jumpcad.bundle.facts import joint_facts
from jumpcad.checks.sideways import play_rad, rolls
from jumpcad.parts.holes import HoleSizes


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
