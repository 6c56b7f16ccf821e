"""The leg from release to its rest stop, and its impact there (numpy only; kg, m, s, rad, J).

The foot stands flat, or rolls on its toes' tips or its nose without slipping, and takes off when the ground force
becomes zero. In flight momentum and angular momentum of the links are conserved. There is no friction and no damping,
so that the impact is not underestimated. Points in x-z are complex numbers x + iz; angles are below x.
"""

import cmath
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.mechanism.linkage import Complex, Linkage
from jumpcad.mechanism.model import BODY_NAMES, FOOT, Body, ContactSphere, Spring
from jumpcad.mechanism.planar import about_common_centre, seen_from_foot
from jumpcad.transforms import Array

POSITIONS = 241
"""Leg angles at which the bodies' positions are computed; linear interpolation between them."""
STEP_S = 1e-3
"""Time step of the push-off; with half of it, impact energies of the template designs change by 0.5 % at most."""
GIVEN_UP_S = 0.4
"""A robot that stands on the ground this long after release does not jump."""


@dataclass(frozen=True)
class Blow:
    """The leg's impact on its stop: leg angle at take-off, leg rate at the stop, effective inertia there.

    `inertia_kg_m2` is the effective inertia about the leg's joint in free flight: ½·I·ω² is the energy that is lost
    when the leg stops relative to the body.
    """

    takeoff_rad: float
    stop_rad_s: float
    inertia_kg_m2: float

    @property
    def energy_j(self) -> float:
        """Energy of the impact (J)."""
        return 0.5 * self.inertia_kg_m2 * self.stop_rad_s**2


def leg_blow(bodies: Mapping[str, Body], linkage: Linkage, spring: Spring, stop_rad: float) -> Blow:
    """Return the impact of the leg on a stop past rest, after a push-off from loaded springs.

    In flight ½·I·q̇² + ½·H²/J + V is constant, with the angular momentum H and the inertia J of all about their centre,
    and the springs' energy V. Springs that do not raise the robot bring no leg to its stop: the impact is 0.
    """
    chain = _Chain(bodies, linkage, spring, stop_rad)
    state = _push_off(chain, bodies[FOOT].contacts)
    inertia, whole = chain.in_flight(stop_rad)
    if state is None:
        return Blow(float(chain.leg[0]), 0.0, inertia)
    momentum, energy = chain.about_common(state)
    left = energy + spring.stored_j(state.leg_rad) - spring.stored_j(stop_rad) - 0.5 * momentum**2 / whole
    return Blow(state.leg_rad, (2.0 * max(left, 0.0) / inertia) ** 0.5, inertia)


class _State(NamedTuple):
    """Leg angle and foot's angle with their rates, and the end of the foot that stays on the ground."""

    leg_rad: float
    foot_rad: float
    leg_rad_s: float
    foot_rad_s: float
    pivot: ContactSphere


class _Equations(NamedTuple):
    """Inertia of leg and foot, the torques on them, and the ground's force: by each acceleration, and without them."""

    leg: float
    mixed: float
    foot: float
    leg_nm: float
    foot_nm: float
    up_by_leg: float
    up_by_foot: float
    up: float


class _Chain:
    """The bodies' centres and angles by leg angle, in the foot's frame."""

    def __init__(self, bodies: Mapping[str, Body], linkage: Linkage, spring: Spring, stop_rad: float) -> None:
        self.spring = spring
        self.mass = np.array([bodies[name].mass_kg for name in BODY_NAMES])
        self.inertia = np.array([bodies[name].inertia_kg_m2[1, 1] for name in BODY_NAMES])
        self.leg = np.linspace(linkage.travel_rad[0], stop_rad, POSITIONS)
        self._first, self._step = float(self.leg[0]), float(self.leg[1] - self.leg[0])
        self.place, turns = seen_from_foot(bodies, linkage, self.leg)
        self.place1, self.place2 = self._rates(self.place)
        self.turn1, self.turn2 = self._rates(turns)
        self._table = np.stack([self.place, self.place1, self.place2, self.turn1, self.turn2], axis=1)
        self._rows = self._table.transpose(0, 2, 1).tolist()
        self._bodies = list(zip(self.mass.tolist(), self.inertia.tolist(), strict=True))

    def _rates(self, values: Complex | Array) -> tuple[Complex, Complex]:
        first = np.asarray(np.gradient(values, self.leg, axis=0, edge_order=2))
        return first, np.asarray(np.gradient(first, self.leg, axis=0, edge_order=2))

    def at(self, leg_rad: float) -> Complex:
        """Return place, its two rates, and the two rates of the turn, (5, 4), at a leg angle."""
        low, share = self._between(leg_rad)
        return np.asarray((1.0 - share) * self._table[low] + share * self._table[low + 1])

    def _between(self, leg_rad: float) -> tuple[int, float]:
        """Return the number of the position below a leg angle, and the share of the way to the next."""
        steps = (leg_rad - self._first) / self._step
        low = min(max(int(steps), 0), POSITIONS - 2)
        return low, steps - low

    def equations(self, state: _State) -> _Equations:
        """Return the equations of motion for leg and foot; numbers, which is quicker than arrays for four bodies."""
        spin = cmath.exp(-1j * state.foot_rad)
        pivot = complex(state.pivot.centre_m[0], state.pivot.centre_m[2])
        leg, foot, radius = state.leg_rad_s, state.foot_rad_s, float(state.pivot.radius_m)
        low, share = self._between(state.leg_rad)
        before = 1.0 - share
        by_leg_leg = by_leg_foot = by_foot_foot = leg_nm = foot_nm = up_by_leg = up_by_foot = up = 0.0
        for (mass, inertia), one, other in zip(self._bodies, self._rows[low], self._rows[low + 1], strict=True):
            place = before * one[0] + share * other[0]
            place1 = before * one[1] + share * other[1]
            place2 = before * one[2] + share * other[2]
            turn, bend = before * one[3].real + share * other[3].real, before * one[4].real + share * other[4].real
            arm = (place - pivot) * spin
            by_leg, by_foot = place1 * spin, radius - 1j * arm
            rest = (place2 * leg**2 - 2j * place1 * leg * foot) * spin - arm * foot**2
            pull = -1j * GRAVITY_M_S2 - rest
            swing = inertia * bend * leg**2
            leg_x, leg_z, foot_x, foot_z = by_leg.real, by_leg.imag, by_foot.real, by_foot.imag
            by_leg_leg += mass * (leg_x**2 + leg_z**2) + inertia * turn**2
            by_leg_foot += mass * (leg_x * foot_x + leg_z * foot_z) + inertia * turn
            by_foot_foot += mass * (foot_x**2 + foot_z**2) + inertia
            leg_nm += mass * (leg_x * pull.real + leg_z * pull.imag) - swing * turn
            foot_nm += mass * (foot_x * pull.real + foot_z * pull.imag) - swing
            up_by_leg += mass * leg_z
            up_by_foot += mass * foot_z
            up += mass * (rest.imag + GRAVITY_M_S2)
        leg_nm += float(self.spring.torque_nm(state.leg_rad))
        return _Equations(by_leg_leg, by_leg_foot, by_foot_foot, leg_nm, foot_nm, up_by_leg, up_by_foot, up)

    def about_common(self, state: _State) -> tuple[float, float]:
        """Return angular momentum and kinetic energy of all bodies about their common centre."""
        place, place1, _, turn1, _ = self.at(state.leg_rad)
        velocity = place1 * state.leg_rad_s - 1j * place * state.foot_rad_s
        rate = turn1.real * state.leg_rad_s + state.foot_rad_s
        momentum, double, _ = about_common_centre(self.mass, self.inertia, place, velocity, rate)
        return float(momentum), float(0.5 * double)

    def in_flight(self, leg_rad: float) -> tuple[float, float]:
        """Return the effective inertia of the leg in free flight, and that of all bodies about their common centre."""
        place, place1, _, turn1, _ = self.at(leg_rad)
        momentum, double, whole = about_common_centre(self.mass, self.inertia, place, place1, turn1.real)
        return float(double - momentum**2 / whole), float(whole)


def _push_off(chain: _Chain, contacts: tuple[ContactSphere, ...]) -> _State | None:
    """Return the state at take-off, or at the end of the leg's travel where the robot does not leave the ground.

    None if neither comes, since the weight presses the leg back or holds it.
    """
    nose, toe = (max(contacts, key=lambda sphere: sign * sphere.centre_m[0]) for sign in (1.0, -1.0))
    state, flat = _State(float(chain.leg[0]), 0.0, 0.0, 0.0, toe), True
    for _ in range(round(GIVEN_UP_S / STEP_S)):
        if flat:
            state, flat, found = _on_the_sole(chain, state, nose)
        else:
            found = chain.equations(state)
        rates, up = _accelerations(found, flat)
        if up <= 0.0 or state.leg_rad >= chain.leg[-1]:
            return state
        if state.leg_rad < chain.leg[0]:
            break
        half = _moved(state, rates, 0.5 * STEP_S, state)
        rates, _ = _accelerations(chain.equations(half), flat)
        state = _moved(state, rates, STEP_S, half)
        lifted = state.foot_rad if state.pivot is nose else -state.foot_rad
        if not flat and lifted < 0.0:  # the foot comes down flat, its other end without rebound
            found = chain.equations(state)
            leg = state.leg_rad_s + found.mixed / found.leg * state.foot_rad_s
            state, flat = _State(state.leg_rad, 0.0, leg, 0.0, toe), True
    return None


def _on_the_sole(chain: _Chain, state: _State, nose: ContactSphere) -> tuple[_State, bool, _Equations]:
    """Return the state of a foot that stands on its toes' tips and nose, with the end on which it stays.

    And whether the other end stays too, and the equations of that state.
    """
    on_toe = chain.equations(state)
    if on_toe.mixed * on_toe.leg_nm / on_toe.leg - on_toe.foot_nm > 0.0:  # the nose would need tension
        return state, False, on_toe
    tried = state._replace(pivot=nose)
    on_nose = chain.equations(tried)
    if on_nose.mixed * on_nose.leg_nm / on_nose.leg - on_nose.foot_nm < 0.0:  # the toes' tips would need tension
        return tried, False, on_nose
    return state, True, on_toe


def _accelerations(found: _Equations, flat: bool) -> tuple[tuple[float, float], float]:
    """Return leg's and foot's acceleration, and the ground's normal force."""
    if flat:
        leg, foot = found.leg_nm / found.leg, 0.0
    else:
        size = found.leg * found.foot - found.mixed**2
        leg = (found.foot * found.leg_nm - found.mixed * found.foot_nm) / size
        foot = (found.leg * found.foot_nm - found.mixed * found.leg_nm) / size
    return (leg, foot), found.up_by_leg * leg + found.up_by_foot * foot + found.up


def _moved(start: _State, rates: tuple[float, float], time_s: float, at: _State) -> _State:
    """Return the state a time later, with the rates and accelerations of another moment."""
    return _State(
        start.leg_rad + time_s * at.leg_rad_s, start.foot_rad + time_s * at.foot_rad_s,
        start.leg_rad_s + time_s * rates[0], start.foot_rad_s + time_s * rates[1], start.pivot,
    )  # fmt: skip
