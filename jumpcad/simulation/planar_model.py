"""The planar engine's model of a robot: plain numbers, all read from the robot here, and what its functions pass on.

The plane is x-z. Points and vectors are complex numbers x + iz, so that a turn by an angle about +y (nose down) is a
multiplication by exp(-i·angle). All are plain tuples, which compiled code reads as fast as locals.
"""

import math
from typing import NamedTuple

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, Mechanism
from jumpcad.settings import Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm

Complexes = tuple[complex, complex, complex, complex]
Floats = tuple[float, float, float, float]


class Links(NamedTuple):
    """The mechanism at one leg angle, in the foot's frame; primes are derivatives by the leg's angle.

    `place`, `place1`, `place2` are the bodies' centres of mass seen from the ankle and their derivatives, `turn1` and
    `turn2` those of the bodies' angles; `pin1` the rates of the pins leg, front, ankle and eye; `pitch` is exp(i·angle
    of the foot in the body's frame), `pivots` the two pivots of the body.
    """

    closed: bool
    place: Complexes
    place1: Complexes
    place2: Complexes
    turn1: Floats
    turn2: Floats
    pin1: Floats
    pitch: complex
    back_pivot: complex
    front_pivot: complex


class Inertia(NamedTuple):
    """Mass matrix in closed form: total mass, first moments by foot and leg angle, and the rest about the centre."""

    mass: float
    by_foot: complex
    by_leg: complex
    foot: float
    both: float
    leg: float


class PlanarMotion(NamedTuple):
    """Velocities, or their changes: of the ankle, of the foot's angle, of the leg joint."""

    ankle: complex
    foot: float
    leg: float


class Contact(NamedTuple):
    """Impulses of the ground on two spheres of the sole and along it, and in which mode they were found."""

    first: int
    second: int
    mode: int
    first_ns: float
    second_ns: float
    along_ns: float


class Stance(NamedTuple):
    """Where the foot stands in the middle of a step: ankle, exp(-i·angle) of the foot, and half of the time step."""

    ankle_m: complex
    turn: complex
    half_s: float


class Gains(NamedTuple):
    """Changes of velocity by unit impulses at the ankle along x and z, and of torque on foot and leg joint."""

    x: PlanarMotion
    z: PlanarMotion
    foot: PlanarMotion
    leg: PlanarMotion


class Losses(NamedTuple):
    """Energy lost so far (J): by viscous damping, dry friction of joints and pins, slip, normal impact, the stop."""

    damping_j: float
    friction_j: float
    slip_j: float
    impact_j: float
    stop_j: float


class StepState(NamedTuple):
    """The state between two steps, and what the next step needs from the last."""

    ankle_m: complex
    foot_rad: float
    leg_rad: float
    speed: PlanarMotion
    contact: Contact
    dry_nm: float
    losses: Losses
    belly_gap_m: float
    closed: bool


class PushOff(NamedTuple):
    """How a push-off ended: steps up to the take-off, if it flew, and the moment there or at the end."""

    flown: bool
    steps: int
    moment: StepState
    worst_gain_j: float
    belly_gap_m: float


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
        l1_m=design.l1_mm / 1000.0, l2_m=design.l2_mm / 1000.0, l3_m=design.l3_mm / 1000.0, l4_m=design.l4_mm / 1000.0,
        rest_rad=math.radians(design.rest_angle_deg), total_kg=mechanism.mass_kg,
        mass_kg=tuple(body.mass_kg for body in bodies),
        com_m=tuple(complex(body.com_m[0], body.com_m[2]) for body in bodies),
        inertia_kg_m2=tuple(float(body.inertia_kg_m2[1, 1]) for body in bodies), gravity_m_s2=settings.gravity_m_s2,
        pull_m_s2=complex(0.0, -settings.gravity_m_s2), stiffness_nm_per_rad=spring.stiffness_nm_per_rad,
        preload_rad=spring.preload_rad, one_sided_spring=spring.one_sided,
        damping_nms_per_rad=rubs.joint_damping_nms_per_rad, joint_friction_nm=settings.joint_friction_nm,
        pins_nm=pin_torque_nm(mechanism, rubs.pin) if pins_nm is None else pins_nm,
        stop_rad=float(stop.angle_rad) if stop else math.inf,
        stop_nm_per_rad=float(stop.stiffness_nm_per_rad) if stop else 0.0, friction=rubs.contact(foot.surface),
        sole_m=sole, sole_radius_m=sole_radius, belly_m=belly, belly_radius_m=belly_radius,
    )  # fmt: skip


def _spheres(body: Body) -> tuple[tuple[complex, ...], tuple[float, ...]]:
    """Return centres and radii of a body's contact spheres, each once."""
    spheres: list[tuple[complex, float]] = []
    for contact in body.contacts:
        centre, radius = complex(contact.centre_m[0], contact.centre_m[2]), contact.radius_m
        if all(abs(centre - other) > SAME_M or abs(radius - size) > SAME_M for other, size in spheres):
            spheres.append((centre, radius))
    return tuple(centre for centre, _ in spheres), tuple(radius for _, radius in spheres)
