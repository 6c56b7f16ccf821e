"""MJCF: the robot above a floor for MuJoCo, loop and spring included, ready to be released.

Loading key frame `wound` and stepping is the whole jump. The cam is not modelled: it lets go at once. MuJoCo's
constraints are springs; here contacts and the loop are as stiff as the time step allows, and the time step is a
fraction of that in the settings. The project's own MuJoCo engine runs this very model.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from jumpcad.dimensions import MESHES_FROM_BESIDE
from jumpcad.exporters.xml import add, document, wxyz
from jumpcad.mechanism.model import BODY, Body, Joint, Mechanism
from jumpcad.mechanism.poses import body_poses, standing
from jumpcad.settings import Settings, surface_friction
from jumpcad.transforms import rotation_about_y

if TYPE_CHECKING:
    from jumpcad.robot import Robot
    from jumpcad.scene.visuals import Visual

SUBSTEPS = 4
"""MuJoCo's own steps per step of the settings; its stiffest constraints are then as exact as Bullet's rigid ones."""
SOFTNESS_STEPS = 2.0
"""Time constant of the constraints over MuJoCo's own step: the least that MuJoCo keeps stable."""
IMPEDANCE = [0.99, 0.9999, 0.0001, 0.5, 2.0]
"""Share of a constraint that is enforced, and how it grows with penetration (MuJoCo's `solimp`)."""
LEAST_ITERATIONS, MUJOCO_ITERATIONS = 50, 100
"""Solver iterations: fewer do not reach the tolerance; and MuJoCo's default."""


def mjcf_files(robot: "Robot") -> Iterator[tuple[str, str]]:
    """Yield path and content of the model; its meshes are those beside the URDF."""
    from jumpcad.scene.visuals import visuals

    yield f"mjcf/{robot.name}.xml", write_mjcf(robot, visuals(robot))


def write_mjcf(mechanism: Mechanism, visible: "Sequence[Visual]" = (), settings: Settings | None = None) -> str:
    """Return the MJCF document of a robot, with the settings' time step, friction and damping."""
    settings = settings or Settings()
    root = ET.Element("mujoco", model=mechanism.name)
    add(root, "compiler", angle="radian", meshdir=MESHES_FROM_BESIDE, inertiafromgeom="false")
    iterations = max(settings.solver_iterations, LEAST_ITERATIONS)
    add(
        root,
        "option",
        timestep=settings.dt_s / SUBSTEPS,
        gravity=(0.0, 0.0, -settings.gravity_m_s2),
        integrator="implicitfast",
        cone="elliptic",
        impratio=10.0,
        tolerance=1e-12,
        **({} if iterations == MUJOCO_ITERATIONS else {"iterations": str(iterations)}),
    )
    asset = add(root, "asset")
    for name in dict.fromkeys(shape.mesh_name for shape in visible):
        add(asset, "mesh", name=name, file=f"{name}.stl", scale="0.001 0.001 0.001")
    world = add(root, "worldbody")
    add(world, "light", pos="0.2 -0.5 1", dir="-0.2 0.5 -1", directional="true")
    add(world, "geom", name="ground", type="plane", size="2 2 0.1", rgba="0.9 0.9 0.9 1", contype="0", conaffinity="0")
    rest = body_poses(mechanism)[BODY]
    base = add(world, "body", name=BODY, pos=rest[:3, 3], quat=wxyz(rest[:3, :3]))
    add(base, "freejoint", name="free")
    _fill(base, mechanism.bodies[BODY], visible)
    order = _children(base, mechanism, BODY, settings, visible)
    _contacts(root, mechanism, settings)
    _loop(root, mechanism, settings)
    _wound(root, mechanism, order)
    return document(root)


def _children(
    parent: ET.Element, mechanism: Mechanism, name: str, settings: Settings, visible: "Sequence[Visual]"
) -> list[str]:
    """Append the child bodies of a body; return their joints in the order in which MuJoCo numbers them."""
    order: list[str] = []
    for joint in (joint for joint in mechanism.joints if joint.parent == name):
        node = add(
            parent, "body", name=joint.child, pos=joint.origin_m, quat=wxyz(rotation_about_y(joint.rest_angle_rad))
        )
        _hinge(node, joint, mechanism, settings)
        _fill(node, mechanism.bodies[joint.child], visible)
        order += [joint.name, *_children(node, mechanism, joint.child, settings, visible)]
    return order


def _hinge(node: ET.Element, joint: Joint, mechanism: Mechanism, settings: Settings) -> None:
    spring = {"stiffness": mechanism.spring.stiffness_nm_per_rad} if joint.name == mechanism.spring.joint else {}
    add(
        node,
        "joint",
        name=joint.name,
        type="hinge",
        axis="0 1 0",
        damping=settings.joint_damping_nms_per_rad,
        frictionloss=settings.joint_friction_nm,
        **spring,
    )


def _fill(node: ET.Element, body: Body, visible: "Sequence[Visual]") -> None:
    """Give a body its mass properties, visible meshes and contact spheres."""
    tensor = body.inertia_kg_m2
    six = (*tensor.diagonal(), tensor[0, 1], tensor[0, 2], tensor[1, 2])
    add(node, "inertial", pos=body.com_m, mass=body.mass_kg, fullinertia=six)
    for shape in (shape for shape in visible if shape.body == body.name):
        pose = shape.T_body_mesh
        add(
            node,
            "geom",
            name=shape.name,
            type="mesh",
            mesh=shape.mesh_name,
            pos=pose[:3, 3],
            quat=wxyz(pose[:3, :3]),
            rgba=(*shape.colour, 1.0),
            contype="0",
            conaffinity="0",
            group="2",
        )
    for contact in body.contacts:
        add(
            node,
            "geom",
            name=f"{body.name}_{contact.name}_contact",
            type="sphere",
            pos=contact.centre_m,
            size=contact.radius_m,
            contype="0",
            conaffinity="0",
            group="3",
        )


def _contacts(root: ET.Element, mechanism: Mechanism, settings: Settings) -> None:
    """Pair every contact sphere with the ground alone."""
    node = add(root, "contact")
    spin = settings.ground_friction * settings.spinning_friction_m
    roll = settings.ground_friction * settings.rolling_friction_m
    for body in mechanism.bodies.values():
        slide = settings.ground_friction * surface_friction(body, settings)
        for contact in body.contacts:
            add(
                node,
                "pair",
                geom1="ground",
                geom2=f"{body.name}_{contact.name}_contact",
                condim="6" if spin or roll else "3",
                friction=(slide, slide, spin, roll, roll),
                **_stiff(settings),
            )


def _loop(root: ET.Element, mechanism: Mechanism, settings: Settings) -> None:
    """Connect the loop's two points, a site on each body."""
    loop = mechanism.loop
    for name, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
        body = next(node for node in root.iter("body") if node.get("name") == name)
        add(body, "site", name=f"{name}_loop", pos=point)
    sites = {"site1": f"{loop.body_a}_loop", "site2": f"{loop.body_b}_loop"}
    add(add(root, "equality"), "connect", name="loop", **sites, **_stiff(settings))


def _wound(root: ET.Element, mechanism: Mechanism, order: list[str]) -> None:
    release = standing(mechanism, 1.0)
    attitude = wxyz(rotation_about_y(release.body_pitch_rad))
    angles = [release.joint_rad[name] for name in order]
    add(add(root, "keyframe"), "key", name="wound", qpos=(*release.body_position_m, *attitude, *angles))


def _stiff(settings: Settings) -> dict[str, Sequence[float]]:
    """Return the stiffness of contacts and loop, the same as in the project's own MuJoCo runs."""
    return {"solref": (SOFTNESS_STEPS * settings.dt_s / SUBSTEPS, 1.0), "solimp": IMPEDANCE}
