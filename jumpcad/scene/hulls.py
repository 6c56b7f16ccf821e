"""Convex hulls of what is there, and capsules along the cage: the collision shapes of a robot's bodies."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, FOOT, Mechanism
from jumpcad.robot import Robot
from jumpcad.scene.visuals import Visual
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.strength.cage import ring_n_per_mm
from jumpcad.transforms import Array

if TYPE_CHECKING:
    import trimesh

SOLE_MM = 0.5
"""How far the foot's hull stays above its sole, so that a standing robot stands on its contact spheres alone."""
CAGE = "cage_"
"""Begins the names of all parts of a cage."""
DIGITS = 4
"""Of a corner's coordinates (mm)."""
CORNERS, OF_FACE, FLAT_MM = 32, 12, 0.001
"""Most corners of a hull, and of one of its faces, which are so flat: MJX takes 20 of a face, and time for each."""


def body_hulls(mechanism: Mechanism, visible: Sequence[Visual]) -> "dict[str, trimesh.Trimesh]":
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
    cage = mechanism.layout.cage if isinstance(mechanism, Robot) else None
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
