"""Inertia of a robot in the air: of all its bodies about their common centre, and of its leg joint."""

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, FOOT, Mechanism
from jumpcad.mechanism.planar import about_common_centre, frames, points
from jumpcad.transforms import Array


def flying_inertias(mechanism: Mechanism, leg_rad: Array) -> tuple[Array, Array, Array]:
    """Return K, M and J (n,) of a robot in the air at coordinates (n,) of the leg joint (kg·m²).

    With the rates w of the body and q' of the leg, about the common centre of mass, the angular momentum is J·w + K·q'
    and twice the kinetic energy J·w² + 2·K·w·q' + M·q'².
    """
    linkage, still = mechanism.linkage, np.zeros_like(leg_rad)
    placed = frames(linkage, leg_rad)
    foot, front = linkage.turning(leg_rad)
    rate = np.stack([still, still + 1.0, front, foot], axis=-1)
    origin, angle = (np.stack([placed[name][part] for name in BODY_NAMES], axis=-1) for part in (0, 1))
    speed = np.zeros_like(origin)
    speed[:, BODY_NAMES.index(FOOT)] = -1j * (placed[FOOT][0] + linkage.l1 / 2000.0)
    bodies = [mechanism.bodies[name] for name in BODY_NAMES]
    arm = points(np.array([body.com_m[[0, 2]] for body in bodies])) * np.exp(-1j * angle)
    mass = np.array([body.mass_kg for body in bodies])
    about_y = np.array([body.inertia_kg_m2[1, 1] for body in bodies])
    return about_common_centre(mass, about_y, origin + arm, speed - 1j * rate * arm, rate)


def leg_inertia_kg_m2(mechanism: Mechanism, leg_rad: float) -> float:
    """Return the effective inertia of the leg joint of a flying robot, at a joint coordinate (kg·m²).

    Twice the kinetic energy of the links at a leg rate of 1 rad/s with the body held, less that of the common
    translation and rotation: in flight momentum and angular momentum are zero (König's theorem, twice).
    """
    coupling, leg, whole = flying_inertias(mechanism, np.array([leg_rad]))
    return float((leg - coupling**2 / whole)[0])
