"""GLB: the assembled robot as a scene of named, coloured parts, standing with springs at rest.

Every body's frame is a node (`foot_frame`) with its parts below it, so that a viewer can pose the robot; `animation`
moves them. glTF uses metres, y up, and linear colours.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial

from jumpcad.mechanism.poses import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.shading import with_normals
from jumpcad.scene.visuals import Colour, Visual, visuals

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""Rotation (4, 4) from the robot's axes, z up, to glTF's, y up."""
FRAME = "robot"
ROUGHNESS = 0.6
VERTICES, INDICES = 34962, 34963
"""What a buffer view holds (glTF 2.0, 5.11.5)."""


def glb_files(robot: Robot) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of the scene."""
    yield f"{robot.name}.glb", write_glb(robot)


def write_glb(robot: Robot) -> bytes:
    """Return the GLB file of a robot."""
    scene = trimesh.Scene(base_frame="world")
    scene.graph.update(FRAME, "world", matrix=Y_UP)
    for name, pose in body_poses(robot).items():
        scene.graph.update(frame_name(name), FRAME, matrix=pose)
    for shape in visuals(robot):
        if shape.mesh_name not in scene.geometry:
            scene.geometry[shape.mesh_name] = _in_metres(shape)
        scene.graph.update(shape.name, frame_name(shape.body), matrix=shape.T_body_mesh, geometry=shape.mesh_name)
    colours = {shape.mesh_name: shape.colour for shape in visuals(robot)}
    return bytes(scene.export(file_type="glb", tree_postprocessor=lambda tree: _finish(tree, colours)))


def _finish(tree: dict[str, Any], colours: dict[str, Colour]) -> None:
    """Write exact colours (trimesh's have 256 levels), and mark buffer views as vertices or indices."""
    for material in tree["materials"]:
        linear = [round(linear_light(part), 6) for part in colours[material["name"]]]
        material["pbrMetallicRoughness"]["baseColorFactor"] = [*linear, 1.0]
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            _target(tree, primitive["indices"], INDICES)
            for accessor in primitive["attributes"].values():
                _target(tree, accessor, VERTICES)


def _target(tree: dict[str, Any], accessor: int, target: int) -> None:
    tree["bufferViews"][tree["accessors"][accessor]["bufferView"]]["target"] = target


def linear_light(part: float) -> float:
    """Return one component of an sRGB colour, 0 to 1, as linear light, 0 to 1 (IEC 61966-2-1)."""
    return part / 12.92 if part <= 0.04045 else math.pow((part + 0.055) / 1.055, 2.4)


def frame_name(body: str) -> str:
    """Return the name of a body's node; not the body's own, which is also the name of a part (`foot`)."""
    return f"{body}_frame"


def _in_metres(shape: Visual) -> trimesh.Trimesh:
    """Return a mesh with normals and material (m)."""
    vertices, normals, faces = with_normals(shape.mesh)
    material = PBRMaterial(name=shape.mesh_name, metallicFactor=0.0, roughnessFactor=ROUGHNESS)
    visual = trimesh.visual.TextureVisuals(material=material)
    return trimesh.Trimesh(vertices * 0.001, faces, vertex_normals=normals, visual=visual, process=False)
