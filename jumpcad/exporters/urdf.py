"""URDF: the tree of the mechanism, and a JSON file beside it with what URDF cannot express: loop, spring, release.

The leg's upper limit is the stop. Pin friction is one dry torque at the leg joint; the JSON file has its coefficient.

Link frames are the body frames of `Robot`. Inertial frames are along the principal axes, because PyBullet's own
diagonalisation has an error of 1e-5. Visible are the parts' meshes (`meshes/NAME.stl`, in mm, scaled to metres); the
collision shapes are the contact spheres, and cylinders along the cage.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from jumpcad.collision.hulls import Capsule, cage_capsules
from jumpcad.dimensions import MESH_FOLDER
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.steered import steered
from jumpcad.exporters.xml import allowed, friction_nm, limits, rpy, written
from jumpcad.files.templates import fill
from jumpcad.mechanism.mass import principal_axes
from jumpcad.mechanism.model import BODY, Mechanism
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.solids.stl import write_stl


def urdf_files(robot: Robot) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of the visible meshes, of the URDF and of the loop file beside it."""
    visible = visuals(robot)
    for name, mesh in {shape.mesh_name: shape.mesh for shape in visible}.items():
        yield f"urdf/{MESH_FOLDER}/{name}.stl", write_stl(mesh)
    yield f"urdf/{robot.name}.urdf", write_urdf(*steered(robot, visible))
    yield f"urdf/{robot.name}.loop.json", write_loop(robot)


def write_urdf(mechanism: Mechanism, visible: Sequence[Visual] = (), settings: Settings | None = None) -> str:
    """Return the URDF document of a mechanism; its joints have the settings' damping and dry friction.

    `visible` are its visible meshes, from `jumpcad.scene.visuals`.
    """
    cylinders, values = {BODY: cage_cylinders(mechanism)}, {"name": mechanism.name, "w": written}
    return tree(mechanism, visible, settings or Settings(), MESH_FOLDER, cylinders, values)


def tree(
    mechanism: Mechanism,
    visible: Sequence[Visual],
    settings: Settings,
    meshes: str,
    cylinders: Mapping[str, Mapping[str, Capsule]],
    values: dict[str, Any],
    leg: Mapping[str, float] | None = None,
) -> str:
    """Return the document of links and hinges.

    `meshes` is the path or URI of the visible meshes' folder, `cylinders` are capsules of each body, by name, written
    as cylinders, which URDF has; `leg` are limits of its joint that are not those of the mechanism.
    """
    rubs = coefficients(mechanism, settings)
    links, joints = [], []
    for body in mechanism.bodies.values():
        moments, axes = principal_axes(body.inertia_kg_m2)
        placed = [(shape, shape.T_body_mesh) for shape in visible if shape.body == body.name]
        shapes = [(shape, pose[:3, 3], rpy(pose[:3, :3])) for shape, pose in placed]
        links.append((body, moments, rpy(axes), shapes, cylinders.get(body.name, {})))
    for joint in mechanism.joints:
        limit = {**limits(joint, mechanism), **(leg if leg and joint.name == mechanism.spring.joint else {})}
        friction = friction_nm(joint, mechanism, settings)
        joints.append((joint, limit, rubs.joint_damping_nms_per_rad, friction))
    common = {"links": links, "joints": joints, "meshes": meshes, "leg": mechanism.spring.joint}
    return allowed(fill("urdf/tree.xml.j2", {"base": "", "box": None, "mimics": {}} | common | values))


def cage_cylinders(mechanism: Mechanism) -> dict[str, Capsule]:
    """Return the cage's rods and bars, which touch the ground, by name."""
    return {f"cage_{number}": capsule for number, capsule in enumerate(cage_capsules(mechanism), start=1)}
