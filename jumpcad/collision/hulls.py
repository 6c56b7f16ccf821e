"""Convex hulls of what is there, and capsules along the cage: the collision shapes of a robot's bodies.

From the hull of all of it follow the poses in which a wound robot lies still: a quick look at righting itself.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.mass import combined
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Mechanism, body_poses
from jumpcad.robot.cage.limits import ring_n_per_mm
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array, Trimesh, chained

SOLE_MM = 0.5
"""How far the foot's hull stays above its sole, so that a standing robot stands on its contact spheres alone."""
CAGE = "cage_"
"""Begins the names of all parts of a cage."""
DIGITS = 4
"""Of a corner's coordinates (mm)."""
CORNERS, OF_FACE, FLAT_MM = 32, 12, 0.001
"""Most corners of a hull, and of one of its faces, which are so flat: MJX takes 20 of a face, and time for each."""


def body_hulls(mechanism: Mechanism, visible: Sequence[Visual]) -> dict[str, Trimesh]:
    """Return a hull of few corners of each body's parts in its own frame (mm), without the cage; none without parts."""
    from trimesh.convex import convex_hull

    found = {}
    for body in BODY_NAMES:
        placed = [
            shape.mesh.vertices @ shape.T_body_mesh[:3, :3].T + 1000.0 * shape.T_body_mesh[:3, 3]
            for shape in visible
            if shape.body == body and not shape.name.startswith(CAGE)
        ]
        if not placed:
            continue
        corners = np.concatenate(placed)
        if body == FOOT:
            corners[:, 2] = np.maximum(corners[:, 2], SOLE_MM - 1000.0 * mechanism.foot_depth_m)
        found[body] = convex_hull(_few(np.asarray(convex_hull(np.unique(np.round(corners, DIGITS), axis=0)).vertices)))
    return found


def _few(corners: Array) -> Array:
    """Return few of a hull's corners, the farthest out first; of a template the others are at most 2.5 mm outside."""
    from scipy.spatial import ConvexHull

    ways = np.array([way for way in itertools.product((-1.0, 0.0, 1.0), repeat=3) if sum(map(abs, way)) in (1, 3)])
    chosen = sorted(set(np.round(corners @ ways.T, DIGITS).argmax(axis=0)))
    while len(chosen) < CORNERS:
        planes = ConvexHull(corners[chosen]).equations
        beyond = np.round(corners @ planes[:, :3].T + planes[:, 3], DIGITS)
        full = (beyond[chosen] > -FLAT_MM).sum(axis=0) >= OF_FACE
        outside = np.where((abs(beyond[:, full]) < FLAT_MM).any(axis=1), 0.0, beyond.max(axis=1))
        if outside.max() <= 0.0:
            break
        chosen.append(outside.argmax())
    return corners[chosen]


def quick_corners_mm(thing: Visual) -> Array:
    """Return points (n, 3) that span a part's convex hull in its own frame, without its mesh.

    Exact for stacks; of other shapes they are the outline at bottom and top, or the bounding box.
    """
    shape = thing.shape
    if isinstance(shape, DrawnWire):
        return 1000.0 * thing.corners_m
    if isinstance(shape, Stack):
        slabs = [(slab.region.hull().to_polygons()[0], slab.z0_mm, slab.z1_mm) for slab in shape.slabs]
    else:
        slabs = [(shape.outline_mm, *shape.bounds_mm[:, 2])]
    return np.concatenate([np.column_stack([flat, np.full(len(flat), z)]) for flat, *heights in slabs for z in heights])


@dataclass(frozen=True)
class Capsule:
    """A cylinder with rounded ends: its ends (3,) and radius (m), in its body's frame; `n_per_m` is how stiff it is."""

    start_m: Array
    end_m: Array
    radius_m: float
    n_per_m: float = math.inf

    @property
    def length_m(self) -> float:
        """From end to end."""
        return math.dist(self.start_m, self.end_m)

    @property
    def rpy(self) -> tuple[float, float, float]:
        """Roll, pitch, yaw that turn the z axis along it."""
        x, y, z = self.end_m - self.start_m
        return 0.0, math.atan2(math.hypot(x, y), z), math.atan2(y, x)


def cage_capsules(mechanism: Mechanism) -> list[Capsule]:
    """Return the cage as capsules in the body's frame, along the pieces of its rods and along its bars."""
    cage = mechanism.layout.of(Cage) if isinstance(mechanism, Robot) else None
    if cage is None:
        return []
    found = []
    for arc in cage.arcs:
        points = np.round(arc.points_mm, DIGITS) / 1000.0
        radius = cage.rod.diameter_mm / 2000.0
        stiffness = 1000.0 * ring_n_per_mm(cage.rod, arc.radius_mm)
        found += [Capsule(one, other, radius, stiffness) for one, other in itertools.pairwise(points)]
    for bar in cage.bars:
        along = (bar.reach_mm(cage.socket_mm) - cage.socket_mm / 2.0) * bar.T_body_bar[:3, 0]
        ends = np.round(bar.T_body_bar[:3, 3] + np.array([-along, along]), DIGITS) / 1000.0
        found.append(Capsule(ends[0], ends[1], cage.socket_mm / 2000.0))
    return found


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
    whole = combined(body.placed(poses[name]) for name, body in robot.bodies.items())
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
