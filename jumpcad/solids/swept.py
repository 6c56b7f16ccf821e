"""The volume that a stack sweeps on a straight path to its place (mm)."""

import numpy as np

from jumpcad.solids.outline import Region, hull, polygon, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array

PARALLEL = 1e-6
"""Sine of the angle below which a path counts as along, or square to, a stack's axis."""


def swept(stack: Stack, path_mm: Array) -> Stack | None:
    """Return the exact volume that a stack sweeps from `path_mm` (3,), in its own frame, before its place to its place.

    None where the path is neither along the stack's axis nor square to it.
    """
    length = float(np.linalg.norm(path_mm))
    flat, along = np.asarray(path_mm[:2], dtype=float), float(path_mm[2])
    if np.linalg.norm(flat) <= PARALLEL * length:
        before, after = max(along, 0.0), max(-along, 0.0)
        return Stack.of((slab.z0_mm - before, slab.z1_mm + after, slab.region) for slab in stack.slabs)
    if abs(along) <= PARALLEL * length:
        return Stack.of((slab.z0_mm, slab.z1_mm, _dragged(slab.region, -flat)) for slab in stack.slabs)
    return None


def _dragged(region: Region, by_mm: Array) -> Region:
    """Return the area that a region sweeps: both ends, and a parallelogram under every edge of its outlines."""
    covered = [region, region.translate(tuple(by_mm))]
    for contour in region.to_polygons():
        for start, end in zip(contour, np.roll(contour, -1, axis=0), strict=True):
            covered.append(hull([polygon([start, end, end + by_mm, start + by_mm])]))
    return union(covered)
