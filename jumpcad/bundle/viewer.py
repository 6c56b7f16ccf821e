"""What moves on pages without network: the 3-D viewer of report.html, and robots that jump side by side.

The viewer is its data, the robot's GLB file and its program, as elements of the page. Lanes are outlines and poses from
the side, to one scale.
"""

import base64
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.motion import motion, series_motion
from jumpcad.bundle.renders import exploded
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import templates_folder
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.mechanism.model import body_poses
from jumpcad.parts.part import Part
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, extent_m, visuals
from jumpcad.simulation.jump import Jump, Trajectory
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.transforms import Array, chained

MICRONS = 6
"""Decimals of lengths in m."""
CELL_MM = 50
"""Distance of the lines of the ground; judgement: a third of a robot."""


def viewer_values(robot: Robot, jump: Jump, glb: bytes, series: Series | Trip | None = None) -> dict[str, Any]:
    """Return what `templates/report/viewer.html.j2` needs: data, GLB file and program."""
    return {
        "cell_mm": CELL_MM,
        "data": _embedded(viewer_data(robot, jump, series)),
        "glb": base64.b64encode(glb).decode(),
        "program": (templates_folder() / "report" / "viewer.min.js").read_text(encoding="ascii"),
    }


def viewer_data(robot: Robot, jump: Jump, series: Series | Trip | None = None) -> dict[str, Any]:
    """Return the viewer's data: motion, turning parts, parts' labels, assembly steps, offsets when exploded (SI).

    The motion is that of a jump, or of recorded jumps in a row or on a course.
    """
    things = visuals(robot)
    bodies = body_poses(robot)
    poses = [chained(bodies[thing.body], thing.T_body_mesh) for thing in things]
    apart = [after[:3, 3] - before[:3, 3] for before, after in zip(poses, exploded(things, poses), strict=True)]
    moved = series_motion(robot, series) if series else motion(robot, jump.trajectory, jump.takeoff_time_s)
    return moved | {
        "size_m": round(float(extent_m(robot).max()), MICRONS),
        "cell_m": CELL_MM / 1000.0,
        "turning": turning_parts(robot),
        "explode_m": {
            thing.name: round(float(offset[1]), MICRONS) for thing, offset in zip(things, apart, strict=True)
        },
        "steps": [
            {"title": step.title, "parts": [shape.name for shape in step.added]} for step in assembly_steps(robot)
        ],
        "parts": parts_facts(robot),
    }


def turning_parts(robot: Robot) -> list[dict[str, Any]]:
    """Return the turning parts: node, axis (x, z) in the body's frame (m), turns per turn of the cam."""
    layout = robot.layout
    stages = layout.drive.train.stages
    turns = {"cam": (layout.cam_axis_mm, 1.0), "cam_gear": (layout.cam_axis_mm, 1.0)}
    rate = 1.0
    if layout.idler_mm is not None:
        rate *= -stages[-1].wheel.teeth / stages[-1].pinion.teeth
        turns["idler"] = (layout.idler_mm, rate)
    rate *= -stages[0].wheel.teeth / stages[0].pinion.teeth
    turns["motor_pinion"] = turns["motor_shaft"] = (layout.motor_mm, rate)
    return [
        {"node": node, "axis_m": np.round(axis / 1000.0, MICRONS).tolist(), "per_cam": round(rate, MICRONS)}
        for node, (axis, rate) in turns.items()
    ]


def parts_facts(robot: Robot) -> dict[str, dict[str, Any]]:
    """Return what a click on a part shows: label, material or article, file, and mass (g), by the name in the picture.

    Of what is bought in one piece and seen as several that move apart, such as a spring and its second arm, the words
    also have the mass of the whole in the bill of materials: a scale shows that.
    """
    seen_apart = {thing.article for thing in robot.hardware if thing.units == 0}
    whole_kg = {line.name: line.mass_kg for line in bill_of_materials(robot).items if line.name in seen_apart}
    return {thing.name: _facts(thing, whole_kg) for thing in visuals(robot)}


def _facts(thing: Visual, whole_kg: Mapping[str, float]) -> dict[str, Any]:
    source = thing.source
    if isinstance(source, Part):
        words = {"label": source.name.replace("_", " "), "material": source.material, "file": f"stl/{source.name}.stl"}
    else:
        whole = f"; as bought {1000.0 * whole_kg[source.article]:.2f} g" if source.article in whole_kg else ""
        words = {"label": thing.name.replace("_", " "), "material": f"{source.article}{whole}", "file": ""}
    return {key: allowed(value) for key, value in words.items()} | {"mass_g": round(1000.0 * source.mass.mass_kg, 3)}


def _embedded(data: dict[str, Any]) -> str:
    """Return JSON that may be part of HTML and of XML: without `<`, `>` and `&`."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")


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
        "lanes": lanes, "left": left, "width": right - left,
        "tops": [math.floor(one.low[1] - EDGE_MM) for one in lanes], "ruler": RULER_MM,
        "ticks": range(TICK_MM * math.ceil(left / TICK_MM), right + 1, TICK_MM), "slower": SHOWN_S / shortest,
        "data": json.dumps(data, separators=(",", ":")),
    }  # fmt: skip


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
