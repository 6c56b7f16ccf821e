"""The 3-D viewer of report.html: its data, the robot's GLB file and its program, as elements of the page."""

import base64
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.motion import motion, series_motion
from jumpcad.bundle.renders import exploded
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import templates_folder
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.mechanism.poses import body_poses
from jumpcad.parts.part import Part
from jumpcad.robot.robot import Robot
from jumpcad.scene.extent import extent_m
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.simulation.jump import Jump
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.transforms import chained

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
