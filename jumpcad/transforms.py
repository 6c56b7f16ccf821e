"""Arrays, rotations and poses: one sign convention for all turns.

Frames follow REP-103 (x forward, y left, z up). The mechanism is planar: a positive angle turns about +y, from z
towards x, so that a vector that points forwards turns downwards. Poses are (4, 4) matrices `T_a_b` that take points of
frame b to frame a. Products of small matrices are sums (`einsum`) and not calls to BLAS, whose last digits depend on
the processor: the same robot has the same bytes everywhere.
"""

import math
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from trimesh import Trimesh as Trimesh
else:  # it takes 0.3 s, and masses need no mesh
    Trimesh = Any

Array = npt.NDArray[np.float64]


class ByValue:
    """A dataclass, with `eq=False`, whose fields may be arrays: two are equal where all fields are, arrays by value."""

    def __eq__(self, other: object) -> bool:
        return same_by_value(self, other) if type(other) is type(self) else NotImplemented

    def __hash__(self) -> int:
        return hash((type(self).__name__, *(one for one in _compared(self) if isinstance(one, str | int | float))))


def same_by_value(one: Any, other: Any) -> bool:
    """Tell whether two things are equal; arrays, and dataclasses that compare by identity, are by what is in them."""
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    if type(one) is not type(other):
        return bool(one == other)
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same_by_value(value, other[key]) for key, value in one.items())
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same_by_value, one, other))
    if is_dataclass(one):
        return all(map(same_by_value, _compared(one), _compared(other)))
    return bool(one == other)


def _compared(data: Any) -> list[Any]:
    return [getattr(data, field.name) for field in fields(data) if field.compare]


def direction(angle_rad: npt.ArrayLike) -> Array:
    """Return unit vectors (..., 2) in x-z that point `angle_rad` (...) below the x axis."""
    angle = np.asarray(angle_rad, dtype=float)
    return np.stack([np.cos(angle), -np.sin(angle)], axis=-1)


def turned_about_y(vector: npt.ArrayLike, angle_rad: npt.ArrayLike) -> Array:
    """Return x-z vectors (..., 2) turned about +y by angles (...)."""
    vector, angle = np.asarray(vector, dtype=float), np.asarray(angle_rad, dtype=float)
    cos, sin = np.cos(angle), np.sin(angle)
    x, z = vector[..., 0], vector[..., 1]
    return np.stack([cos * x + sin * z, cos * z - sin * x], axis=-1)


def rotation_about_y(angle_rad: float) -> Array:
    """Return the rotation (3, 3) about y, from its quaternion."""
    w, _, y, _ = quaternion_about_y(angle_rad)
    cos, sin = w * w - y * y, 2.0 * y * w
    return np.array([[cos, 0.0, sin], [0.0, w * w + y * y, 0.0], [-sin, 0.0, cos]])


def quaternion_about_y(angle_rad: float) -> tuple[float, float, float, float]:
    """Return the quaternion (w, x, y, z) of a turn about y."""
    return math.cos(angle_rad / 2), 0.0, math.sin(angle_rad / 2), 0.0


def pose_at(rotation: Array, translation: npt.ArrayLike) -> Array:
    """Return the pose (4, 4) of a rotation (3, 3) and a translation (3,)."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, translation
    return matrix


def pose_about_y(angle_rad: float, place: npt.ArrayLike) -> Array:
    """Return the pose (4, 4) of a turn about +y, then a move to a place (2,) in x-z."""
    cos, sin = math.cos(angle_rad), math.sin(angle_rad)
    x, z = np.asarray(place, dtype=float)
    return np.array([[cos, 0.0, sin, x], [0.0, 1.0, 0.0, 0.0], [-sin, 0.0, cos, z], [0.0, 0.0, 0.0, 1.0]])


def pose_about_z(angle_rad: float) -> Array:
    """Return the pose (4, 4) of a turn about +z, counter-clockwise seen from above."""
    matrix = np.eye(4)
    matrix[:2, :2] = [[np.cos(angle_rad), -np.sin(angle_rad)], [np.sin(angle_rad), np.cos(angle_rad)]]
    return matrix


def chained(T_a_b: Array, T_b_c: Array) -> Array:
    """Return the pose `T_a_c` (4, 4) of two poses, one after the other."""
    return np.asarray(np.einsum("ij,jk->ik", T_a_b, T_b_c))


def in_metres(pose_mm: Array) -> Array:
    """Return a pose (4, 4) with its translation in metres instead of millimetres."""
    metres = pose_mm.copy()
    metres[:3, 3] /= 1000.0
    return metres
