"""Vertex normals of a mesh: smooth over small angles, sharp at creases."""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from scipy import sparse

from jumpcad.transforms import Array

if TYPE_CHECKING:
    import trimesh


CREASE_RAD = 0.5
"""Faces that meet at a smaller angle are shaded smoothly."""
CACHED_MESHES = 128
"""More than a robot has; its GLB file and its pictures use the same meshes."""


@lru_cache(maxsize=CACHED_MESHES)
def with_normals(mesh: "trimesh.Trimesh") -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Return vertices (n, 3), their normals (n, 3) and faces (m, 3); a vertex on a crease is repeated for each normal.

    A corner's normal is the mean, weighted by area, of the faces around its vertex that meet its own face at less than
    the crease angle. trimesh's `smooth_shade` is not used: it orders vertices by a sort whose ties depend on the
    processor.
    """
    seen = mesh.face_normals.any(axis=1)  # without faces of no area
    normal, area, ends = mesh.face_normals[seen], mesh.area_faces[seen], mesh.faces[seen].ravel()
    corner = np.arange(ends.size)
    at_vertex = sparse.csr_array((np.ones(corner.size), (corner, ends)))
    one, other = (at_vertex @ at_vertex.T).nonzero()
    smooth = (normal[one // 3] * normal[other // 3]).sum(axis=1) > np.cos(CREASE_RAD)
    one, other = one[smooth], other[smooth] // 3
    weighted = normal[other] * area[other, None]
    sums = np.stack([np.bincount(one, axis, corner.size) for axis in weighted.T], axis=1)
    normals = np.round(sums / np.sqrt((sums * sums).sum(axis=1, keepdims=True)), 6)
    rows = np.column_stack([mesh.vertices[ends], normals])
    order = np.lexsort(rows.T[::-1])
    new = np.append(True, (np.diff(rows[order], axis=0) != 0.0).any(axis=1))
    faces = np.empty(order.size, dtype=np.int64)
    faces[order] = np.cumsum(new) - 1
    vertices = rows[order[new]]
    return vertices[:, :3], vertices[:, 3:], faces.reshape(-1, 3)
