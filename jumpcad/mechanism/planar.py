"""The bodies of a leg in its plane: where they are seen from the foot, and their momenta about the common centre.

Points in x-z are complex numbers x + iz; angles are below x.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from jumpcad.mechanism.linkage import Complex, Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG, Body
from jumpcad.transforms import Array


def seen_from_foot(
    bodies: Mapping[str, Body], linkage: Linkage, leg_rad: Array, names: Sequence[str] = BODY_NAMES
) -> tuple[Complex, Array]:
    """Return centres of mass (m) and angles of bodies in the foot's frame, (n, bodies) each, at leg angles (n,).

    Raises
    ------
    CannotBuildError
        If the loop does not close at one of the angles.
    """
    pose = linkage.pose(leg_rad)
    ankle = points(pose.ankle_mm) / 1000.0
    still = np.zeros_like(ankle)
    frames = {
        BODY: (still, np.zeros_like(leg_rad)),
        MAIN_LEG: (still + points(linkage.back_pivot_mm) / 1000.0, linkage.rest_rad + pose.leg_rad),
        FRONT_LINK: (still + points(linkage.front_pivot_mm) / 1000.0, linkage.rest_rad + pose.front_rad),
        FOOT: (ankle, pose.foot_rad),
    }
    places, turns = [], []
    for name in names:
        origin, turn = frames[name]
        com = origin + points(bodies[name].com_m[[0, 2]]) * np.exp(-1j * turn)
        places.append((com - ankle) * np.exp(1j * pose.foot_rad))
        turns.append(turn - pose.foot_rad)
    return np.stack(places, axis=-1), np.stack(turns, axis=-1)


def about_common_centre(
    mass: Array, inertia: Array, place: Complex, velocity: Complex, rate: Array
) -> tuple[float, float, float]:
    """Return angular momentum, twice the kinetic energy and inertia of bodies about their common centre of mass.

    The bodies' masses, inertias, centres, their velocities and the bodies' rates of turn have shape (bodies,).
    """
    share = mass / mass.sum()
    arm, speed = place - (share * place).sum(), velocity - (share * velocity).sum()
    momentum = (mass * dot(-1j * arm, speed) + inertia * rate).sum()
    double = (mass * dot(speed, speed) + inertia * rate**2).sum()
    whole = (mass * dot(arm, arm) + inertia).sum()
    return float(momentum), float(double), float(whole)


def points(vector: Array) -> Complex:
    """Return x-z vectors (..., 2) as numbers x + iz (...)."""
    return np.asarray(vector[..., 0] + 1j * vector[..., 1])


def dot(a: Complex, b: Complex) -> Array:
    """Return the scalar products of vectors x + iz."""
    return np.asarray((a * b.conjugate()).real)
