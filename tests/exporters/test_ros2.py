"""Joints that mimic the leg's in ROS: the line through their angles, against numpy's polynomial fit."""

import compileall
import re
import shutil
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built
from support.decimals import decimals
from support.each import each

from jumpcad.design import load_design
from jumpcad.exporters import ros2
from jumpcad.exporters.ros2 import body_box, capsules, mimicked, model_name, ros2_files
from jumpcad.files import templates_folder
from jumpcad.mechanism.model import BODY, BODY_NAMES, body_poses
from jumpcad.mechanism.variants import capsule_robot
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


def test_what_pip_compiles_is_no_file_of_the_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(templates_folder() / "ros2", tmp_path / "ros2")
    assert compileall.compile_dir(tmp_path, quiet=1)
    assert list(tmp_path.rglob("*.pyc"))
    monkeypatch.setattr(ros2, "templates_folder", lambda: tmp_path)
    assert {Path(path).name: content for path, content in ros2_files(built("kenan-2.0"))} == files()


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


@each(
    ("name", "model"),
    [("Kenan-2.0", "kenan_2_0"), ("2nd", "robot_2nd"), ("--", "robot"), ("a__b", "a_b"), ("r2d2", "r2d2"), ("X", "x"),
     ("Kenan 2.0 (light)", "kenan_2_0_light"), ("_x", "x")],
)  # fmt: skip
def test_names_are_those_that_ros_allows(name: str, model: str) -> None:
    """REP 144: lower case, digits, single underscores, a letter first."""
    assert model_name(name) == model


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_capsules_lie_along_the_links_and_the_toes(name: str) -> None:
    """Six tenths of the ankle's height thick; toes no thicker than eight tenths of the spheres at their tips."""
    robot = built(name)
    design = robot.design
    lengths = dict(zip(BODY_NAMES, (0.0, design.l2_mm, design.l3_mm, design.l4_mm), strict=True))
    for body, length in lengths.items():
        shapes = list(capsules(robot, body))
        toes = [one for one in robot.bodies[body].contacts if one.surface == "foot" and one.centre_m[0] < 0.0]
        assert len(shapes) == (length > 0.0) + len(toes)
        if length:
            link = shapes.pop(0)
            assert link.start_m.tolist() == [0.0, 0.0, 0.0]
            assert link.end_m == pytest.approx([length / 1000.0, 0.0, 0.0])
            assert link.radius_m == pytest.approx(0.6 * robot.foot_depth_m, abs=1e-6)
        assert decimals([[one.end_m, one.radius_m] for one in shapes]) <= 6  # micrometres
        for shape, toe in zip(shapes, toes, strict=True):
            assert shape.end_m == pytest.approx(toe.centre_m, abs=1e-6)
            assert shape.radius_m == pytest.approx(min(0.6 * robot.foot_depth_m, 0.8 * toe.radius_m), abs=1e-6)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_box_holds_the_bodys_parts_above_a_millimetre_over_the_ground(name: str) -> None:
    robot = built(name)
    seen = visuals(robot)
    box = body_box(robot, seen)
    assert box is not None
    assert decimals([box.low_m, box.high_m]) == 4  # tenths of a millimetre
    points = np.concatenate(
        [
            one.mesh.vertices / 1000.0 @ one.T_body_mesh[:3, :3].T + one.T_body_mesh[:3, 3]
            for one in seen
            if one.body == BODY
        ]
    )
    low, high = points.min(axis=0), points.max(axis=0)
    assert (box.high_m > high - 1e-4).all()  # a turned part's own box is larger
    assert (box.high_m < high + 0.006).all()
    assert (box.low_m[:2] < low[:2] + 1e-4).all()
    assert (box.low_m[:2] > low[:2] - 0.006).all()
    pose = body_poses(robot, 1.0)[BODY]
    corners = np.array([[x, 0.0, box.low_m[2]] for x in (box.low_m[0], box.high_m[0])])
    heights = corners @ pose[:3, :3].T[:, 2] + pose[2, 3]
    assert heights.min() >= 0.001 - 1e-4
    raised = box.low_m[2] > low[2] + 2e-4
    assert not raised or heights.min() == pytest.approx(0.001, abs=2e-4)
    assert box.low_m[2] > low[2] - 0.006
    assert body_box(robot, [one for one in seen if one.body != BODY]) is None
