"""The bundle: one folder with everything that a robot is made, printed and simulated from.

The same robot gives the same bytes.
"""

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from jumpcad.bundle.bom import bill_of_materials, mass_facts, write_bom
from jumpcad.bundle.folder import write_folder
from jumpcad.bundle.guide import write_guide
from jumpcad.bundle.manifest import Bundle
from jumpcad.bundle.page import write_report
from jumpcad.bundle.renders import RENDERS, all_pictures
from jumpcad.dimensions import MESH_FOLDER
from jumpcad.errors import JumpcadError
from jumpcad.exporters.dxf import write_dxfs
from jumpcad.exporters.glb import write_glb
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.exporters.sdf import write_sdf
from jumpcad.exporters.step import require_step, write_step
from jumpcad.exporters.threemf import write_threemf
from jumpcad.exporters.urdf import write_loop, write_urdf
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.solids.finish import require_part
from jumpcad.solids.stl import write_stl

NAME = re.compile(r"\w([\w .+-]*[\w+-])?")
LONGEST_NAME = 200
"""Bytes of a robot's name: file systems allow 255 for a name with all that is put before and after it."""


def export(robot: Robot, folder: str | Path, pictures: bool = True, step: bool = False, force: bool = False) -> Bundle:
    """Write a robot's bundle.

    Parameters
    ----------
    robot
        With its parts, from `build`.
    folder
        Is made, with its parents; may be empty or hold an older bundle of the robot. The files that it lists are
        replaced; what a user added stays.
    pictures
        Whether to draw the robot, which takes a quarter of the time.
    step
        Whether to write STEP files too; needs the extra `step`.
    force
        Whether to replace another bundle too, and files that a user edited or added under a name of ours.

    Raises
    ------
    JumpcadError
        If the folder holds anything else, if something of a user's would be lost, if it cannot be written, or if the
        extra for STEP is missing.
    """
    if not NAME.fullmatch(robot.name):
        raise JumpcadError(f"{robot.name!r} names files: use letters, digits, blanks, '.', '-', '+' and '_'")
    if len(os.fsencode(robot.name)) > LONGEST_NAME:
        raise JumpcadError(f"{robot.name!r} names files: use at most {LONGEST_NAME} bytes")
    if step:
        require_step()
    return write_folder(folder, robot.name, _facts(robot), contents(robot, pictures, step), force)


def contents(robot: Robot, pictures: bool, step: bool = False) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every file of a bundle but its manifest."""
    name = robot.name
    yield "design.toml", robot.design.to_toml()
    yield "workshop.toml", robot.workshop.to_toml()
    for part in robot.parts:
        stl = write_stl(part.mesh)
        require_part(part.name, stl)
        yield f"stl/{part.name}.stl", stl
        if step:
            yield f"step/{part.name}.step", write_step(part.drawing)
    for plate in packed(robot.parts, robot.workshop.printer.bed_mm, robot.workshop.process.part_spacing_mm):
        yield f"print/{plate.name}.3mf", write_threemf(plate)
    visible = visuals(robot)
    for mesh_name, mesh in {shape.mesh_name: shape.mesh for shape in visible}.items():
        yield f"urdf/{MESH_FOLDER}/{mesh_name}.stl", write_stl(mesh)
    yield f"urdf/{name}.urdf", write_urdf(robot, visible)
    yield f"urdf/{name}.loop.json", write_loop(robot)
    yield f"mjcf/{name}.xml", write_mjcf(robot, visible)
    yield f"sdf/{name}.sdf", write_sdf(robot, visible)
    yield f"{name}.glb", write_glb(robot)
    for outline, dxf in write_dxfs(robot).items():
        yield f"dxf/{outline}.dxf", dxf
    yield "bom.csv", write_bom(bill_of_materials(robot))
    yield "assembly.md", write_guide(robot, pictures)
    seen = all_pictures(robot) if pictures else {}
    for picture, png in seen.items():
        yield f"pictures/{picture}.png", png
    yield "report.html", write_report(robot, {name: seen[name] for name in RENDERS if name in seen})


def _facts(robot: Robot) -> dict[str, Any]:
    """Return what the manifest says of the robot."""
    return {
        "mass_kg": robot.mass_kg,
        "masses": mass_facts(bill_of_materials(robot)),
        "bodies": {
            name: {
                "mass_kg": body.mass_kg,
                "com_m": body.com_m.tolist(),
                "inertia_kg_m2": body.inertia_kg_m2.tolist(),
            }
            for name, body in robot.bodies.items()
        },
    }
