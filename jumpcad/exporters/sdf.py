"""SDF 1.9: the robot for Gazebo, the loop as a joint of its own, the spring on its hinge.

The model stands with springs at rest. Links' frames are the body frames of `Robot`.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from jumpcad.dimensions import MESHES_FROM_BESIDE
from jumpcad.exporters.urdf import SWING_RAD
from jumpcad.exporters.xml import add, document, rpy
from jumpcad.mechanism.model import Body, Joint, Mechanism
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.settings import Settings, surface_friction
from jumpcad.transforms import Array


def sdf_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and content of the model; its meshes are those beside the URDF."""
    yield f"sdf/{robot.name}.sdf", write_sdf(robot, visuals(robot))


def write_sdf(mechanism: Mechanism, visible: Sequence[Visual] = (), settings: Settings | None = None) -> str:
    """Return the SDF document of a robot, with the settings' friction and damping."""
    settings = settings or Settings()
    root = ET.Element("sdf", version="1.9")
    model = add(root, "model", name=mechanism.name)
    for name, pose in body_poses(mechanism).items():
        link = add(model, "link", name=name)
        add(link, "pose", _six(pose))
        _fill(link, mechanism.bodies[name], [shape for shape in visible if shape.body == name], settings)
    for joint in mechanism.joints:
        _hinge(model, joint, mechanism, settings)
    loop = mechanism.loop
    closure = add(model, "joint", name="loop", type="ball")
    add(closure, "pose", (*loop.point_b_m, 0.0, 0.0, 0.0))
    add(closure, "parent", loop.body_a)
    add(closure, "child", loop.body_b)
    return document(root)


def _fill(link: ET.Element, body: Body, visible: list[Visual], settings: Settings) -> None:
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
        add(mesh, "uri", f"{MESHES_FROM_BESIDE}/{shape.mesh_name}.stl")
        add(mesh, "scale", "0.001 0.001 0.001")
        material = add(visual, "material")
        for light in ("ambient", "diffuse"):
            add(material, light, (*shape.colour, 1.0))
    for contact in body.contacts:
        collision = add(link, "collision", name=contact.name)
        add(collision, "pose", (*contact.centre_m, 0.0, 0.0, 0.0))
        add(add(add(collision, "geometry"), "sphere"), "radius", contact.radius_m)
        ode = add(add(add(collision, "surface"), "friction"), "ode")
        for direction in ("mu", "mu2"):
            add(ode, direction, settings.ground_friction * surface_friction(body, settings))


def _hinge(model: ET.Element, joint: Joint, mechanism: Mechanism, settings: Settings) -> None:
    node = add(model, "joint", name=joint.name, type="revolute")
    add(node, "parent", joint.parent)
    add(node, "child", joint.child)
    axis = add(node, "axis")
    add(axis, "xyz", "0 1 0")
    limit = add(axis, "limit")
    add(limit, "lower", joint.lower_rad - SWING_RAD)
    add(limit, "upper", joint.upper_rad + SWING_RAD)
    add(limit, "effort", joint.effort_nm)
    add(limit, "velocity", joint.velocity_rad_s)
    dynamics = add(axis, "dynamics")
    add(dynamics, "damping", settings.joint_damping_nms_per_rad)
    add(dynamics, "friction", settings.joint_friction_nm)
    if joint.name == mechanism.spring.joint:
        add(dynamics, "spring_reference", 0.0)
        add(dynamics, "spring_stiffness", mechanism.spring.stiffness_nm_per_rad)


def _six(pose: Array) -> tuple[float, ...]:
    """Return x, y, z, roll, pitch, yaw of a pose (4, 4)."""
    return (*pose[:3, 3], *rpy(pose[:3, :3]))
