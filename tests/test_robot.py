"""A printed robot is a mechanism whose bodies are made of its parts."""

import copy
import pickle
import re
from dataclasses import replace

import pytest
from support.built import LONG_TOES, built, geared

import jumpcad
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot import Robot, require_name

ROBOTS = {"kenan-2.0": lambda: built("kenan-2.0"), LONG_TOES: lambda: built(LONG_TOES), "two pairs of gears": geared}


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_weighs_what_its_parts_weigh(name: str) -> None:
    robot = ROBOTS[name]()
    assert isinstance(robot, Mechanism)
    pieces = [part.mass_kg for part in robot.parts for _ in range(part.quantity)]
    pieces += [thing.mass_kg for thing in robot.hardware]
    assert robot.mass_kg == pytest.approx(sum(pieces), rel=1e-9)


def test_every_part_belongs_to_a_body() -> None:
    robot = built("kenan-2.0")
    on_bodies = {place.body for part in robot.parts for place in part.placements}
    assert on_bodies == {*robot.bodies}


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


def test_robots_are_equal_where_all_is_of_which_they_are_made() -> None:
    """Arrays too, number by number; what is heavier, or made with another workshop, is another robot."""
    design = jumpcad.load_design("kenan-2.0")
    robot, again = jumpcad.build(design), jumpcad.build(design)
    assert robot == again
    foot = replace(robot.bodies["foot"], com_m=robot.bodies["foot"].com_m + 1e-6)
    assert robot != replace(robot, bodies={**robot.bodies, "foot": foot})
    assert robot != replace(robot, workshop=robot.workshop.model_copy(update={"safety": None}))
    assert robot != capsule_robot(design)
    assert capsule_robot(design) == pickle.loads(pickle.dumps(capsule_robot(design)))
    assert robot != "kenan-2.0"
    assert robot.parts == again.parts
    assert robot.parts[0] not in again.parts[1:]
    assert robot.hardware == again.hardware
    assert robot.hardware[0] not in again.hardware[1:]


@pytest.mark.parametrize("name", ["/", "..", "a/b", "a\nb", "\x1b[31m", "a.", "x" * 5000, "\ud800", " frog"])
def test_what_cannot_name_files_is_refused_at_once_in_one_line(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("jumpcad.building.growth.assembled", None)  # not reached
    with pytest.raises(JumpcadError, match="is used in file names") as caught:
        jumpcad.build(jumpcad.load_design("kenan-2.0"), name=name)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(("name", "letter"), [("a/b", "U+002F"), ("ab\nc", "U+000A"), ("frog?", "U+003F")])
def test_the_letter_that_cannot_be_in_a_name_is_named(name: str, letter: str) -> None:
    with pytest.raises(JumpcadError, match=re.escape(f", not {letter}")):
        require_name(name)


@pytest.mark.parametrize("name", ["CON", "nul", "Aux.v2", "com1", "LPT9", "PRN.toml", "com²"])
def test_a_name_that_windows_keeps_for_a_device_is_refused(name: str) -> None:
    """Microsoft, Naming Files, Paths, and Namespaces: NUL.txt is NUL, so NUL.glb could not be unpacked there."""
    with pytest.raises(JumpcadError, match=r"is used in file names: .* is a device on Windows; use another name"):
        require_name(name)


@pytest.mark.parametrize("name", ["console", "conrad-2", "com10", "auxiliary.v2", "my-con", "nul-2"])
def test_a_name_that_begins_like_a_device_is_taken(name: str) -> None:
    require_name(name)


@pytest.mark.parametrize(("letter", "most"), [("x", 200), ("ä", 100), ("机", 66)])
def test_a_name_has_room_in_a_files_name_in_any_script(letter: str, most: int) -> None:
    """File systems count bytes: in UTF-8 an umlaut has two, a Chinese character three."""
    require_name(most * letter)
    with pytest.raises(JumpcadError, match="is used in file names: use at most 200 bytes"):
        require_name((most + 1) * letter)
