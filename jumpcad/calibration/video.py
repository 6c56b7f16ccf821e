"""Take-off speed and angle from the points of a flight in a video: t in s, x and z in m."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from jumpcad.counting import counted
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.files import read_text
from jumpcad.files.complaints import shown
from jumpcad.transforms import Array

COLUMNS = ("t", "x", "z")
LEAST_POINTS = 6
"""Least number of points from which gravity can be fitted."""
GRAVITY_SHARE = 0.15
"""Largest relative difference of the fitted gravity from the earth's."""
MISTAKES = (
    (1000.0, "x and z are in mm: divide them by 1000"),
    (100.0, "x and z are in cm: divide them by 100"),
    (0.01, "t is 10 times too long: slow motion needs the camera's time, frames over frames a second"),
    (1e-6, "t is in ms: divide it by 1000"),
    (-1.0, "z points down: change its sign"),
)
"""Fitted gravity over the earth's, and the probable mistake."""


@dataclass(frozen=True)
class TakeoffSeen:
    """Velocity at the first point: speed (m/s) and angle (°), each with its standard error from the fit."""

    speed_m_s: float
    angle_deg: float
    speed_error_m_s: float
    angle_error_deg: float


def read_points(path: Path) -> Array:
    """Return the points (n, 3) of a CSV file with the columns t, x, z, in order of time.

    Raises
    ------
    JumpcadError
        If the file cannot be read, or not as CSV, a column is missing, a value is no finite number (with file and
        line), there are too few points, or t does not increase.
    """
    reader = csv.reader(read_text(path, "a CSV file").splitlines())
    try:
        rows = list(reader)
    except csv.Error as error:
        raise JumpcadError(f"{path}:{reader.line_num}: cannot be read as CSV: {error}") from None
    head = [cell.strip() for cell in rows[0]] if rows else []
    if missing := [name for name in COLUMNS if name not in head]:
        raise JumpcadError(f"{path}: no column {missing[0]}: the first line must be t,x,z")
    places = [head.index(name) for name in COLUMNS]
    points = []
    for number, row in enumerate(rows[1:], start=2):
        if not any(cell.strip() for cell in row):
            continue
        try:
            point = [float(row[place]) for place in places]
        except (IndexError, ValueError):
            raise JumpcadError(f"{path}:{number}: {shown(','.join(row))} must be three numbers t, x, z") from None
        if not all(map(math.isfinite, point)):
            raise JumpcadError(f"{path}:{number}: {shown(','.join(row))} must be finite numbers")
        points.append(point)
    if len(points) < LEAST_POINTS:
        raise JumpcadError(f"{path}: {counted(len(points), 'point')}: too few, mark at least {LEAST_POINTS} in flight")
    found = np.array(points)
    if (np.diff(found[:, 0]) <= 0.0).any():
        raise JumpcadError(f"{path}: t must grow from line to line")
    return found


def seen_takeoff(points: Array, source: str) -> TakeoffSeen:
    """Fit a ballistic flight to points (n, 3), and check its gravity.

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
        hint = next(
            (why for factor, why in MISTAKES if abs(ratio / factor - 1.0) <= GRAVITY_SHARE),
            "keep only the points between take-off and touchdown, and check the scale",
        )
        raise JumpcadError(f"{source}: its points fall with {found[2]:.3g} m/s² instead of {GRAVITY_M_S2:g}: {hint}")
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


def _residual(matrix: Array, values: Array) -> Array:
    left: Array = values - np.einsum("ij,j->i", matrix, np.linalg.lstsq(matrix, values, rcond=None)[0])
    return left
