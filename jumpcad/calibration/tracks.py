"""Points of a flight from the text file that a video tool exports: Tracker, Kinovea, Logger Pro, a spreadsheet.

The first line that names the columns t, x and z (or y) is the head; lines before it are the tool's. Columns stand apart
by tabs, semicolons, commas or spaces. Units are beside the names, `x (cm)`, `x [m]`, `t/s`, or on a line of their own.
"""

import csv
import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from jumpcad.dimensions import counted
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
