"""Joints that mimic the leg's in ROS: the line through their angles, against numpy's polynomial fit."""

import re
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built
from support.each import each

from jumpcad.design import load_design
from jumpcad.exporters.collision import body_box, capsules
from jumpcad.exporters.ros2 import mimicked, model_name, ros2_files
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.scene.visuals import visuals
from jumpcad.settings import Settings, coefficients


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga"])
def test_dependent_joints_follow_the_leg_by_the_line_of_least_squares(name: str) -> None:
    """The error that the package's README states is the largest one over the travel."""
    robot = capsule_robot(load_design(name))
    leg = np.linspace(-robot.design.compression_rad, 0.0, 500)
    pose = robot.linkage.pose(leg)
    for joint, angle in (("front", pose.front_rad), ("ankle", pose.ankle_rad)):
        slope, offset = np.polyfit(leg, angle, 1)
        mimic = mimicked(robot)[joint]
        assert (mimic.slope, mimic.offset_rad) == pytest.approx((slope, offset), abs=0.005)
        assert np.abs(mimic.slope * leg + mimic.offset_rad - angle).max() == pytest.approx(mimic.error_rad, abs=1e-4)


@cache
def files() -> dict[str, str | bytes]:
    """Return the files of a ROS package by their names."""
    return {Path(path).name: content for path, content in ros2_files(built("kenan-2.0"))}


@pytest.fixture(scope="module")
def package() -> dict[str, ET.Element]:
    """The files of XML of the ROS package, by name."""
    return {path: ET.fromstring(text) for path, text in files().items() if path.endswith((".xacro", ".sdf"))}


def expanded(package: dict[str, ET.Element], given: dict[str, str]) -> ET.Element:
    """Return the document that xacro makes of the package: files included, arguments put in, conditions followed."""
    whole = ET.Element("robot")
    top = next(root for name, root in package.items() if name.endswith(".urdf.xacro"))
    words = {one.get("name"): one.get("default", "") for one in top if one.tag.endswith("arg")} | given

    def said(text: str | None) -> str:
        return re.sub(r"\$\(arg (\w+)\)", lambda found: words[found[1]] or "", text or "")

    def take(node: ET.Element, into: ET.Element) -> None:
        for one in node:
            kind = one.tag.removeprefix("{http://www.ros.org/wiki/xacro}")
            if kind == "include":
                take(package[one.attrib["filename"]], into)
            elif kind in ("if", "unless"):
                if said(one.attrib["value"]) == {"if": "true", "unless": "false"}[kind]:
                    take(one, into)
            elif kind == one.tag:
                made = ET.SubElement(into, kind, {key: said(value) for key, value in one.attrib.items()})
                made.text = said(one.text)
                take(one, made)

    take(top, whole)
    return whole


@pytest.mark.parametrize("gazebo", ["true", "false"])
@pytest.mark.parametrize("mimic", ["true", "false"])
def test_the_whole_is_a_tree_on_a_base_without_mass_and_in_gazebo_alone_has_its_plugin(
    package: dict[str, ET.Element], gazebo: str, mimic: str
) -> None:
    """`base_link` as the root and the body fixed to it; every shape has a name of its own."""
    root = expanded(package, {"gazebo": gazebo, "mimic": mimic, "controllers": "c.yaml"})
    joints = {
        one.attrib["name"]: [one.attrib["type"], *(one.find(end).attrib["link"] for end in ("parent", "child"))]
        for one in root.findall("joint")
    }
    assert joints["base"] == ["fixed", "base_link", "body"]
    assert {kind for name, (kind, *_) in joints.items() if name != "base"} == {"revolute"}
    links, children = [one.attrib["name"] for one in root.findall("link")], [child for *_, child in joints.values()]
    assert sorted(links) == sorted(["base_link", *children])
    assert len({*links}) == len(links)
    for link in root.findall("link"):
        for tag in ("visual", "collision"):
            names = [one.attrib["name"] for one in link.findall(tag)]
            assert len({*names}) == len(names)
    assert sorted(one.attrib["name"] for one in root.find("ros2_control").findall("joint")) == ["ankle", "front", "leg"]
    assert {one.attrib["name"] for one in root.findall("joint") if one.find("mimic") is not None} == (
        {"front", "ankle"} if mimic == "true" else set()
    )
    inside = [one.text for one in root.findall("ros2_control/hardware/plugin")]
    assert inside == ["gz_ros2_control/GazeboSimSystem" if gazebo == "true" else "mock_components/GenericSystem"]
    plugins = [(one.attrib, one.findtext("parameters")) for one in root.findall("gazebo/plugin")]
    expected = {"filename": "gz_ros2_control-system", "name": "gz_ros2_control::GazeboSimROS2ControlPlugin"}
    assert plugins == ([(expected, "c.yaml")] if gazebo == "true" else [])
    system = root.find("ros2_control").attrib
    assert system == {"name": "jumper", "type": "system"}


def test_the_leg_alone_is_driven(package: dict[str, ET.Element]) -> None:
    joints = package["ros2_control.xacro"].findall("ros2_control/joint")
    driven = {one.get("name"): [command.get("name") for command in one.findall("command_interface")] for one in joints}
    assert driven == {"leg": ["effort"], "front": [], "ankle": []}
    for one in joints:
        assert [state.get("name") for state in one.findall("state_interface")] == ["position", "velocity"]


def test_collision_cylinders_lie_where_the_capsules_of_the_bodies_do(package: dict[str, ET.Element]) -> None:
    """The axis, z turned by roll, pitch and yaw (fixed axes), and the middle between the ends."""
    robot, found = built("kenan-2.0"), 0
    for link in package["links.xacro"].findall("link"):
        if link.get("name") not in robot.bodies:
            continue  # the fixed base
        for number, capsule in enumerate(capsules(robot, link.get("name")), start=1):
            (shape,) = (one for one in link.findall("collision") if one.get("name") == f"{link.get('name')}_{number}")
            origin, cylinder = shape.find("origin"), shape.find("geometry/cylinder")
            middle = np.array(origin.get("xyz").split(), dtype=float)
            turn = Rotation.from_euler("xyz", [float(angle) for angle in origin.get("rpy").split()])
            half = float(cylinder.get("length")) / 2.0 * turn.apply([0.0, 0.0, 1.0])
            np.testing.assert_allclose(middle + half, capsule.end_m, atol=2e-6)
            np.testing.assert_allclose(middle - half, capsule.start_m, atol=2e-6)
            assert float(cylinder.get("radius")) == pytest.approx(capsule.radius_m)
            found += 1
    assert found >= 4


def test_gazebo_has_the_springs_and_the_floor(package: dict[str, ET.Element]) -> None:
    robot = built("kenan-2.0")
    (spring,) = (one for one in package["gazebo.xacro"] if one.get("reference") == "leg")
    stiffness = float(spring.find("springStiffness").text)
    assert stiffness == pytest.approx(robot.spring.stiffness_nm_per_rad)
    assert float(spring.find("springReference").text) == pytest.approx(robot.spring.preload_rad)
    floor = coefficients(robot, Settings())
    for body in robot.bodies.values():
        (one,) = (one for one in package["gazebo.xacro"] if one.get("reference") == body.name)
        assert float(one.find("mu1").text) == float(one.find("mu2").text) == pytest.approx(floor.contact(body.surface))


def test_joints_are_those_of_the_urdf(package: dict[str, ET.Element]) -> None:
    """Axes, limits, friction and damping; how far and how hard the driven leg is wound is looked at below."""
    theirs = {one.get("name"): one for one in ET.fromstring(write_urdf(built("kenan-2.0"))).findall("joint")}
    ours = {one.get("name"): one for one in package["links.xacro"].findall("joint")}
    assert ours.keys() - theirs.keys() == {"base"}
    for name, joint in theirs.items():
        for tag in ("origin", "axis", "limit", "dynamics"):
            one, other = ours[name].find(tag).attrib, joint.find(tag).attrib
            assert one.keys() == other.keys()
            for key in other.keys() - ({"lower", "effort"} if name == "leg" else set()):
                values = [np.array(found[key].split(), dtype=float) for found in (one, other)]
                np.testing.assert_allclose(*values, rtol=1e-6, atol=1e-9, err_msg=f"{name} {tag} {key}")
        assert [ours[name].find(end).attrib for end in ("parent", "child")] == [
            joint.find(end).attrib for end in ("parent", "child")
        ]


def test_the_controller_holds_the_leg_where_its_springs_are_loaded(package: dict[str, ET.Element]) -> None:
    """ros2_control and Gazebo clip a torque to the joint's effort; what is more than the springs' needs a limit."""
    robot = built("kenan-2.0")
    (limit,) = (one.find("limit") for one in package["links.xacro"].findall("joint") if one.get("name") == "leg")
    pages = files()["README.md"] + files()["controllers.yaml"]
    held = [float(found) for found in re.findall(r"[ \[]-(\d+\.\d+)", pages)]
    assert len(held) == 2
    for torque in held:
        assert robot.spring.peak_torque_nm < torque <= float(limit.get("effort"))
    assert float(limit.get("lower")) == pytest.approx(-robot.spring.wind_rad)


def test_joints_that_mimic_the_leg_are_those_of_the_line(package: dict[str, ET.Element]) -> None:
    robot = built("kenan-2.0")
    for joint in package["links.xacro"].findall("joint"):
        mimics = list(joint.iter("mimic"))
        line = mimicked(robot).get(joint.get("name"))
        assert len(mimics) == (line is not None)
        if line is not None:
            assert mimics[0].get("joint") == "leg"
            assert float(mimics[0].get("multiplier")) == pytest.approx(line.slope, abs=1e-6)
            assert float(mimics[0].get("offset")) == pytest.approx(line.offset_rad, abs=1e-6)


@each(
    ("name", "model"),
    [("Kenan-2.0", "kenan_2_0"), ("2nd", "robot_2nd"), ("--", "robot"), ("a__b", "a_b"), ("r2d2", "r2d2"), ("X", "x"),
     ("Kenan 2.0 (light)", "kenan_2_0_light"), ("_x", "x")],
)  # fmt: skip
def test_names_are_those_that_ros_allows(name: str, model: str) -> None:
    """REP 144: lower case, digits, single underscores, a letter first."""
    assert model_name(name) == model


def test_the_bodys_box_lies_where_its_parts_do(package: dict[str, ET.Element]) -> None:
    """From corner to corner, with its middle half way between them."""
    robot = built("kenan-2.0")
    box = body_box(robot, visuals(robot))
    assert box is not None
    links = package["links.xacro"].findall("link")
    (shape,) = (one for link in links for one in link.findall("collision") if one.get("name") == "body_box")
    middle = np.array(shape.find("origin").get("xyz").split(), dtype=float)
    half = np.array(shape.find("geometry/box").get("size").split(), dtype=float) / 2.0
    assert shape.find("origin").get("rpy") == "0 0 0"
    np.testing.assert_allclose(middle - half, box.low_m, atol=2e-6)
    np.testing.assert_allclose(middle + half, box.high_m, atol=2e-6)


def test_every_link_shows_the_parts_of_its_body_where_they_are(package: dict[str, ET.Element]) -> None:
    """By their names and places; masses are the bodies'. The fixed base has nothing."""
    robot = built("kenan-2.0")
    links = {one.get("name"): one for one in package["links.xacro"].findall("link")}
    seen = {name: {one.name: one.T_body_mesh for one in visuals(robot) if one.body == name} for name in robot.bodies}
    (base,) = links.keys() - robot.bodies.keys()
    assert len(links[base]) == 0
    for name, body in robot.bodies.items():
        shown = {one.get("name"): one.find("origin") for one in links[name].findall("visual")}
        assert shown.keys() == seen[name].keys()
        for part, origin in shown.items():
            place = np.array(origin.get("xyz").split(), dtype=float)
            np.testing.assert_allclose(place, seen[name][part][:3, 3], atol=1e-6)
        assert float(links[name].find("inertial/mass").get("value")) == pytest.approx(body.mass_kg)


def test_in_gazebo_a_robot_is_put_on_its_foot() -> None:
    """Whose sole is level where the body is turned by the pitch at rest, and the joints are at 0 (a tenth of a mm)."""
    robot = built("best-printable")
    (launch,) = (text for path, text in ros2_files(robot) if path.endswith("gazebo.launch.py"))
    ((height, pitch),) = re.findall(r'HEIGHT_M, PITCH_RAD = "(.*)", "(.*)"', launch)
    assert '"-z", HEIGHT_M, "-P", PITCH_RAD]' in launch
    angles = {joint.name: joint.rest_angle_rad for joint in robot.joints}
    foot_rad = float(pitch) + angles["leg"] + angles["ankle"]  # about y, as the joints turn
    assert foot_rad == pytest.approx(0.0, abs=1e-4)
    hip = Rotation.from_euler("y", float(pitch)).apply(robot.joint("leg").origin_m)
    leg = Rotation.from_euler("y", float(pitch) + angles["leg"]).apply(robot.joint("ankle").origin_m)
    lowest = min(point.centre_m[2] - point.radius_m for point in robot.bodies["foot"].contacts)
    assert float(height) + hip[2] + leg[2] + lowest == pytest.approx(0.0, abs=1e-4)
