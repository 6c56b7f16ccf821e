"""URDF: the tree of the mechanism, and a JSON file beside it with what URDF cannot express: loop, spring, release.

The leg's upper limit is the stop. Pin friction is one dry torque at the leg joint; the JSON file has its coefficient.

Link frames are the body frames of `Robot`. Inertial frames are along the principal axes, because PyBullet's own
diagonalisation has an error of 1e-5. Visible are the parts' meshes (`meshes/NAME.stl`, in mm, scaled to metres); the
collision shapes are the contact spheres, and cylinders along the cage.
"""

import json
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from jumpcad.dimensions import MESH_FOLDER
from jumpcad.exporters.xml import add, document, limits_rad, rpy
from jumpcad.mechanism.mass import principal_axes
from jumpcad.mechanism.model import BODY, Body, Joint, Mechanism
from jumpcad.mechanism.poses import release_pose
from jumpcad.settings import Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm

if TYPE_CHECKING:
    from jumpcad.robot import Robot
    from jumpcad.scene.hulls import Capsule
    from jumpcad.scene.visuals import Visual


OWN = "stop", "roller_off", "friction"
"""Attributes of `Mechanism` that only printed robots have, and their names in the JSON file."""


def urdf_files(robot: "Robot") -> "Iterator[tuple[str, str | bytes]]":
    """Yield path and content of the visible meshes, of the URDF and of the loop file beside it."""
    from jumpcad.scene.visuals import visuals
    from jumpcad.solids.stl import write_stl

    visible = visuals(robot)
    for name, mesh in {shape.mesh_name: shape.mesh for shape in visible}.items():
        yield f"urdf/{MESH_FOLDER}/{name}.stl", write_stl(mesh)
    yield f"urdf/{robot.name}.urdf", write_urdf(robot, visible)
    yield f"urdf/{robot.name}.loop.json", write_loop(robot)


def write_urdf(mechanism: Mechanism, visible: "Sequence[Visual]" = (), settings: Settings | None = None) -> str:
    """Return the URDF document of a mechanism; its joints have the settings' damping and dry friction.

    `visible` are its visible meshes, from `jumpcad.scene.visuals`.

    The `mujoco` element keeps MuJoCo from dropping the root link's mass and the folder of the meshes.
    """
    settings = settings or Settings()
    root = ET.Element("robot", name=mechanism.name)
    add(add(root, "mujoco"), "compiler", fusestatic="false", strippath="false", discardvisual="false")
    for body in mechanism.bodies.values():
        add_link(root, body, [shape for shape in visible if shape.body == body.name], MESH_FOLDER)
    add_cage(root, mechanism)
    for joint in mechanism.joints:
        add_joint(root, joint, mechanism, settings)
    return document(root)


def write_loop(mechanism: Mechanism) -> str:
    """Return the JSON document beside the URDF: loop closure, spring, pose at release, surfaces of the spheres."""
    release = release_pose(mechanism)
    loop, spring = mechanism.loop, mechanism.spring
    data = {
        "design": mechanism.design.model_dump(),
        "loop": {
            "body_a": loop.body_a,
            "point_a_m": loop.point_a_m.tolist(),
            "body_b": loop.body_b,
            "point_b_m": loop.point_b_m.tolist(),
        },
        "spring": {
            "joint": spring.joint,
            "stiffness_nm_per_rad": spring.stiffness_nm_per_rad,
            "rest_rad": 0.0,
            "wind_rad": spring.wind_rad,
            **({"preload_rad": spring.preload_rad} if spring.preload_rad else {}),
            **({"one_sided": True} if spring.one_sided else {}),
        },
        **{key: asdict(value) for key in OWN if (value := getattr(mechanism, key)) is not None},
        "travel_rad": {joint.name: [joint.lower_rad, joint.upper_rad] for joint in mechanism.joints},
        "release": {
            "joint_rad": release.joint_rad,
            "body_position_m": release.body_position_m.tolist(),
            "body_pitch_rad": release.body_pitch_rad,
        },
        "foot_depth_m": mechanism.foot_depth_m,
        "surfaces": {contact.name: contact.surface for body in mechanism.bodies.values() for contact in body.contacts},
    }
    return json.dumps(data, indent=2, allow_nan=False) + "\n"


def add_link(root: ET.Element, body: Body, visible: "list[Visual]", meshes: str) -> ET.Element:
    """Append a body with its visible meshes, which are at the path or URI `meshes`, and its contact spheres."""
    link = add(root, "link", name=body.name)
    moments, axes = principal_axes(body.inertia_kg_m2)
    inertial = add(link, "inertial")
    add(inertial, "origin", xyz=body.com_m, rpy=rpy(axes))
    add(inertial, "mass", value=body.mass_kg)
    add(inertial, "inertia", ixx=moments[0], ixy=0.0, ixz=0.0, iyy=moments[1], iyz=0.0, izz=moments[2])
    for shape in visible:
        visual = add(link, "visual", name=shape.name)
        add(visual, "origin", xyz=shape.T_body_mesh[:3, 3], rpy=rpy(shape.T_body_mesh[:3, :3]))
        geometry = add(visual, "geometry")
        add(geometry, "mesh", filename=f"{meshes}/{shape.mesh_name}.stl", scale="0.001 0.001 0.001")
        material = add(visual, "material", name=f"{shape.name}_colour")
        add(material, "color", rgba=(*shape.colour, 1.0))
    for contact in body.contacts:
        collision = add(link, "collision", name=contact.name)
        add(collision, "origin", xyz=contact.centre_m, rpy="0 0 0")
        add(add(collision, "geometry"), "sphere", radius=contact.radius_m)
    return link


def add_cage(root: ET.Element, mechanism: Mechanism) -> None:
    """Append the cage's rods and bars to the link of the body, as cylinders that touch the ground."""
    from jumpcad.scene.hulls import cage_capsules

    link = next(link for link in root.iter("link") if link.get("name") == BODY)
    for number, capsule in enumerate(cage_capsules(mechanism), start=1):
        add_cylinder(link, f"cage_{number}", capsule)


def add_cylinder(link: ET.Element, name: str, capsule: "Capsule") -> None:
    """Append a capsule as a cylinder: URDF has no capsules."""
    collision = add(link, "collision", name=name)
    add(collision, "origin", xyz=(capsule.start_m + capsule.end_m) / 2.0, rpy=capsule.rpy)
    add(add(collision, "geometry"), "cylinder", radius=capsule.radius_m, length=capsule.length_m)


def add_joint(root: ET.Element, joint: Joint, mechanism: Mechanism, settings: Settings) -> ET.Element:
    """Append a hinge with its limits, damping and dry friction."""
    node = add(root, "joint", name=joint.name, type="revolute")
    add(node, "origin", xyz=joint.origin_m, rpy=(0.0, joint.rest_angle_rad, 0.0))
    add(node, "parent", link=joint.parent)
    add(node, "child", link=joint.child)
    add(node, "axis", xyz="0 1 0")
    rubs, (lower, upper) = coefficients(mechanism, settings), limits_rad(joint, mechanism)
    pins = pin_torque_nm(mechanism, rubs.pin) if joint.name == mechanism.spring.joint else 0.0
    add(
        node,
        "limit",
        lower=lower,
        upper=upper,
        effort=joint.effort_nm,
        velocity=joint.velocity_rad_s,
    )
    add(node, "dynamics", damping=rubs.joint_damping_nms_per_rad, friction=settings.joint_friction_nm + pins)
    return node
