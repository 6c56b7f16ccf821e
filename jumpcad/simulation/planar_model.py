"""The planar engine's model of a robot: plain numbers, all read from the robot here.

The plane is x-z. Points and vectors are complex numbers x + iz, so that a turn by an angle about +y (nose down) is a
multiplication by exp(-i·angle).
"""

import math
from typing import NamedTuple

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, Mechanism
from jumpcad.settings import Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm

SAME_M = 1e-9
"""Contact spheres that differ by less than this in the plane are one: left and right toe."""


class PlanarModel(NamedTuple):
    """A robot in the plane, SI units; tuples of four follow `BODY_NAMES`.

    `com_m` are the centres of mass in the bodies' frames, `pull_m_s2` is gravity as x + iz, with the air's braking;
    `sole_m` and `belly_m` are the centres of the spheres of foot and body that may touch the ground, with their radii.
    Without a stop its angle is infinite.
    """

    l1_m: float
    l2_m: float
    l3_m: float
    l4_m: float
    rest_rad: float
    total_kg: float
    mass_kg: tuple[float, ...]
    com_m: tuple[complex, ...]
    inertia_kg_m2: tuple[float, ...]
    gravity_m_s2: float
    pull_m_s2: complex
    stiffness_nm_per_rad: float
    preload_rad: float
    one_sided_spring: bool
    damping_nms_per_rad: float
    joint_friction_nm: float
    pins_nm: float
    stop_rad: float
    stop_nm_per_rad: float
    friction: float
    sole_m: tuple[complex, ...]
    sole_radius_m: tuple[float, ...]
    belly_m: tuple[complex, ...]
    belly_radius_m: tuple[float, ...]


def planar_model(mechanism: Mechanism, settings: Settings, pins_nm: float | None = None) -> PlanarModel:
    """Return a robot's mechanism in the plane, left and right sides coinciding.

    Dry friction of the pins is the constant torque at the leg joint that the other engines have, or the given one.
    Every number is a float or a complex: a tuple with integers would be another type, compiled anew.
    """
    design, spring, stop = mechanism.design, mechanism.spring, mechanism.stop
    rubs = coefficients(mechanism, settings)
    bodies = [mechanism.bodies[name] for name in BODY_NAMES]
    foot, body = mechanism.bodies[FOOT], mechanism.bodies[BODY]
    sole, sole_radius = _spheres(foot)
    belly, belly_radius = _spheres(body)
    return PlanarModel(
        l1_m=design.l1_mm / 1000.0,
        l2_m=design.l2_mm / 1000.0,
        l3_m=design.l3_mm / 1000.0,
        l4_m=design.l4_mm / 1000.0,
        rest_rad=math.radians(design.rest_angle_deg),
        total_kg=mechanism.mass_kg,
        mass_kg=tuple(body.mass_kg for body in bodies),
        com_m=tuple(complex(body.com_m[0], body.com_m[2]) for body in bodies),
        inertia_kg_m2=tuple(float(body.inertia_kg_m2[1, 1]) for body in bodies),
        gravity_m_s2=settings.gravity_m_s2,
        pull_m_s2=complex(0.0, -settings.gravity_m_s2),
        stiffness_nm_per_rad=spring.stiffness_nm_per_rad,
        preload_rad=spring.preload_rad,
        one_sided_spring=spring.one_sided,
        damping_nms_per_rad=rubs.joint_damping_nms_per_rad,
        joint_friction_nm=settings.joint_friction_nm,
        pins_nm=pin_torque_nm(mechanism, rubs.pin) if pins_nm is None else pins_nm,
        stop_rad=float(stop.angle_rad) if stop else math.inf,
        stop_nm_per_rad=float(stop.stiffness_nm_per_rad) if stop else 0.0,
        friction=rubs.contact(foot.surface),
        sole_m=sole,
        sole_radius_m=sole_radius,
        belly_m=belly,
        belly_radius_m=belly_radius,
    )


def _spheres(body: Body) -> tuple[tuple[complex, ...], tuple[float, ...]]:
    """Return centres and radii of a body's contact spheres, each once."""
    spheres: list[tuple[complex, float]] = []
    for contact in body.contacts:
        centre, radius = complex(contact.centre_m[0], contact.centre_m[2]), contact.radius_m
        if all(abs(centre - other) > SAME_M or abs(radius - size) > SAME_M for other, size in spheres):
            spheres.append((centre, radius))
    return tuple(centre for centre, _ in spheres), tuple(radius for _, radius in spheres)
