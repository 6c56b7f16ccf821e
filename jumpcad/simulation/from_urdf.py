"""A robot read back from its URDF file and the JSON file beside it: what is simulated is then what was written."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Body, ContactSphere, Joint, Loop, Mechanism, Spring


def robot_from_urdf(path: Path) -> Mechanism:
    """Return the mechanism of a URDF file that `jumpcad build` wrote.

    Raises
    ------
    JumpcadError
        If the file, or `NAME.loop.json` beside it, is missing, broken, or lacks something.
    """
    from yourdfpy import URDF

    beside = path.with_suffix(".loop.json")
    for file in (path, beside):
        if not file.is_file():
            raise JumpcadError(f"{file}: no such file; jumpcad build writes the URDF and its loop together")
    try:
        model = URDF.load(
            str(path), build_scene_graph=False, load_meshes=False, build_collision_scene_graph=False,
            load_collision_meshes=False,
        ).robot  # fmt: skip
        extra = json.loads(beside.read_text(encoding="utf-8"))
        bodies = {link.name: _body(link, extra["surfaces"]) for link in model.links}
        loop, spring = extra["loop"], extra["spring"]
        return Mechanism(
            name=model.name,
            design=Design(**extra["design"]),
            bodies=bodies,
            joints=tuple(_joint(joint, extra["travel_rad"]) for joint in model.joints),
            loop=Loop(loop["body_a"], np.array(loop["point_a_m"]), loop["body_b"], np.array(loop["point_b_m"])),
            spring=Spring(spring["joint"], spring["stiffness_nm_per_rad"], spring["wind_rad"]),
            foot_depth_m=float(extra["foot_depth_m"]),
        )
    except (KeyError, AttributeError, TypeError, ValueError, SyntaxError) as error:
        raise JumpcadError(f"{path}: not a robot that jumpcad build wrote: {error}") from None


def _body(link: Any, surfaces: dict[str, Any]) -> Body:
    inertial = link.inertial
    contacts = tuple(
        ContactSphere(item.name, item.origin[:3, 3].copy(), float(item.geometry.sphere.radius), surfaces[item.name])
        for item in link.collisions
    )
    axes = inertial.origin[:3, :3]
    tensor = axes @ inertial.inertia @ axes.T
    return Body(link.name, float(inertial.mass), inertial.origin[:3, 3].copy(), tensor, contacts)


def _joint(joint: Any, travel_rad: dict[str, list[float]]) -> Joint:
    turn = joint.origin[:3, :3]
    lower, upper = travel_rad[joint.name]
    return Joint(
        name=joint.name,
        parent=joint.parent,
        child=joint.child,
        origin_m=joint.origin[:3, 3].copy(),
        rest_angle_rad=math.atan2(turn[0, 2], turn[0, 0]),
        lower_rad=lower,
        upper_rad=upper,
        effort_nm=float(joint.limit.effort),
        velocity_rad_s=float(joint.limit.velocity),
    )
