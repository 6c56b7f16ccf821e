"""Take-off speed and angle from the points of a flight in a video: t in s, x and z in m."""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

GRAVITY_SHARE = 0.15
"""Largest relative difference of the fitted gravity from the earth's."""
UNITS = ((1000.0, "x and z are in mm: divide them by 1000"), (100.0, "x and z are in cm: divide them by 100"))
"""Fitted gravity over the earth's, and the probable mistake, where it is no clock's."""
FLIGHT = "keep only the points between take-off and touchdown, and check the scale"


@dataclass(frozen=True)
class TakeoffSeen:
    """Velocity at the first point: speed (m/s) and angle (°), each with its standard error from the fit."""

    speed_m_s: float
    angle_deg: float
    speed_error_m_s: float
    angle_error_deg: float


def seen_takeoff(points: Array, source: str) -> TakeoffSeen:
    """Fit a ballistic flight to points (n, 3) of t (s), x and z (m), and check its gravity.

    Raises
    ------
    JumpcadError
        If the fitted gravity is not the earth's (wrong scale, wrong clock, or points on the ground), or if x does not
        point forwards or z upwards.
    """
    t, x, z = (points - points[0]).T
    fall = np.column_stack([np.ones_like(t), t, -0.5 * t * t])
    found, _, _, _ = np.linalg.lstsq(fall, z, rcond=None)
    ratio = float(found[2]) / GRAVITY_M_S2
    if abs(ratio - 1.0) > GRAVITY_SHARE:
        raise JumpcadError(
            f"{source}: its points fall with {found[2]:.3g} m/s² instead of {GRAVITY_M_S2:g}: {_mistake(ratio)}"
        )
    line = fall[:, :2]
    (_, forward), (_, up) = (
        np.linalg.lstsq(line, values, rcond=None)[0] for values in (x, z + 0.5 * GRAVITY_M_S2 * t * t)
    )
    left = np.concatenate([_residual(line, x), _residual(line, z + 0.5 * GRAVITY_M_S2 * t * t)])
    deviation = math.sqrt(float(np.sum(left * left)) / max(len(left) - 4, 1))
    error = deviation / math.sqrt(float(np.sum((t - t.mean()) ** 2)))
    speed = math.hypot(forward, up)
    if forward <= 0.0 or up <= 0.0:
        raise JumpcadError(f"{source}: flies with ({forward:.3g}, {up:.3g}) m/s: x must point forwards and z upwards")
    return TakeoffSeen(speed, math.degrees(math.atan2(up, forward)), error, math.degrees(error / speed))


def _mistake(ratio: float) -> str:
    """Return what is probably wrong, from the fitted gravity over the earth's: lengths scale it, clocks by squares."""
    if abs(ratio + 1.0) <= GRAVITY_SHARE:
        return "z points down: change its sign"
    if ratio <= 0.0:
        return FLIGHT
    slow = 1.0 / math.sqrt(ratio)
    clock = f"the clock is {slow:.4g} times too slow" if slow > 1.0 else f"the clock is {1.0 / slow:.4g} times too fast"
    clock += f": say slow_motion = {slow:.4g} in [[videos]], the camera's frames a second over the video's"
    unit = next((text for factor, text in UNITS if abs(ratio / factor - 1.0) <= GRAVITY_SHARE), "")
    return f"{unit}; or {clock}" if unit else f"{clock}; or {FLIGHT}"


def _residual(matrix: Array, values: Array) -> Array:
    left: Array = values - np.einsum("ij,j->i", matrix, np.linalg.lstsq(matrix, values, rcond=None)[0])
    return left
