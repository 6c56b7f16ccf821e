"""A printed robot is a mechanism whose bodies are made of its parts."""

import copy
import pickle

import pytest
from support.built import LONG_TOES, built, geared

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot

ROBOTS = {"kenan-2.0": lambda: built("kenan-2.0"), LONG_TOES: lambda: built(LONG_TOES), "two pairs of gears": geared}


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_weighs_what_its_parts_weigh(name: str) -> None:
    robot = ROBOTS[name]()
    assert isinstance(robot, Mechanism)
    pieces = [part.mass_kg for part in robot.parts for _ in range(part.quantity)]
    pieces += [thing.mass_kg for thing in robot.hardware]
    assert robot.mass_kg == pytest.approx(sum(pieces), rel=1e-9)


def test_a_robot_cannot_be_without_parts() -> None:
    capsules = capsule_robot(built("kenan-2.0").design)
    with pytest.raises(TypeError, match="'parts', 'hardware', 'workshop', 'layout', 'release', and 'stop_blow'"):
        Robot(**vars(capsules))


def test_a_robot_is_shared_and_not_pickled() -> None:
    robot = built("kenan-2.0")
    assert copy.deepcopy([robot])[0] is copy.copy(robot) is robot
    with pytest.raises(JumpcadError, match=r"send its design and workshop .*to_dict\(\) is plain data"):
        pickle.dumps({"robot": robot})
    assert pickle.loads(pickle.dumps(robot.design)) == robot.design
