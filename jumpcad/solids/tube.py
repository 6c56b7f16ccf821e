"""Bent wire as a mesh: a tube of few facets along a line (mm)."""

from dataclasses import dataclass

import numpy as np

from jumpcad.transforms import Array, ByValue, Trimesh

SIDES = 8
"""Of a tube's section; judgement: it looks round beside parts of its size."""


@dataclass(frozen=True, eq=False)
class DrawnWire(ByValue):
    """A round wire along points (n, 3)."""

    points_mm: Array
    diameter_mm: float

    def __hash__(self) -> int:
        return hash((self.points_mm.tobytes(), self.diameter_mm))


def tube(points_mm: Array, diameter_mm: float) -> Trimesh:
    """Return a closed mesh along points (n, 3) that make no sharp bend; its facets lie within the round wire.

    Each section stands square to the line. The sections' first directions follow one another without a twist, by
    projection from point to point.
    """
    import trimesh

    along = np.gradient(points_mm, axis=0)
    along /= np.sqrt((along**2).sum(axis=1))[:, None]
    first = np.zeros_like(points_mm)
    side = np.eye(3)[np.argmin(np.abs(along[0]))]
    for index, direction in enumerate(along):
        side = side - (side * direction).sum() * direction
        side = first[index] = side / np.sqrt((side**2).sum())
    second = np.cross(along, first)
    turn = np.arange(SIDES) * 2.0 * np.pi / SIDES
    rings = np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * second[:, None]
    vertices = (points_mm[:, None] + diameter_mm / 2.0 * rings).reshape(-1, 3)
    corner = np.arange(SIDES)
    after = (corner + 1) % SIDES
    start = SIDES * np.arange(len(points_mm) - 1)[:, None]
    walls = [
        np.stack([start + corner, start + after, start + SIDES + after], axis=-1),
        np.stack([start + corner, start + SIDES + after, start + SIDES + corner], axis=-1),
    ]
    fan = np.stack([np.zeros(SIDES - 2, dtype=int), corner[1:-1], corner[2:]], axis=-1)
    ends = [fan[:, ::-1], fan + SIDES * (len(points_mm) - 1)]
    faces = np.concatenate([wall.reshape(-1, 3) for wall in walls] + ends)
    return trimesh.Trimesh(np.round(vertices, 6), faces, process=False)
