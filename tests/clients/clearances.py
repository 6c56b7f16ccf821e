"""Does anything of a bundle meet anything else, from loaded springs to the stop and its pad's give?

Reads the URDF with its meshes, the printed parts' own files, the loop file and the manifest alone: trimesh for the
files, shapely for roller and cam, manifold3d for volumes. The leg's angle follows from the cam's by letting its roller
down on the cam's outline; the five-bar is closed with circles. `python clearances.py BUNDLE` prints what meets.
"""

import io
import json
import math
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import shapely
import trimesh
from manifold3d import Manifold, Mesh

TOLERANCE_MM3 = 0.3
"""The meshes of bought parts leave out detail below 0.05 mm: round things in round holes share a little, two bought
ones twice as much."""
FACET_MM = 0.05
"""By which the meshes of bought parts may leave a circle."""
DOG_DEG = 12.0
"""How far the cam may run past where it lets the roller fall, where the manifest says nothing of its play."""
TRAIN = ("cam", "cam_gear", "idler", "motor_pinion", "motor_shaft")
TURNING = {"cam", "cam_gear"}
LIFTED, DROPPED, PAST = 30, 15, 5
"""Positions; those past rest each with three angles of the cam: 60 in all."""


@dataclass(frozen=True)
class Piece:
    """A mesh in its link's frame (mm); a printed one is as exact as its STL file."""

    name: str
    link: str
    solid: Manifold
    printed: bool


@dataclass(frozen=True)
class Pose:
    """A position: angles of leg and cam (rad)."""

    leg: float
    cam: float


class Bundle:
    """The pieces of a bundle and how they move."""

    def __init__(self, folder: Path) -> None:
        self.manifest = json.loads((folder / "manifest.json").read_text())
        name = self.manifest["name"]
        self.loop = json.loads((folder / "urdf" / f"{name}.loop.json").read_text())
        root = ET.parse(folder / "urdf" / f"{name}.urdf").getroot()
        self.joints = {joint.get("name"): _frame(joint) for joint in root.iter("joint")}
        self.pieces = [
            _piece(folder, link.get("name"), visual) for link in root.iter("link") for visual in link.iter("visual")
        ]
        self.axes = {
            visual.get("name"): 1000.0 * _frame(visual)[[0, 2], 3]
            for visual in root.iter("visual")
            if visual.get("name") in TRAIN
        }
        self.moving = [i for i, piece in enumerate(self.pieces) if piece.link != "body" or piece.name in TURNING]
        pieces = {piece.name: piece for piece in self.pieces}
        low, high = pieces["roller"].solid.bounding_box()[1::3]
        self.cam, self.roller = (_section(pieces[name].solid, (low + high) / 2.0) for name in ("cam", "roller"))
        self.roller_at = np.array(self.roller.convex_hull.centroid.coords[0])
        self.roller_mm = math.sqrt(self.roller.convex_hull.area / math.pi)
        self.wound = -self.loop["spring"]["wind_rad"]
        stop = self.manifest["stop"]
        self.stop = math.radians(stop["angle_deg"])
        self.give = math.radians(stop["give_deg"])

    def poses(self) -> list[Pose]:
        """Return the positions: the cam's lift, the fall of the roller, and past rest with the cam running on."""
        turns = np.linspace(0.0, 2.0 * math.pi, 241)
        top = int(np.argmin(self._legs_on_cam(turns)))
        lifting = np.linspace(0.0, turns[top], LIFTED)
        lift = [Pose(float(leg), float(turn)) for leg, turn in zip(self._legs_on_cam(lifting), lifting, strict=True)]
        ways = np.linspace(self.wound, self.stop + self.give, 25)
        free = next(float(turn) for turn in turns[top:] if (self._roller_gaps(ways, turn) > 0.0).all())
        play = self.manifest.get("drive", {}).get("release", {}).get("free_play_deg", DOG_DEG)
        drop = [Pose(leg, free) for leg in np.linspace(self.wound, 0.0, DROPPED)]
        past = [
            Pose(leg, free + share * math.radians(play))
            for leg in np.linspace(0.0, self.stop + self.give, PAST)
            for share in (0.0, 0.5, 1.0)
        ]
        return lift + drop + past

    def places(self, pose: Pose) -> dict[str, np.ndarray]:
        """Return the pose (4, 4; mm) of every link in the body's frame."""
        leg = self.joints["leg"] @ _turn(pose.leg)
        ankle = (leg @ self.joints["ankle"])[[0, 2], 3] * 1000.0
        front = self.joints["front"][[0, 2], 3] * 1000.0
        l3, l4 = (1000.0 * math.hypot(*np.array(self.loop["loop"][key])[[0, 2]]) for key in ("point_a_m", "point_b_m"))
        way = front - ankle
        distance = math.hypot(*way)
        along = (l4**2 - l3**2 + distance**2) / (2.0 * distance)
        across = math.sqrt(l4**2 - along**2)
        unit = way / distance
        eye = ankle + along * unit - across * np.array([-unit[1], unit[0]])  # below the line to the front pivot
        links = {"body": np.eye(4), "main_leg": leg}
        if "steer" in self.joints:  # a wheel is round: as it stands is as it turns
            links["wheel"] = self.joints["steer"].copy()
        for name, start in (("front_link", front), ("foot", ankle)):
            below = math.atan2(-(eye - start)[1], (eye - start)[0])
            links[name] = _turn(below)
            links[name][[0, 2], 3] = start / 1000.0
        for matrix in links.values():
            matrix[:3, 3] *= 1000.0
        return links

    def leg_place(self, leg_rad: float) -> np.ndarray:
        """Return the pose (4, 4; mm) of the main leg in the body's frame."""
        matrix: np.ndarray = self.joints["leg"] @ _turn(leg_rad)
        matrix[:3, 3] *= 1000.0
        return matrix

    def meetings(self, poses: Sequence[Pose] | None = None) -> Iterator[tuple[str, str, float, Pose]]:
        """Yield the pieces that meet in some positions, those of `poses()` by default: names, shared volume (mm³)."""
        poses = self.poses() if poses is None else poses
        places = [self._matrices(pose) for pose in poses]
        corners = [np.asarray(piece.solid.hull().to_mesh().vert_properties)[:, :3] for piece in self.pieces]
        boxes = np.array([[_box(*pair) for pair in zip(corners, matrices, strict=True)] for matrices in places])
        near = self._near(boxes)
        volumes: dict[tuple[tuple[int, float], ...], float] = {}  # many poses have the same leg, or the same cam
        for pose, matrices, box in zip(poses, places, boxes, strict=True):
            beyond = (box[:, None, :3] >= box[None, :, 3:]).any(axis=2)
            placed = {i: self.pieces[i].solid.transform(matrices[i][:3]) for i in self.moving}
            for i, j in np.argwhere(np.triu(~(beyond | beyond.T), 1)).tolist():
                a, b = self.pieces[i], self.pieces[j]
                if not self._moves(a, b, pose):
                    continue
                one, other = ((near[k, m] if k not in placed else placed[k]) for k, m in ((i, j), (j, i)))
                if one.is_empty() or other.is_empty():
                    continue
                where = (i, self._angle(a, pose)), (j, self._angle(b, pose))
                if where not in volumes:
                    volumes[where] = (one ^ other).volume()
                if (volume := volumes[where]) > (1.0 if a.printed or b.printed else 2.0) * TOLERANCE_MM3:
                    yield a.name, b.name, volume, pose

    def _near(self, boxes: np.ndarray) -> dict[tuple[int, int], Manifold]:
        """Return what of each fixed piece lies in the box that a moving one sweeps, by both: less to cut in each pose.

        `boxes` (poses, pieces, 6) are the corners, least ones first.
        """
        low, high = boxes[..., :3].min(axis=0), boxes[..., 3:].max(axis=0)
        swept = {j: Manifold.cube((high[j] - low[j]).tolist()).translate(low[j].tolist()) for j in self.moving}
        fixed = [i for i in range(len(self.pieces)) if i not in swept]
        return {(i, j): self.pieces[i].solid ^ box for j, box in swept.items() for i in fixed}

    def _angle(self, piece: Piece, pose: Pose) -> float:
        """Return the angle on which a piece's place depends (rad)."""
        return pose.cam if piece.name in TURNING else pose.leg if piece.link != "body" else 0.0

    def _moves(self, a: Piece, b: Piece, pose: Pose) -> bool:
        """Tell whether two pieces move past each other and may not meet."""
        names = {a.name, b.name}
        if names <= set(TRAIN) or (a.name.startswith("spring_") and b.name.startswith(a.name[:9])):
            return False  # wheels in mesh; coil and arm of one wire
        if names == {"stop_pad", "main_leg"}:
            return pose.leg < self.stop - 1e-9
        return a.link != b.link or bool(names & TURNING)

    def _matrices(self, pose: Pose) -> list[np.ndarray]:
        """Return the pose (4, 4; mm) of every piece."""
        links, there, back = self.places(pose), np.eye(4), np.eye(4)
        there[[0, 2], 3], back[[0, 2], 3] = self.axes["cam_gear"], -self.axes["cam_gear"]
        turned = links["body"] @ there @ _turn(pose.cam) @ back
        return [turned if piece.name in TURNING else links[piece.link] for piece in self.pieces]

    def _roller_gaps(self, legs: np.ndarray, turns: np.ndarray | float) -> np.ndarray:
        """Return the gaps (n,) between roller and cam (mm); negative where they meet."""
        frame, centre = self.joints["leg"], self.axes["cam_gear"]
        right, up = self.roller_at / 1e3  # a turn about y brings x towards -z
        turned = np.stack([np.cos(legs) * right + np.sin(legs) * up, np.cos(legs) * up - np.sin(legs) * right])
        x, z = 1e3 * (frame[np.ix_([0, 2], [0, 2])] @ turned + frame[[0, 2], 3][:, None]) - centre[:, None]
        cos, sin = np.cos(turns), np.sin(turns)  # turned back into the cam's frame
        seen = shapely.points(centre[0] + cos * x - sin * z, centre[1] + sin * x + cos * z)
        return np.where(self.cam.contains(seen), 0.0, self.cam.distance(seen)) - self.roller_mm

    def _legs_on_cam(self, turns: np.ndarray) -> np.ndarray:
        """Return the leg's angles (n,) while its roller lies on the cam: those nearest to rest without overlap."""
        legs = np.linspace(0.0, self.wound, 60)
        free = np.full(len(turns), len(legs) - 1)
        for i in range(len(legs))[::-1]:
            free[self._roller_gaps(np.full(len(turns), legs[i]), turns) >= -FACET_MM] = i
        low, high = legs[np.maximum(free - 1, 0)], legs[free]
        for _ in range(20):
            middle = (low + high) / 2.0
            meet = self._roller_gaps(middle, turns) < -FACET_MM
            low, high = np.where(meet, middle, low), np.where(meet, high, middle)
        return high


def _section(solid: Manifold, y_mm: float) -> shapely.Geometry:
    """Return the outline of a piece at y."""
    rings = solid.rotate([90.0, 0.0, 0.0]).slice(y_mm).to_polygons()  # y becomes z, z becomes -y
    outline = max((shapely.Polygon(ring) for ring in rings), key=lambda ring: ring.area)
    return shapely.transform(outline, lambda points: points * [1.0, -1.0])


def _box(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return the corners (6,) of the box around points (n, 3), moved: the least ones, the largest ones."""
    moved = points @ matrix[:3, :3].T + matrix[:3, 3]
    return np.concatenate([moved.min(axis=0), moved.max(axis=0)])


def _turn(angle: float) -> np.ndarray:
    return trimesh.transformations.rotation_matrix(angle, [0.0, 1.0, 0.0])


def _frame(element: ET.Element) -> np.ndarray:
    origin = element.find("origin")
    assert origin is not None
    xyz, rpy = (np.array([float(value) for value in origin.get(key, "0 0 0").split()]) for key in ("xyz", "rpy"))
    matrix = trimesh.transformations.euler_matrix(*rpy, "sxyz")
    matrix[:3, 3] = xyz
    return matrix


@cache
def _solid(stl: bytes) -> Manifold:
    """Return what an STL file encloses; many robots have the same motor, bearings and screws."""
    mesh = trimesh.load_mesh(io.BytesIO(stl), file_type="stl")
    mesh.merge_vertices()
    return Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))


def _piece(folder: Path, link: str | None, visual: ET.Element) -> Piece:
    file = visual.find("geometry/mesh")
    assert link is not None
    assert file is not None
    path = folder / "urdf" / str(file.get("filename"))
    printed = folder / "stl" / path.name
    solid = _solid((printed if printed.exists() else path).read_bytes())
    assert solid.volume() > 0.0, visual.get("name")
    matrix = _frame(visual)
    matrix[:3, 3] *= 1000.0
    return Piece(str(visual.get("name")), link, solid.transform(matrix[:3]), printed.exists())


if __name__ == "__main__":
    bundle = Bundle(Path(sys.argv[1]))
    worst: dict[tuple[str, str], tuple[float, Pose]] = {}
    for one, other, shared, where in bundle.meetings():
        if shared > worst.get((one, other), (0.0, where))[0]:
            worst[one, other] = shared, where
    print(f"{len(bundle.poses())} positions, {len(bundle.pieces)} pieces")
    for (one, other), (shared, where) in worst.items():
        print(f"{one} {other} {shared:.2f} mm3 leg {math.degrees(where.leg):.1f} cam {math.degrees(where.cam):.1f}")
