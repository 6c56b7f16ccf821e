"""Rasterization of triangles: at every pixel the nearest triangle that faces the camera.

All triangles at once: every triangle is cut into the span that it covers of each row, every span into its pixels. An
edge that two triangles share is cut at the same points in both, so that there are neither gaps nor overlaps.
"""

import numpy as np
import numpy.typing as npt

from jumpcad.transforms import Array

Ints = npt.NDArray[np.int64]

X, Y, NEARNESS, SHADE = range(4)
"""Columns of a corner's data."""


def rasterized(corners: Array, size: tuple[int, int]) -> tuple[Ints, Array, Array]:
    """Return the visible triangle at every pixel, with its nearness and shade there.

    Parameters
    ----------
    corners
        The corners (n, 3, 4) of triangles, counter-clockwise as seen from outside: x (pixels, to the right), y (pixels,
        down), nearness (1 over the distance, 1/m), shade. A triangle with a corner behind the camera, where nearness
        is negative, is left out.
    size
        Width and height in pixels.

    Returns
    -------
    number
        Index of the triangle at every pixel (height, width); -1 where there is none.
    nearness, shade
        Those of that triangle at the pixel's centre (height, width); 0 where there is none.
    """
    width, height = size
    ahead, across = corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]
    before = (corners[:, :, NEARNESS] > 0.0).all(axis=1)
    facing = np.nonzero(before & (ahead[:, 0] * across[:, 1] < ahead[:, 1] * across[:, 0]))[0]
    span, left, right = _spans(corners[facing], height)
    which, x = _centres(left[:, X], right[:, X], width)
    share = (x + 0.5 - left[:, X][which]) / (right[:, X] - left[:, X])[which]

    def between(column: int, some: Ints | slice) -> Array:
        """Interpolate a column of the spans' ends at some of the pixels."""
        first, span_of = left[:, column], which[some]
        point: Array = first[span_of] + share[some] * (right[:, column] - first)[span_of]
        return point

    near = between(NEARNESS, np.s_[:])
    pixel = ((left[:, Y] - 0.5).astype(np.int64) * width)[which] + x
    nearness = np.zeros(width * height)
    np.maximum.at(nearness, pixel, near)
    nearest = np.flatnonzero(near == nearness[pixel])
    number, shade = np.full(width * height, -1), np.zeros(width * height)
    number[pixel[nearest]] = facing[span[which[nearest]]]
    shade[pixel[nearest]] = between(SHADE, nearest)
    return number.reshape(height, width), nearness.reshape(height, width), shade.reshape(height, width)


def _spans(corners: Array, height: int) -> tuple[Ints, Array, Array]:
    """Return the spans of triangles (n, 3, 4) on the rows that they cover: triangle (m,), left and right end (m, 4)."""
    order = np.argsort(corners[:, :, Y], axis=1, kind="stable")
    ends = np.take_along_axis(corners, order[:, :, None], axis=1).reshape(-1, 4)  # top, middle and bottom of each
    number, row = _centres(ends[0::3, Y], ends[2::3, Y], height)
    top = 3 * number
    below = top + (row + 0.5 >= ends[top + 1, Y])
    one, other = _at(row, ends[top], ends[top + 2]), _at(row, ends[below], ends[below + 1])
    swapped = (one[:, X] > other[:, X])[:, None]
    return number, np.where(swapped, other, one), np.where(swapped, one, other)


def _at(row: Ints, start: Array, end: Array) -> Array:
    """Return where edges that run down from start to end (n, 4) cross the middles of rows (n,), as points (n, 4)."""
    share = (row + 0.5 - start[:, Y]) / (end[:, Y] - start[:, Y])
    point: Array = start + share[:, None] * (end - start)
    point[:, Y] = row + 0.5
    return point


def _centres(low: Array, high: Array, count: int) -> tuple[Ints, Ints]:
    """Return all pairs (interval, pixel) in which low ≤ pixel + 0.5 < high, for pixels from 0 to below a count."""
    first, last = (np.clip(np.ceil(ends - 0.5), 0, count).astype(np.int64) for ends in (low, high))
    many = np.maximum(last - first, 0)
    interval = np.repeat(np.arange(len(low)), many)
    return interval, first[interval] + np.arange(len(interval)) - np.repeat(np.cumsum(many) - many, many)
