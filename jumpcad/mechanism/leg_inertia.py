"""Effective inertia of the leg joint while the robot is in the air."""

import cmath

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, Mechanism
from jumpcad.mechanism.planar import about_common_centre, points


def leg_inertia_kg_m2(mechanism: Mechanism, leg_rad: float) -> float:
    """Return the effective inertia of the leg joint of a flying robot, at a joint coordinate (kg·m²).

    Twice the kinetic energy of the links at a leg rate of 1 rad/s with the body held, less that of the common
    translation and rotation: in flight momentum and angular momentum are zero (König's theorem, twice).
    """
    linkage = mechanism.linkage
    l1, l2, rest = linkage.l1 / 1000.0, linkage.l2 / 1000.0, linkage.rest_rad
    pose = linkage.pose([leg_rad])
    foot, front, _ = linkage.rates(leg_rad)
    ankle = -l1 / 2.0 + l2 * cmath.exp(-1j * (rest + leg_rad))
    motions = (  # of each frame, the body held: origin, its velocity, angle, rate
        (0j, 0j, 0.0, 0.0),
        (complex(-l1 / 2.0), 0j, rest + leg_rad, 1.0),
        (complex(l1 / 2.0), 0j, rest + float(pose.front_rad[0]), front),
        (ankle, -1j * (ankle + l1 / 2.0), float(pose.foot_rad[0]), foot),
    )
    bodies = [mechanism.bodies[name] for name in BODY_NAMES]
    origin, speed, angle, rate = (np.array(column) for column in zip(*motions, strict=True))
    arm = points(np.array([body.com_m[[0, 2]] for body in bodies])) * np.exp(-1j * angle)
    mass = np.array([body.mass_kg for body in bodies])
    inertia = np.array([body.inertia_kg_m2[1, 1] for body in bodies])
    momentum, double, whole = about_common_centre(mass, inertia, origin + arm, speed - 1j * rate * arm, rate)
    return double - momentum**2 / whole
