"""XML has no way to write a control character: such a text is rejected, by every format."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.each import each
from support.machines import STOP_RAD, machine, rubbing

from jumpcad.bundle.page import write_report
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.exporters.threemf import write_threemf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.exporters.xml import allowed, rpy, written, wxyz
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.parts.plates import packed
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.from_urdf import robot_from_urdf


@pytest.mark.parametrize("letter", ["\x7f", "\x9b", "é", "机", "😀", "\t"])
def test_what_is_written_is_what_a_parser_reads(letter: str) -> None:
    assert ET.fromstring(f"<a>{allowed(letter)}</a>").text == letter


@pytest.mark.parametrize("letter", ["\x00", "\x01", "\x0b", "\x1b", "\ufffe"])
def test_what_no_parser_reads_is_not_written(letter: str) -> None:
    with pytest.raises(ET.ParseError):
        ET.fromstring(f"<a>{letter}</a>")
    with pytest.raises(JumpcadError, match=rf"U\+{ord(letter):04X}") as caught:
        allowed(letter)
    assert str(caught.value).isprintable()


@each("axis", [0, 1, 2])
@each("angle_deg", [0.0, 30.0, 90.0, -90.0, 170.0])
def test_a_quaternion_has_the_cosine_of_half_the_angle_first(axis: int, angle_deg: float) -> None:
    """And then the axis times its sine; either sign is the same turn."""
    half = np.radians(angle_deg) / 2.0
    expected = np.array([np.cos(half), *(np.sin(half) * np.eye(3)[axis])])
    found = wxyz(_about(axis, 2.0 * half))
    assert found * np.sign(found[0]) == pytest.approx(expected, abs=1e-12)


def test_surrogates_are_refused() -> None:
    with pytest.raises(JumpcadError, match=r"U\+D800"):
        allowed("\ud800")


def test_no_format_writes_a_robot_whose_name_has_a_control_character(small_robot: Robot) -> None:
    robot = replace(small_robot, name="a\x01")
    jump = simulate(small_robot)
    for write in (write_urdf, lambda robot: write_report(robot, {}, jump)):
        with pytest.raises(JumpcadError, match=r"U\+0001"):
            write(robot)
    plate = packed(small_robot.parts[:1], (250.0, 210.0, 220.0), 5.0)[0]
    with pytest.raises(JumpcadError, match=r"U\+0001"):
        write_threemf(replace(plate, material="\x01"), {}, b"")


def test_numbers_read_back_as_the_same_doubles() -> None:
    """Of a light part's inertia too, 1e-10 kg·m²; a zero has no sign."""
    numbers = np.array([[1.0 / 3.0, 2.0e-10 / 3.0], [-1.0e9 / 7.0, 0.1 + 0.2]])
    assert [float(one) for one in written(numbers).split()] == numbers.ravel().tolist()
    assert written(-0.0) == written(0) == "0.0"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("pitch_deg", [90.0, -90.0, 30.0])
def test_angles_about_fixed_axes_turn_as_the_rotation_does(pitch_deg: float) -> None:
    """R = Rz(yaw)·Ry(pitch)·Rx(roll), also where roll and yaw turn about one axis."""
    rotation = _about(2, np.radians(40.0)) @ _about(1, np.radians(pitch_deg))
    roll, pitch, yaw = rpy(rotation)
    turned = _about(2, yaw) @ _about(1, pitch) @ _about(0, roll)
    assert turned == pytest.approx(rotation, abs=1e-12)


def _about(axis: int, angle: float) -> np.ndarray:
    """Return the rotation (3, 3) about an axis, by Rodrigues' formula."""
    cross = np.cross(np.eye(3), np.eye(3)[axis])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


@pytest.fixture(scope="module")
def robot() -> Mechanism:
    """Capsules with all that a printed robot has."""
    return rubbing(machine(capsule_robot(load_design("best-bo"))), 0.8, pin=0.25)


def leg(root: ET.Element) -> ET.Element:
    return next(node for node in root.iter("joint") if node.get("name") == "leg")


def test_the_leg_is_limited_at_the_stop(robot: Mechanism) -> None:
    """A quarter turn beyond its travel on the other side, and on both without a stop; URDF and SDF: `test_facts`."""
    lower, upper = map(float, leg(ET.fromstring(write_mjcf(robot))).get("range").split())
    assert (lower, upper) == (robot.joint("leg").lower_rad - math.pi / 2.0, STOP_RAD)
    free = capsule_robot(robot.design)
    assert float(leg(ET.fromstring(write_urdf(free))).find("limit").get("upper")) == math.pi / 2.0
    assert leg(ET.fromstring(write_mjcf(free))).get("range") is None


def test_the_keyframe_moves_as_the_robot_does(robot: Mechanism) -> None:
    """In `released` the loop is closed and the foot flat, both with all their velocities; `wound` stands still."""
    mujoco = needs.package("mujoco")
    model = mujoco.MjModel.from_xml_string(write_mjcf(robot))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("released").id)
    mujoco.mj_forward(model, data)
    for body in ("foot", "front_link"):
        velocity = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, model.site(f"{body}_loop").id, velocity, 0)
        np.testing.assert_allclose(velocity[3:], 0.0, atol=1e-9)
    assert data.joint("leg").qvel[0] == robot.roller_off.leg_rad_s
    assert data.joint("leg").qpos[0] == robot.roller_off.leg_rad
    mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
    assert not data.qvel.any()
    assert data.joint("leg").qpos[0] == -robot.spring.wind_rad
    assert "released" not in write_mjcf(capsule_robot(robot.design))


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_the_urdf_jumps_as_the_robot_in_memory(robot: Mechanism, engine: str, tmp_path: Path) -> None:
    if engine != "planar":
        needs.package(engine)
    path = tmp_path / "r.urdf"
    path.write_text(write_urdf(robot), encoding="utf-8")
    path.with_suffix(".loop.json").write_text(write_loop(robot), encoding="utf-8")
    again = robot_from_urdf(path)
    assert (again.spring, again.stop, again.roller_off, again.friction) == (
        robot.spring, robot.stop, robot.roller_off, robot.friction,
    )  # fmt: skip
    here, there = simulate(robot, Settings(), engine), simulate(again, Settings(), engine)
    assert there.ballistic_range_m == pytest.approx(here.ballistic_range_m, rel=1e-9)
    assert there.release_energy_ratio == pytest.approx(here.release_energy_ratio, rel=1e-9)
