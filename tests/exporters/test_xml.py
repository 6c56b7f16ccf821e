"""XML has no way to write a control character: such a text is rejected, by every format."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.bundle.bom import bill_of_materials
from jumpcad.bundle.page import write_report
from jumpcad.errors import JumpcadError
from jumpcad.exporters.threemf import write_threemf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.exporters.xml import add, allowed, document, rpy, shorten, written, wxyz
from jumpcad.files.names import NAME
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot
from jumpcad.simulation import simulate


@pytest.mark.parametrize("letter", ["\x7f", "\x9b", "é", "机", "😀", "\t"])
def test_what_is_written_is_what_a_parser_reads(letter: str) -> None:
    root = ET.Element("a")
    add(root, "b", letter)
    assert ET.fromstring(document(root))[0].text == letter


@pytest.mark.parametrize("letter", ["\x00", "\x01", "\x0b", "\x1b", "\ufffe"])
def test_what_no_parser_reads_is_not_written(letter: str) -> None:
    root = ET.Element("a")
    add(root, "b", letter)
    with pytest.raises(ET.ParseError):
        ET.fromstring(f"<a>{letter}</a>")
    with pytest.raises(JumpcadError, match=rf"U\+{ord(letter):04X}") as caught:
        document(root)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    ("before", "after"), [("", ""), ("a", "b"), ("x" + "a" * 20, "b" * 20 + "x"), ("long " * 50, " text" * 50)]
)
def test_what_cannot_be_written_is_told_with_twenty_letters_around_it(before: str, after: str) -> None:
    with pytest.raises(JumpcadError) as caught:
        allowed(f"{before}\x01{after}")
    assert str(caught.value).startswith(repr(f"{before[-20:]}\x01{after[:20]}") + ": XML cannot hold")


def test_a_document_says_its_encoding_first_and_ends_with_its_last_line() -> None:
    root = ET.Element("a")
    add(root, "b")
    assert document(root) == '<?xml version="1.0" encoding="utf-8"?>\n<a>\n  <b />\n</a>\n'


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("angle_deg", [0.0, 30.0, 90.0, -90.0, 170.0])
def test_a_quaternion_has_the_cosine_of_half_the_angle_first(axis: int, angle_deg: float) -> None:
    """And then the axis times its sine; either sign is the same turn."""
    half = np.radians(angle_deg) / 2.0
    expected = np.array([np.cos(half), *(np.sin(half) * np.eye(3)[axis])])
    found = wxyz(_about(axis, 2.0 * half))
    assert found * np.sign(found[0]) == pytest.approx(expected, abs=1e-12)


def test_names_that_look_like_numbers_stay_as_they_are() -> None:
    """A robot may be called 007, a part 1e3."""
    root = ET.Element("a", {"name": "007", "mesh": "1e3", "class": "2.50", "pos": "007 2.50"})
    shorten(root)
    assert root.attrib == {"name": "007", "mesh": "1e3", "class": "2.50", "pos": "7 2.5"}


def test_a_character_that_xml_cannot_hold_is_shown_with_what_stands_around_it() -> None:
    """Twenty characters to either side, or as many as there are."""
    with pytest.raises(JumpcadError, match=r"^'ab\\x01c{20}': XML cannot hold the character U\+0001: leave it out$"):
        allowed("ab\x01" + "c" * 60)
    with pytest.raises(JumpcadError, match=r"^'b{20}\\x01c{20}': XML"):
        allowed("a" * 30 + "b" * 20 + "\x01" + "c" * 20 + "d" * 30)


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


def test_every_article_of_a_bill_can_be_given_a_price(small_robot: Robot) -> None:
    """Prices are named by the beginnings of articles, which must therefore be names."""
    for item in bill_of_materials(small_robot).items:
        assert NAME.fullmatch(item.name[:50]), item.name


def test_numbers_read_back_as_the_same_doubles() -> None:
    """Of a light part's inertia too, 1e-10 kg·m²; a zero has no sign."""
    numbers = np.array([[1.0 / 3.0, 2.0e-10 / 3.0], [-1.0e9 / 7.0, 0.1 + 0.2]])
    assert [float(one) for one in written(numbers).split()] == numbers.ravel().tolist()
    assert written(-0.0) == written(0) == "0.0"


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ("1 4e-13 0.3333333333333333", "1 0 0.333333333333"), ("4e-13 2e-14 -1e-26", "4e-13 2e-14 0"),
        ("2000 1e-10", "2000 0"), ("2000 1e-8", "2000 1e-08"), ("one 4e-13", "one 4e-13"),
    ],
)  # fmt: skip
def test_of_numbers_twelve_digits_are_kept_and_what_is_none_beside_the_largest_is_0(given: str, kept: str) -> None:
    root = ET.Element("a", pos=given)
    shorten(root)
    assert root.get("pos") == kept


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
