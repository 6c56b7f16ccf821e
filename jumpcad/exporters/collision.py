"""Simple collision shapes for simulations by others: capsules and a box, in addition to the contact spheres.

They end above the ground where the robot stands, so that it stands on its spheres alone.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.model import BODY, BODY_NAMES, ContactSphere, Mechanism
from jumpcad.mechanism.poses import body_poses
from jumpcad.scene.hulls import CAGE, Capsule
from jumpcad.scene.visuals import Visual
from jumpcad.transforms import Array

SLIM = 0.6
"""Radius of the links' capsules over the height of the ankle; judgement."""
SLIM_TOE = 0.8
"""Radius of the toes' capsules over that of their spheres; judgement."""
CLEAR_M = 0.001
"""Clearance between the body's box and the ground in the loaded pose; judgement."""


@dataclass(frozen=True)
class Box:
    """A box along the axes of its body's frame: lower and upper corner (3,) (m)."""

    low_m: Array
    high_m: Array


def capsules(mechanism: Mechanism, body: str) -> Iterator[Capsule]:
    """Yield the capsules of a link; the foot has one for each toe too, the body none."""
    design, origin = mechanism.design, np.zeros(3)
    radius = round(SLIM * mechanism.foot_depth_m, 6)
    lengths = dict(zip(BODY_NAMES, (0.0, design.l2_mm, design.l3_mm, design.l4_mm), strict=True))
    if lengths[body]:
        yield Capsule(origin, np.array([lengths[body] / 1000.0, 0.0, 0.0]), radius)
    for toe in (contact for contact in mechanism.bodies[body].contacts if _is_toe(contact)):
        yield Capsule(origin, np.round(toe.centre_m, 6), min(radius, round(SLIM_TOE * toe.radius_m, 6)))


def body_box(mechanism: Mechanism, visible: Sequence[Visual]) -> Box | None:
    """Return a box around the body's parts without the cage, or None without visible parts or if no height is left.

    Its lower face is raised until it is clear of the ground in the loaded pose: the body is round at its lower corners.
    """
    corners = [
        shape.corners_at(shape.T_body_mesh)
        for shape in visible
        if shape.body == BODY and not shape.name.startswith(CAGE)
    ]
    if not corners:
        return None
    every = np.round(np.concatenate(corners), 4)
    low, high = every.min(axis=0), every.max(axis=0)
    pose = body_poses(mechanism, 1.0)[BODY]
    lowest = max((CLEAR_M - pose[2, 3] - pose[2, 0] * x) / pose[2, 2] for x in (low[0], high[0]))
    low[2] = max(low[2], round(float(lowest), 4))
    return Box(low, high) if low[2] < high[2] else None


def _is_toe(contact: ContactSphere) -> bool:
    return contact.surface == "foot" and contact.centre_m[0] < 0.0
