"""GLB: the assembled robot as a scene of named, coloured parts, standing with springs at rest.

Every body's frame is a node (`foot_frame`) with its parts below it, so that a viewer can pose the robot;
`animated` moves them, as in the jump (glTF 2.0, 3.11). glTF uses metres, y up, and linear colours.
"""

import json
import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial

from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.raster import with_normals
from jumpcad.scene.visuals import Colour, visuals
from jumpcad.transforms import Array

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
            vertices, normals, faces = with_normals(shape.mesh)
            material = PBRMaterial(name=shape.mesh_name, metallicFactor=0.0, roughnessFactor=ROUGHNESS)
            visual = trimesh.visual.TextureVisuals(material=material)
            scene.geometry[shape.mesh_name] = trimesh.Trimesh(
                vertices * 0.001, faces, vertex_normals=normals, visual=visual, process=False
            )
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


ANIMATIONS = {"jump": 1.0, "jump, a tenth of the speed": 10.0}
"""Names, and each duration over the real one."""
JSON, BINARY = 0x4E4F534A, 0x004E4942
"""Kinds of chunks of a GLB file (glTF 2.0, 4.4.3)."""
MAGIC, VERSION = 0x46546C67, 2
"""First two words of a GLB file (glTF 2.0, 4.4.2)."""
FLOAT = 5126
"""Component type of 32-bit floats (glTF 2.0, 3.6.2.2)."""
DIGITS = 6
"""Decimals of metres, seconds and quaternions: simulated figures differ beyond them from processor to processor."""


@dataclass(frozen=True)
class BodyMotion:
    """Bodies' frames in the world: `time_s` (n,), and by body `position_m` (n, 3) and `quaternion_xyzw` (n, 4)."""

    time_s: Array
    position_m: dict[str, Array]
    quaternion_xyzw: dict[str, Array]


def animated(glb: bytes, motion: BodyMotion) -> bytes:
    """Return the GLB file of a robot with animations that move the nodes `BODY_frame`."""
    tree, binary = _chunks(glb)
    names = [node.get("name") for node in tree["nodes"]]
    moving = {body: names.index(f"{body}_frame") for body in motion.position_m}
    paths = []
    for body, node in moving.items():
        places, turns = _rounded(motion.position_m[body]), motion.quaternion_xyzw[body]
        # without jumps of sign (q and -q are one rotation): viewers interpolate linearly
        signs = np.cumprod(np.where((turns[1:] * turns[:-1]).sum(axis=1) < 0.0, -1.0, 1.0))
        turns = _rounded(turns * np.append(1.0, signs)[:, None])
        _split_matrix(tree["nodes"][node])
        for path, kind, values in (("translation", "VEC3", places), ("rotation", "VEC4", turns)):
            binary, accessor = _appended(tree, binary, values, kind)
            paths.append((node, path, accessor))
    tree["animations"] = []
    for name, slower in ANIMATIONS.items():
        binary, times = _appended(tree, binary, _rounded(slower * motion.time_s), "SCALAR")
        samplers = [{"input": times, "output": output, "interpolation": "LINEAR"} for *_, output in paths]
        channels = [
            {"sampler": number, "target": {"node": node, "path": path}} for number, (node, path, _) in enumerate(paths)
        ]
        tree["animations"].append({"name": name, "samplers": samplers, "channels": channels})
    tree["buffers"][0]["byteLength"] = len(binary)
    return _packed(tree, binary)


def _rounded(values: Array) -> Array:
    return np.asarray(np.round(values, DIGITS) + 0.0)


def _split_matrix(node: dict[str, Any]) -> None:
    """Replace a node's matrix by translation and rotation: animations cannot change a matrix (glTF 2.0, 3.11)."""
    matrix = np.array(node.pop("matrix", np.eye(4).ravel())).reshape(4, 4).T
    angle = np.arctan2(matrix[0, 2], matrix[0, 0])  # bodies turn about y alone
    node["translation"] = _rounded(matrix[:3, 3]).tolist()
    node["rotation"] = _rounded(np.array([0.0, np.sin(angle / 2.0), 0.0, np.cos(angle / 2.0)])).tolist()


def _appended(tree: dict[str, Any], binary: bytes, values: Array, kind: str) -> tuple[bytes, int]:
    """Append values (n, …) to the binary data; return it, and the number of their accessor."""
    data = values.astype("<f4")
    tree["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": data.nbytes})
    accessor = {"bufferView": len(tree["bufferViews"]) - 1, "componentType": FLOAT, "count": len(data), "type": kind}
    if kind == "SCALAR":
        accessor |= {"min": [float(data.min())], "max": [float(data.max())]}
    tree["accessors"].append(accessor)
    return binary + data.tobytes(), len(tree["accessors"]) - 1


def _chunks(glb: bytes) -> tuple[dict[str, Any], bytes]:
    """Return the JSON document and the binary data of a GLB file."""
    length, _ = struct.unpack_from("<II", glb, 12)
    tree: dict[str, Any] = json.loads(glb[20 : 20 + length])
    size, _ = struct.unpack_from("<II", glb, 20 + length)
    return tree, glb[28 + length : 28 + length + size]


def _packed(tree: dict[str, Any], binary: bytes) -> bytes:
    """Return a GLB file; chunks are padded to multiples of 4 bytes, the document with blanks."""
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    whole = struct.pack("<III", MAGIC, VERSION, 28 + len(text) + len(binary))
    return whole + struct.pack("<II", len(text), JSON) + text + struct.pack("<II", len(binary), BINARY) + binary
