"""The flight from take-off to the first touch of the ground, in closed form: how far the robot turns, how it arrives.

In flight the angular momentum about the common centre of mass is conserved (SI units; angles about +y, so that a turn
forwards is positive). The leg opens until its stop holds it; without a stop its springs let it swing about their rest.
Friction in the pins is left out. Points in x-z are complex numbers x + iz.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.linkage import Complex
from jumpcad.mechanism.model import BODY, BODY_NAMES, MAIN_LEG, Mechanism, Multibody
from jumpcad.mechanism.planar import about_common_centre, flying_inertias, frames, points, seen_from_body
from jumpcad.simulation.mechanics import Ballistics, Mechanics, Points, State, surface
from jumpcad.transforms import Array

SWING_POINTS = 9
"""Leg angles between take-off and stop; with 33, turns of the templates change by less than 0.1°."""
MOMENTS = 200
"""Moments of the flight at which the lowest part's height is looked up, with linear interpolation between them."""
TABLE = 65
"""Leg angles at which the inertias of a leg that swings freely are tabled."""
SLOWEST = 0.05
"""Least share of the leg's rate at take-off that is left before the stop, where friction would let it creep."""


@dataclass(frozen=True)
class Flight:
    """How far a robot flies, and how it turns: forwards is positive.

    `touchdown_distance_m` is the way of the centre of mass from where the robot stood with loaded springs to the first
    touch of the ground by any part, along x; `touchdown_pitch_deg` the body's pitch there against its standing loaded
    pose, from -180 to 180; `turn_deg` its turn from take-off to touchdown, not wrapped; `turn_rate_deg_s` its rate once
    the leg is at its stop, of robots that are no five-bars its mean; `air_time_s` the time between both.
    `clears_bar_mm` is the highest thin bar that it passes, `lands_on_mm` the highest step that it lands on, with their
    distances from its nose where it stands; 0 without.
    """

    touchdown_distance_m: float
    touchdown_pitch_deg: float
    turn_deg: float
    turn_rate_deg_s: float
    air_time_s: float
    clears_bar_mm: float
    bar_distance_mm: float
    lands_on_mm: float
    step_distance_mm: float


def flight(
    mechanism: Mechanism, mechanics: Mechanics, loaded: State, takeoff: State, path: Ballistics, damping_nms: float
) -> Flight:
    """Return the flight that follows from the state at take-off, when the last contact ends, rising.

    The pitch counts against the robot as it stands with its springs loaded. `path` is that of its centre of mass;
    `damping_nms` of each of the four joints, over their rates, stills a leg that swings freely.
    """
    about_y = mechanics.inertia_kg_m2[:, 1, 1]
    velocity, rate = points(takeoff.velocity_m_s[:, [0, 2]]), takeoff.angular_rad_s[:, 1]
    place = points(takeoff.com_m[:, [0, 2]])
    momentum = float(about_common_centre(mechanics.mass_kg, about_y, place, velocity, rate)[0])
    leg_rad_s = float(rate[BODY_NAMES.index(MAIN_LEG)] - rate[BODY_NAMES.index(BODY)])
    started = mechanism, takeoff.leg_rad, leg_rad_s, momentum
    free = mechanism.stop is None and not mechanism.spring.one_sided
    swing = _free_swing(*started, path.deepest_s, damping_nms) if free else _swing(*started, path.deepest_s)
    pitch, time, turn = _pitch_rad(takeoff), swing.time_s, swing.turn_rad
    centre, around = path.place_m(time), surface(mechanism)
    bottoms = centre[:, None] + _arms_m(mechanism, mechanics, around, swing.leg_rad, pitch + turn)
    air = _first_touch_s(time, bottoms.imag.min(axis=1))
    turned = float(np.interp(air, time, turn))
    arrived = math.degrees(pitch + turned - _pitch_rad(loaded))
    stood = complex(*mechanics.centre_of_mass_m(loaded)[[0, 2]])
    standing = _arms_m(mechanism, mechanics, around, np.array([loaded.leg_rad]), np.array([_pitch_rad(loaded)]))
    flown = time <= air
    away_m = float(path.place_m(np.array([air]))[0].real) - stood.real
    return Flight(
        away_m, (arrived + 180.0) % 360.0 - 180.0, math.degrees(turned), math.degrees(swing.rate_rad_s), air,
        *obstacles(bottoms[flown], centre[flown].real, float((stood + standing).real.max())),
    )  # fmt: skip


def seen_flight(
    mechanism: Multibody, mechanics: Mechanics, loaded: State, states: Sequence[State], air_s: float
) -> Flight:
    """Return the flight that a simulation has seen, from states at take-off, on the way and at the touchdown.

    Turn and pitch are those of the heaviest body.
    """
    main = mechanism.order.index(mechanism.main)
    pitch = np.unwrap([_pitch_rad(state, main) for state in states])
    around = [(mechanism.order.index(name), *sphere) for name, sphere in surface(mechanism).items()]

    def bottoms(state: State) -> Complex:
        lowest = []
        for index, at, radius in around:
            arm = np.column_stack([at.real, np.zeros(len(at)), at.imag]) - mechanics.com_in_body_m[index]
            place = state.com_m[index] + arm @ state.rotation[index].T
            lowest.append(points(place[:, [0, 2]]) - 1j * radius)
        return np.concatenate(lowest)

    centre = np.array([mechanics.centre_of_mass_m(state)[0] for state in states])
    turned, arrived = float(pitch[-1] - pitch[0]), math.degrees(pitch[-1] - _pitch_rad(loaded, main))
    return Flight(
        float(centre[-1] - mechanics.centre_of_mass_m(loaded)[0]), (arrived + 180.0) % 360.0 - 180.0,
        math.degrees(turned), math.degrees(turned) / air_s, air_s,
        *obstacles(np.stack([bottoms(state) for state in states]), centre, float(bottoms(loaded).real.max())),
    )  # fmt: skip


def obstacles(bottoms_m: Complex, centre_m: Array, nose_m: float) -> tuple[float, float, float, float]:
    """Return the last four figures of a `Flight`: what it passes over and lands on.

    Lowest points of the robot's parts, x + iz (n, parts), and the centre of mass along the way (n,) are given at n
    moments up to the touchdown; the standing robot ends at `nose_m` in front: no obstacle is nearer. All parts have
    passed a bar by the touchdown. The edge of a step lies below whatever passes it while the robot rises, and before
    the centre of mass when the robot, falling, comes down to its height.
    """
    if len(bottoms_m) < 2 or not np.ptp(bottoms_m.real, axis=0).any():  # straight up: over nothing
        return 0.0, 0.0, 0.0, 0.0
    lowest, width = bottoms_m.imag.min(axis=1), 1.5 * float(np.abs(np.diff(bottoms_m.real, axis=0)).max())
    apex, first = int(np.argmax(lowest)), float(bottoms_m.real.min())
    bins = ((bottoms_m.real - first) / width).astype(int)
    whole, rising = (np.full(bins.max() + 1, np.inf) for _ in range(2))
    np.minimum.at(whole, bins, bottoms_m.imag)
    np.minimum.at(rising, bins[: apex + 1], bottoms_m.imag[: apex + 1])
    place = first + width * (np.arange(len(whole)) + 0.5)
    passed = (place > nose_m) & (place < bottoms_m[-1].real.min()) & np.isfinite(whole)
    bar = int(np.argmax(np.where(passed, whole, -np.inf)))
    bar_m = float(whole[bar]) if passed[bar] else 0.0
    over = np.where(place > nose_m, rising, -np.inf)
    edges = np.maximum.accumulate(over)  # the best edge up to a place
    before = np.clip(np.searchsorted(place, centre_m[apex:]) - 1, 0, len(place) - 1)
    heights = np.minimum(lowest[apex:], edges[before])
    best = int(np.argmax(heights))
    step_m, edge = float(heights[best]), float(place[int(np.argmax(over[: before[best] + 1]))])
    found = [(bar_m, float(place[bar])), (step_m, edge)]
    figures = [(1000.0 * high, 1000.0 * (at - nose_m)) if high > 0.0 else (0.0, 0.0) for high, at in found]
    return *figures[0], *figures[1]


@dataclass(frozen=True)
class _Swing:
    """Moments of the flight (n,), the leg's angle at them (n,) or all (1,), the body's turn, and its mean rate."""

    time_s: Array
    leg_rad: Array
    turn_rad: Array
    rate_rad_s: float


def _free_swing(
    mechanism: Mechanism, leg_rad: float, leg_rad_s: float, momentum: float, until_s: float, damping_nms: float
) -> _Swing:
    """Return how a leg without a stop swings on its springs, by leapfrog steps.

    With m = M - K²/J of `_swing`: m·q'' = torque - damping·q' - m'·q'²/2 - H²·(1/J)'/2, by q what has a mark.
    """
    spring, linkage, rest_rad = mechanism.spring, mechanism.linkage, mechanism.spring.preload_rad
    angles = np.linspace(-spring.wind_rad, min(spring.wind_rad + 2.0 * rest_rad, linkage.open_rad), TABLE)
    coupling, leg, whole = flying_inertias(mechanism, angles)
    free, (foot, front), step = leg - coupling**2 / whole, linkage.turning(angles), angles[1] - angles[0]
    torque = spring.stiffness_nm_per_rad * (rest_rad - angles) - np.gradient(0.5 * momentum**2 / whole, step)
    decay = damping_nms * (1.0 + front**2 + (foot - 1.0) ** 2 + (front - foot) ** 2) / free
    table = np.stack([torque / free, decay, 0.5 * np.gradient(free, step) / free])
    waves = until_s * math.sqrt(spring.stiffness_nm_per_rad / float(free.min()))
    time = np.linspace(0.0, until_s, max(MOMENTS, math.ceil(2.0 * waves)))
    found, rate, gone = [leg_rad], leg_rad_s, 0.5 * time[1]
    for _ in time[1:]:
        push, slow, curve = (np.interp(found[-1], angles, column) for column in table)
        rate += gone * (push - slow * rate - curve * rate**2)
        swung = found[-1] + time[1] * rate
        found.append(min(max(swung, angles[0]), angles[-1]))
        rate, gone = rate if found[-1] == swung else 0.0, time[1]  # foot and front link in line hold it
    swung = np.array(found)
    turned = momentum * time[1] * _sums(np.interp(swung, angles, 1.0 / whole))
    by_leg = np.interp(swung, angles, step * _sums(coupling / whole))
    mean = momentum / float(np.interp(rest_rad, angles, whole))
    return _Swing(time, swung, turned - by_leg + by_leg[0], mean)


def _swing(mechanism: Mechanism, leg_rad: float, leg_rad_s: float, momentum: float, until_s: float) -> _Swing:
    """Return the flight from when the leg has come to rest beside the body, until a time or that moment.

    With the body's rate w and the leg's q', H = J·w + K·q' and 2·T = J·w² + 2·K·w·q' + M·q'², so that
    (M - K²/J)·q'² + H²/J + 2·V is constant. The body turns by the integral of (H - K·q')/J.
    """
    spring, stop = mechanism.spring, mechanism.stop
    end_rad = max(stop.angle_rad, leg_rad) if stop else spring.preload_rad
    angles = np.linspace(leg_rad, end_rad, SWING_POINTS)
    coupling, leg, whole = flying_inertias(mechanism, angles)
    free = leg - coupling**2 / whole
    stored = np.array([spring.stored_j(angle) for angle in angles.tolist()])
    square = free[0] * leg_rad_s**2 + momentum**2 * (1.0 / whole[0] - 1.0 / whole) + 2.0 * (stored[0] - stored)
    speed = np.sqrt(np.maximum(square, (SLOWEST * leg_rad_s) ** 2 * free) / free)
    step = (end_rad - leg_rad) / (SWING_POINTS - 1)
    time = 0.0
    if step != 0.0 and speed.min() > 0.0:
        time = abs(step * float(_sums(1.0 / speed)[-1]))
    turn = -step * float(_sums(coupling / whole)[-1]) + time * momentum * float(np.mean(1.0 / whole))
    if stop:  # the pad gives way until the leg stands still, a quarter of its swing, and does not throw it back
        quarter = math.sqrt(float(free[-1]) / stop.stiffness_nm_per_rad)
        give, give_s = float(speed[-1]) * quarter, 0.5 * math.pi * quarter
        turn += (momentum * give_s - float(coupling[-1]) * give) / float(whole[-1])
        time, end_rad = time + give_s, end_rad + give
        *_, whole = flying_inertias(mechanism, np.array([end_rad]))
    moments, rate = np.linspace(time, max(until_s, time), MOMENTS), momentum / float(whole[-1])
    return _Swing(moments, np.array([end_rad]), turn + rate * (moments - time), rate)


def _arms_m(mechanism: Mechanism, mechanics: Mechanics, around: Points, leg_rad: Array, pitch_rad: Array) -> Complex:
    """Return the lowest points, x + iz from the common centre (n, k), at leg angles (n,) or (1,) and pitches (n,)."""
    placed, (com, _) = frames(mechanism.linkage, leg_rad), seen_from_body(mechanism.bodies, mechanism.linkage, leg_rad)
    centre = com @ mechanics.mass_kg / mechanics.total_mass_kg
    arms = [placed[name][0][:, None] + at * np.exp(-1j * placed[name][1])[:, None] for name, (at, _) in around.items()]
    radii = np.concatenate([radius for _, radius in around.values()])
    return np.asarray((np.concatenate(arms, axis=1) - centre[:, None]) * np.exp(-1j * pitch_rad)[:, None] - 1j * radii)


def _first_touch_s(time_s: Array, clearance_m: Array) -> float:
    """Return when the clearance (n,) has been above 0 and is no more."""
    first = int(np.argmax(clearance_m > 0.0))
    low = first + int(np.argmax(clearance_m[first:] <= 0.0))
    if low == first:
        return float(time_s[first])
    share = clearance_m[low - 1] / (clearance_m[low - 1] - clearance_m[low])
    return float(time_s[low - 1] + share * (time_s[low] - time_s[low - 1]))


def _pitch_rad(state: State, body: int = BODY_NAMES.index(BODY)) -> float:
    """Return a body's angle about +y."""
    turn = state.rotation[body]
    return math.atan2(turn[0, 2], turn[0, 0])


def _sums(values: Array) -> Array:
    """Return the integral of values (n,) at steps of 1 up to each of them, by trapezia."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]))])
