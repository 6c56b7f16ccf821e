"""Take-off speed and angle from the points of a flight in a video, in a text file of any video tool.

Such as Tracker, Kinovea, Logger Pro or a spreadsheet. The first line that names the columns t, x and z (or y) is the
head; lines before it are the tool's. Columns stand apart by tabs, semicolons, commas or spaces. Units are beside the
names, `x (cm)`, `x [m]`, `t/s`, or on a line of their own.
"""

import csv
import math
import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.special import stdtrit

from jumpcad.dimensions import GRAVITY_M_S2, counted
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.files.reading import read_bytes
from jumpcad.transforms import Array

LEAST_POINTS = 6
"""Least number of points from which gravity can be fitted."""
HEAD_LINES, HEAD_CHARACTERS = 50, 1000
"""Where the head is looked for: in the first lines, and how long it may be."""
NAMES = (
    dict.fromkeys(("time", "timestamp", "zeit", "temps", "tiempo", "tempo"), "t")
    | dict.fromkeys(("height", "höhe", "vertical"), "z")
    | {"horizontal": "x"}
)
"""Other names of a column."""
SILENT = ("in", "pos", "position", "coordinate", "koordinate")
"""Words of a name that say no more: x position (m), t in ms."""
UNMARKED = ("", "-", "--", "nan", "n/a")
"""What stands in the cells of a frame in which nothing is marked."""
SECONDS = {"s": 1.0, "sec": 1.0, "second": 1.0, "sekunde": 1.0, "ms": 1e-3, "millisecond": 1e-3, "min": 60.0}
METRES = {
    "m": 1.0, "metre": 1.0, "meter": 1.0, "dm": 0.1, "cm": 0.01, "centimetre": 0.01, "centimeter": 0.01, "mm": 1e-3,
    "millimetre": 1e-3, "millimeter": 1e-3, "in": 0.0254, "ft": 0.3048,
}  # fmt: skip
SECONDS |= {f"{name}{end}": one for name, one in SECONDS.items() for end in "sn" if len(name) > 3}
METRES |= {f"{name}s": one for name, one in METRES.items() if len(name) > 3}

LARGEST = 1e15
"""Largest number: microseconds since 1970 have 16 digits."""

Column = tuple[int, float]
"""Place in a row, and the factor to seconds or metres."""


def read_points(path: Path) -> Array:
    """Return the points (n, 3) of a text file, t (s), x and z (m), in order of time."""
    content = read_bytes(path, "a CSV file")
    encodings = ("utf-16",) if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else ("utf-8-sig", "cp1252")
    for encoding in encodings:
        try:
            return _points(content.decode(encoding).splitlines(), path)
        except UnicodeDecodeError:
            continue
        except csv.Error as error:
            raise JumpcadError(f"{path}: cannot be read as CSV: {error}") from None
    raise JumpcadError(f"{path}: not a text file in UTF-8, UTF-16 or Windows-1252")


def _points(lines: Sequence[str], path: Path) -> Array:
    start, delimiter, columns = _head(lines, path)
    width = len(_split(lines[start - 1], delimiter))
    factors, decimals = [factor for _, factor in columns], set[str]()
    points: list[list[float]] = []
    for number, line in enumerate(lines[start:], start=start + 1):
        if line.lstrip().startswith(("#", "%", "//")):
            continue
        cells = ["" if cell.strip().lower() in UNMARKED else cell.strip() for cell in _split(line, delimiter)]
        if not points and _columns(cells, path):  # names once more, shorter
            continue
        row = [cells[place] if place < len(cells) else "" for place, _ in columns]
        if any(cells[width:]):
            hint = "decimal commas need semicolons or tabs between the columns"
            raise JumpcadError(f"{path}:{number}: {shown(line)} has more values than columns: {hint}")
        if not any(row[1:]) and (row[0] or not any(cells)):  # an empty line, or a frame in which nothing is marked
            continue
        if not points and (found := _units(row)):
            factors = found
            continue
        decimals.update(re.findall("[.,]", "".join(row)))
        try:
            point = [float(cell.replace(",", ".").replace("−", "-")) for cell in row]
        except ValueError:
            raise JumpcadError(f"{path}:{number}: {shown(','.join(row))} must be three numbers t, x, z") from None
        if not all(abs(value) <= LARGEST for value in point):  # nor is NaN
            raise JumpcadError(f"{path}:{number}: {shown(','.join(row))} must be finite numbers within ±{LARGEST:g}")
        points.append(point)
    if len(decimals) > 1:
        raise JumpcadError(f"{path}: has decimal points and decimal commas: export it without separators of thousands")
    if len(points) < LEAST_POINTS:
        raise JumpcadError(f"{path}: {counted(len(points), 'point')}: too few, mark at least {LEAST_POINTS} in flight")
    found_points = np.array(points) * factors
    if (np.diff(found_points[:, 0]) <= 0.0).any():
        raise JumpcadError(f"{path}: t must grow from line to line, in one track alone")
    return found_points


def _head(lines: Sequence[str], path: Path) -> tuple[int, str, list[Column]]:
    """Return the number of the head's line, its delimiter, and the columns t, x and z."""
    for number, line in enumerate(lines[:HEAD_LINES], start=1):
        for delimiter in "\t;, " if len(line) <= HEAD_CHARACTERS else "":
            if columns := _columns(_split(line, delimiter), path):
                return number, delimiter, columns
    raise JumpcadError(f"{path}: no line names the columns t, x and z (or y): begin with t,x,z")


def _split(line: str, delimiter: str) -> list[str]:
    if delimiter == " ":
        return re.split(r"\s+(?![(\[])", line.strip("# \t"))
    return next(csv.reader([line.lstrip("# ")], delimiter=delimiter), [])


def _columns(cells: Sequence[str], path: Path) -> list[Column]:
    """Return the columns t, x and z, which y stands for where there is no z; none if the cells do not name them.

    A name alone goes before one with words before it (`Ball x`).
    """
    alone: dict[str, list[tuple[int, str]]] = {}
    worded: dict[str, list[tuple[int, str]]] = {}
    for place, cell in enumerate(cells):
        text, *units = re.split(r"[(\[/]", re.sub(r"_?\{.*?\}", "", cell.lower()), maxsplit=1)  # x_{A} (m)
        words = re.findall(r"[^\W\d_]+", text)
        unit = re.split(r"[)\]]", units[0])[0].strip() if units else ""  # t (s) Run #1
        if not unit and len(words) > 1 and words[-1] in SECONDS | METRES:  # x_mm
            *words, unit = words
        words = [word for word in words if word not in SILENT]
        last = words[-1] if words else ""
        name = NAMES.get(last, last)
        if len(words) == 1 or unit in _known(name):  # else a speed: v_x (m/s)
            (worded if len(words) > 1 else alone).setdefault(name, []).append((place, unit))
    found = worded | alone
    names = "t", "x", "z" if "z" in found else "y"
    if not all(name in found for name in names):
        return []
    for name in names:
        if len(found[name]) > 1:
            raise JumpcadError(f"{path}: has {len(found[name])} columns {name}: export one track alone")
        if (unit := found[name][0][1]) not in _known(name):
            hint = "export seconds" if name == "t" else "set the scale of the video in its tool, and export metres"
            raise JumpcadError(f"{path}: {name} is in {shown(unit)}, which is no unit that is known: {hint}")
    return [(place, _known(name)[unit]) for name in names for place, unit in found[name]]


def _known(name: str) -> dict[str, float]:
    return {"": 1.0} | (SECONDS if name == "t" else METRES)


def _units(row: Sequence[str]) -> list[float]:
    """Return the factors of a row of units; none if it is no such row."""
    time, *lengths = (cell.strip("()[] ").lower() for cell in row)
    known = time in SECONDS and all(length in METRES for length in lengths)
    return [SECONDS[time], *(METRES[length] for length in lengths)] if known else []


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
    return np.asarray(values - np.einsum("ij,j...->i...", matrix, np.linalg.lstsq(matrix, values, rcond=None)[0]))
