"""ROS 2: a description package, for `colcon build` in a workspace; written on request.

Unlike the URDF of a bundle it begins with a link without mass, `base_link`, as ROS expects; PyBullet would give it a
mass of 1 kg. The loop's dependent joints mimic the leg's by a linear approximation. Simple collision shapes, capsules
and a box, are there in addition to the contact spheres; they end above the ground where the robot stands, so that it
stands on its spheres alone.
"""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.collision.hulls import CAGE, Capsule
from jumpcad.exporters.mjcf_robot import HOLD
from jumpcad.exporters.sdf import write_config, write_sdf
from jumpcad.exporters.steered import WHEEL, steered
from jumpcad.exporters.urdf import cage_cylinders, tree
from jumpcad.exporters.xml import shortened
from jumpcad.files import templates_folder
from jumpcad.mechanism.model import BODY, BODY_NAMES, Mechanism, body_poses, standing
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.solids.stl import write_stl
from jumpcad.transforms import Array

BASE = "base_link"
MESHES = "meshes"
MIMIC_POINTS = 65
"""Number of leg angles at which a linear approximation is fitted."""
MIMIC_DIGITS = 6
SLIM = 0.6
"""Radius of the links' capsules over the height of the ankle; judgement."""
SLIM_TOE = 0.8
"""Radius of the toes' capsules over that of their spheres; judgement."""
CLEAR_M = 0.001
"""Clearance between the body's box and the ground in the loaded pose; judgement."""


@dataclass(frozen=True)
class Box:
    """A box along the axes of its body's frame: lower and upper corner (3,) (m)."""

    low_m: Array
    high_m: Array


@dataclass(frozen=True)
class Mimic:
    """A joint's angle as `slope`·leg + `offset_rad`, with an error of at most `error_rad` over the leg's travel."""

    slope: float
    offset_rad: float
    error_rad: float


def ros2_files(robot: Robot) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of every file of the package."""
    model = model_name(robot.name)
    package = f"{model}_description"
    folder, mimics, (whole, visible) = f"ros2/{package}", mimicked(robot), steered(robot, visuals(robot))
    rest, rubs = standing(robot, 0.0), coefficients(robot, Settings())
    words = {
        "PACKAGE": package,
        "MODEL": model,
        "NAME": robot.name,
        "HEIGHT_M": f"{rest.body_position_m[2]:.4f}",
        "PITCH_RAD": f"{rest.body_pitch_rad:z.4f}",
        "HOLD": f"{_hold_nm(robot):g}",
        **{f"{name.upper()}_DEG": f"{math.degrees(mimic.error_rad):.2f}" for name, mimic in mimics.items()},
        **{f"{name.upper()}_FRICTION": f"{rubs.contact(body.surface):g}" for name, body in robot.bodies.items()},
        "SPRING_REFERENCE": f"{robot.spring.preload_rad:.9g}",
        "SPRING_STIFFNESS": f"{robot.spring.stiffness_nm_per_rad:.9g}",
    }
    wheel = r"\1" if WHEEL in whole.bodies else ""  # @WHEEL@...@END@ is for robots that have one
    templates = templates_folder() / "ros2"  # with @WORDS@ to be replaced, in their names too; pip compiles its *.py
    for file in sorted(path for path in templates.rglob("*") if path.is_file() and path.suffix != ".pyc"):
        raw = file.relative_to(templates).as_posix(), file.read_text(encoding="utf-8")
        texts = (re.sub("@WHEEL@(.*?)@END@", wheel, one, flags=re.DOTALL) for one in raw)
        path, text = (re.sub("@([A-Z_]+)@", lambda found: words[found[1]], one) for one in texts)
        yield f"{folder}/{path}", text
    for mesh, shape in {shape.mesh_name: shape.mesh for shape in visible}.items():
        yield f"{folder}/{MESHES}/{mesh}.stl", write_stl(shape)
    yield f"{folder}/urdf/links.xacro", _links(whole, visible, mimics, f"package://{package}/{MESHES}")
    yield f"{folder}/models/{model}/model.config", write_config(robot.name, "model.sdf")
    yield f"{folder}/models/{model}/model.sdf", write_sdf(whole, visible, meshes=f"../../{MESHES}")


def _hold_nm(mechanism: Mechanism) -> float:
    """Return the torque that holds the loaded leg against its lower limit, as the package's pages state it."""
    return float(f"{HOLD * mechanism.spring.peak_torque_nm:.4g}")


def model_name(name: str) -> str:
    """Return a robot's name as ROS packages may have it: small letters, digits, single underscores (REP 144)."""
    plain = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
    return plain if plain[:1].isalpha() else f"robot_{plain}".rstrip("_")


def mimicked(mechanism: Mechanism) -> dict[str, Mimic]:
    """Return front and ankle angle as linear functions of the leg's, fitted by least squares over its travel."""
    leg = np.linspace(-mechanism.spring.wind_rad, 0.0, MIMIC_POINTS)
    pose = mechanism.linkage.pose(leg)
    return {"front": _line(leg, pose.front_rad), "ankle": _line(leg, pose.ankle_rad)}


def _line(x: Array, y: Array) -> Mimic:
    off = x - x.mean()
    slope = round(math.fsum(off * y) / math.fsum(off * off), MIMIC_DIGITS)
    offset = round(float(y.mean() - slope * x.mean()), MIMIC_DIGITS) + 0.0
    return Mimic(slope, offset, float(np.abs(slope * x + offset - y).max()))


def _links(robot: Robot, visible: Sequence[Visual], mimics: dict[str, Mimic], meshes: str) -> str:
    """Return the bodies with visible meshes and collision shapes, and the joints of the tree.

    The leg turns no farther than its springs are wound, and its controller holds it there.
    """
    cylinders = {
        name: {f"{name}_{number}": capsule for number, capsule in enumerate(capsules(robot, name), start=1)}
        for name in robot.bodies
    }
    cylinders[BODY] |= cage_cylinders(robot)
    values = {"base": BASE, "box": body_box(robot, visible), "mimics": mimics, "w": shortened}
    leg = {"lower": -robot.spring.wind_rad, "effort": _hold_nm(robot)}
    return tree(robot, visible, Settings(), meshes, cylinders, values, leg)


def capsules(mechanism: Mechanism, body: str) -> Iterator[Capsule]:
    """Yield the capsules of a link; the foot has one for each toe too, the body none."""
    origin = np.zeros(3)
    radius = round(SLIM * mechanism.foot_depth_m, 6)
    lengths = dict(zip(BODY_NAMES[1:], mechanism.design.links_mm, strict=False))
    if body in lengths:
        yield Capsule(origin, np.array([lengths[body] / 1000.0, 0.0, 0.0]), radius)
    for toe in (one for one in mechanism.bodies[body].contacts if one.surface == "foot" and one.centre_m[0] < 0.0):
        yield Capsule(origin, np.round(toe.centre_m, 6), min(radius, round(SLIM_TOE * toe.radius_m, 6)))


def body_box(mechanism: Mechanism, visible: Sequence[Visual]) -> Box | None:
    """Return a box around the body's parts without the cage, or None without visible parts or if no height is left.

    Its lower face is raised until it is clear of the ground in the loaded pose: the body is round at its lower corners.
    """
    corners = [
        shape.corners_at(shape.T_body_mesh)
        for shape in visible
        if shape.body == BODY and not shape.name.startswith(CAGE)
    ]
    if not corners:
        return None
    every = np.round(np.concatenate(corners), 4)
    low, high = every.min(axis=0), every.max(axis=0)
    pose = body_poses(mechanism, 1.0)[BODY]
    lowest = max((CLEAR_M - pose[2, 3] - pose[2, 0] * x) / pose[2, 2] for x in (low[0], high[0]))
    low[2] = max(low[2], round(float(lowest), 4))
    return Box(low, high) if low[2] < high[2] else None
