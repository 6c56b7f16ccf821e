"""The same facts in every description: bodies, spheres, hinges, friction and springs, read from URDF, SDF and MJCF."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs

from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.exporters.sdf import write_sdf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.model import Body, Joint, Mechanism
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm

SETTINGS = Settings(joint_friction_nm=0.0123, joint_damping_nms_per_rad=0.00045)


@pytest.fixture(scope="module")
def urdf(kenan: Robot) -> ET.Element:
    return ET.fromstring(write_urdf(kenan, visuals(kenan), SETTINGS))


@pytest.fixture(scope="module")
def sdf(kenan: Robot) -> ET.Element:
    return ET.fromstring(write_sdf(kenan, visuals(kenan), settings=SETTINGS))[0]


def numbers(text: str | None) -> np.ndarray:
    return np.array((text or "").split(), dtype=float)


def named(root: ET.Element, tag: str, name: str) -> ET.Element:
    return next(one for one in root.iter(tag) if one.get("name") == name)


def tensor(inertia: ET.Element, angles: np.ndarray) -> np.ndarray:
    """Inertia about the axes of the body's frame, from moments about axes turned by roll, pitch and yaw."""
    read = {key: float(inertia.get(key) or inertia.findtext(key)) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
    own = np.array([[read["ixx"], read["ixy"], read["ixz"]], [read["ixy"], read["iyy"], read["iyz"]],
                    [read["ixz"], read["iyz"], read["izz"]]])  # fmt: skip
    turn = Rotation.from_euler("xyz", angles).as_matrix()
    return turn @ own @ turn.T


def same_inertia(found: np.ndarray, body: Body) -> bool:
    return np.allclose(found, body.inertia_kg_m2, rtol=1e-5, atol=1e-5 * body.inertia_kg_m2.max())


def leg_friction_nm(robot: Mechanism, joint: Joint) -> float:
    pins = pin_torque_nm(robot, coefficients(robot, SETTINGS).pin) if joint.name == "leg" else 0.0
    return 0.0123 + pins


def test_urdf_has_every_body_with_its_inertia_and_spheres(kenan: Robot, urdf: ET.Element) -> None:
    for body in kenan.bodies.values():
        link = named(urdf, "link", body.name)
        origin, mass = link.find("inertial/origin"), link.find("inertial/mass")
        assert float(mass.get("value")) == pytest.approx(body.mass_kg)
        assert numbers(origin.get("xyz")) == pytest.approx(body.com_m, abs=1e-7)
        assert same_inertia(tensor(link.find("inertial/inertia"), numbers(origin.get("rpy"))), body)
        spheres = {one.get("name"): one for one in link.findall("collision") if one.find("geometry/sphere") is not None}
        assert set(spheres) == {contact.name for contact in body.contacts}
        for contact in body.contacts:
            one = spheres[contact.name]
            assert numbers(one.find("origin").get("xyz")) == pytest.approx(contact.centre_m, abs=1e-7)
            assert float(one.find("geometry/sphere").get("radius")) == pytest.approx(contact.radius_m)


def test_sdf_has_every_body_with_its_inertia_spheres_and_friction(kenan: Robot, sdf: ET.Element) -> None:
    rubs = coefficients(kenan, SETTINGS)
    for body in kenan.bodies.values():
        link = named(sdf, "link", body.name)
        pose = numbers(link.findtext("inertial/pose"))
        assert float(link.findtext("inertial/mass")) == pytest.approx(body.mass_kg)
        assert pose[:3] == pytest.approx(body.com_m, abs=1e-7)
        assert same_inertia(tensor(link.find("inertial/inertia"), pose[3:]), body)
        spheres = {one.get("name"): one for one in link.findall("collision")}
        for contact in body.contacts:
            one = spheres[contact.name]
            assert numbers(one.findtext("pose")) == pytest.approx([*contact.centre_m, 0.0, 0.0, 0.0], abs=1e-7)
            assert float(one.findtext("geometry/sphere/radius")) == pytest.approx(contact.radius_m)
            for direction in ("mu", "mu2"):
                found = float(one.findtext(f"surface/friction/ode/{direction}"))
                assert found == pytest.approx(rubs.contact(body.surface))


def test_hinges_have_their_places_limits_and_losses(kenan: Robot, urdf: ET.Element, sdf: ET.Element) -> None:
    """The leg goes to its stop; all else a right angle beyond its travel."""
    for joint in kenan.joints:
        one, other = named(urdf, "joint", joint.name), named(sdf, "joint", joint.name)
        assert numbers(one.find("origin").get("xyz")) == pytest.approx(joint.origin_m, abs=1e-7)
        assert numbers(one.find("origin").get("rpy")) == pytest.approx([0.0, joint.rest_angle_rad, 0.0], abs=1e-7)
        assert (one.find("parent").get("link"), one.find("child").get("link")) == (joint.parent, joint.child)
        assert (other.findtext("parent"), other.findtext("child")) == (joint.parent, joint.child)
        assert one.find("axis").get("xyz") == other.findtext("axis/xyz") == "0 1 0"
        limit, dynamics = one.find("limit"), one.find("dynamics")
        for key, value in (
            ("effort", joint.effort_nm),
            ("velocity", joint.velocity_rad_s),
            ("lower", joint.lower_rad - math.pi / 2.0),
        ):
            assert float(limit.get(key)) == pytest.approx(value, abs=1e-6), key
            assert float(other.findtext(f"axis/limit/{key}")) == pytest.approx(value, abs=1e-6), key
        upper = kenan.stop.angle_rad if kenan.stop and joint.name == "leg" else joint.upper_rad + math.pi / 2.0
        assert float(limit.get("upper")) == float(other.findtext("axis/limit/upper")) == pytest.approx(upper)
        assert float(dynamics.get("friction")) == pytest.approx(leg_friction_nm(kenan, joint))
        assert float(other.findtext("axis/dynamics/friction")) == pytest.approx(leg_friction_nm(kenan, joint))
        assert float(dynamics.get("damping")) == pytest.approx(0.00045)
        assert float(other.findtext("axis/dynamics/damping")) == pytest.approx(0.00045)


def test_the_stop_is_critically_damped_in_sdf(kenan: Robot, sdf: ET.Element) -> None:
    """Stiffness k and 2·sqrt(k·I) about the leg's joint; other hinges have none."""
    stop = kenan.stop
    assert stop is not None
    limit = named(sdf, "joint", "leg").find("axis/limit")
    inertia = leg_inertia_kg_m2(kenan, stop.angle_rad)
    assert float(limit.findtext("stiffness")) == pytest.approx(stop.stiffness_nm_per_rad)
    assert float(limit.findtext("dissipation")) == pytest.approx(2.0 * math.sqrt(stop.stiffness_nm_per_rad * inertia))
    for other in ("front", "ankle"):
        assert named(sdf, "joint", other).find("axis/limit/stiffness") is None


def test_visible_meshes_stand_where_the_parts_are(kenan: Robot, urdf: ET.Element, sdf: ET.Element) -> None:
    for shape in visuals(kenan):
        one, other = named(urdf, "visual", shape.name), named(sdf, "visual", shape.name)
        origin, pose = one.find("origin"), numbers(other.findtext("pose"))
        for place, angles in ((numbers(origin.get("xyz")), numbers(origin.get("rpy"))), (pose[:3], pose[3:])):
            assert place == pytest.approx(shape.T_body_mesh[:3, 3], abs=1e-7)
            turn = Rotation.from_euler("xyz", angles).as_matrix()
            np.testing.assert_allclose(turn, shape.T_body_mesh[:3, :3], atol=1e-6)
        assert one.find("geometry/mesh").get("scale") == other.findtext("geometry/mesh/scale") == "0.001 0.001 0.001"
        assert one.find("geometry/mesh").get("filename").endswith(f"/{shape.mesh_name}.stl")
        assert numbers(one.find("material/color").get("rgba")) == pytest.approx((*shape.colour, 1.0))
        assert one.find("material").get("name") == f"{shape.name}_colour"  # URDF asks for one of its own
        assert numbers(other.findtext("material/diffuse")) == pytest.approx((*shape.colour, 1.0))


def test_mjcf_has_the_same_bodies_and_hinges(kenan: Robot) -> None:
    mujoco = needs.package("mujoco")
    model = mujoco.MjModel.from_xml_string(write_mjcf(kenan, SETTINGS))
    for body in kenan.bodies.values():
        index = model.body(body.name).id
        assert model.body_mass[index] == pytest.approx(body.mass_kg, rel=1e-6)
        assert model.body_ipos[index] == pytest.approx(body.com_m, abs=1e-7)
        turn = Rotation.from_quat(np.roll(model.body_iquat[index], -1)).as_matrix()
        assert same_inertia(turn @ np.diag(model.body_inertia[index]) @ turn.T, body)
    for joint in kenan.joints:
        index = model.joint(joint.name).id
        dof = model.jnt_dofadr[index]
        assert model.dof_damping[dof] == pytest.approx(0.00045)
        assert model.dof_frictionloss[dof] == pytest.approx(leg_friction_nm(kenan, joint))
