"""What two placed stacks share."""

import numpy as np

from jumpcad.solids.outline import Region, boxes_apart
from jumpcad.solids.slab import SMALLEST_AREA_MM2, Z_DIGITS, Slab
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array


def overlap_volume_mm3(a: Stack, T_world_a: Array, b: Stack, T_world_b: Array) -> float:
    """Return the volume that two placed stacks share, exactly.

    Parameters
    ----------
    a, b
        The stacks, each in its own frame (mm).
    T_world_a, T_world_b
        Their poses (4, 4), lengths in mm; the two extrusion axes must be parallel (either way round).
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
