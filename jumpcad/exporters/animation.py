"""Animations in a GLB file: the jump, and the same at a tenth of its speed (glTF 2.0, 3.11).

They move the frames of the four bodies, whose nodes hold the parts.
"""

import json
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np

from jumpcad.transforms import Array

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
        places = _rounded(motion.position_m[body])
        turns = _rounded(_continuous(motion.quaternion_xyzw[body]))
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


def _continuous(quaternions: Array) -> Array:
    """Return quaternions (n, 4) without jumps of sign (q and -q are one rotation): viewers interpolate linearly."""
    signs = np.cumprod(np.where((quaternions[1:] * quaternions[:-1]).sum(axis=1) < 0.0, -1.0, 1.0))
    continuous: Array = quaternions * np.append(1.0, signs)[:, None]
    return continuous


def _rounded(values: Array) -> Array:
    rounded: Array = np.round(values, DIGITS) + 0.0
    return rounded


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
