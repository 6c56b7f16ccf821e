"""The release of an exported robot, simulated with contacts: a program apart from jumpcad, which it does not import.

Reads a bundle's meshes, URDF, loop.json and manifest. The cam is the outline of its mesh, the roller a circle on a
lever that bends, the leg a four-bar whose foot stands on the ground; between them elastic contacts. The dog's play is
measured on the jaws of the meshes. Cam, gear and rotor have a moment of inertia each; flanks of dog and gearhead are
springs with damping. From the manifest come only figures that no mesh has: the assumed motors, friction, stiffnesses.

Unlike the model in jumpcad/drive it steps in time, and has mass in roller and lever's end, rebound, and hops.
"""

import json
import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import trimesh
from shapely import affinity

STEP_S = 2e-6
DAMPING = 0.2
"""Of every contact, as a share of the critical one: a rebound with about half of the speed."""
CONTACT_N_PER_M = 5e6
"""Of the roller on the cam; a hundredth of a millimetre at 50 N."""
LEVER_SHARE = 0.25
"""Of the lever's mass that moves with its end (Rayleigh, a cantilever: 33/140)."""
LEVER_G = 1.5
G = 9.81


@dataclass
class Outcome:
    """What a release came to: energies over that of the springs wound without bending, torques at the gear motor."""

    energy_ratio: float
    kick_nm: float
    blow_at_cam_nm: float
    play_deg: float
    left_s: float


def turned(point: np.ndarray, angle: float) -> np.ndarray:
    """Return an x-z point turned about +y."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([cos * point[0] + sin * point[1], cos * point[1] - sin * point[0]])


class Files:
    """What a bundle's files say of its leg and drive (m, kg, rad)."""

    def __init__(self, bundle: Path) -> None:
        self.manifest = json.loads((bundle / "manifest.json").read_text())
        (urdf,) = (bundle / "urdf").glob("*.urdf")
        self.loop = json.loads(urdf.with_suffix(".loop.json").read_text())
        self.folder, self.root = urdf.parent, ET.parse(urdf).getroot()
        self.joints = {joint.attrib["name"]: joint for joint in self.root.iter("joint")}

    def mesh(self, name: str) -> trimesh.Trimesh:
        """Return a mesh in its link's frame (m)."""
        visual = next(item for item in self.root.iter("visual") if item.attrib["name"] == name)
        origin, shape = visual.find("origin"), visual.find("geometry/mesh")
        assert origin is not None and shape is not None
        mesh = trimesh.load(self.folder / shape.attrib["filename"])
        assert isinstance(mesh, trimesh.Trimesh)
        mesh.apply_scale(0.001)
        pose = trimesh.transformations.euler_matrix(*floats(origin.attrib["rpy"]), "sxyz")
        pose[:3, 3] = floats(origin.attrib["xyz"])
        mesh.apply_transform(pose)
        return mesh

    def link(self, name: str) -> tuple[float, np.ndarray, float]:
        """Return a link's mass, its centre (x, z) and its inertia about the y axis through it."""
        inertial = next(item for item in self.root.iter("link") if item.attrib["name"] == name).find("inertial")
        assert inertial is not None
        origin, mass, moments = (inertial.find(tag) for tag in ("origin", "mass", "inertia"))
        assert origin is not None and mass is not None and moments is not None
        axes = trimesh.transformations.euler_matrix(*floats(origin.attrib["rpy"]), "sxyz")[:3, :3]
        principal = [float(moments.attrib[key]) for key in ("ixx", "iyy", "izz")]
        return (
            float(mass.attrib["value"]),
            floats(origin.attrib["xyz"])[[0, 2]],
            float((axes @ np.diag(principal) @ axes.T)[1, 1]),
        )

    def hinge(self, name: str) -> tuple[np.ndarray, float]:
        """Return a joint's place (x, z) in its parent and its angle at rest."""
        origin = self.joints[name].find("origin")
        assert origin is not None
        return floats(origin.attrib["xyz"])[[0, 2]], float(floats(origin.attrib["rpy"])[1])

    def grams(self, name: str) -> float:
        """Return the mass of one copy of a printed part."""
        return 1000.0 * next(line["mass_kg"] for line in self.manifest["masses"] if line["name"] == name)


def floats(text: str) -> np.ndarray:
    """Return the numbers of an attribute."""
    return np.array([float(word) for word in text.split()])


def section(mesh: trimesh.Trimesh, y_m: float) -> Any:
    """Return a mesh's section across y as a region of x-z."""
    lines = trimesh.intersections.mesh_plane(mesh, [0, 1, 0], [0, y_m, 0])
    return shapely.unary_union(shapely.polygonize(shapely.linestrings(np.round(lines[:, :, [0, 2]], 9)).tolist()))


def holed(mesh: trimesh.Trimesh, y_m: float) -> Any:
    """Return the section with its holes left out: the faces whose inside lies in the mesh."""
    faces = shapely.get_parts(section_faces(mesh, y_m))
    points = np.array([[face.representative_point().x, y_m, face.representative_point().y] for face in faces])
    return shapely.unary_union([face for face, inside in zip(faces, mesh.contains(points), strict=True) if inside])


def section_faces(mesh: trimesh.Trimesh, y_m: float) -> Any:
    """Return the faces that the section's lines bound."""
    lines = trimesh.intersections.mesh_plane(mesh, [0, 1, 0], [0, y_m, 0])
    return shapely.polygonize(shapely.linestrings(np.round(lines[:, :, [0, 2]], 9)).tolist())
