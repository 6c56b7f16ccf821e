"""XML has no way to write a control character: such a text is rejected, by every format."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from support.each import each

from jumpcad.bundle.page import write_report
from jumpcad.errors import JumpcadError
from jumpcad.exporters.threemf import write_threemf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.exporters.xml import allowed, rpy, written, wxyz
from jumpcad.printing.plates import packed
from jumpcad.robot.robot import Robot
from jumpcad.simulation import simulate


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
