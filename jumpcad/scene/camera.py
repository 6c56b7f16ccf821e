"""The camera of a picture: its position, its axes, and the perspective projection of points."""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.transforms import Array

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
    result: Array = np.einsum("...j,kj->...k", vectors, rotation)
    return result
