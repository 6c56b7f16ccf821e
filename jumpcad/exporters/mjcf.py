"""MJCF: bodies, joints, loop and springs for MuJoCo, and the model above a floor that the project's own engine runs.

The files of a bundle are made of the same elements, see `mjcf_robot`. In this model only the contact spheres touch the
ground, and nothing else touches anything.

To simulate a jump, load a key frame and step: from `wound` the springs are released at once; `released`, which only
robots with a cam have, is the moment when the roller has left it, with all velocities. MuJoCo's constraints are soft;
here contacts and the loop are as stiff as the time step allows, and the time step is a fraction of that in the
settings.

Springs that only push are a tendon along the leg joint that is slack beyond the angle at which they are relaxed. The
stop is the leg joint's limit, with the stiffness of its pad and critical damping for the leg's inertia in flight; the
leg goes back at an eighth of its speed. The project's own engine puts the pad of the other engines in its place. Pin
friction is one dry torque at the leg joint.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence

from jumpcad.exporters.xml import Value, add, document, limits_rad, written, wxyz
from jumpcad.mechanism.model import BODY, Body, Joint, Mechanism, Spring
from jumpcad.mechanism.poses import ReleasePose, body_poses, release_pose, standing
from jumpcad.mechanism.reflected import leg_inertia_kg_m2
from jumpcad.settings import Coefficients, Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import rotation_about_y

Dress = Callable[[ET.Element, Body], None]
"""Appends a body's visible and collision geometry to its element."""

SUBSTEPS = 4
"""MuJoCo's own steps per step of the settings; its stiffest constraints are then as exact as Bullet's rigid ones."""
SOFTNESS_STEPS = 2.0
"""Time constant of the constraints over MuJoCo's own step: the least that MuJoCo keeps stable."""
IMPEDANCE = [0.99, 0.9999, 0.0001, 0.5, 2.0]
"""MuJoCo's `solimp`: impedance from 0.99 to 0.9999 over a penetration of 0.1 mm (or rad)."""
FREE_RAD = 10.0
"""Range in which springs that only push are slack: more than any leg turns."""
CONTACT_IMPEDANCE = [0.0, 0.95, 0.0001, 0.5, 1.0]
"""`solimp` of contacts: it starts at 0, otherwise a sliding foot chatters and gains energy (ranges of slipping jumps up
to 9 % too long; with it within 1 % of rigid contacts)."""
FRICTION_STIFFNESS = 100.0
"""Of friction over normal constraints (MuJoCo's `impratio`): at 1 a sticking foot creeps by 1 % of the range."""
LEAST_ITERATIONS, MUJOCO_ITERATIONS = 50, 100
"""Solver iterations: least number that reaches the tolerance; MuJoCo's default."""


def write_mjcf(mechanism: Mechanism, settings: Settings | None = None) -> str:
    """Return the document that the engine runs, with the time step, friction and damping of the settings."""
    settings = settings or Settings()
    rubs = coefficients(mechanism, settings)
    root = ET.Element("mujoco", model=mechanism.name)
    add(root, "compiler", angle="radian", inertiafromgeom="false")
    add_options(root, settings)
    world = add(root, "worldbody")
    add(world, "geom", name="ground", type="plane", size="2 2 0.1", contype="0", conaffinity="0")
    _, order = add_bodies(world, mechanism, settings, _spheres)
    _contacts(root, mechanism, settings, rubs)
    add_springs(add(root, "tendon"), mechanism.spring)
    add_loop(root, add(root, "equality"), mechanism, settings)
    keys = add(root, "keyframe")
    add_key(keys, "wound", standing(mechanism, 1.0), order)
    if mechanism.roller_off:
        add_key(keys, "released", release_pose(mechanism), order)
    return document(root)


def add_options(root: ET.Element, settings: Settings) -> None:
    """Append the options that the model's contacts and loop need."""
    iterations = max(settings.solver_iterations, LEAST_ITERATIONS)
    add(
        root,
        "option",
        timestep=settings.dt_s / SUBSTEPS,
        gravity=(0.0, 0.0, -settings.gravity_m_s2),
        integrator="implicitfast",
        cone="elliptic",
        impratio=FRICTION_STIFFNESS,
        tolerance=1e-12,
        **({} if iterations == MUJOCO_ITERATIONS else {"iterations": str(iterations)}),
    )


def add_bodies(
    world: ET.Element, mechanism: Mechanism, settings: Settings, dress: Dress
) -> tuple[ET.Element, list[str]]:
    """Append the tree of bodies, standing at rest; return its root and the names of its joints in MuJoCo's order."""
    rest = body_poses(mechanism)[BODY]
    base = add(world, "body", name=BODY, pos=rest[:3, 3], quat=wxyz(rest[:3, :3]))
    add(base, "freejoint", name="free")
    _fill(base, mechanism.bodies[BODY], dress)
    return base, _children(base, mechanism, BODY, settings, dress)


def _children(parent: ET.Element, mechanism: Mechanism, name: str, settings: Settings, dress: Dress) -> list[str]:
    """Append the child bodies of a body; return their joints in the order in which MuJoCo numbers them."""
    order: list[str] = []
    for joint in (joint for joint in mechanism.joints if joint.parent == name):
        node = add(
            parent, "body", name=joint.child, pos=joint.origin_m, quat=wxyz(rotation_about_y(joint.rest_angle_rad))
        )
        _hinge(node, joint, mechanism, settings)
        _fill(node, mechanism.bodies[joint.child], dress)
        order += [joint.name, *_children(node, mechanism, joint.child, settings, dress)]
    return order


def _hinge(node: ET.Element, joint: Joint, mechanism: Mechanism, settings: Settings) -> None:
    spring, rubs = mechanism.spring, coefficients(mechanism, settings)
    more: dict[str, Value] = {}
    friction = settings.joint_friction_nm
    if joint.name == spring.joint:
        friction += pin_torque_nm(mechanism, rubs.pin)
        if not spring.one_sided:
            more["stiffness"] = spring.stiffness_nm_per_rad
            if spring.preload_rad:
                more["springref"] = spring.preload_rad
        more |= _limit(joint, mechanism)
    if friction:
        more |= {"solreffriction": stiff(settings)["solref"], "solimpfriction": IMPEDANCE}
    add(
        node,
        "joint",
        name=joint.name,
        type="hinge",
        axis="0 1 0",
        damping=rubs.joint_damping_nms_per_rad,
        frictionloss=friction,
        **more,
    )


def _limit(joint: Joint, mechanism: Mechanism) -> dict[str, Value]:
    """Return the attributes of the leg joint's stop, if there is one.

    MuJoCo's time constant T and damping ratio 1 mean the stiffness I/T² with the joint's inertia I.
    """
    stop = mechanism.stop
    if stop is None:
        return {}
    inertia = leg_inertia_kg_m2(mechanism, stop.angle_rad)
    return {
        "limited": "true",
        "range": limits_rad(joint, mechanism),
        "solreflimit": (math.sqrt(inertia / stop.stiffness_nm_per_rad), 1.0),
        "solimplimit": IMPEDANCE,
    }


def add_springs(tendons: ET.Element, spring: Spring) -> None:
    """Append springs that only push; those that also pull are an attribute of the leg joint.

    A tendon along the leg joint pushes below the angle at which the springs are relaxed, and is slack beyond.
    """
    if not spring.one_sided:
        return
    tendon = add(tendons, "fixed", name="springs", stiffness=spring.stiffness_nm_per_rad,
                 springlength=(spring.preload_rad, spring.preload_rad + FREE_RAD))  # fmt: skip
    add(tendon, "joint", joint=spring.joint, coef=1.0)


def _fill(node: ET.Element, body: Body, dress: Dress) -> None:
    """Give a body its mass properties and its geometry."""
    tensor = body.inertia_kg_m2
    six = (*tensor.diagonal(), tensor[0, 1], tensor[0, 2], tensor[1, 2])
    add(node, "inertial", pos=body.com_m, mass=body.mass_kg, fullinertia=six)
    dress(node, body)


def _spheres(node: ET.Element, body: Body) -> None:
    """Give a body the spheres that are paired with the ground."""
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


def _contacts(root: ET.Element, mechanism: Mechanism, settings: Settings, rubs: Coefficients) -> None:
    """Pair every contact sphere with the ground alone."""
    node = add(root, "contact")
    spin = rubs.ground * settings.spinning_friction_m
    roll = rubs.ground * settings.rolling_friction_m
    for body in mechanism.bodies.values():
        slide = rubs.contact(body.surface)
        for contact in body.contacts:
            add(
                node,
                "pair",
                geom1="ground",
                geom2=f"{body.name}_{contact.name}_contact",
                condim="6" if spin or roll else "3",
                friction=(slide, slide, spin, roll, roll),
                **stiff(settings) | {"solimp": CONTACT_IMPEDANCE},
            )


def add_loop(root: ET.Element, equality: ET.Element, mechanism: Mechanism, settings: Settings) -> None:
    """Connect the loop's two points, a site on each body."""
    loop = mechanism.loop
    for name, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
        body = next(node for node in root.iter("body") if node.get("name") == name)
        add(body, "site", name=f"{name}_loop", pos=point)
    sites = {"site1": f"{loop.body_a}_loop", "site2": f"{loop.body_b}_loop"}
    add(equality, "connect", name="loop", **sites, **stiff(settings))


def add_key(keys: ET.Element, name: str, release: ReleasePose, order: list[str], **more: Value) -> None:
    """Append a key frame with the pose and the velocities of a release; `order` names the joints in MuJoCo's order."""
    attitude = wxyz(rotation_about_y(release.body_pitch_rad))
    angles = [release.joint_rad[name] for name in order]
    key = add(keys, "key", name=name, qpos=(*release.body_position_m, *attitude, *angles), **more)
    if release.joint_rad_s[order[0]]:
        rates = [release.joint_rad_s[joint] for joint in order]
        key.set("qvel", written((*release.body_m_s, 0.0, release.body_rad_s, 0.0, *rates)))


def stiff(settings: Settings) -> dict[str, Sequence[float]]:
    """Return `solref` and `solimp` of contacts and loop."""
    return {"solref": (SOFTNESS_STEPS * settings.dt_s / SUBSTEPS, 1.0), "solimp": IMPEDANCE}
