"""What a torque on the leg joint has to turn while the robot is in the air."""

import cmath
import math

from jumpcad.mechanism.model import BODY_NAMES, Mechanism


def leg_inertia_kg_m2(mechanism: Mechanism, leg_rad: float) -> float:
    """Return the inertia of the leg joint of a flying robot, at a coordinate of it.

    Twice the kinetic energy of the links that turn with the leg at 1 rad/s, less what the whole robot takes over by
    moving and turning against them: in flight its momenta are zero (König's theorem, twice).
    """
    linkage = mechanism.linkage
    l1, l2, rest = linkage.l1 / 1000.0, linkage.l2 / 1000.0, linkage.rest_rad
    pose = linkage.pose([leg_rad])
    foot, front, _ = linkage.rates(leg_rad)
    ankle = -l1 / 2.0 + l2 * cmath.exp(-1j * (rest + leg_rad))
    motions = (  # of each frame, with the body held: origin, its velocity, angle, rate
        (0j, 0j, 0.0, 0.0),
        (complex(-l1 / 2.0), 0j, rest + leg_rad, 1.0),
        (complex(l1 / 2.0), 0j, rest + float(pose.front_rad[0]), front),
        (ankle, -1j * (ankle + l1 / 2.0), float(pose.foot_rad[0]), foot),
    )
    points = []
    for name, (origin, speed, angle, rate) in zip(BODY_NAMES, motions, strict=True):
        body = mechanism.bodies[name]
        arm = complex(body.com_m[0], body.com_m[2]) * cmath.exp(-1j * angle)
        points.append((body.mass_kg, origin + arm, speed - 1j * rate * arm, float(body.inertia_kg_m2[1, 1]), rate))
    mass = mechanism.mass_kg
    centre = sum(m * place for m, place, *_ in points) / mass
    drift = sum(m * speed for m, _, speed, *_ in points) / mass
    spin = math.fsum(m * _turning(p - centre, v - drift) + inertia * rate for m, p, v, inertia, rate in points)
    whole = math.fsum(m * abs(p - centre) ** 2 + inertia for m, p, _, inertia, _ in points)
    moving = math.fsum(m * abs(v - drift) ** 2 + inertia * rate**2 for m, _, v, inertia, rate in points)
    return moving - spin**2 / whole


def _turning(arm: complex, vector: complex) -> float:
    """Return the moment about +y of a vector x + iz at the end of an arm."""
    return -(arm.conjugate() * vector).imag
