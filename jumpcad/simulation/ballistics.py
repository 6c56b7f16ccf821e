"""The way of a centre of mass from take-off to the ground: in closed form, or integrated through air (SI units)."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from jumpcad.mechanism.linkage import Complex
from jumpcad.transforms import Array

AIR_KG_M3 = 1.2
"""Density of air at 20 °C and 1013 hPa (ISO 2533 gives 1.225 at 15 °C)."""
TOLERANCE = 1e-9
"""Of the integration: relative, and in m and m/s."""


@dataclass(frozen=True)
class Ballistics:
    """The flight of a centre of mass from its place at release, through take-off, back to the height of release.

    `place_m` gives where it is, x + iz (n,), at times (n,) after take-off, until `deepest_s`, when it is far below the
    ground.
    """

    range_m: float
    rise_m: float
    speed_m_s: float
    angle_deg: float
    place_m: Callable[[Array], Complex] = field(compare=False)
    deepest_s: float


def drag_per_m(drag_area_m2: float, mass_kg: float) -> float:
    """Return the deceleration by air over the square of speed: ½·ρ·c_d·A/m."""
    return 0.5 * AIR_KG_M3 * drag_area_m2 / mass_kg


def drag_m_s2(velocity_m_s: Array, per_m: float) -> Array:
    """Return the acceleration (3,) or (2,) by quadratic drag."""
    return np.asarray(-per_m * float(np.linalg.norm(velocity_m_s)) * velocity_m_s)


def ballistics(
    start_m: Array, takeoff_m: Array, velocity_m_s: Array, gravity_m_s2: float, per_m: float = 0.0, below_m: float = 0.0
) -> Ballistics:
    """Return the ballistic flight of a centre of mass.

    Parameters
    ----------
    start_m, takeoff_m
        Where the centre of mass is at release and at take-off, each (3,).
    velocity_m_s
        Its velocity (3,) at take-off, rising.
    per_m
        Deceleration by air over the square of speed, see `drag_per_m`.
    below_m
        How far below the ground the height is wanted.

    Notes
    -----
    The range runs along x from release to where the centre of mass falls through its height at release; the rise is
    that of the apex above that height. A centre of mass that leaves lower than it started and too slowly does not come
    back to that height: it lands at its apex.
    """
    forward, up = float(velocity_m_s[0]), float(velocity_m_s[2])
    before, lift = float(takeoff_m[0] - start_m[0]), float(takeoff_m[2] - start_m[2])
    height, place = float(takeoff_m[2]), complex(takeoff_m[0], takeoff_m[2])
    speed, angle = float(np.linalg.norm(velocity_m_s)), math.degrees(math.atan2(up, forward))

    def fall_s(drop_m: float) -> float:
        """Return the time without air from take-off until the centre has fallen below it by a drop."""
        return (up + math.sqrt(max(up**2 + 2.0 * gravity_m_s2 * drop_m, 0.0))) / gravity_m_s2

    if per_m == 0.0:
        rise = lift + up**2 / (2 * gravity_m_s2)
        time = (up + math.sqrt(max(2 * gravity_m_s2 * rise, 0.0))) / gravity_m_s2
        return Ballistics(
            before + forward * time, rise, speed, angle,
            lambda at: place + forward * at + 1j * (up * at - 0.5 * gravity_m_s2 * at**2), fall_s(height + below_m),
        )  # fmt: skip
    from scipy.integrate import solve_ivp

    def rates(_time: float, state: Array) -> Array:
        return np.concatenate([state[2:], drag_m_s2(state[2:], per_m) - np.array([0.0, gravity_m_s2])])

    def apex(_time: float, state: Array) -> float:
        return float(state[3])

    def back(_time: float, state: Array) -> float:
        return float(state[1] + lift) if state[3] < 0.0 else 1.0

    def deep(_time: float, state: Array) -> float:
        return float(state[1] + height + below_m)

    deep.terminal, deep.direction = True, -1.0  # type: ignore[attr-defined]
    longest = 4.0 * fall_s(height + below_m) + 4.0  # falling through air takes longer than without
    found = solve_ivp(
        rates, (0.0, longest), [0.0, 0.0, forward, up], rtol=TOLERANCE, atol=TOLERANCE, dense_output=True,
        events=(apex, back, deep),
    )  # fmt: skip
    top = found.sol(found.t_events[0][0]) if len(found.t_events[0]) else np.array([0.0, 0.0])
    down = found.sol(found.t_events[1][0]) if lift + top[1] > 0.0 and len(found.t_events[1]) else top
    return Ballistics(
        before + float(down[0]), lift + float(top[1]), speed, angle,
        lambda at: place + found.sol(at)[0] + 1j * found.sol(at)[1], float(found.t[-1]),
    )  # fmt: skip
