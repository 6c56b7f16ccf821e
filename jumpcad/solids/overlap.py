"""What two placed stacks share."""

import numpy as np

from jumpcad.solids.outline import boxes_apart
from jumpcad.solids.slab import SMALLEST_AREA_MM2, Z_DIGITS
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

    Raises
    ------
    ValueError
        If the extrusion axes are not parallel.
    """
    T_a_b = np.linalg.inv(T_world_a) @ T_world_b
    turn, shift = T_a_b[:3, :3], T_a_b[:3, 3]
    if abs(abs(turn[2, 2]) - 1.0) > 1e-9:
        raise ValueError("the extrusion axes of the two stacks are not parallel")
    flat = np.column_stack([turn[:2, :2], shift[:2]])
    total = 0.0
    for slab_b in b.slabs:
        low, high = sorted(turn[2, 2] * z + shift[2] for z in (slab_b.z0_mm, slab_b.z1_mm))
        region_b = None
        for slab_a in a.slabs:
            height = min(high, slab_a.z1_mm) - max(low, slab_a.z0_mm)
            if height <= 10.0**-Z_DIGITS:
                continue
            if region_b is None:
                region_b = slab_b.region.transform(flat)
            if boxes_apart(slab_a.region, region_b):
                continue
            area = (slab_a.region ^ region_b).area()
            if area > SMALLEST_AREA_MM2:
                total += area * height
    return total
