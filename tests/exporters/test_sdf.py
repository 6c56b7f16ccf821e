"""SDF read back: masses, the springs' hinge, and a loop that is closed where the links stand."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from jumpcad.exporters.sdf import sdf_files, write_sdf
from jumpcad.mechanism.model import FOOT
from jumpcad.robot import Robot
from jumpcad.settings import Settings


@pytest.fixture(scope="module")
def model(small_robot: Robot) -> ET.Element:
    return ET.fromstring(write_sdf(small_robot))[0]


def numbers(element: ET.Element, path: str) -> np.ndarray:
    return np.array([float(value) for value in element.findtext(path, "").split()])


def pose(element: ET.Element) -> np.ndarray:
    """Return the pose (4, 4) of a link or joint; roll, pitch and yaw turn about fixed axes."""
    six, placed = numbers(element, "pose"), np.eye(4)
    placed[:3, :3], placed[:3, 3] = Rotation.from_euler("xyz", six[3:]).as_matrix(), six[:3]
    return placed


def test_links_have_the_masses_of_the_bodies(small_robot: Robot, model: ET.Element) -> None:
    masses = {link.get("name"): numbers(link, "inertial/mass")[0] for link in model.iter("link")}
    assert masses == {name: body.mass_kg for name, body in small_robot.bodies.items()}


def test_the_loop_is_closed_and_the_foot_lies_flat(small_robot: Robot, model: ET.Element) -> None:
    links = {link.get("name"): pose(link) for link in model.iter("link")}
    loop = next(joint for joint in model.iter("joint") if joint.get("name") == "loop")
    at_child = links[loop.findtext("child")] @ pose(loop)
    at_parent = links[loop.findtext("parent")] @ np.append(small_robot.loop.point_a_m, 1.0)
    np.testing.assert_allclose(at_child[:3, 3], at_parent[:3], atol=1e-9)
    np.testing.assert_allclose(links[FOOT][:3, :3], np.eye(3), atol=1e-9)


def test_the_springs_are_on_one_hinge_alone(small_robot: Robot, model: ET.Element) -> None:
    stiffness = {
        joint.get("name"): numbers(joint, "axis/dynamics/spring_stiffness").tolist() for joint in model.iter("joint")
    }
    assert stiffness.pop(small_robot.spring.joint) == [small_robot.spring.stiffness_nm_per_rad]
    assert list(stiffness.values()) == [[]] * 3


def test_friction_is_the_product_of_ground_and_foot(small_robot: Robot) -> None:
    settings = Settings(ground_friction=0.5, foot_friction=0.8)
    links = ET.fromstring(write_sdf(small_robot, settings=settings))[0].iter("link")
    foot = next(link for link in links if link.get("name") == FOOT)
    found = {float(mu.text or "nan") for name in ("mu", "mu2") for mu in foot.iter(name)}
    assert found == {0.4}


def test_meshes_are_those_beside_the_urdf(small_robot: Robot) -> None:
    ((path, text),) = sdf_files(small_robot)
    assert path == f"sdf/{small_robot.name}.sdf"
    uris = {uri.text for uri in ET.fromstring(text).iter("uri")}
    assert {f"../urdf/meshes/{part.name}.stl" for part in small_robot.parts} <= uris
