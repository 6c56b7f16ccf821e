"""Built robots, and measurements of their meshes by trimesh and shapely, without the package's own geometry."""

from functools import lru_cache
from typing import Any

import numpy as np
import shapely
import trimesh

from jumpcad.building import build
from jumpcad.checks import check
from jumpcad.design import Design, load_design
from jumpcad.findings import Finding
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.parts.part import Part
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.varied import varied
from support.workshops import workshop_with

LONG_TOES = "long toes"
"""A 183 mm robot whose foot is larger than any common bed."""


@lru_cache(maxsize=32)
def built(name: str, workshop: str = "default", mass_model: str = "printed", **bought: Any) -> Robot:
    """Return the robot of a template or of `LONG_TOES`, built once; with other parts than the workshop has bought."""
    shop = workshop_with(load_workshop(workshop), mass={"model": mass_model}, bought=bought)
    return build(design(name), shop, name)


@lru_cache(maxsize=4)
def of_kit(kit: str, name: str = "best-printable", **bought: Any) -> Robot:
    """Return the robot of a template with the electrical parts of a kit, and others where asked, built once."""
    return build(load_design(name), workshop_with(with_kit(kit), bought=bought), name)


def with_kit(kit: str, **bought: str) -> Workshop:
    """Return the default workshop with the electrical parts of a kit but for some."""
    return varied(load_workshop(), {"bought.kit": kit} | {f"bought.{slot}": part for slot, part in bought.items()})


@lru_cache(maxsize=8)
def checked(name: str) -> tuple[Finding, ...]:
    """Return the findings of all checks of such a robot, computed once: the checks need solids of all parts (2 s)."""
    return tuple(check(built(name)))


def geared() -> Robot:
    """Return a robot with two pairs of gears: a strong design with a quick motor."""
    return built("best-bo", motors=("n20-50",))


def design(name: str) -> Design:
    """Return a template's design or that of `LONG_TOES`."""
    if name == LONG_TOES:
        return Design.from_vector([183.0, 1.06, 0.77, 1.26, 0.4, 58.0, 27.0, 17.0])
    return load_design(name)


def part(robot: Robot, name: str) -> Part:
    """Return a printed part by its name."""
    return next(part for part in robot.parts if part.name == name)


def placed(robot: Robot, name: str, copy: int = 0) -> trimesh.Trimesh:
    """Return the mesh of one copy of a printed part in its body's frame (mm)."""
    found = part(robot, name)
    return found.mesh.copy().apply_transform(found.placements[copy].T_body_part)


def cut(mesh: trimesh.Trimesh, y_mm: float) -> np.ndarray:
    """Return where a mesh's triangles cross the plane at y: segments (n, 2, 2) in x-z."""
    return trimesh.intersections.mesh_plane(mesh, [0.0, 1.0, 0.0], [0.0, y_mm, 0.0])[:, :, ::2]


def region(segments: np.ndarray) -> shapely.Geometry:
    """Return the area that segments (n, 2, 2) enclose; trimesh joins their ends."""
    return shapely.union_all(trimesh.load_path(segments).polygons_full)


def inscribed_diameter(segments: np.ndarray, centre_mm: np.ndarray) -> float:
    """Return the diameter of the largest circle about a place that crosses none of the segments (n, 2, 2)."""
    lines = shapely.multilinestrings(list(shapely.linestrings(segments)))
    return 2.0 * shapely.Point(*centre_mm).distance(lines)


def hole_centres(segments: np.ndarray) -> dict[tuple[float, float], float]:
    """Return middle and width of every hole of a section, by their bounding boxes."""
    area = region(segments)
    polygons = area.geoms if hasattr(area, "geoms") else [area]
    found = {}
    for ring in (ring for polygon in polygons for ring in polygon.interiors):
        low_x, low_z, high_x, high_z = ring.bounds
        found[((low_x + high_x) / 2.0, (low_z + high_z) / 2.0)] = high_x - low_x
    return found


def body_in_plane(robot: Robot, body: str, wind_rad: float) -> np.ndarray:
    """Return the pose (3, 3) of a body in the body frame's x-z plane with the springs loaded by an angle (mm).

    By the law of cosines from the four lengths alone, not by the package's own solution.
    """
    d = robot.design
    leg = np.radians(d.rest_angle_deg) - wind_rad
    hub, front = np.array([-d.l1_mm / 2, 0.0]), np.array([d.l1_mm / 2, 0.0])
    ankle = hub + d.l2_mm * np.array([np.cos(leg), -np.sin(leg)])
    across = front - ankle
    far = np.hypot(*across)
    corner = np.arccos((d.l4_mm**2 + far**2 - d.l3_mm**2) / (2 * d.l4_mm * far))
    foot = np.arctan2(across[1], across[0]) - corner
    eye = ankle + d.l4_mm * np.array([np.cos(foot), np.sin(foot)])
    link = eye - front
    places = {
        BODY: (np.zeros(2), 0.0),
        MAIN_LEG: (hub, -leg),
        FRONT_LINK: (front, np.arctan2(link[1], link[0])),
        FOOT: (ankle, foot),
    }
    origin, angle = places[body]
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, -sin, origin[0]], [sin, cos, origin[1]], [0.0, 0.0, 1.0]])


def in_body(robot: Robot, body: str, wind_rad: float, points_mm: np.ndarray) -> np.ndarray:
    """Return points (..., 2) of a body's x-z plane in the body's frame with the springs loaded by an angle."""
    pose = body_in_plane(robot, body, wind_rad)
    return points_mm @ pose[:2, :2].T + pose[:2, 2]
