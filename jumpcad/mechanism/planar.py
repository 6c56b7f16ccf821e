"""The bodies of a leg in its plane: places, momenta about the common centre, and their mass reflected to its joint.

Points in x-z are complex numbers x + iz; angles are below x.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.mechanism.linkage import Complex, Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG, Body, Mechanism, Spring
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
    return momentum, double, (mass * dot(arm, arm) + inertia).sum(axis=-1)


def points(vector: Array) -> Complex:
    """Return x-z vectors (..., 2) as numbers x + iz (...)."""
    return np.asarray(vector[..., 0] + 1j * vector[..., 1])


def dot(a: Complex, b: Complex) -> Array:
    """Return the scalar products of vectors x + iz."""
    return np.asarray((a * b.conjugate()).real)


POSITIONS = 33
"""Leg angles of the table; with four times as many, the templates' inertia changes by less than 0.4 %, the time of
their push-off and the kick of their release by less than 0.1 %."""

WEAKEST = 0.2
"""Least share of the springs' energy that becomes kinetic; a leg too weak for its body is rejected elsewhere."""


@dataclass(frozen=True)
class ReflectedMass:
    """Reflected mass and weight at evenly spaced wind angles (n,) that grow from rest to the loaded springs.

    Half of the reflected inertia I (n,) times the wind rate squared is the kinetic energy; `inertia_slope` is its slope
    by the wind angle, `weight_nm` that of the potential energy of weight: negative where the body sinks.
    """

    wind_rad: Array
    inertia_kg_m2: Array
    inertia_slope: Array
    weight_nm: Array

    def at(self, wind_rad: Array) -> tuple[Array, Array, Array]:
        """Return I, its slope and the weight's torque (n,) at wind angles (n,); constant beyond the table."""
        columns = (self.inertia_kg_m2, self.inertia_slope, self.weight_nm)
        inertia, slope, weight = (np.interp(wind_rad, self.wind_rad, column) for column in columns)
        return inertia, slope, weight

    def push_off_s(self, spring: Spring, past_rad: float) -> float:
        """Return the time from rest with loaded springs until the leg is an angle past rest, foot on the ground.

        From the energy, dt = dw/sqrt(2·(E(w0) - E(w))/I); with w = w0·cos(s) the integrand is finite.
        """
        loaded = spring.wind_rad
        phase = (np.arange(POSITIONS) + 0.5) * (math.pi / 2.0 / POSITIONS)
        wind = loaded * np.cos(phase)
        inertia, _, _ = self.at(wind)
        weight = np.interp(wind, self.wind_rad, self._weight_j())
        stored = 0.5 * spring.stiffness_nm_per_rad * (wind + 2.0 * spring.preload_rad) * wind
        free = spring.energy_j + self._weight_j()[-1] - stored - weight
        free = np.maximum(free, WEAKEST * spring.energy_j * np.sin(phase) ** 2)
        rate = np.sqrt(2.0 * free / inertia)
        to_rest = float(np.sum(loaded * np.sin(phase) / rate)) * math.pi / 2.0 / POSITIONS
        return to_rest + past_rad / float(rate[-1])

    def _weight_j(self) -> Array:
        """Return the potential energy of weight (n,), 0 at rest."""
        step = self.wind_rad[1] - self.wind_rad[0]
        mean = 0.5 * step * (self.weight_nm[1:] + self.weight_nm[:-1])
        return np.concatenate([[0.0], np.add.accumulate(mean)])


def reflected_mass(bodies: Mapping[str, Body], linkage: Linkage) -> ReflectedMass:
    """Return mass and weight of body, main leg and front link reflected to the leg joint; the foot stands still.

    I = sum of m·|dc/dw|² + I_y·(dt/dw)² over the bodies, c and t their centres of mass and turns seen from the foot
    (e.g. Norton, Design of Machinery, 10.12: equivalent inertia from equal kinetic energy).
    """
    leg = np.linspace(*linkage.travel_rad, POSITIONS)
    names = (BODY, MAIN_LEG, FRONT_LINK)
    place, turn = seen_from_foot(bodies, linkage, leg, names)
    mass = np.array([bodies[name].mass_kg for name in names])
    about_y = np.array([bodies[name].inertia_kg_m2[1, 1] for name in names])

    def by_wind(values: Array) -> Array:
        return -np.gradient(values, leg, axis=0, edge_order=2)

    x, z, turned = np.moveaxis(by_wind(np.stack([place.real, place.imag, turn], axis=1)), 1, 0)
    inertia = (mass * (x**2 + z**2) + about_y * turned**2).sum(axis=1)
    slopes = by_wind(np.column_stack([inertia, (mass * place.imag).sum(axis=1)]))
    columns = (-leg, inertia, slopes[:, 0], GRAVITY_M_S2 * slopes[:, 1])
    return ReflectedMass(*(column[::-1].copy() for column in columns))


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
