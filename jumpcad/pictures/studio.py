"""Shaded pictures by PyBullet's software renderer, with the edges that a draughtsman would draw.

Everything is drawn twice as large as asked and scaled down. An edge is a crease of a mesh that the depth buffer does
not hide, or a border between two things.
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy.spatial.transform import Rotation

from jumpcad.exporters.shapes import Colour
from jumpcad.simulation.engines import import_pybullet
from jumpcad.solids.shading import CREASE_RAD, creased

if TYPE_CHECKING:
    import trimesh

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

SUPERSAMPLING = 2
EDGE_DEPTH_M = 0.0006
"""An edge may lie this far behind what is seen beside it."""
EDGE_COLOUR = np.array([30.0, 32.0, 36.0])
EDGE_STRENGTH = 0.7
BACKGROUND = 255
FIELD_OF_VIEW_DEG = 14.0
"""A long lens: nearly parallel lines."""
MARGIN = 1.06
PALE: Colour = (0.90, 0.90, 0.91)
AWAY = np.eye(4) + np.outer([0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1e4])
"""Where things are that a picture leaves out: far above it."""
LIGHT = [-0.5, -1.2, 1.6]
MM = 0.001


@dataclass(frozen=True)
class View:
    """From where a picture is taken: yaw from the robot's x axis and pitch above the ground (deg)."""

    yaw_deg: float = -58.0
    pitch_deg: float = 20.0

    @property
    def direction(self) -> Array:
        """Unit vector (3,) from what is seen towards the camera."""
        yaw, pitch = math.radians(self.yaw_deg), math.radians(self.pitch_deg)
        return np.array([math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), math.sin(pitch)])


@dataclass(frozen=True)
class Camera:
    """Where a camera stands, what it looks at (3,), and between which distances it sees (m)."""

    eye_m: Array
    target_m: Array
    near_m: float
    far_m: float


class Studio:
    """Things that stay loaded while poses and views change; made by `studio`."""

    def __init__(self, bullet: Any, client: int, things: Sequence[tuple["trimesh.Trimesh", Colour]]) -> None:
        self._bullet, self._client = bullet, client
        self._creases_mm = [creases(mesh) for mesh, _ in things]
        self._colours = [colour for _, colour in things]
        self._ids = [self._load(mesh, colour) for mesh, colour in things]

    def picture(
        self,
        poses: Sequence[Array | None],
        size: tuple[int, int],
        view: View,
        frame_m: Array,
        pale: Sequence[bool] | None = None,
    ) -> Image.Image:
        """Return a picture.

        Parameters
        ----------
        poses
            The pose (4, 4) of every thing in the world, translations in m, meshes in mm; None leaves it out.
        size
            Width and height in pixels.
        view
            From where.
        frame_m
            Points (n, 3) that the picture shall hold.
        pale
            Which things are only hinted at.
        """
        bullet, (width, height) = self._bullet, (SUPERSAMPLING * side for side in size)
        self._place([AWAY if pose is None else pose for pose in poses])
        for number, colour, hinted in zip(self._ids, self._colours, pale or [False] * len(poses), strict=True):
            self._paint(number, PALE if hinted else colour)
        camera = aimed(frame_m, view, width / height)
        eyes = bullet.computeViewMatrix(camera.eye_m.tolist(), camera.target_m.tolist(), [0, 0, 1])
        lens = bullet.computeProjectionMatrixFOV(FIELD_OF_VIEW_DEG, width / height, camera.near_m, camera.far_m)
        pixels, depth, owner = bullet.getCameraImage(
            width, height, eyes, lens, lightDirection=LIGHT, lightDistance=10.0, shadow=0, lightAmbientCoeff=0.6,
            lightDiffuseCoeff=0.45, lightSpecularCoeff=0.05, renderer=bullet.ER_TINY_RENDERER,
            physicsClientId=self._client,
        )[2:]  # fmt: skip
        image = np.reshape(pixels, (height, width, 4))[:, :, :3].astype(np.uint8)
        owner = np.reshape(owner, (height, width))
        image[owner < 0] = BACKGROUND
        matrix = np.reshape(lens, (4, 4)).T @ np.reshape(eyes, (4, 4)).T
        ink = borders(owner)
        seen = _farthest_beside(np.reshape(depth, (height, width)))
        for ends, pose in zip(self._creases_mm, poses, strict=True):
            if pose is None:
                continue
            _draw(ink, ends * MM @ pose[:3, :3].T + pose[:3, 3], matrix, seen, camera)
        image[ink] = image[ink] + EDGE_STRENGTH * (EDGE_COLOUR - image[ink])
        return Image.fromarray(image).resize(size, Image.Resampling.BOX)

    def _load(self, mesh: "trimesh.Trimesh", colour: Colour) -> int:
        """Load a mesh with a vertex for every normal that a corner needs."""
        bullet = self._bullet
        vertices, normals, faces = creased(mesh)
        shape = bullet.createVisualShape(
            bullet.GEOM_MESH,
            vertices=(vertices * MM).tolist(),
            indices=faces.ravel().tolist(),
            normals=normals.tolist(),
            rgbaColor=[*colour, 1.0],
            physicsClientId=self._client,
        )
        return int(bullet.createMultiBody(0.0, -1, shape, physicsClientId=self._client))

    def _place(self, poses: Sequence[Array]) -> None:
        stacked = np.array(poses)
        turns = Rotation.from_matrix(stacked[:, :3, :3]).as_quat().tolist()
        for number, place, turn in zip(self._ids, stacked[:, :3, 3].tolist(), turns, strict=True):
            self._bullet.resetBasePositionAndOrientation(number, place, turn, physicsClientId=self._client)

    def _paint(self, number: int, colour: Colour) -> None:
        self._bullet.changeVisualShape(number, -1, rgbaColor=[*colour, 1.0], physicsClientId=self._client)


@contextmanager
def studio(things: Sequence[tuple["trimesh.Trimesh", Colour]]) -> Iterator[Studio]:
    """Open a studio with things, each a mesh (mm) and a colour.

    Raises
    ------
    JumpcadError
        If PyBullet is not installed.
    """
    bullet = import_pybullet()
    client = bullet.connect(bullet.DIRECT)
    try:
        yield Studio(bullet, client, things)
    finally:
        bullet.disconnect(client)


def aimed(frame_m: Array, view: View, aspect: float) -> Camera:
    """Return the camera that sees points (n, 3) in a picture of a width over height."""
    back = view.direction
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back])
    along = frame_m @ axes.T
    low, high = along.min(axis=0), along.max(axis=0)
    half_width, half_height, half_depth = MARGIN * (high - low) / 2.0
    slope = math.tan(math.radians(FIELD_OF_VIEW_DEG / 2.0))
    distance = max(half_height, half_width / aspect) / slope + half_depth
    target = (low + high) / 2.0 @ axes
    return Camera(target + distance * back, target, distance - 1.5 * half_depth, distance + 1.5 * half_depth)


def distance_m(depth: Array, camera: Camera) -> Array:
    """Return the distance along the view of a depth buffer's values (0…1, OpenGL's convention)."""
    near, far = camera.near_m, camera.far_m
    return far * near / (far - (far - near) * depth)


def creases(mesh: "trimesh.Trimesh") -> Array:
    """Return the ends (n, 2, 3) of the edges at which a mesh is creased (mm)."""
    sharp = mesh.face_adjacency_angles > CREASE_RAD
    return np.asarray(mesh.vertices[mesh.face_adjacency_edges[sharp]], dtype=float)


def borders(owner: npt.NDArray[np.int_]) -> Mask:
    """Return the pixels at which one thing (or the background) ends and another begins."""
    mask = np.zeros(owner.shape, dtype=bool)
    mask[:, 1:] |= owner[:, 1:] != owner[:, :-1]
    mask[1:, :] |= owner[1:, :] != owner[:-1, :]
    return mask


def _farthest_beside(depth: Array) -> Array:
    """Return for every pixel the greatest depth within one pixel of it."""
    for _ in range(2):
        wide = depth.copy()
        np.maximum(wide[1:], depth[:-1], out=wide[1:])
        np.maximum(wide[:-1], depth[1:], out=wide[:-1])
        depth = wide.T
    return depth


def _draw(ink: Mask, ends_m: Array, matrix: Array, depth: Array, camera: Camera) -> None:
    """Ink the pixels of edges (n, 2, 3) that nothing hides, by what depth is seen at every pixel."""
    height, width = ink.shape
    clip = np.concatenate([ends_m, np.ones((*ends_m.shape[:2], 1))], axis=2) @ matrix.T
    distance = clip[..., 3]
    pixel = (clip[..., :2] / distance[..., None] * [0.5, -0.5] + 0.5) * [width, height]
    count = np.ceil(np.abs(pixel[:, 1] - pixel[:, 0]).max(axis=1, initial=0.0)).astype(int) + 1
    which = np.repeat(np.arange(len(ends_m)), count)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / np.repeat(count, count)
    # perspective: what moves evenly across the picture is the inverse of distance
    x, y = (pixel[which, 0] + share[:, None] * (pixel[which, 1] - pixel[which, 0])).astype(int).T
    near = 1.0 / (1.0 / distance[which, 0] + share * (1.0 / distance[which, 1] - 1.0 / distance[which, 0]))
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    x, y, near = x[inside], y[inside], near[inside]
    seen = near <= distance_m(depth[y, x], camera) + EDGE_DEPTH_M
    ink[y[seen], x[seen]] = True
