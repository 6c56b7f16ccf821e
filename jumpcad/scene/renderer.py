"""The camera of a picture, and shaded pictures of meshes with their visible edges.

A camera has a position, axes, and the perspective projection of points. Pictures are drawn at twice their size and
scaled down. An edge is a visible crease of a mesh, or a border between two meshes.
"""

import functools
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from jumpcad.scene.raster import CREASE_RAD, rasterized, with_normals
from jumpcad.scene.visuals import Colour
from jumpcad.transforms import Array, Trimesh

FIELD_OF_VIEW_DEG = 14.0
"""Small, so that the projection is nearly parallel."""
SLOPE = math.tan(math.radians(FIELD_OF_VIEW_DEG / 2.0))
"""Half the visible height over the distance."""
MARGIN = 1.06
"""Visible extent over that of the framed points."""


@dataclass(frozen=True)
class View:
    """The direction from which a picture is taken: yaw from the robot's x axis and pitch above the ground (deg)."""

    yaw_deg: float = -58.0
    pitch_deg: float = 20.0

    @property
    def axes(self) -> Array:
        """Unit vectors (3, 3) to the picture's right, up, and from what is seen towards the camera, in rows."""
        yaw, pitch = math.radians(self.yaw_deg), math.radians(self.pitch_deg)
        right = [-math.sin(yaw), math.cos(yaw), 0.0]
        up = [-math.cos(yaw) * math.sin(pitch), -math.sin(yaw) * math.sin(pitch), math.cos(pitch)]
        back = [math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), math.sin(pitch)]
        return np.array([right, up, back])


@dataclass(frozen=True)
class Camera:
    """A camera at a point (3,) in the world (m), with the axes (3, 3) of its view."""

    eye_m: Array
    axes: Array

    def seen(self, points_m: Array, size: tuple[int, int]) -> tuple[Array, Array]:
        """Project points (…, 3) in the world (m) onto a picture of `size`, width and height in pixels.

        Return pixels (…, 2) from the upper left corner, x to the right and y down; distances (…) along the view (m).
        """
        right, up, back = np.moveaxis(turned(points_m - self.eye_m, self.axes), -1, 0)
        scale = size[1] / 2.0 / SLOPE / -back
        return np.stack([size[0] / 2.0 + scale * right, size[1] / 2.0 - scale * up], axis=-1), -back


def aimed(frame_m: Array, view: View, aspect: float) -> Camera:
    """Return the camera that has points (n, 3) in the world (m) in its picture; `aspect` is width over height."""
    along = turned(frame_m, view.axes)
    low, high = along.min(axis=0), along.max(axis=0)
    half_width, half_height, half_depth = MARGIN * (high - low) / 2.0
    distance = max(half_height, half_width / aspect) / SLOPE + half_depth
    middle = (low + high) / 2.0 + [0.0, 0.0, distance]
    return Camera(turned(middle, view.axes.T), view.axes)


def turned(vectors: Array, rotation: Array) -> Array:
    """Return vectors (…, 3) rotated by a matrix (3, 3), without BLAS: the same on every processor."""
    return np.asarray(np.einsum("...j,kj->...k", vectors, rotation))


Mask = npt.NDArray[np.bool_]

SUPERSAMPLING = 2
EDGE_DEPTH_M = 0.0006
"""An edge is drawn if it lies at most this far behind the surface beside it."""
EDGE_COLOUR = np.array([30.0, 32.0, 36.0])
EDGE_STRENGTH = 0.7
"""Opacity of an edge."""
BACKGROUND = 255
PALE: Colour = (0.90, 0.90, 0.91)
LIGHT = np.array([-0.5, -1.2, 1.6]) / math.hypot(-0.5, -1.2, 1.6)
"""Unit vector towards the light, in the world."""
AMBIENT, DIFFUSE = 0.6, 0.45
"""Brightness of a face turned away from the light, and what perpendicular light adds."""
MM = 0.001
"""In metres."""
COMPRESSION = 6
"""Of PNG files: 9 takes four times as long, for files 6 % smaller."""


@dataclass(frozen=True)
class ShadedMesh:
    """A mesh to draw: vertices (n, 3) in m, normals (n, 3), faces (m, 3), ends of creases (k, 2, 3) in m, a colour."""

    vertices_m: Array
    normals: Array
    faces: npt.NDArray[np.int64]
    creases_m: Array
    colour: Colour


class Renderer:
    """Draws meshes (mm), each of one colour, in any poses and views."""

    def __init__(self, things: Sequence[tuple[Trimesh, Colour]]) -> None:
        self._things = []
        for mesh, colour in things:
            vertices, normals, faces = with_normals(mesh)
            self._things.append(ShadedMesh(vertices * MM, normals, faces, creases(mesh) * MM, colour))

    def picture(
        self, poses: Sequence[Array | None], size: tuple[int, int], view: View, frame_m: Array,
        pale: Sequence[bool] | None = None,
    ) -> Image.Image:  # fmt: skip
        """Return a picture of `size`, width and height in pixels, that contains points (n, 3) in the world (m).

        The pose (4, 4) of every mesh is in the world, translation in m; None leaves it out. `pale` meshes are drawn in
        pale grey; by default none.
        """
        large = (SUPERSAMPLING * size[0], SUPERSAMPLING * size[1])
        camera = aimed(frame_m, view, size[0] / size[1])
        rows = zip(self._things, poses, pale or [False] * len(poses), strict=True)
        there = [(thing, pose, PALE if grey else thing.colour) for thing, pose, grey in rows if pose is not None]
        number, nearness, shade = rasterized(
            np.concatenate([_corners(thing, pose, camera, large) for thing, pose, _ in there]), large
        )
        covered = np.flatnonzero(number >= 0)
        seen = np.repeat(np.arange(len(there)), [len(thing.faces) for thing, *_ in there])[number.ravel()[covered]]
        owner = np.full(number.shape, -1, dtype=np.int16)
        owner.ravel()[covered] = seen
        image = np.full((number.size, 3), BACKGROUND, dtype=np.uint8)
        brightness = shade.ravel()[covered]
        for channel, strength in enumerate(255.0 * np.array([colour for *_, colour in there]).T):
            image[covered, channel] = np.minimum(strength[seen] * brightness, 255.0)
        ink = borders(owner)
        ends = np.concatenate([_placed(thing.creases_m, pose) for thing, pose, _ in there])
        _draw(ink, *camera.seen(ends, large), nearness)
        inked = np.flatnonzero(ink)
        image[inked] = image[inked] + EDGE_STRENGTH * (EDGE_COLOUR - image[inked])
        image = image.reshape(*ink.shape, 3)
        return Image.fromarray(image).reduce(SUPERSAMPLING)


def png_of(picture: Image.Image, **options: int) -> bytes:
    """Return a picture as a PNG file."""
    stream = io.BytesIO()
    picture.save(stream, "PNG", **options)
    return stream.getvalue()


def paletted(picture: Image.Image) -> Image.Image:
    """Return a picture with a palette of at most 256 colours; the colour of its first pixel stays as it is."""
    found = picture.quantize(method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    palette, ground = found.getpalette() or [], 3 * int(np.asarray(found)[0, 0])
    palette[ground : ground + 3] = np.asarray(picture)[0, 0].tolist()
    found.putpalette(palette)
    return found


def creases(mesh: Trimesh) -> Array:
    """Return the ends (n, 2, 3) of the edges whose faces meet at more than the crease angle (mm)."""
    sharp = mesh.face_adjacency_angles > CREASE_RAD
    return np.asarray(mesh.vertices[mesh.face_adjacency_edges[sharp]], dtype=float)


def borders(owner: npt.NDArray[np.integer[Any]]) -> Mask:
    """Return the pixels (height, width) whose left or upper neighbour shows another mesh, or the background."""
    mask = np.zeros(owner.shape, dtype=bool)
    mask[:, 1:] |= owner[:, 1:] != owner[:, :-1]
    mask[1:, :] |= owner[1:, :] != owner[:-1, :]
    return mask


def _placed(points_m: Array, pose: Array) -> Array:
    return turned(points_m, pose[:3, :3]) + pose[:3, 3]


def _corners(thing: ShadedMesh, pose: Array, camera: Camera, size: tuple[int, int]) -> Array:
    """Return the corners (n, 3, 4) of a placed mesh's triangles for `rasterized`."""
    pixels, distance = camera.seen(_placed(thing.vertices_m, pose), size)
    lit = np.maximum(turned(turned(thing.normals, pose[:3, :3]), LIGHT[None])[:, 0], 0.0)
    return np.column_stack([pixels, 1.0 / distance, AMBIENT + DIFFUSE * lit])[thing.faces]


def _draw(ink: Mask, pixel: Array, distance_m: Array, nearness: Array) -> None:
    """Set the pixels of visible edges in `ink` (height, width).

    Edges have their ends at pixels (n, 2, 2) and distances (n, 2); `nearness` (height, width) is one over the distance
    of what is seen there (1/m).
    """
    height, width = ink.shape
    before = (distance_m > 0.0).all(axis=1)
    start, way = pixel[before, 0].T, (pixel[before, 1] - pixel[before, 0]).T
    # perspective: the inverse of the distance is linear across the picture
    close, closer = (1.0 / distance_m[before]).T
    count = np.ceil(np.abs(way).max(axis=0, initial=0.0)).astype(int) + 1
    share = (np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)) / np.repeat(count, count)
    x, y = (
        np.floor(np.repeat(from_, count) + share * np.repeat(along, count)).astype(int)
        for from_, along in zip(start, way, strict=True)
    )
    near = 1.0 / (np.repeat(close, count) + share * np.repeat(closer - close, count))
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    x, y, near = x[inside], y[inside], near[inside]
    rows = [width * row for row in (np.maximum(y - 1, 0), y, np.minimum(y + 1, height - 1))]
    columns = [np.maximum(x - 1, 0), x, np.minimum(x + 1, width - 1)]
    beside = functools.reduce(np.minimum, (nearness.take(row + column) for row in rows for column in columns))
    seen = near <= 1.0 / np.maximum(beside, np.finfo(float).tiny) + EDGE_DEPTH_M
    ink[y[seen], x[seen]] = True
