"""Do the springs fit? Rebuilds them from a bundle's manifest and checks them against its URDF and meshes.

A program of its own: it reads `manifest.json`, `urdf/NAME.urdf`, its loop and its meshes, and knows nothing of jumpcad.
For each spring it draws both arms as tangents of the coil, to the sides that its hand and the winding direction ask
for, lets each touch the side of its pin, and compares the turns between the tangent points with those ordered. It
looks for the pins' holes in plates and leg, and for the hand in the spring's mesh.

Run `python tests/clients/spring_pins.py BUNDLE…`: one line a spring; the exit status is 1 if one does not fit.
"""

import json
import math
import sys
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

ANGLE_LIMIT_DEG = 1.0
HAND = {"right": 1.0, "left": -1.0}
SIDE = {"left": 1.0, "right": -1.0}


@dataclass
class Fit:
    """What was found of one spring: the angle between relaxed arms and pins less the preload, and what is wrong."""

    side: str
    angle_error_deg: float
    wrong: list[str] = field(default_factory=list)


def fits(folder: Path) -> list[Fit]:
    """Return what was found of every spring of a bundle."""
    manifest = json.loads((folder / "manifest.json").read_text())
    name = manifest["name"]
    urdf = ET.parse(folder / "urdf" / f"{name}.urdf").getroot()
    release = json.loads((folder / "urdf" / f"{name}.loop.json").read_text())["release"]["joint_rad"]["leg"]
    hub, pitch = _leg_joint(urdf)
    found = []
    for spring in manifest["drive"]["springs"]:
        # Seen from the right, a negative turn about the axis y, to the left, is counter-clockwise.
        sense = HAND[spring["hand"]] * SIDE[spring["side"]]  # of the wire from the outer, body's arm to the leg's
        fit = Fit(spring["side"], _angle_error_deg(spring, sense))
        if sense * -release <= 0.0:
            fit.wrong.append("winding opens the coil")
        if abs(fit.angle_error_deg) >= ANGLE_LIMIT_DEG:
            fit.wrong.append("the relaxed arms miss their pins")
        if spring["arm_length_mm"] <= _lever_mm(spring):
            fit.wrong.append("the arms end before their pins")
        fit.wrong += _holes(folder, urdf, spring, hub, pitch) + _hand(folder, urdf, spring, hub)
        found.append(fit)
    if {fit.side for fit in found} != {"left", "right"} or len(found) != 2:
        found.append(Fit("both", math.nan, ["a left and a right spring are expected"]))
    return found


def _beside_mm(spring: dict[str, Any]) -> float:
    """Return the distance of a pin's axis from the hub, square to the arm that touches the pin's side."""
    return float(spring["inside_diameter_mm"] / 2 + spring["wire_mm"] + spring["pin_diameter_mm"] / 2)


def _lever_mm(spring: dict[str, Any]) -> float:
    """Return the tangent's length from the coil to the farther pin."""
    return max(
        math.sqrt(np.hypot(*spring[pin]) ** 2 - _beside_mm(spring) ** 2) for pin in ("plate_pin_mm", "leg_pin_mm")
    )


def _angle_error_deg(spring: dict[str, Any], sense: float) -> float:
    """Return by how much the pins at rest turn the leg's arm against the relaxed one, less the preload (deg)."""
    touched = []
    for pin, sign in (("plate_pin_mm", 1.0), ("leg_pin_mm", -1.0)):
        x, z = spring[pin]
        turn = math.acos(_beside_mm(spring) / math.hypot(x, z))
        touched.append(math.atan2(z, x) + sense * sign * turn)
    plate, leg = touched
    closed = sense * (leg - plate) - 2.0 * math.pi * spring["turns"] - math.radians(spring.get("preload_deg", 0.0))
    return math.degrees(math.remainder(closed, 2.0 * math.pi))


def _leg_joint(urdf: ET.Element) -> tuple[np.ndarray, float]:
    """Return the hub (2,) in the body's frame (mm, x-z) and the leg's turn about y in the rest pose."""
    origin = next(joint for joint in urdf.findall("joint") if joint.get("name") == "leg").find("origin")
    assert origin is not None
    x, _, z = (1000.0 * float(word) for word in origin.get("xyz", "").split())
    return np.array([x, z]), float(origin.get("rpy", "").split()[1])


def _mesh(folder: Path, urdf: ET.Element, name: str) -> trimesh.Trimesh:
    """Return a part's mesh in its link's frame (mm)."""
    visual = next(visual for visual in urdf.iter("visual") if visual.get("name") == name)
    geometry, origin = visual.find("geometry/mesh"), visual.find("origin")
    assert geometry is not None
    assert origin is not None
    mesh = trimesh.load_mesh(folder / "urdf" / geometry.get("filename", ""))
    rpy = [float(word) for word in origin.get("rpy", "").split()]
    pose = trimesh.transformations.euler_matrix(*rpy)
    pose[:3, 3] = [1000.0 * float(word) for word in origin.get("xyz", "").split()]
    mesh.apply_transform(pose)
    return mesh


def _holes(folder: Path, urdf: ET.Element, spring: dict[str, Any], hub: np.ndarray, pitch: float) -> list[str]:
    """Return what is wrong with the pins' holes in the plate of this side and in the leg."""
    x, z = spring["leg_pin_mm"]
    cos, sin = math.cos(pitch), math.sin(pitch)
    places = {
        f"body_plate_{spring['side']}": hub + spring["plate_pin_mm"],
        "main_leg": np.array([cos * x - sin * z, sin * x + cos * z]),  # turned back into the leg's frame
    }
    return [
        f"no hole for the pin in {part}"
        for part, place in places.items()
        if not _has_hole(_mesh(folder, urdf, part), place, spring["pin_diameter_mm"] / 2)
    ]


def _has_hole(mesh: trimesh.Trimesh, place: np.ndarray, radius: float) -> bool:
    """Tell whether a round hole for a rod goes along y through a mesh at a place (2,) in x-z, with a wall around."""
    low, high = mesh.bounds[:, 1]
    offsets = mesh.vertices[:, [0, 2]] - place
    near = np.hypot(*offsets.T)
    if not (ring := near < radius + 0.4).any() or near.min() < radius - 0.1:
        return False
    angles = np.sort(np.arctan2(offsets[ring, 1], offsets[ring, 0]))
    gap = np.diff(np.append(angles, angles[0] + 2.0 * math.pi)).max()
    across = np.ptp(mesh.vertices[ring, 1])
    return bool(gap < math.radians(60.0) and across > 1.0 and low <= mesh.vertices[ring, 1].min() <= high)


def _hand(folder: Path, urdf: ET.Element, spring: dict[str, Any], hub: np.ndarray) -> list[str]:
    """Return what is wrong with the drawn spring: the outermost points of a coil lie on a helix of its hand."""
    points = _mesh(folder, urdf, f"spring_{spring['side']}").vertices
    wire, mean = spring["wire_mm"], spring["inside_diameter_mm"] + spring["wire_mm"]
    offsets = points[:, [0, 2]] - hub
    radius = np.hypot(*offsets.T)
    out = (radius > mean / 2 + 0.4 * wire) & (radius < mean / 2 + 0.51 * wire)
    if out.sum() < 12:
        return ["no coil is drawn"]
    rise = (np.ptp(points[:, 1]) - wire) / spring["turns"]
    # Seen against y, z is reached from x clockwise: a right-handed helix along y has falling angles in x-z.
    angle = np.arctan2(offsets[out, 1], offsets[out, 0])
    agree = {
        hand: abs(np.exp(1j * (angle + sign * 2.0 * math.pi * points[out, 1] / rise)).mean())
        for hand, sign in HAND.items()
    }
    drawn = max(agree, key=lambda hand: agree[hand])
    return [] if drawn == spring["hand"] else [f"a {drawn}-hand coil is drawn for a {spring['hand']}-hand one"]


def main(folders: list[str]) -> int:
    """Print what was found of every bundle."""
    bad = False
    for folder in folders:
        for fit in fits(Path(folder)):
            bad |= bool(fit.wrong)
            print(f"{folder}: {fit.side} spring: {fit.angle_error_deg:+.4f}°", *fit.wrong or ["fits"], sep="; ")
    return int(bad)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
