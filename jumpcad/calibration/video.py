"""Take-off speed and angle from the points of a flight in a video: t in s, x and z in m."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

GRAVITY_SHARE = 0.15
"""Relative difference of the fitted gravity from the earth's that is never called a mistake."""
CONFIDENCE = 0.99865
"""Probability below three standard errors; taken by Student's t, since few points tell little of their noise."""
SPEED_SHARES = 0.3, 1.5
"""Least and most of the take-off speed over that with all of the springs' energy; judgement."""
UNITS = {"m": 1.0, "cm": 100.0, "mm": 1000.0, "inches": 1.0 / 0.0254}
"""Units in which x and z may be by mistake: how many are a metre."""
FLIGHT = "keep only the points between take-off and touchdown, and check the scale"


@dataclass(frozen=True)
class TakeoffSeen:
    """Velocity at the first point: speed (m/s) and angle (°), each with its standard error from the fit."""

    speed_m_s: float
    angle_deg: float
    speed_error_m_s: float
    angle_error_deg: float


def seen_takeoff(points: Array, source: str, fastest_m_s: float, slow_motion: float = 1.0) -> TakeoffSeen:
    """Fit a ballistic flight to points (n > 3, 3) of t (s), x and z (m), and check its gravity and its speed.

    Gravity alone cannot tell lengths in cm with a clock 10 times too slow from a flight that is right: the speed does,
    by `fastest_m_s`, that with all of the springs' energy. `slow_motion` divides t.
    """
    t, x, z = (points - points[0]).T
    t = t / slow_motion
    fall = np.column_stack([np.ones_like(t), t, -0.5 * t * t])
    line, straight = fall[:, :2], np.column_stack([x, z + 0.5 * GRAVITY_M_S2 * t * t])
    _, rising, gravity = np.linalg.lstsq(fall, z, rcond=None)[0]
    forward, up = np.linalg.lstsq(line, straight, rcond=None)[0][1]
    bend = np.linalg.norm(_residual(line, fall[:, 2]))  # of which the gravity is the slope
    doubt = stdtrit(len(t) - 3, CONFIDENCE) * np.linalg.norm(_residual(fall, z)) / math.sqrt(len(t) - 3) / bend
    seen = math.hypot(forward, rising)
    ways = _explanations(gravity, doubt, seen / fastest_m_s)
    if ("m", 1.0) not in ways:
        raise JumpcadError(
            f"{source}: its points fall with {gravity:.3g} m/s² instead of {GRAVITY_M_S2:g} and start with {seen:.3g} "
            f"m/s, where the springs give up to {fastest_m_s:.3g}: "
            + ("z points down: change its sign" if max(gravity, rising) < 0.0 else _ways_out(ways, slow_motion))
        )
    if forward <= 0.0 or up <= 0.0:
        raise JumpcadError(f"{source}: flies with ({forward:.3g}, {up:.3g}) m/s: x must point forwards and z upwards")
    speed = math.hypot(forward, up)
    deviation = float(np.linalg.norm(_residual(line, straight))) / math.sqrt(2 * len(t) - 4)
    error = deviation / math.sqrt(float(np.sum((t - t.mean()) ** 2)))
    return TakeoffSeen(speed, math.degrees(math.atan2(up, forward)), error, math.degrees(error / speed))


def _explanations(gravity: float, error: float, share: float) -> list[tuple[str, float]]:
    """Return units of x and z, each with how many times too slow the clock is, that make the flight the robot's.

    Clocks divide gravity (here with its error, m/s²) by their square, speed (here over the fastest) once.
    """
    found = []
    for unit, scale in UNITS.items():
        right = abs(gravity / scale - GRAVITY_M_S2) <= max(GRAVITY_SHARE * GRAVITY_M_S2, error / scale)
        slow = 1.0 if right else math.sqrt(GRAVITY_M_S2 * scale / gravity) if gravity > 0.0 else math.inf
        if SPEED_SHARES[0] <= share * slow / scale <= SPEED_SHARES[1]:
            found.append((unit, slow))
    return [one for one in found if one[1] == 1.0] or found  # a right clock is likelier than any other


def _ways_out(ways: list[tuple[str, float]], slow_motion: float) -> str:
    """Return what is probably wrong and what to do, from `_explanations`."""
    said = []
    for unit, slow in ways:
        wrong = [] if unit == "m" else [f"x and z are in {unit}: divide them by {UNITS[unit]:.4g}"]
        if slow != 1.0:
            clock = f"{slow:.4g} times too slow" if slow > 1.0 else f"{1.0 / slow:.4g} times too fast"
            wrong.append(f"the clock is {clock}: say slow_motion = {slow * slow_motion:.4g} in [[videos]]")
        said.append(", and ".join(wrong))
    if any(slow == 1.0 for _, slow in ways):
        return "; or ".join(said)
    rates = ", the camera's frames a second over the video's; or "
    return "; or ".join(said) + rates + FLIGHT if said else FLIGHT


def _residual(matrix: Array, values: Array) -> Array:
    left: Array = values - np.einsum("ij,j...->i...", matrix, np.linalg.lstsq(matrix, values, rcond=None)[0])
    return left
