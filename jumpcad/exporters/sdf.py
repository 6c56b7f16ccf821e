"""SDF 1.9: the robot for Gazebo, the loop as a joint of its own, the spring on its hinge.

The model stands with springs at rest. Links' frames are the body frames of `Robot`. The leg's limit is the stop, with
the stiffness of its pad and critical damping. SDF has no spring that only pushes: beyond rest, in flight, that of the
hinge pulls the leg back. Pin friction is one dry torque at the leg joint.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from jumpcad.dimensions import MESHES_FROM_BESIDE
from jumpcad.exporters.xml import add, allowed, document, limits_rad, rpy
from jumpcad.files.rendering import fill
from jumpcad.mechanism.model import BODY, Body, Joint, Mechanism
from jumpcad.mechanism.poses import body_poses
from jumpcad.mechanism.reflected import leg_inertia_kg_m2
from jumpcad.robot import Robot
from jumpcad.scene.hulls import cage_capsules
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.settings import Coefficients, Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import Array

SDF = "1.9"


def sdf_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and content of the model and of the file by which Gazebo finds it; meshes are those of the URDF."""
    yield f"sdf/{robot.name}.sdf", write_sdf(robot, visuals(robot))
    yield "sdf/model.config", write_config(robot.name, f"{robot.name}.sdf")


def write_config(name: str, file: str) -> str:
    """Return the `model.config` of a folder whose `file` is the SDF document of the robot `name`."""
    return allowed(fill("sdf/model.config.j2", {"name": name, "file": file, "version": SDF}))


def write_sdf(
    mechanism: Mechanism,
    visible: Sequence[Visual] = (),
    settings: Settings | None = None,
    meshes: str = MESHES_FROM_BESIDE,
) -> str:
    """Return the SDF document of a robot, with the settings' friction and damping.

    `meshes` is the folder of the visible meshes, relative to the document's.
    """
    settings = settings or Settings()
    rubs = coefficients(mechanism, settings)
    root = ET.Element("sdf", version=SDF)
    model = add(root, "model", name=mechanism.name)
    for name, pose in body_poses(mechanism).items():
        link = add(model, "link", name=name)
        add(link, "pose", _six(pose))
        _fill(link, mechanism.bodies[name], [shape for shape in visible if shape.body == name], rubs, meshes)
    for number, capsule in enumerate(cage_capsules(mechanism), start=1):
        base = next(link for link in model.iter("link") if link.get("name") == BODY)
        collision = add(base, "collision", name=f"cage_{number}")
        add(collision, "pose", (*(capsule.start_m + capsule.end_m) / 2.0, *capsule.rpy))
        shape = add(add(collision, "geometry"), "capsule")
        add(shape, "radius", capsule.radius_m)
        add(shape, "length", capsule.length_m)
        _rubs(collision, rubs.contact("body"))
    for joint in mechanism.joints:
        _hinge(model, joint, mechanism, settings)
    loop = mechanism.loop
    closure = add(model, "joint", name="loop", type="ball")
    add(closure, "pose", (*loop.point_b_m, 0.0, 0.0, 0.0))
    add(closure, "parent", loop.body_a)
    add(closure, "child", loop.body_b)
    return document(root)


def _fill(link: ET.Element, body: Body, visible: list[Visual], rubs: Coefficients, meshes: str) -> None:
    inertial = add(link, "inertial")
    add(inertial, "pose", (*body.com_m, 0.0, 0.0, 0.0))
    add(inertial, "mass", body.mass_kg)
    inertia = add(inertial, "inertia")
    for row, column in ("xx", "xy", "xz", "yy", "yz", "zz"):
        add(inertia, f"i{row}{column}", body.inertia_kg_m2["xyz".index(row), "xyz".index(column)])
    for shape in visible:
        visual = add(link, "visual", name=shape.name)
        add(visual, "pose", _six(shape.T_body_mesh))
        mesh = add(add(visual, "geometry"), "mesh")
        add(mesh, "uri", f"{meshes}/{shape.mesh_name}.stl")
        add(mesh, "scale", "0.001 0.001 0.001")
        material = add(visual, "material")
        for light in ("ambient", "diffuse"):
            add(material, light, (*shape.colour, 1.0))
    for contact in body.contacts:
        collision = add(link, "collision", name=contact.name)
        add(collision, "pose", (*contact.centre_m, 0.0, 0.0, 0.0))
        add(add(add(collision, "geometry"), "sphere"), "radius", contact.radius_m)
        _rubs(collision, rubs.contact(body.surface))


def _rubs(collision: ET.Element, friction: float) -> None:
    ode = add(add(add(collision, "surface"), "friction"), "ode")
    for direction in ("mu", "mu2"):
        add(ode, direction, friction)


def _hinge(model: ET.Element, joint: Joint, mechanism: Mechanism, settings: Settings) -> None:
    node = add(model, "joint", name=joint.name, type="revolute")
    add(node, "parent", joint.parent)
    add(node, "child", joint.child)
    axis = add(node, "axis")
    add(axis, "xyz", "0 1 0")
    rubs, spring = coefficients(mechanism, settings), mechanism.spring
    limit, (lower, upper) = add(axis, "limit"), limits_rad(joint, mechanism)
    add(limit, "lower", lower)
    add(limit, "upper", upper)
    add(limit, "effort", joint.effort_nm)
    add(limit, "velocity", joint.velocity_rad_s)
    if mechanism.stop and mechanism.stop.joint == joint.name:
        add(limit, "stiffness", mechanism.stop.stiffness_nm_per_rad)
        inertia = leg_inertia_kg_m2(mechanism, mechanism.stop.angle_rad)
        add(limit, "dissipation", 2.0 * math.sqrt(mechanism.stop.stiffness_nm_per_rad * inertia))
    dynamics = add(axis, "dynamics")
    add(dynamics, "damping", rubs.joint_damping_nms_per_rad)
    on_leg = joint.name == spring.joint
    add(dynamics, "friction", settings.joint_friction_nm + (pin_torque_nm(mechanism, rubs.pin) if on_leg else 0.0))
    if on_leg:
        add(dynamics, "spring_reference", spring.preload_rad)
        add(dynamics, "spring_stiffness", spring.stiffness_nm_per_rad)


def _six(pose: Array) -> tuple[float, ...]:
    """Return x, y, z, roll, pitch, yaw of a pose (4, 4)."""
    return (*pose[:3, 3], *rpy(pose[:3, :3]))
