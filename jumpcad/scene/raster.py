"""From a mesh to pixels: vertex normals, and at every pixel the nearest triangle that faces the camera.

All triangles at once: every triangle is cut into the span that it covers of each row, every span into its pixels. An
edge that two triangles share is cut at the same points in both, so that there are neither gaps nor overlaps.
"""

from functools import lru_cache

import numpy as np
import numpy.typing as npt
from scipy import sparse

from jumpcad.transforms import Array, Trimesh

CREASE_RAD = 0.5
"""Faces that meet at a smaller angle are shaded smoothly."""
CACHED_MESHES = 128
"""More than a robot has; its GLB file and its pictures use the same meshes."""


@lru_cache(maxsize=CACHED_MESHES)
def with_normals(mesh: Trimesh) -> tuple[Array, Array, npt.NDArray[np.int64]]:
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


Ints = npt.NDArray[np.int64]

X, Y, NEARNESS, SHADE = range(4)
"""Columns of a corner's data."""


def rasterized(corners: Array, size: tuple[int, int]) -> tuple[npt.NDArray[np.int32], Array, Array]:
    """Return the visible triangle at every pixel, -1 where there is none, with its nearness and shade there, else 0.

    All three have shape (height, width). The corners (n, 3, 4) of triangles, counter-clockwise as seen from outside,
    are x (pixels, to the right), y (pixels, down), nearness (1 over the distance, 1/m), shade. A triangle with a corner
    behind the camera, where nearness is negative, is left out. `size` is width and height in pixels.
    """
    width, height = size
    ahead, across = corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]
    before = (corners[:, :, NEARNESS] > 0.0).all(axis=1)
    facing = np.nonzero(before & (ahead[:, 0] * across[:, 1] < ahead[:, 1] * across[:, 0]))[0]
    spans = _Spans(corners[facing], height)
    (left, right), (low, high) = spans.ends(X), spans.ends(NEARNESS)
    first, many = _centres(left, right, width)
    x = _counted(first, many)
    share = x + 0.5
    share -= np.repeat(left, many)
    share /= np.repeat(right - left, many)
    near = np.repeat(high - low, many)
    near *= share
    near += np.repeat(low, many)
    pixel = np.repeat(spans.row * width, many) + x
    nearness = np.zeros(width * height)
    np.maximum.at(nearness, pixel, near)
    nearest = np.flatnonzero(near == nearness[pixel])
    seen, span = pixel[nearest], np.repeat(np.arange(len(many)), many)[nearest]
    low, high = spans.ends(SHADE)
    number, shade = np.full(width * height, -1, dtype=np.int32), np.zeros(width * height)
    number[seen] = facing[spans.triangle][span]
    shade[seen] = low[span] + share[nearest] * (high - low)[span]
    return number.reshape(height, width), nearness.reshape(height, width), shade.reshape(height, width)


class _Spans:
    """The spans (m) of triangles (n, 3, 4) on the rows that they cover: `triangle` (m,) and `row` (m,).

    A span lies between the edge from the top of its triangle to the bottom, and the one above or below the corner
    between.
    """

    def __init__(self, corners: Array, height: int) -> None:
        order = np.argsort(corners[:, :, Y], axis=1, kind="stable")
        top, middle, bottom = np.take_along_axis(corners, order[:, :, None], axis=1).transpose(1, 2, 0)
        first, many = _centres(top[Y], bottom[Y], height)
        self.triangle, self.row = np.repeat(np.arange(len(many)), many), _counted(first, many)
        below = self.row + 0.5 >= middle[Y][self.triangle]
        self._starts = np.concatenate([top, top, middle], axis=1)
        self._ways = np.concatenate([bottom - top, middle - top, bottom - middle], axis=1)
        self._edges = [self.triangle, self.triangle + np.where(below, 2, 1) * len(many)]
        self._shares = [(self.row + 0.5 - self._starts[Y][edge]) / self._ways[Y][edge] for edge in self._edges]
        self._swapped = np.greater(*self._crossings(X))

    def ends(self, column: int) -> tuple[Array, Array]:
        """Return a column's values where the spans begin, on the left, and where they end (m,)."""
        one, other = self._crossings(column)
        return np.where(self._swapped, other, one), np.where(self._swapped, one, other)

    def _crossings(self, column: int) -> list[Array]:
        start, way = self._starts[column], self._ways[column]
        return [start[edge] + share * way[edge] for edge, share in zip(self._edges, self._shares, strict=True)]


def _centres(low: Array, high: Array, count: int) -> tuple[Ints, Ints]:
    """Return the first pixel of each interval with low ≤ pixel + 0.5 < high, and how many there are, below a count."""
    first, last = (np.clip(np.ceil(ends - 0.5), 0, count).astype(np.int64) for ends in (low, high))
    return first, np.maximum(last - first, 0)


def _counted(first: Ints, many: Ints) -> Ints:
    """Return the numbers from each first one on, so many of each, in a row."""
    return np.arange(many.sum()) + np.repeat(first - np.cumsum(many) + many, many)
