"""What stands and moves between the plates: each as wide as it is, and kept clear of by 0.8 mm."""

import pytest

from jumpcad.robot.robot import Robot
from jumpcad.robot.space.obstacles import LEVER_HEAD_MM, swept_obstacles
from jumpcad.robot.space.room import Obstacle

SCREW_HEAD_MM = 1.65
"""Height of the head of an M3 screw (ISO 7380-1)."""


def swept(robot: Robot, *given: float, reach_rad: float = 0.1) -> dict[str, Obstacle]:
    """Return what a robot's links sweep, by name."""
    layout = robot.layout
    found = swept_obstacles(layout.linkage, layout.sections, layout.drive, layout.lateral, reach_rad, *given)
    return {one.name: one for one in found}


def test_the_lever_takes_its_screw_with_the_head_to_the_left(kenan: Robot) -> None:
    """Its interval of y is that of the screw, and a head's height more towards the left, which is up along y."""
    right, left = swept(kenan)["lever"].y_mm
    screw = kenan.layout.lateral.roller_screw
    assert right == screw[0]
    assert SCREW_HEAD_MM <= left - screw[1] < SCREW_HEAD_MM + 0.1
    assert left - screw[1] == pytest.approx(LEVER_HEAD_MM)
