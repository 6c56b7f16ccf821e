"""Reads G-code: extruded lines, their volume and its moments, and the slicer's remarks."""

import math
import re
from dataclasses import dataclass

import numpy as np

from jumpcad.transforms import Array

WORD = re.compile(r"([A-Z])(-?\d*\.?\d+)")
SETTING = re.compile(r"^; ([\w \[\]()]+?) = (.*)$")


@dataclass(frozen=True)
class Toolpath:
    """Extruding moves: both ends (n, 3) of the nozzle's path, filament fed (n,), line heights (n,), all mm, and kinds.

    `remarks` holds the slicer's closing comments: its settings, time and filament.
    """

    starts_mm: Array
    ends_mm: Array
    filament_mm: Array
    heights_mm: Array
    kinds: tuple[str, ...]
    remarks: dict[str, str]

    @property
    def volumes_mm3(self) -> Array:
        """Plastic of each move (n,), from the filament's diameter."""
        return self.filament_mm * (math.pi / 4.0 * float(self.remarks["filament_diameter"].split(",")[0]) ** 2)

    def moments(self) -> Array:
        """Return the volume moments (10,) of the plastic, see `jumpcad.solids.moments`, in the G-code's frame.

        Each move is a thin straight line half a line height under the nozzle; Simpson's rule is exact for it.
        """
        drop = np.column_stack([np.zeros((len(self.heights_mm), 2)), self.heights_mm / 2.0])
        starts, ends = self.starts_mm - drop, self.ends_mm - drop
        x, y, z = np.concatenate([starts, (starts + ends) / 2.0, ends]).T
        weights = np.concatenate([self.volumes_mm3 * share / 6.0 for share in (1.0, 4.0, 1.0)])
        products = (np.ones_like(x), x, y, z, x * x, y * y, z * z, x * y, y * z, z * x)
        return np.array([float((weights * product).sum()) for product in products])


def read_gcode(text: str) -> Toolpath:
    """Read G-code in the Marlin dialect with PrusaSlicer's comments.

    Feeding filament without moving (priming, retracting) lays no line and is left out.
    """
    position, fed = {"X": 0.0, "Y": 0.0, "Z": 0.0}, 0.0
    relative, height, kind = False, 0.0, ""
    moves: list[tuple[float, ...]] = []
    kinds: list[str] = []
    remarks: dict[str, str] = {}
    for line in text.splitlines():
        if line.startswith(";"):
            if line.startswith(";HEIGHT:"):
                height = float(line[8:])
            elif line.startswith(";TYPE:"):
                kind = line[6:]
            elif found := SETTING.match(line):
                remarks[found[1]] = found[2]
            continue
        command, _, _ = line.partition(";")
        name = command.split(" ", 1)[0]
        if name in ("M82", "M83"):
            relative = name == "M83"
        elif name in ("G0", "G1", "G92"):
            words = {letter: float(value) for letter, value in WORD.findall(command[len(name) :])}
            before = tuple(position.values())
            position.update({axis: words[axis] for axis in position if axis in words})
            feed = words.get("E", 0.0) if relative or "E" not in words else words["E"] - fed
            fed = words.get("E", fed)
            if name != "G92" and feed > 0 and ("X" in words or "Y" in words):
                moves.append((*before, *position.values(), feed, height))
                kinds.append(kind)
    table = np.array(moves).reshape(-1, 8)
    return Toolpath(table[:, :3], table[:, 3:6], table[:, 6], table[:, 7], tuple(kinds), remarks)
