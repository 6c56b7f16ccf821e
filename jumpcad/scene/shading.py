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
"""Faces that meet at a smaller angle look smooth."""
SCENE = 128
"""How many meshes stay in the cache: those of a robot, which its scene file and its pictures both show."""


@lru_cache(maxsize=SCENE)
def creased(mesh: "trimesh.Trimesh") -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Return vertices (n, 3), their normals (n, 3) and faces (m, 3): one vertex for every normal that a corner needs.

    A corner's normal is the mean of the faces around it that meet its own face at less than the crease angle, weighted
    by area. trimesh's `smooth_shade` numbers its vertices in the order of a sort whose ties depend on the processor.
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
