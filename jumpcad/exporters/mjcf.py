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
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from jumpcad.exporters.xml import Value, allowed, friction_nm, limits, written, wxyz
from jumpcad.files.templates import fill
from jumpcad.mechanism.model import BODY, Joint, Mechanism, Multibody, ReleasePose, body_poses, release_pose, standing
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.settings import Settings, coefficients
from jumpcad.transforms import Array, rotation_about_y

Attributes = dict[str, Value]

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
GROUND: Attributes = {"name": "ground", "type": "plane", "size": "2 2 0.1", "contype": "0", "conaffinity": "0"}


def write_mjcf(mechanism: Multibody, settings: Settings | None = None) -> str:
    """Return the document that the engine runs, with the time step, friction and damping of the settings."""
    settings = settings or Settings()
    rubs = coefficients(mechanism, settings)
    spin, roll = rubs.ground * settings.spinning_friction_m, rubs.ground * settings.rolling_friction_m
    spheres: dict[str, list[tuple[str, Attributes]]] = {}
    pairs: list[Attributes] = []
    for body in mechanism.bodies.values():
        slide, spheres[body.name] = rubs.contact(body.surface), []
        for contact in body.contacts:
            name = f"{body.name}_{contact.name}_contact"
            shape: Attributes = {"name": name, "type": "sphere", "pos": contact.centre_m, "size": contact.radius_m}
            spheres[body.name].append(("geom", shape | {"contype": "0", "conaffinity": "0", "group": "3"}))
            pairs.append({"geom2": name, "condim": "6" if spin or roll else "3",
                          "friction": (slide, slide, spin, roll, roll), **stiff(settings),
                          "solimp": CONTACT_IMPEDANCE})  # fmt: skip
    keys = {"wound": standing(mechanism, 1.0)} if isinstance(mechanism, Mechanism) else {}
    if mechanism.roller_off:
        keys["released"] = release_pose(mechanism)
    return filled(mechanism, settings, written, spheres, {name: (pose, {}) for name, pose in keys.items()},
                  tendons=springs(mechanism), floor=GROUND, pairs=pairs)  # fmt: skip


def filled(
    mechanism: Multibody,
    settings: Settings,
    number: Callable[[Value], str],
    shapes: Mapping[str, Sequence[tuple[str, Attributes]]],
    keys: Mapping[str, tuple[ReleasePose, Attributes]],
    **more: Any,
) -> str:
    """Return the document of a robot: a five-bar stands at rest, any other has its root at the origin, held in x-z.

    `number` writes values; `shapes` are tags and attributes of the elements inside each body, `keys` the key frames:
    poses and velocities, and other attributes; `more` is what else the template says.
    """
    rest = body_poses(mechanism)[BODY] if isinstance(mechanism, Mechanism) else np.eye(4)
    order = list(_numbered(mechanism, mechanism.root))
    closures = [(f"loop{number or ''}", [(loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)])
                for number, loop in enumerate(mechanism.loops)]  # fmt: skip
    values = {
        "robot": mechanism,
        "options": options(settings),
        "rubs": coefficients(mechanism, settings),
        "stiff": stiff(settings),
        "planar": not isinstance(mechanism, Mechanism),
        "place_m": rest[:3, 3],
        "attitude": wxyz(rest[:3, :3]),
        "closures": closures,
        "joints": [
            (joint, wxyz(rotation_about_y(joint.rest_angle_rad)), _hinge(joint, mechanism, settings)) for joint in order
        ],
        "shapes": shapes,
        "keys": {name: _key(pose, order, others) for name, (pose, others) in keys.items()},
        "six": _six,
        "w": number,
    }
    others = {"hold_nm": None, "steer": None, "excluded": (), "pairs": ()}
    return allowed(fill("mjcf/robot.xml.j2", others | values | more))


def options(settings: Settings) -> Attributes:
    """Return the options that the model's contacts and loop need."""
    iterations = max(settings.solver_iterations, LEAST_ITERATIONS)
    return {
        "timestep": settings.dt_s / SUBSTEPS,
        "gravity": (0.0, 0.0, -settings.gravity_m_s2),
        "integrator": "implicitfast",
        "cone": "elliptic",
        "impratio": FRICTION_STIFFNESS,
        "tolerance": 1e-12,
        **({} if iterations == MUJOCO_ITERATIONS else {"iterations": str(iterations)}),
    }


def springs(mechanism: Multibody) -> list[tuple[str, Attributes]]:
    """Return joints and tendons of springs that only push; those that also pull are an attribute of their joint.

    A tendon along the joint pushes below the angle at which the springs are relaxed, and is slack beyond.
    """
    return [
        (one.joint, {"name": f"springs{number or ''}", "stiffness": one.stiffness_nm_per_rad,
                     "springlength": (one.preload_rad, one.preload_rad + FREE_RAD)})
        for number, one in enumerate(mechanism.springs) if one.one_sided
    ]  # fmt: skip


def stiff(settings: Settings) -> dict[str, Sequence[float]]:
    """Return `solref` and `solimp` of contacts and loop."""
    return {"solref": (SOFTNESS_STEPS * settings.dt_s / SUBSTEPS, 1.0), "solimp": IMPEDANCE}


def _numbered(mechanism: Multibody, parent: str) -> Iterator[Joint]:
    """Yield the joints below a body in the order in which MuJoCo numbers them."""
    for joint in mechanism.joints:
        if joint.parent == parent:
            yield joint
            yield from _numbered(mechanism, joint.child)


def _hinge(joint: Joint, mechanism: Multibody, settings: Settings) -> Attributes:
    rubs = coefficients(mechanism, settings)
    friction = friction_nm(joint, mechanism, settings)
    found: Attributes = {"damping": rubs.joint_damping_nms_per_rad, "frictionloss": friction}
    for spring in mechanism.springs:
        if joint.name == spring.joint and not spring.one_sided:
            found["stiffness"] = spring.stiffness_nm_per_rad
            if spring.preload_rad:
                found["springref"] = spring.preload_rad
    found |= {"armature": joint.armature_kg_m2} if joint.armature_kg_m2 else {}
    found |= _limit(joint, mechanism, settings)
    if friction and isinstance(mechanism, Mechanism):
        found |= {"solreffriction": stiff(settings)["solref"], "solimpfriction": IMPEDANCE}
    return found


def _limit(joint: Joint, mechanism: Multibody, settings: Settings) -> Attributes:
    """Return the attributes of a joint's stop, if there is one: rigid, or of a five-bar's leg its pad.

    MuJoCo's time constant T and damping ratio 1 mean the stiffness I/T² with the joint's inertia I.
    """
    stop = mechanism.stop
    if joint.stops:
        rigid = {f"{key}limit": value for key, value in stiff(settings).items()}
        return {"limited": "true", "range": (joint.lower_rad, joint.upper_rad), **rigid}
    if stop is None or joint.name != stop.joint or not isinstance(mechanism, Mechanism):
        return {}
    inertia = leg_inertia_kg_m2(mechanism, stop.angle_rad)
    return {
        "limited": "true",
        "range": (limits(joint, mechanism)["lower"], stop.angle_rad),
        "solreflimit": (math.sqrt(inertia / stop.stiffness_nm_per_rad), 1.0),
        "solimplimit": IMPEDANCE,
    }


def _key(pose: ReleasePose, order: Sequence[Joint], others: Attributes) -> Attributes:
    """Return the attributes of a key frame with the pose and the velocities of a release."""
    attitude = wxyz(rotation_about_y(pose.body_pitch_rad))
    angles, rates = ([found.get(joint.name, 0.0) for joint in order] for found in (pose.joint_rad, pose.joint_rad_s))
    moves = {"qvel": (*pose.body_m_s, 0.0, pose.body_rad_s, 0.0, *rates)} if rates[0] else {}
    return {"qpos": (*pose.body_position_m, *attitude, *angles), **others, **moves}


def _six(tensor: Array) -> tuple[float, ...]:
    """Return the elements of an inertia (3, 3) in MuJoCo's order."""
    return (*tensor.diagonal(), tensor[0, 1], tensor[0, 2], tensor[1, 2])
