"""URDF and loop files from unknown sources: read as they were written, or rejected in one line."""

import json
import os
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.each import each
from support.flights import make_lopsided
from support.machines import let_go, one_sided, rubbing, stopped

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation.from_urdf import robot_from_urdf

KENAN = capsule_robot(load_design("kenan-2.0"))
URDF, LOOP = write_urdf(KENAN), write_loop(KENAN)
HEAD = '<?xml version="1.0" encoding="utf-8"?>\n'
LAUGHS = "".join(f'<!ENTITY a{n + 1} "{f"&a{n};" * 10}">' for n in range(9))
LEG_TURN = r'(?s)(<joint name="leg".*?)rpy="[^"]*"'


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Robot]:
    """Return a function that reads a robot from the texts of its two files."""

    def read_texts(urdf: str | bytes = URDF, loop: str | bytes = LOOP) -> Robot:
        for name, text in (("k.urdf", urdf), ("k.loop.json", loop)):
            (tmp_path / name).write_bytes(text.encode() if isinstance(text, str) else text)
        return robot_from_urdf(tmp_path / "k.urdf")

    return read_texts


def element(tag: str, **attributes: str) -> str:
    """The text of the first such element of the URDF, with other attributes."""
    text = re.search(rf"<{tag} [^>]*>", URDF)[0]  # type: ignore[index]
    for key, value in attributes.items():
        text = re.sub(rf'\b{key}="[^"]*"', f'{key}="{value}"', text)
    return re.sub(rf"<{tag} [^>]*>", text, URDF, count=1)


@each(
    ("urdf", "reason"),
    [
        (element("mass", value="0"), "body: mass: value = 0: must be 1e-06…1000"),
        (element("mass", value="nan"), "mass: value = 'nan': must be 1 finite number"),
        (element("mass", value="light"), "mass: value = 'light': must be 1 finite number"),
        (element("inertia", ixx="0"), "principal moments 0, .* must be more than 0"),
        (element("inertia", izz="-1e-5"), "principal moments -1e-05, .* must be more than 0"),
        (element("inertia", iyy="1e-9"), "none more than the other two together"),
        (element("inertia", ixx="1e6", iyy="1e6", izz="1e6"), r"a radius of gyration of \d+\.?\d* m: .* 1e-05…10"),
        (element("inertia", ixx="1.1e9"), r"ixx = 1.1e\+09: must be -1e\+09…1e\+09"),
        (element("inertia", ixy="inf"), "ixy = 'inf': must be 1 finite number"),
        (element("origin", xyz="0 0"), "xyz = '0 0': must be 3 finite numbers"),
        (element("origin", xyz="100 0 0"), "its origin is further than 10 m away"),
        (element("sphere", radius="10.1"), "radius = 10.1: must be"),
        (element("origin", xyz="0 0 -10.1"), "its origin is further than 10 m away"),
        (element("origin", rpy="0 6.3 0"), "or turned by more than 2π"),
        (element("axis", xyz="1 0 0"), "joint leg: must be revolute about the axis 0 1 0"),
        (element("limit", effort="-1"), r"joint leg: effort = -1: must be 0…1e\+06"),
        (element("limit", velocity="0"), r"joint leg: velocity = 0: must be 1e-06…1e\+06"),
        (element("parent", link="foot"), "joint leg: its origin is not that .* from body to main_leg"),
        (element("parent", link="x" * 1001), r"parent: link = 'x{56}[.]{3}: is missing, too long"),
        (re.sub(LEG_TURN, r'\g<1>rpy="0.1 0 0"', URDF, count=1), "joint leg: must be revolute .* rpy 0 ANGLE 0"),
        (re.sub(LEG_TURN, r'\g<1>rpy="0 0 0.1"', URDF, count=1), "joint leg: must be revolute .* rpy 0 ANGLE 0"),
        (URDF.replace('link name="foot"', 'link name="fot"'), "its links must be .*, each once, not .*'fot'"),
        (re.sub(r'<joint name="ankle".*?</joint>', "", URDF, flags=re.DOTALL), "its joints must be leg, front, "),
        (re.sub(r"<inertial>.*?</inertial>", "", URDF, count=1, flags=re.DOTALL), "body: has no inertial, needs one"),
        (re.sub(r'<joint name="leg" type="revolute">\s*<origin xyz="-0\.0', r"\g<0>1", URDF), "origin is not that"),
        (URDF.replace(HEAD, f'{HEAD}<!DOCTYPE r [<!ENTITY a0 "ha">{LAUGHS}]>').replace("kenan", "&a9;"), "type decl"),
        (URDF.replace("utf-8", "no-such-code"), "broken XML"),
        (URDF + " " * (1 << 20), "is larger than 1 MiB"),
        ("<a/>", "its root is 'a', not 'robot'"),
    ],
)  # fmt: skip
def test_what_no_mechanism_has_is_refused(read: Callable[..., Robot], urdf: str, reason: str) -> None:
    assert urdf != URDF
    with pytest.raises(JumpcadError, match=reason) as caught:
        read(urdf)
    assert str(caught.value).isprintable()


def changed(value: Any, *path: str | int) -> str:
    """The loop file with one value changed, or left out where the value is a hole."""
    data = json.loads(LOOP)
    inner = data
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = value
    return json.dumps(data)


@each(
    ("loop", "reason"),
    [
        (changed(float("nan"), "foot_depth_m"), "NaN is no number"),
        (changed(10**400, "spring", "wind_rad"), "wind_rad = 1000"),
        (changed(-1.0, "spring", "stiffness_nm_per_rad"), "must be at least 0.0001"),
        (changed("ankle", "spring", "joint"), "spring.joint = 'ankle': must be 'leg'"),
        (changed(0.0, "foot_depth_m"), "foot_depth_m = 0.0: must be at least 1e-05"),
        (changed([0.1, 0.0], "loop", "point_a_m"), "loop.point_a_m.2: missing"),
        (changed([0.2, 0.0, 0.0], "loop", "point_a_m"), "points of the loop are not those of the design"),
        (changed("body", "loop", "body_a"), "points of the loop are not those .* on front_link and foot"),
        (changed(1e9, "design", "carrying_link_mm"), "must be at most 400"),
        (changed(3, "design"), r"design = 3: must be a table: \[design\]"),
        (changed(150.0, "design", "carrying_link_mm"), "joint leg: its origin is not that of the design"),
        (changed({}, "travel_rad"), "travel_rad"),
        (changed("ice", "surfaces", "back"), "surfaces.back = 'ice': must be 'foot' or 'body'"),
        (changed({}, "surfaces"), "collision 'back_pivot': has no surface"),
        (changed(1, "self"), "self: unknown key"),
        (changed(1, "spring", "one_sided"), "spring.one_sided = 1: must be"),
        (changed({"joint": "leg", "angle_rad": 0.1, "stiffness_nm_per_rad": 0.0}, "stop"), "must be at least"),
        (changed({"joint": "foot", "angle_rad": 0.1, "stiffness_nm_per_rad": 1.0}, "stop"), "must be 'leg'"),
        (changed({"leg_rad": 0.5, "leg_rad_s": 1.0, "energy_ratio": 1.0}, "roller_off"), "must be at most 0"),
        (changed({"leg_rad": -2.0, "leg_rad_s": 1.0, "energy_ratio": 1.0}, "roller_off"), "before the springs"),
        (changed({"foot": 0.8, "body": 0.3, "pin": 0.2, "pin_radius_m": [0.1]}, "friction"), "pin_radius_m.1: missing"),
        ("[]", "is not a table of values"),
        ("[" * 5000 + "]" * 5000, "nested deeper than 20 levels"),
        (b"\xff", "not a text file in UTF-8"),
    ],
)
def test_what_no_loop_file_says_is_refused(read: Callable[..., Robot], loop: str | bytes, reason: str) -> None:
    with pytest.raises(JumpcadError, match=reason) as caught:
        read(loop=loop)
    assert str(caught.value).isprintable()


def test_pipes_and_devices_do_not_block(tmp_path: Path) -> None:
    (tmp_path / "k.loop.json").write_text(LOOP)
    os.mkfifo(tmp_path / "k.urdf")
    with pytest.raises(JumpcadError, match="is a pipe or a device"):
        robot_from_urdf(tmp_path / "k.urdf")
    (tmp_path / "k.urdf").unlink()
    (tmp_path / "k.urdf").symlink_to("/dev/zero")
    with pytest.raises(JumpcadError, match="is a pipe or a device"):
        robot_from_urdf(tmp_path / "k.urdf")


def test_springs_are_read_as_they_were_written(read: Callable[..., Robot]) -> None:
    """Loaded already at rest, or with arms that only push."""
    for more in ({"preload_rad": 0.2}, {"one_sided": True}):
        robot = replace(KENAN, springs=(replace(KENAN.spring, **more),))
        found = read(loop=write_loop(robot)).spring
        assert (found.preload_rad, found.one_sided) == (robot.spring.preload_rad, robot.spring.one_sided)
        assert found.energy_j == pytest.approx(robot.spring.energy_j, rel=1e-9)


def test_every_joint_keeps_its_limits(read: Callable[..., Robot]) -> None:
    """The mechanism's travel is that of the loop file, to which the URDF adds room."""
    got = read()
    for joint in KENAN.joints:
        again = got.joint(joint.name)
        assert joint.lower_rad < joint.upper_rad
        for key in ("lower_rad", "upper_rad", "effort_nm", "velocity_rad_s", "rest_angle_rad"):
            assert getattr(again, key) == pytest.approx(getattr(joint, key), rel=1e-6), (joint.name, key)
        assert (again.parent, again.child) == (joint.parent, joint.child)
        assert again.origin_m == pytest.approx(joint.origin_m, abs=1e-9)


def test_bodies_are_read_back_with_tensors_that_are_turned_out_of_their_frames(read: Callable[..., Robot]) -> None:
    """The file has principal moments and the turn of their axes; masses, centres and spheres as they were."""
    robot = make_lopsided(KENAN)
    found = read(write_urdf(robot), write_loop(robot))
    assert (found.name, found.design, found.foot_depth_m) == (robot.name, robot.design, robot.foot_depth_m)
    for name, body in robot.bodies.items():
        again = found.bodies[name]
        assert again.mass_kg == pytest.approx(body.mass_kg)
        np.testing.assert_allclose(again.com_m, body.com_m, atol=1e-9)
        size = np.abs(body.inertia_kg_m2).max()
        assert np.abs(body.inertia_kg_m2 - np.diag(np.diag(body.inertia_kg_m2))).max() > 0.01 * size
        np.testing.assert_allclose(again.inertia_kg_m2, body.inertia_kg_m2, atol=1e-6 * size)
        assert [(one.name, one.radius_m, one.surface) for one in again.contacts] == [
            (one.name, one.radius_m, one.surface) for one in body.contacts
        ]
        for one, other in zip(again.contacts, body.contacts, strict=True):
            np.testing.assert_allclose(one.centre_m, other.centre_m, atol=1e-9)


@pytest.mark.parametrize("machine", [stopped, let_go, rubbing, one_sided], ids=lambda make: make.__name__)
def test_what_a_robot_has_beside_its_links_is_read_back_each_without_the_others(
    read: Callable[..., Robot], machine: Callable[[Robot], Robot]
) -> None:
    robot = machine(KENAN)
    found = read(write_urdf(robot), write_loop(robot))
    for key in ("stop", "roller_off", "friction"):
        assert (getattr(found, key) is None) == (getattr(robot, key) is None)
        if getattr(robot, key) is not None:
            assert getattr(found, key) == getattr(robot, key)
    assert found.spring == robot.spring
