"""Length, width and height of a standing robot."""

import numpy as np

from jumpcad.mechanism.poses import body_poses
from jumpcad.parts.part import Shape
from jumpcad.robot import Robot
from jumpcad.transforms import Array, chained, in_metres


def extent_m(robot: Robot) -> Array:
    """Return length, width and height (3,) of a robot that stands with its springs at rest, bought parts included (m).

    Every part counts with its whole outline over its whole height: exact for a part of one outline, an upper bound for
    others; 0.006 mm too large in the templates, where a pad at the nose is the farthest point.
    """
    poses = body_poses(robot)
    pieces: list[tuple[Shape, str, Array]] = [(item.shape, item.body, item.T_body_part) for item in robot.hardware]
    for part in robot.parts:
        pieces += [(part.drawing.shape, place.body, place.T_body_part) for place in part.placements]
    corners = [_corners_m(shape, chained(poses[body], in_metres(pose))) for shape, body, pose in pieces]
    low, high = np.min([one[0] for one in corners], axis=0), np.max([one[1] for one in corners], axis=0)
    return np.asarray(high - low)


def _corners_m(shape: Shape, T_world_part: Array) -> Array:
    """Return lower and upper corner (2, 3) of a shape's bounding box in the world (m)."""
    flat = np.einsum("ij,nj->ni", T_world_part[:3, :2], shape.outline_mm) / 1000.0
    upright = np.outer(shape.bounds_mm[:, 2], T_world_part[:3, 2]) / 1000.0
    middle = T_world_part[:3, 3]
    return np.stack([middle + flat.min(axis=0) + upright.min(axis=0), middle + flat.max(axis=0) + upright.max(axis=0)])
