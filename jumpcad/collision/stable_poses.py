"""The poses in which a wound robot lies still, from the convex hull of all of it: a quick look at righting itself."""

import math

import numpy as np

from jumpcad.collision.hulls import CAGE, cage_capsules, quick_corners_mm
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import Array, chained

UPRIGHT = math.cos(math.radians(20.0))
SHIFTS_M = ((0.0, 0.0, 0.003), (0.004, 0.0, 0.0), (-0.004, 0.0, 0.0), (0.0, 0.002, 0.0), (0.0, -0.002, 0.0))
"""By how much the centre of mass may lie elsewhere, up, along and across; judgement: a circle around it is neutral."""


def share_on_feet(robot: Robot) -> float:
    """Return the probability that the loaded robot, put down in any attitude, lies on its feet.

    Quasi-static probabilities (Goldberg et al., Part pose statistics, 1999). With a cage the winding robot does as
    well or better; without one it winds where it lies, and does worse.
    """
    return _share(*_loaded(robot))


def least_share_on_feet(robot: Robot) -> float:
    """Return the least such probability over shifts of the centre of mass by a few millimetres."""
    points, centre, up = _loaded(robot)
    return min(_share(points, centre + np.array(shift), up) for shift in ((0.0, 0.0, 0.0), *SHIFTS_M))


def _loaded(robot: Robot) -> tuple[Array, Array, Array]:
    """Return corners of the loaded robot's hull (n, 3), its centre of mass, and the foot's upward direction (m)."""
    poses = body_poses(robot, 1.0)
    placed = [
        _moved(chained(poses[thing.body], thing.T_body_mesh), quick_corners_mm(thing) / 1000.0)
        for thing in visuals(robot)
        if not thing.name.startswith(CAGE)
    ]
    cage = [end for capsule in cage_capsules(robot) for end in (capsule.start_m, capsule.end_m)]
    placed.append(_moved(poses[BODY], np.reshape(cage, (-1, 3))))
    whole = combined(
        MassProperties(body.mass_kg, body.com_m, body.inertia_kg_m2).placed(poses[name])
        for name, body in robot.bodies.items()
    )
    return np.concatenate(placed), whole.com_m, poses[FOOT][:3, 2]


def _moved(pose: Array, points: Array) -> Array:
    return points @ pose[:3, :3].T + pose[:3, 3]


def _share(points: Array, centre: Array, up: Array) -> float:
    """Return the share of attitudes of a convex body from which it rolls onto its feet.

    A facet is met as often as the centre sees it (its solid angle, Van Oosterom and Strackee 1983). The body rolls over
    the edge beyond which the centre's foot lies, from facet to facet, until that foot lies within one.
    """
    from scipy.spatial import ConvexHull

    hull = ConvexHull(points - centre)
    corners, normals, heights = hull.points[hull.simplices], hull.equations[:, :3], -hull.equations[:, 3]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    volume = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c)))
    dots = [np.einsum("ij,ij->i", one, other) * length for one, other, length in ((a, b, lc), (a, c, lb), (b, c, la))]
    angles = np.mod(2.0 * np.arctan2(volume, la * lb * lc + sum(dots)), 2.0 * math.pi) / (4.0 * math.pi)
    below = normals * heights[:, None]
    turn = np.sign(np.einsum("ij,ij->i", np.cross(b - a, c - a), normals))
    inside = np.empty((len(corners), 3))  # distance of the centre's foot from the edge opposite to a corner
    for corner in range(3):
        start, end = corners[:, (corner + 1) % 3], corners[:, (corner + 2) % 3]
        along = (end - start) / (np.linalg.norm(end - start, axis=1)[:, None] + 1e-12)
        inside[:, corner] = turn * np.einsum("ij,ij->i", np.cross(along, below - start), normals)
    rows = np.arange(len(corners))
    after = np.where((inside >= -1e-9).all(axis=1), rows, hull.neighbors[rows, inside.argmin(axis=1)])
    ends = rows
    for _ in range(len(rows).bit_length()):  # twice as far each time
        after = after[after]
    ends = after
    return float(angles[-(normals[ends] @ up) > UPRIGHT].sum())
