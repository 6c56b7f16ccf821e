"""A robot read back from its URDF file and the JSON file beside it: what is simulated is then what was written.

Such files may come from unknown sources. Both are checked as far as simulation needs them: what `jumpcad build` does
not write or no mechanism can have is rejected; nothing is guessed or corrected.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.collision.hulls import CAGE
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.exporters.loop_file import LoopFile
from jumpcad.exporters.steered import STEER, WHEEL
from jumpcad.files import read_bytes, read_json
from jumpcad.files.complaints import shown
from jumpcad.files.records import LONGEST_TEXT, control_character
from jumpcad.mechanism import model
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.planar import points
from jumpcad.transforms import Array, pose_at

LARGEST_M = 10.0
"""How far anything of a robot may be from the origin of its frame."""
MASS_KG = 1e-6, 1e3
"""Masses that a body may have."""
GYRATION_M = 1e-5, 10.0
"""Radii of gyration that a body may have."""
TRIANGLE_SHARE = 1e-6
"""Share by which rounding may bring the largest principal moment above the sum of the others."""
LARGEST_EFFORT = 1e6
"""Limit of a joint's torque (N·m) and speed (rad/s)."""
SAME = 1e-6
"""By how much the mechanism of the URDF may differ from its design's (m, rad)."""


def robot_from_urdf(path: Path) -> model.Mechanism:
    """Return the mechanism of a URDF file that `jumpcad build` wrote."""
    beside = path.with_suffix(".loop.json")
    content, data = read_bytes(path, "a URDF file"), read_json(beside)
    with _named_file(beside):
        if not isinstance(data, dict):
            raise JumpcadError("is not a table of values")
        extra = LoopFile(**data)
        design = Design(**extra.design)
    with _named_file(path):
        root = _parsed(content)
        wheel = _taken_wheel(root)
        links, joints = _named(root, "link", model.BODY_NAMES), _named(root, "joint", model.JOINT_NAMES)
        loop = extra.loop
        mechanism = model.Mechanism(
            name=_text(root, "name"), design=design,
            bodies={name: _body(links[name], extra.surfaces, wheel) for name in model.BODY_NAMES},
            joints=tuple(_joint(joints[name], extra.travel_rad[name]) for name in model.JOINT_NAMES),
            loops=(model.Loop(loop.body_a, np.array(loop.point_a_m), loop.body_b, np.array(loop.point_b_m)),),
            springs=(model.Spring(**extra.spring.model_dump(exclude={"rest_rad"})),), foot_depth_m=extra.foot_depth_m,
            stop=model.Stop(**extra.stop.model_dump()) if extra.stop else None,
            roller_off=model.RollerOff(**extra.roller_off.model_dump()) if extra.roller_off else None,
            friction=model.Friction(**extra.friction.model_dump()) if extra.friction else None,
            outline_m={name: points(np.array(corners)) for name, corners in extra.outline_m.items()},
        )  # fmt: skip
        _require_mechanism(mechanism)
    return mechanism


@contextmanager
def _named_file(path: Path) -> Iterator[None]:
    """Put the file's name before the error's message."""
    try:
        yield
    except JumpcadError as error:
        raise JumpcadError(f"{path}: not a robot that jumpcad build wrote: {error}") from None


class _NoDoctype(ET.TreeBuilder):
    """Builds trees of documents without a document type declaration, the only place where entities can be declared."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        raise JumpcadError("has a document type declaration, which no URDF needs")


def _parsed(content: bytes) -> ET.Element:
    """Return the root of a URDF document."""
    parser = ET.XMLParser(target=_NoDoctype())
    try:
        parser.feed(content)
        root: ET.Element = parser.close()
    except (ET.ParseError, ValueError, LookupError) as error:  # the latter two: encodings that are not known
        raise JumpcadError(f"broken XML: {error}") from None
    if root.tag != "robot":
        raise JumpcadError(f"its root is {shown(root.tag)}, not 'robot'")
    return root


def _named(root: ET.Element, tag: str, names: Sequence[str]) -> dict[str, ET.Element]:
    """Return the elements of a kind by name, which must be exactly those of `names`, each once."""
    found = [(_text(node, "name"), node) for node in root.findall(tag)]
    if sorted(name for name, _ in found) != sorted(names):
        have = ", ".join(shown(name) for name, _ in found[: len(names) + 1]) or "none"
        raise JumpcadError(f"its {tag}s must be {', '.join(names)}, each once, not {have}")
    return dict(found)


def _taken_wheel(root: ET.Element) -> MassProperties | None:
    """Take a steering wheel and its joint out of a document; return what the body carries with it, in its frame."""
    links, joints = ([one for one in root.findall(tag) if one.get("name") == name] for tag, name in
                     (("link", WHEEL), ("joint", STEER)))  # fmt: skip
    if not (len(links) == len(joints) == 1):
        return None
    for one in (*links, *joints):
        root.remove(one)
    for collision in links[0].findall("collision"):
        links[0].remove(collision)
    wheel, (origin_m, rpy) = _body(links[0], {}), _origin(joints[0], f"joint {STEER}")
    place = pose_at(Rotation.from_euler("xyz", rpy).as_matrix(), origin_m)
    return wheel.placed(place)


def _body(link: ET.Element, surfaces: dict[str, Any], wheel: MassProperties | None = None) -> model.Body:
    name = _text(link, "name")
    inertial = _child(link, "inertial", name)
    com_m, rpy = _origin(inertial, name)
    mass_kg = _number(_child(inertial, "mass", name), "value", f"{name}: mass", *MASS_KG)
    node = _child(inertial, "inertia", name)
    xx, xy, xz, yy, yz, zz = (
        _number(node, key, f"{name}: inertia", -1e9, 1e9) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    _require_inertia(name, mass_kg, tensor)
    axes = Rotation.from_euler("xyz", rpy).as_matrix()
    contacts = tuple(
        _contact(item, name, surfaces)
        for item in link.findall("collision")
        if not (
            item.get("name", "").startswith(CAGE)
            and item.find("geometry/cylinder") is not None  # no more than its mass
        )
    )
    if len({contact.name for contact in contacts}) < len(contacts):
        raise JumpcadError(f"{name}: two collisions have the same name")
    mass = MassProperties(mass_kg, com_m, np.einsum("ij,jk,lk->il", axes, tensor, axes))
    mass = combined([mass, wheel]) if wheel and name == model.BODY else mass
    return model.Body.of(name, mass, contacts)


def _require_inertia(name: str, mass_kg: float, tensor: Array) -> None:
    """Reject a tensor (3, 3) about the centre of mass that no distribution of the mass has.

    Principal moments are positive, and none exceeds the sum of the others (Featherstone, Rigid Body Dynamics
    Algorithms, section 2.8): a flat body reaches that sum.
    """
    low, middle, high = np.linalg.eigvalsh(tensor).tolist()
    gyration_m = math.sqrt(max(low + middle + high, 0.0) / 2.0 / mass_kg)
    triangle = low > 0.0 and high <= (low + middle) * (1.0 + TRIANGLE_SHARE)
    if not (triangle and GYRATION_M[0] <= gyration_m <= GYRATION_M[1]):
        raise JumpcadError(
            f"{name}: inertia has the principal moments {low:g}, {middle:g} and {high:g} kg·m² and a radius of "
            f"gyration of {gyration_m:g} m: moments must be more than 0, none more than the other two together, the "
            f"radius {GYRATION_M[0]:g}…{GYRATION_M[1]:g}"
        )


def _contact(item: ET.Element, body: str, surfaces: dict[str, Any]) -> model.ContactSphere:
    name = _text(item, "name")
    place = f"{body}: collision {shown(name)}"
    if name not in surfaces:
        raise JumpcadError(f"{place}: has no surface in the loop file")
    centre_m, _ = _origin(item, place)
    sphere = _child(_child(item, "geometry", place), "sphere", place)
    return model.ContactSphere(name, centre_m, _number(sphere, "radius", place, 1e-6, LARGEST_M), surfaces[name])


def _joint(node: ET.Element, travel_rad: tuple[float, float]) -> model.Joint:
    name = _text(node, "name")
    place = f"joint {name}"
    axis = _numbers(_child(node, "axis", place), "xyz", 3)
    origin_m, (roll, pitch, yaw) = _origin(node, place)
    if node.get("type") != "revolute" or not np.array_equal(axis, (0, 1, 0)) or roll or yaw:
        raise JumpcadError(f"{place}: must be revolute about the axis 0 1 0, and its rpy 0 ANGLE 0")
    limit = _child(node, "limit", place)
    return model.Joint(
        name=name, parent=_text(_child(node, "parent", place), "link"),
        child=_text(_child(node, "child", place), "link"), origin_m=origin_m, rest_angle_rad=float(pitch),
        lower_rad=travel_rad[0], upper_rad=travel_rad[1],
        effort_nm=_number(limit, "effort", place, 0.0, LARGEST_EFFORT),
        velocity_rad_s=_number(limit, "velocity", place, 1e-6, LARGEST_EFFORT),
    )  # fmt: skip


def _require_mechanism(mechanism: model.Mechanism) -> None:
    """Reject a tree and a loop that are not those of the design, which gives the pose at release."""
    joints, loop, _ = model.five_bar(mechanism.linkage, (-mechanism.design.compression_rad, 0.0))
    for joint in joints:
        read = mechanism.joint(joint.name)
        off = max(np.abs(read.origin_m - joint.origin_m).max(), abs(read.rest_angle_rad - joint.rest_angle_rad))
        if (read.parent, read.child) != (joint.parent, joint.child) or off > SAME:
            raise JumpcadError(
                f"joint {joint.name}: its origin is not that of the design in the loop file, from {joint.parent} to "
                f"{joint.child}"
            )
    released, wind_rad = mechanism.roller_off, mechanism.spring.wind_rad
    if released and released.leg_rad < -wind_rad:
        raise JumpcadError(f"roller_off.leg_rad = {released.leg_rad:g}: begins before the springs' {-wind_rad:g}")
    found = mechanism.loop
    off = max(np.abs(found.point_a_m - loop.point_a_m).max(), np.abs(found.point_b_m - loop.point_b_m).max())
    if (found.body_a, found.body_b) != (loop.body_a, loop.body_b) or off > SAME:
        raise JumpcadError(
            f"the points of the loop are not those of the design in the loop file, on {loop.body_a} and {loop.body_b}"
        )


def _child(node: ET.Element, tag: str, place: str) -> ET.Element:
    """Return the one child of a kind."""
    found = node.findall(tag)
    if len(found) != 1:
        raise JumpcadError(f"{place}: has {len(found) or 'no'} {tag}, needs one")
    return found[0]


def _text(node: ET.Element, key: str) -> str:
    text = node.get(key, "")
    if not text or len(text) > LONGEST_TEXT or control_character(text):
        raise JumpcadError(f"{node.tag}: {key} = {shown(text)}: is missing, too long, or holds a control character")
    return text


def _origin(node: ET.Element, place: str) -> tuple[Array, Array]:
    """Return where an element lies (3,) in m, and its roll, pitch and yaw (3,) in rad."""
    origin = _child(node, "origin", place)
    xyz, rpy = _numbers(origin, "xyz", 3), _numbers(origin, "rpy", 3)
    if np.abs(xyz).max() > LARGEST_M or np.abs(rpy).max() > 2.0 * math.pi:
        raise JumpcadError(f"{place}: its origin is further than {LARGEST_M:g} m away, or turned by more than 2π")
    return xyz, rpy


def _number(node: ET.Element, key: str, place: str, lower: float, upper: float) -> float:
    value = float(_numbers(node, key, 1)[0])
    if not lower <= value <= upper:
        raise JumpcadError(f"{place}: {key} = {value:g}: must be {lower:g}…{upper:g}")
    return value


def _numbers(node: ET.Element, key: str, count: int) -> Array:
    """Return the finite numbers (count,) of an attribute."""
    text = node.get(key, "")
    try:
        plain = text.isascii() and "_" not in text  # Python reads more as numbers than XML does
        values = np.array([float(word) for word in text.split()[: count + 1] if plain])
    except ValueError:
        values = np.empty(0)
    if len(values) != count or not np.isfinite(values).all():
        raise JumpcadError(f"{node.tag}: {key} = {shown(text)}: must be {count} finite number{'s' * (count > 1)}")
    return values
