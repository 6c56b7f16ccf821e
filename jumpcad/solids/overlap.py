"""What two placed stacks share, and what one sweeps on a straight path to its place (mm)."""

import numpy as np

from jumpcad.solids.outline import Region, boxes_apart, hull, polygon, union
from jumpcad.solids.slab import SMALLEST_AREA_MM2, Z_DIGITS, Slab
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array


def overlap_volume_mm3(a: Stack, T_world_a: Array, b: Stack, T_world_b: Array) -> float:
    """Return the volume that two placed stacks share, exactly.

    Their poses (4, 4) have lengths in mm; the two extrusion axes must be parallel (either way round).
    """
    T_a_b = np.linalg.inv(T_world_a) @ T_world_b
    turn, shift = T_a_b[:3, :3], T_a_b[:3, 3]
    if abs(abs(turn[2, 2]) - 1.0) > 1e-9:
        raise ValueError("the extrusion axes of the two stacks are not parallel")
    flat = np.column_stack([turn[:2, :2], shift[:2]])
    total = 0.0
    for slab_b in b.slabs:
        low, high = sorted(turn[2, 2] * z + shift[2] for z in (slab_b.z0_mm, slab_b.z1_mm))
        region_b, known = None, dict[int, float]()
        for slab_a in a.slabs:
            height = min(high, slab_a.z1_mm) - max(low, slab_a.z0_mm)
            if height <= 10.0**-Z_DIGITS:
                continue
            if region_b is None:
                region_b = slab_b.region.transform(flat)
            if boxes_apart(slab_a.outline, region_b):
                continue
            area = _shared_mm2(slab_a, region_b, known)
            if area > SMALLEST_AREA_MM2:
                total += area * height
    return total


def _shared_mm2(slab: Slab, region: Region, known: dict[int, float]) -> float:
    """Return the area that a slab shares with a region; `known` are those of outlines, by their numbers."""
    if slab.inset_mm:
        return float((slab.region ^ region).area())
    if slab.number not in known:
        known[slab.number] = (slab.outline ^ region).area()
    return known[slab.number] - ((slab.pocket ^ region).area() if slab.pocket_number else 0.0)


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
