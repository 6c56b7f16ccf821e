"""GLB: the assembled robot as a scene of named, coloured parts, standing with springs at rest.

Every body's frame is a node (`foot_frame`) with its parts below it, so that a viewer can pose the robot. glTF uses
metres and y up.
"""

from collections.abc import Iterator

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial

from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.shading import creased
from jumpcad.scene.visuals import Colour, Visual, visuals

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""From the robot's z up to y up."""
FRAME = "robot"
ROUGHNESS = 0.6


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
    return bytes(scene.export(file_type="glb"))


def frame_name(body: str) -> str:
    """Return the name of a body's node; the main part of a body may have the name of the body."""
    return f"{body}_frame"


def _in_metres(shape: Visual) -> trimesh.Trimesh:
    """Return a mesh (m) with a vertex per face and corner where the surface is creased."""
    vertices, normals, faces = creased(shape.mesh)
    material = _material(shape.mesh_name, shape.colour)
    visual = trimesh.visual.TextureVisuals(material=material)
    return trimesh.Trimesh(vertices * 0.001, faces, vertex_normals=normals, visual=visual, process=False)


def _material(name: str, colour: Colour) -> PBRMaterial:
    return PBRMaterial(name=name, baseColorFactor=(*colour, 1.0), metallicFactor=0.0, roughnessFactor=ROUGHNESS)
