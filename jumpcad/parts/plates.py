"""Print plates: parts of one material, packed on the bed."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import rectpack

from jumpcad.parts.part import Part, Piece, require_bed
from jumpcad.transforms import Array

STEPS_PER_MM = 100  # packing counts in whole steps, so that it does not depend on rounding
EDGE_MM = 5.0
"""Left free along the bed's edges where that takes no further plate; judgement: a skirt, clips, an uneven rim."""

SLENDER, BRIM_MM = 2.0, 2.5
"""Height of a part over the narrower side of its bed face from which it gets a brim, and how wide; judgement. Brims of
neighbours at the usual spacing just touch."""

Printable: TypeAlias = Part | Piece


def brim_mm(part: Printable) -> float:
    """Return the width of the brim that holds a part on the bed, 0 for one that stands without."""
    low, high = part.mesh.bounds[:, 2]
    face = part.mesh.vertices[part.mesh.vertices[:, 2] < low + 1e-3, :2]
    return BRIM_MM if high - low > SLENDER * float(np.ptp(face, axis=0).min()) else 0.0


@dataclass(frozen=True)
class PlacedCopy:
    """One copy of a part on a plate: its pose (4, 4) on the bed, in mm, from the bed's front left corner."""

    part: Printable
    T_bed_part: Array


@dataclass(frozen=True)
class PrintPlate:
    """What is printed at once: a material, a number counted from 1 within that material, and the parts.

    `kind` is the beginning of its name.
    """

    material: str
    number: int
    items: tuple[PlacedCopy, ...]
    kind: str = "plate"

    @property
    def name(self) -> str:
        """Name of the plate and of its file."""
        return f"{self.kind}-{self.number}-{self.material}"


def packed(parts: Iterable[Printable], bed_mm: Sequence[float], spacing_mm: float) -> list[PrintPlate]:
    """Pack parts on plates, sorted by material; as many plates as it takes.

    Parts are turned by 90° as needed; one that is too long for that lies at another angle. What a plate has lies in the
    middle of the usable bed (x, y, z); parts keep a distance from each other.
    """
    by_material: dict[str, list[Printable]] = {}
    for part in sorted(parts, key=lambda part: part.name):
        by_material.setdefault(part.material, []).extend([part] * part.quantity)
    return [plate for material in sorted(by_material) for plate in _plates(by_material[material], bed_mm, spacing_mm)]


def _plates(parts: Sequence[Printable], bed_mm: Sequence[float], spacing_mm: float) -> list[PrintPlate]:
    """Return the plates of one material."""
    angles = {part.name: _angle_deg(part, bed_mm) for part in parts}
    sizes = []
    for part in parts:
        low, high = _bounds(part, angles[part.name])
        sizes.append(tuple(math.ceil((side + spacing_mm) * STEPS_PER_MM - 1e-6) for side in (high - low)[:2]))
    packer, inside = (_packer(sizes, bed_mm, spacing_mm, edge_mm) for edge_mm in (0.0, EDGE_MM))
    if len(inside.rect_list()) == len(parts) and len(inside) == len(packer):
        packer = inside
    beside = {number: _beside(bin_, bed_mm, spacing_mm) for number, bin_ in enumerate(packer)}
    plates: dict[int, list[tuple[int, PlacedCopy]]] = {}
    for plate, x, y, width, height, number in packer.rect_list():
        turned = (width, height) != sizes[number]
        angle = angles[parts[number].name] + (90.0 if turned else 0.0)
        low, _ = _bounds(parts[number], angle)
        pose = _turn(angle)
        corner = np.array([x, y]) / STEPS_PER_MM + beside[plate]
        pose[:3, 3] = *(corner - low[:2]), -low[2]
        plates.setdefault(plate, []).append((number, PlacedCopy(parts[number], pose)))
    return [
        PrintPlate(parts[0].material, number, tuple(item for _, item in sorted(items, key=lambda pair: pair[0])))
        for number, items in enumerate(plates.values(), start=1)
    ]


def _packer(sizes: Sequence[tuple[int, ...]], bed_mm: Sequence[float], spacing_mm: float, edge_mm: float) -> Any:
    """Return the rectangles packed on beds without an edge; those that do not fit are left out."""
    packer = rectpack.newPacker(
        bin_algo=rectpack.PackingBin.BFF, pack_algo=rectpack.MaxRectsBssf, sort_algo=rectpack.SORT_LSIDE, rotation=True,
    )  # fmt: skip
    sides = (math.floor((side - 2.0 * edge_mm + spacing_mm) * STEPS_PER_MM) for side in bed_mm[:2])
    packer.add_bin(*sides, count=len(sizes))
    for number, size in enumerate(sizes):
        packer.add_rect(*size, rid=number)
    packer.pack()
    return packer


def _beside(plate: Iterable[Any], bed_mm: Sequence[float], spacing_mm: float) -> Array:
    """Return how much of the bed (2,) is left on either side of what a plate has, in whole steps."""
    used = np.max([(rect.x + rect.width, rect.y + rect.height) for rect in plate], axis=0) / STEPS_PER_MM - spacing_mm
    return np.asarray(np.floor((np.asarray(bed_mm[:2]) - used) / 2.0 * STEPS_PER_MM) / STEPS_PER_MM)


def _angle_deg(part: Printable, bed_mm: Sequence[float]) -> float:
    """Return the turn at which a part fits the bed; packing may add 90°."""
    mesh = part.mesh
    return require_bed(part.name, mesh.bounds, lambda: mesh.vertices[:, :2], bed_mm).angle_deg % 90.0


def _bounds(part: Printable, angle_deg: float) -> tuple[Array, Array]:
    """Return the corners of the bounding box of a part turned about z."""
    points = part.mesh.vertices @ _turn(angle_deg)[:3, :3].T
    return points.min(axis=0), points.max(axis=0)


def _turn(angle_deg: float) -> Array:
    """Return a turn about z as a pose (4, 4); those by 0° and 90° are exact."""
    quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0)}
    angle = math.radians(angle_deg)
    cos, sin = quarter.get(angle_deg, (math.cos(angle), math.sin(angle)))
    return np.array([[cos, -sin, 0.0, 0.0], [sin, cos, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
