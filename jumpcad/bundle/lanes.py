"""Robots that jump side by side to one scale: outlines and poses from the side, for a page without network."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from jumpcad.mechanism.poses import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array

SHOWN_S, TICK_MM, EDGE_MM, RULER_MM = 4.0, 100, 12.0, 36
"""Time in which the shortest jump is shown, distance of the ruler's marks, room about what is drawn, and below the
ground; judgement."""
MOST_FRAMES = 160
"""Largest number of poses that are kept of a motion; judgement: more are not seen."""


@dataclass(frozen=True)
class Lane:
    """A robot's lane: its parts' outlines by body, and its poses in time, seen from the right (mm, y down).

    `outlines` are paths and colours by body, the farthest first. `poses` (n, b, 3) are x, y and the turn (°, clockwise)
    of each body's frame at `time_s` (n,), `path` the way of the centre of mass (n, 2), `low` and `high` (2,) the
    corners of all that is drawn.
    """

    label: str
    outlines: dict[str, list[tuple[str, str]]]
    time_s: list[float]
    poses: Array
    path: list[list[float]]
    low: Array
    high: Array


def lane(label: str, robot: Robot, trajectory: Trajectory | None) -> Lane:
    """Return the lane of a robot up to where it touches the ground; without a trajectory it stands loaded."""
    names = tuple(robot.bodies)
    if trajectory is None:
        standing = body_poses(robot, 1.0)
        matrices = np.array([[standing[name] for name in names]])
        times, places = [0.0], matrices[:, :, :3, 3]
        turns = np.arctan2(matrices[:, :, 0, 2], matrices[:, :, 0, 0])
    else:
        names = trajectory.body_names
        every = np.arange(len(trajectory.time_s))[:: -math.ceil(len(trajectory.time_s) / MOST_FRAMES)][::-1]
        times = np.round(trajectory.time_s[every], 5).tolist()
        places, quaternions = trajectory.position_m[every], trajectory.quaternion_xyzw[every]
        turns = 2.0 * np.arctan2(quaternions[:, :, 1], quaternions[:, :, 3])
    poses = np.stack([1000.0 * places[:, :, 0], -1000.0 * places[:, :, 2], np.degrees(turns)], axis=2)
    drawn = _outlines(robot)
    corners, centres = [], []
    for index, name in enumerate(names):
        com_mm = 1000.0 * robot.bodies[name].com_m[[0, 2]] * (1.0, -1.0)
        every_mm, turn = np.concatenate([com_mm[None], *(part for _, part, _ in drawn[name])]), turns[:, index, None]
        x = np.cos(turn) * every_mm[:, 0] - np.sin(turn) * every_mm[:, 1] + poses[:, index, :1]
        y = np.sin(turn) * every_mm[:, 0] + np.cos(turn) * every_mm[:, 1] + poses[:, index, 1:2]
        corners.append(np.stack([x, y], axis=2))
        centres.append(corners[-1][:, 0])
    path = np.average(centres, axis=0, weights=[robot.bodies[name].mass_kg for name in names])
    outlines = {
        name: [
            ("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in outline) + "Z", colour) for _, outline, colour in drawn[name]
        ]
        for name in names
    }
    corner = np.concatenate(corners, axis=1).reshape(-1, 2)
    way = np.round(path, 1).tolist()
    return Lane(label, outlines, times, poses, way, corner.min(axis=0), corner.max(axis=0))


def lanes_values(lanes: Sequence[Lane]) -> dict[str, Any]:
    """Return what the page needs of all lanes: one box for each, a ruler, and the motions as JSON."""
    left = math.floor(min(one.low[0] for one in lanes) - EDGE_MM)
    right = math.ceil(max(one.high[0] for one in lanes) + EDGE_MM)
    shortest = min((one.time_s[-1] for one in lanes if len(one.time_s) > 1), default=1.0)
    moving = [{"t": one.time_s, "poses": np.round(one.poses, 2).tolist()} for one in lanes]
    data = {"end": max(one.time_s[-1] for one in lanes), "slower": SHOWN_S / shortest, "lanes": moving}
    return {
        "lanes": lanes,
        "left": left,
        "width": right - left,
        "tops": [math.floor(one.low[1] - EDGE_MM) for one in lanes],
        "ruler": RULER_MM,
        "ticks": range(TICK_MM * math.ceil(left / TICK_MM), right + 1, TICK_MM),
        "slower": SHOWN_S / shortest,
        "data": json.dumps(data, separators=(",", ":")),
    }


def _outlines(robot: Robot) -> dict[str, list[tuple[float, Array, str]]]:
    """Return how far to the left each part is, its convex outline (n, 2) (mm, y down) and colour, by body."""
    found: dict[str, list[tuple[float, Array, str]]] = {name: [] for name in robot.bodies}
    for thing in visuals(robot):
        pose = thing.T_body_mesh
        corners = thing.mesh.vertices @ pose[:3, :3].T + 1000.0 * pose[:3, 3]
        flat = corners[:, [0, 2]] * (1.0, -1.0)
        colour = "#" + "".join(f"{round(255.0 * share):02x}" for share in thing.colour)
        found[thing.body].append((float(corners[:, 1].mean()), flat[ConvexHull(flat).vertices], colour))
    return {name: sorted(parts, key=lambda part: -part[0]) for name, parts in found.items()}
