"""GLB: the assembled robot as a scene of named, coloured parts, standing with springs at rest.

Every body's frame is a node (`foot_frame`) with its parts below it, so that a viewer can pose the robot. glTF wants
metres and y up.
"""

import numpy as np
import numpy.typing as npt
import trimesh
from scipy import sparse
from trimesh.visual.material import PBRMaterial

from jumpcad.exporters.poses import body_poses
from jumpcad.exporters.shapes import Colour, Shape, shapes
from jumpcad.robot import Array, Robot

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""From the robot's z up to y up."""
FRAME = "robot"
ROUGHNESS = 0.6
CREASE_RAD = 0.5
"""Faces that meet at less than this look smooth."""


def write_glb(robot: Robot) -> bytes:
    """Return the GLB file of a robot."""
    scene = trimesh.Scene(base_frame="world")
    scene.graph.update(FRAME, "world", matrix=Y_UP)
    for name, pose in body_poses(robot).items():
        scene.graph.update(frame_name(name), FRAME, matrix=pose)
    for shape in shapes(robot):
        if shape.mesh_name not in scene.geometry:
            scene.geometry[shape.mesh_name] = _in_metres(shape)
        scene.graph.update(shape.name, frame_name(shape.body), matrix=shape.T_body_mesh, geometry=shape.mesh_name)
    return bytes(scene.export(file_type="glb"))


def frame_name(body: str) -> str:
    """Return the name of a body's node; the main part of a body may have the name of the body."""
    return f"{body}_frame"


def _in_metres(shape: Shape) -> trimesh.Trimesh:
    """Return a mesh (m) with a vertex per face and corner where the surface is creased."""
    vertices, normals, faces = creased(shape.mesh)
    material = _material(shape.mesh_name, shape.colour)
    visual = trimesh.visual.TextureVisuals(material=material)
    return trimesh.Trimesh(vertices * 0.001, faces, vertex_normals=normals, visual=visual, process=False)


def creased(mesh: trimesh.Trimesh) -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Return vertices (n, 3), their normals (n, 3) and faces (m, 3): one vertex for every normal that a corner needs.

    A corner's normal is the mean of the faces around it that meet its own face at less than the crease angle, weighted
    by area. trimesh's `smooth_shade` numbers its vertices in the order of a sort that leaves ties to the processor.
    """
    seen = mesh.face_normals.any(axis=1)  # not a needle without an area
    normal, area, ends = mesh.face_normals[seen], mesh.area_faces[seen], mesh.faces[seen].ravel()
    corner = np.arange(ends.size)
    at_vertex = sparse.csr_array((np.ones(corner.size), (corner, ends)))
    one, other = (at_vertex @ at_vertex.T).nonzero()
    smooth = (normal[one // 3] * normal[other // 3]).sum(axis=1) > np.cos(CREASE_RAD)
    one, other = one[smooth], other[smooth] // 3
    weighted = normal[other] * area[other, None]
    sums = np.stack([np.bincount(one, axis, corner.size) for axis in weighted.T], axis=1)
    normals = np.round(sums / np.sqrt((sums * sums).sum(axis=1, keepdims=True)), 6)
    rows = np.column_stack([mesh.vertices[ends], normals])
    vertices, faces = np.unique(rows, axis=0, return_inverse=True)
    return vertices[:, :3], vertices[:, 3:], faces.reshape(-1, 3)


def _material(name: str, colour: Colour) -> PBRMaterial:
    return PBRMaterial(name=name, baseColorFactor=(*colour, 1.0), metallicFactor=0.0, roughnessFactor=ROUGHNESS)
