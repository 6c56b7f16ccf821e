"""Length, width and height of a standing robot."""

from collections.abc import Iterable

import numpy as np

from jumpcad.mechanism.poses import body_poses
from jumpcad.parts.part import Shape
from jumpcad.robot.robot import Robot
from jumpcad.transforms import Array, chained, in_metres

ROUND_OFF_M = 1e-9
"""Larger than the error of a placed bounding box."""


def extent_m(robot: Robot) -> Array:
    """Return length, width and height (3,) of a robot that stands with its springs at rest, bought parts included (m).

    Every part counts with its whole outline over its whole height: exact for a part of one outline, an upper bound for
    others; 0.006 mm too large in the templates, where a pad at the nose is the farthest point.
    """
    poses = body_poses(robot)
    pieces: list[tuple[Shape, str, Array]] = [(item.shape, item.body, item.T_body_part) for item in robot.hardware]
    for part in robot.parts:
        pieces += [(part.drawing.shape, place.body, place.T_body_part) for place in part.placements]
    of_bodies, of_pieces = np.array([poses[body] for _, body, _ in pieces]), np.array([pose for *_, pose in pieces])
    boxes = _boxes_m(np.array([shape.bounds_mm for shape, *_ in pieces]), of_bodies, of_pieces)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)

    def reach(numbers: Iterable[int]) -> None:
        for number in numbers:
            if (boxes[number, 0] < low).any() or (boxes[number, 1] > high).any():
                shape, body, pose = pieces[number]
                corners = _corners_m(shape, chained(poses[body], in_metres(pose)))
                np.minimum(low, corners[0], out=low)
                np.maximum(high, corners[1], out=high)

    first = dict.fromkeys([*boxes[:, 0].argmin(axis=0).tolist(), *boxes[:, 1].argmax(axis=0).tolist()])
    reach(first)
    # few boxes reach beyond these
    beyond = np.flatnonzero((boxes[:, 0] < low).any(axis=1) | (boxes[:, 1] > high).any(axis=1)).tolist()
    reach(number for number in beyond if number not in first)
    return np.asarray(high - low)


def _boxes_m(bounds_mm: Array, T_world_body: Array, T_body_part: Array) -> Array:
    """Return boxes (n, 2, 3) in the world (m) that contain bounding boxes (n, 2, 3) (mm).

    Bodies' poses (n, 4, 4) are in m, those of the parts in mm.
    """
    T_world_part = np.einsum("nij,njk->nik", T_world_body[:, :3, :3], T_body_part[:, :3])
    middle, half = bounds_mm.mean(axis=1), (bounds_mm[:, 1] - bounds_mm[:, 0]) / 2000.0
    rotation = T_world_part[:, :, :3]
    centre = T_world_part[:, :, 3] + np.einsum("nij,nj->ni", rotation, middle)
    centre = T_world_body[:, :3, 3] + centre / 1000.0
    reach = np.einsum("nij,nj->ni", np.abs(rotation), half) + ROUND_OFF_M
    return np.stack([centre - reach, centre + reach], axis=1)


def _corners_m(shape: Shape, T_world_part: Array) -> Array:
    """Return lower and upper corner (2, 3) of a shape's bounding box in the world (m)."""
    flat = np.einsum("ij,nj->ni", T_world_part[:3, :2], shape.outline_mm).T.copy() / 1000.0  # rows are quicker
    upright = np.outer(shape.bounds_mm[:, 2], T_world_part[:3, 2]) / 1000.0
    middle = T_world_part[:3, 3]
    return np.stack([middle + flat.min(axis=1) + upright.min(axis=0), middle + flat.max(axis=1) + upright.max(axis=0)])
