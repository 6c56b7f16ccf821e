"""What is seen of a part, many times faster than its closed solid: for a page that shows a robot while it is changed.

The walls of a stack's slabs and the ends of them that lie bare make the same picture as the solid's mesh. Their
triangles do not share corners, so they are nothing to print or to compute with.
"""

import itertools
from collections.abc import Iterator, Sequence
from functools import lru_cache

import manifold3d
import numpy as np
import numpy.typing as npt

from jumpcad.scene.visuals import Visual
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array

Triangles = npt.NDArray[np.int64]
Piece = tuple[Array, Triangles]
"""Vertices (n, 3) in mm, and triangles (m, 3) whose corners run counter-clockwise seen from outside."""

UNSEEN_MM = 0.02
"""How far outlines are simplified; judgement: less than a pixel, however near the camera comes."""
FLAT_MM = 1e-4
"""Tolerance of the triangulation; corners lie on a grid of 1e-3 mm."""


def seen(one: Visual) -> Piece:
    """Return vertices (n, 3) in mm, in the mesh's own frame, and triangles (m, 3) of a part as it is seen."""
    shape = one.shape
    if isinstance(shape, Stack):
        return surface(shape)
    return np.asarray(one.mesh.vertices), np.asarray(one.mesh.faces)


@lru_cache(maxsize=128)
def surface(stack: Stack) -> Piece:
    """Return the outside of a stack: vertices (n, 3) in mm, and triangles (m, 3)."""
    cases = {(slab.number, slab.pocket_number, slab.inset_mm): slab for slab in stack.slabs}
    regions = {case: slab.region.simplify(UNSEEN_MM) for case, slab in cases.items()}
    slabs = [(slab.z0_mm, slab.z1_mm, regions[slab.number, slab.pocket_number, slab.inset_mm]) for slab in stack.slabs]
    pieces = [*(_wall(region.to_polygons(), z0, z1) for z0, z1, region in slabs), *_ends(slabs)]
    first = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    triangles = [number + corners for number, (_, corners) in zip(first, pieces, strict=False)]
    return np.concatenate([vertices for vertices, _ in pieces]), np.concatenate(triangles)


def _wall(contours: Sequence[Array], z0_mm: float, z1_mm: float) -> Piece:
    """Return the wall over contours (k, 2) between two heights."""
    flat = np.concatenate(contours)
    count = len(flat)
    here = np.arange(count)
    there = np.concatenate(
        [np.roll(ring, -1) for ring in np.split(here, np.cumsum([len(one) for one in contours])[:-1])]
    )
    low, high = (np.column_stack([flat, np.full(count, z)]) for z in (z0_mm, z1_mm))
    triangles = [np.column_stack([here, there, there + count]), np.column_stack([here, there + count, here + count])]
    return np.concatenate([low, high]), np.concatenate(triangles)


def _ends(slabs: Sequence[tuple[float, float, Region]]) -> Iterator[Piece]:
    """Yield the flat faces of slabs (z0, z1, region) that no neighbour covers."""
    nothing = (-np.inf, -np.inf, Region())
    for (_, z1, lower), (z0, _, upper) in itertools.pairwise([nothing, *slabs, nothing]):
        met = z0 == z1
        for z, region, other, up in ((z1, lower, upper, True), (z0, upper, lower, False)):
            contours = (region - other if met else region).to_polygons()
            if not contours:
                continue
            flat = np.concatenate(contours)
            triangles = np.asarray(manifold3d.triangulate(contours, FLAT_MM), dtype=np.int64).reshape(-1, 3)
            yield np.column_stack([flat, np.full(len(flat), z)]), triangles if up else triangles[:, ::-1]
