"""The bodies of a leg in its plane: where they are seen from the foot, and their momenta about the common centre.

Points in x-z are complex numbers x + iz; angles are below x.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from jumpcad.mechanism.linkage import Complex, Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG, Body
from jumpcad.transforms import Array


def frames(linkage: Linkage, leg_rad: Array) -> dict[str, tuple[Complex, Array]]:
    """Return origin (m) and angle of every body's frame in the frame of `body`, (n,) each, at leg angles (n,)."""
    pose = linkage.pose(leg_rad)
    ankle = points(pose.ankle_mm) / 1000.0
    still = np.zeros_like(ankle)
    return {
        BODY: (still, np.zeros_like(leg_rad)),
        MAIN_LEG: (still + points(linkage.back_pivot_mm) / 1000.0, linkage.rest_rad + pose.leg_rad),
        FRONT_LINK: (still + points(linkage.front_pivot_mm) / 1000.0, linkage.rest_rad + pose.front_rad),
        FOOT: (ankle, pose.foot_rad),
    }


def seen_from_body(
    bodies: Mapping[str, Body], linkage: Linkage, leg_rad: Array, names: Sequence[str] = BODY_NAMES
) -> tuple[Complex, Array]:
    """Return centres of mass (m) and angles of bodies in the frame of `body`, (n, bodies) each, at leg angles (n,)."""
    placed = frames(linkage, leg_rad)
    turns = np.stack([placed[name][1] for name in names], axis=-1)
    com = np.array([points(bodies[name].com_m[[0, 2]]) for name in names])
    return np.stack([placed[name][0] for name in names], axis=-1) + com * np.exp(-1j * turns), turns


def seen_from_foot(
    bodies: Mapping[str, Body], linkage: Linkage, leg_rad: Array, names: Sequence[str] = BODY_NAMES
) -> tuple[Complex, Array]:
    """Return centres of mass (m) and angles of bodies in the foot's frame, (n, bodies) each, at leg angles (n,)."""
    ankle, foot_rad = frames(linkage, leg_rad)[FOOT]
    places, turns = seen_from_body(bodies, linkage, leg_rad, names)
    return (places - ankle[:, None]) * np.exp(1j * foot_rad)[:, None], turns - foot_rad[:, None]


def about_common_centre(
    mass: Array, inertia: Array, place: Complex, velocity: Complex, rate: Array
) -> tuple[Array, Array, Array]:
    """Return angular momentum, twice the kinetic energy and inertia (...) of bodies about their common centre of mass.

    The bodies' masses and inertias have shape (bodies,), their centres, velocities and rates of turn (..., bodies).
    """
    share = mass / mass.sum()
    arm, speed = (one - (share * one).sum(axis=-1, keepdims=True) for one in (place, velocity))
    momentum = (mass * dot(-1j * arm, speed) + inertia * rate).sum(axis=-1)
    double = (mass * dot(speed, speed) + inertia * rate**2).sum(axis=-1)
    whole = (mass * dot(arm, arm) + inertia).sum(axis=-1)
    return momentum, double, whole


def points(vector: Array) -> Complex:
    """Return x-z vectors (..., 2) as numbers x + iz (...)."""
    return np.asarray(vector[..., 0] + 1j * vector[..., 1])


def dot(a: Complex, b: Complex) -> Array:
    """Return the scalar products of vectors x + iz."""
    return np.asarray((a * b.conjugate()).real)
