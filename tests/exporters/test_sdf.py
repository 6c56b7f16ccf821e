"""SDF read back: the springs' hinge, and a loop that is closed where the links stand."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from jumpcad.design import load_design
from jumpcad.exporters.sdf import write_sdf
from jumpcad.mechanism.model import FOOT, FRONT_LINK, Mechanism
from jumpcad.mechanism.variants import capsule_robot


@pytest.fixture(scope="module", params=["kenan-1.0", "best-bo"])
def mechanism(request: pytest.FixtureRequest) -> Mechanism:
    return capsule_robot(load_design(request.param))


def number(node: ET.Element, path: str) -> float:
    text = node.findtext(path)
    assert text is not None
    return float(text)


def hinges(mechanism: Mechanism) -> dict[str, ET.Element]:
    """Return the revolute joints of the SDF by name."""
    root = ET.fromstring(write_sdf(mechanism))
    return {str(joint.get("name")): joint for joint in root.iter("joint") if joint.get("type") == "revolute"}


def test_the_spring_holds_the_designs_energy(mechanism: Mechanism) -> None:
    """Stiffness on the leg's hinge alone, at rest where the angle is 0: half of it times the loading squared."""
    springs = {
        name: joint.find("axis/dynamics/spring_stiffness") is not None for name, joint in hinges(mechanism).items()
    }
    assert [name for name, there in springs.items() if there] == ["leg"]
    leg = hinges(mechanism)["leg"]
    assert number(leg, "axis/dynamics/spring_reference") == 0.0
    energy = 0.5 * number(leg, "axis/dynamics/spring_stiffness") * mechanism.design.compression_rad**2
    assert energy == pytest.approx(mechanism.design.spring_energy_j, rel=1e-9)


def test_a_preload_pushes_the_leg_on_at_rest(mechanism: Mechanism) -> None:
    """SDF's torque is stiffness times (reference - angle); loading lowers the angle, 5 degrees are left at rest."""
    preload = math.radians(5.0)
    text = write_sdf(replace(mechanism, springs=(replace(mechanism.spring, preload_rad=preload),)))
    (leg,) = (joint for joint in ET.fromstring(text).iter("joint") if joint.get("name") == "leg")
    stiffness, rest = (number(leg, f"axis/dynamics/spring_{key}") for key in ("stiffness", "reference"))
    assert stiffness * (rest - 0.0) == pytest.approx(mechanism.design.stiffness_nm_per_rad * preload)
    wound = -mechanism.design.compression_rad
    assert stiffness * (rest - wound) == pytest.approx(mechanism.design.stiffness_nm_per_rad * (preload - wound))


def test_the_loop_is_one_point_of_two_links(mechanism: Mechanism) -> None:
    """Read from the file alone: poses of links, the joint's point in its child, and the other link's eye."""
    root = ET.fromstring(write_sdf(mechanism))

    def pose(node: ET.Element) -> tuple[np.ndarray, np.ndarray]:
        numbers = [float(value) for value in str(node.findtext("pose")).split()]
        return Rotation.from_euler("xyz", numbers[3:]).as_matrix(), np.array(numbers[:3])

    links = {str(link.get("name")): link for link in root.iter("link")}
    (loop,) = (joint for joint in root.iter("joint") if joint.get("type") == "ball")
    rotation, origin = pose(links[str(loop.findtext("child"))])
    point = origin + rotation @ pose(loop)[1]
    assert {loop.findtext("parent"), loop.findtext("child")} == {FRONT_LINK, FOOT}
    for name, length in ((FRONT_LINK, mechanism.design.l3_mm), (FOOT, mechanism.design.l4_mm)):
        rotation, origin = pose(links[name])
        np.testing.assert_allclose(point, origin + rotation @ [length / 1000.0, 0.0, 0.0], atol=1e-6)
