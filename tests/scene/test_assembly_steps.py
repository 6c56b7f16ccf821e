"""The order of assembly: every thing on the robot is put on once."""

from collections import Counter
from dataclasses import replace

import pytest
from support.built import built

from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import REST, assembly_steps
from jumpcad.scene.visuals import visuals


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def test_every_thing_is_put_on_once_and_none_is_left_over(robot: Robot) -> None:
    steps = assembly_steps(robot)
    assert Counter(thing.name for step in steps for thing in step.added) == Counter(
        thing.name for thing in visuals(robot)
    )
    assert all(step.title != REST for step in steps)


def test_what_no_step_knows_is_not_forgotten(small_robot: Robot) -> None:
    strange = replace(small_robot.hardware[0], name="antenna")
    last = assembly_steps(replace(small_robot, hardware=(*small_robot.hardware, strange)))[-1]
    assert last.title == REST
    assert "antenna" in {thing.name for thing in last.added}
