"""The release of an exported robot, simulated with contacts: a program apart from jumpcad, which it does not import.

Reads a bundle's printed parts, bought parts' meshes, URDF, loop.json and manifest. The cam is the outline of its mesh,
the roller a circle on a lever that bends, the leg a four-bar whose foot stands on the ground; between them elastic
contacts. The dog's play is measured on the jaws of the meshes. Cam, gear and rotor have a moment of inertia each;
flanks of dog and gearhead are springs with damping. From the manifest come figures that no mesh has: inertias of gear,
rotor and roller, friction, stiffnesses.

Unlike the model in jumpcad/drive it steps in time, with rebound and hops in every contact.
"""

import itertools
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
"""Of the roller on the cam, as a share of the critical one: a rebound with about half of the speed."""
APART_S = 0.002
"""Without contact for as long, the roller has left the cam; hops are shorter."""
AFTER_S = 0.025
"""Simulated beyond first parting and blow: the cam rebounds once or twice, and later blows are weaker."""
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
        self.folder, self.printed, self.root = urdf.parent, bundle / "stl", ET.parse(urdf).getroot()
        self.joints = {joint.attrib["name"]: joint for joint in self.root.iter("joint")}

    def mesh(self, name: str) -> trimesh.Trimesh:
        """Return a mesh in its link's frame (m): as it is printed, since the URDF's meshes leave out 0.05 mm."""
        visual = next(item for item in self.root.iter("visual") if item.attrib["name"] == name)
        origin, shape = visual.find("origin"), visual.find("geometry/mesh")
        assert origin is not None
        assert shape is not None
        path = self.folder / shape.attrib["filename"]
        printed = self.printed / path.name
        mesh = trimesh.load(printed if printed.exists() else path)
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
        assert None not in (origin, mass, moments)
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
    """Return a mesh's section across y as an area of x-z (mm)."""
    lines = trimesh.intersections.mesh_plane(mesh, [0.0, 1.0, 0.0], [0.0, y_m, 0.0])[:, :, ::2]
    return shapely.union_all(trimesh.load_path(1000.0 * lines).polygons_full)


def middle_y(mesh: trimesh.Trimesh) -> float:
    """Return the middle of a mesh across the robot."""
    return float(mesh.bounds[:, 1].mean())


class Leg:
    """Body and legs as the leg joint feels them on a flat foot: I, its slope, and weight by wind angle."""

    def __init__(self, files: Files) -> None:
        wound = files.loop["spring"]["wind_rad"]
        self.wind = np.linspace(-0.05, 1.0, 85) * wound
        hub, rest = files.hinge("leg")
        front, _ = files.hinge("front")
        (leg_m, _), (link_m, _), (foot_m, _) = (
            (np.linalg.norm(point), None)
            for point in (files.hinge("ankle")[0], files.loop["loop"]["point_a_m"], files.loop["loop"]["point_b_m"])
        )
        states = []
        for wind in self.wind:
            ankle = hub + turned(np.array([leg_m, 0.0]), rest - wind)
            across = front - ankle
            distance = np.linalg.norm(across)
            along = (foot_m**2 - link_m**2 + distance**2) / (2.0 * distance)
            unit = across / distance
            aside = math.sqrt(foot_m**2 - along**2) * np.array([unit[1], -unit[0]])  # the eye lies below the diagonal
            eye = ankle + along * unit + aside
            foot = eye - ankle
            pitch = math.atan2(foot[1], foot[0])
            below = eye - front
            angles = {"body": 0.0, "main_leg": rest - wind, "front_link": -math.atan2(below[1], below[0])}
            origins = {"body": np.zeros(2), "main_leg": hub, "front_link": front}
            row = []
            for name, angle in angles.items():
                mass, com, inertia = files.link(name)
                seen = turned(origins[name] + turned(com, angle) - ankle, pitch)
                row += [math.sqrt(mass) * seen[0], math.sqrt(mass) * seen[1], math.sqrt(inertia) * (angle + pitch)]
                row.append(mass * G * seen[1])
            states.append(row)
        table = np.array(states)
        slope = np.gradient(table, self.wind, axis=0)
        moving = [column for column in range(12) if column % 4 < 3]
        self.inertia = (slope[:, moving] ** 2).sum(axis=1)
        self.bend = np.gradient(self.inertia, self.wind)
        self.weight = slope[:, 3::4].sum(axis=1)

    def at(self, wind: float) -> tuple[float, float, float]:
        """Return inertia, its slope, and the torque of weight at a wind angle."""
        place = min(max((wind - self.wind[0]) / (self.wind[1] - self.wind[0]), 0.0), len(self.wind) - 1.001)
        low = int(place)
        share = place - low
        return tuple(
            float(column[low] + share * (column[low + 1] - column[low]))
            for column in (self.inertia, self.bend, self.weight)
        )  # type: ignore[return-value]


class Contact:
    """Release of one bundle. Angles: `wind` of leg and roller, and the cam's turn clockwise from its mesh's place."""

    def __init__(self, bundle: Path) -> None:
        self.files = files = Files(bundle)
        self.leg = Leg(files)
        cam, gear, roller = (files.mesh(name) for name in ("cam", "cam_gear", "roller"))
        hub, self.rest = files.hinge("leg")
        # in mm from the hub from here on
        start = turned(roller.bounds.mean(axis=0)[[0, 2]], self.rest)
        self.roller_mm = 500.0 * float(np.ptp(roller.bounds[:, 0]))
        self.lever_mm = 1000.0 * float(np.linalg.norm(start))
        self.lever_rad = math.atan2(start[1], start[0])
        hole = files.mesh("cam_axle").bounds.mean(axis=0)[[0, 2]]
        self.axis = 1000.0 * (hole - hub)
        roller_y = middle_y(roller)
        area = section(cam, roller_y)
        outline = np.array(shapely.Polygon(area.exterior).exterior.coords) - 1000.0 * hole
        self.start, self.edge = outline[:-1], np.diff(outline, axis=0)
        self.edge_square = (self.edge**2).sum(axis=1)
        jaws, pockets = (affinity.translate(section(mesh, middle_y(gear)), *(-1000.0 * hole)) for mesh in (cam, gear))
        self.play = self._play(jaws, pockets)
        share = files.grams("cam") / 1e6 / cam.volume * 1e3
        moment = cam.moment_inertia[1, 1] + cam.volume * ((cam.center_mass[[0, 2]] - hole) ** 2).sum()
        self.cam_kg_m2 = float(share * moment)

    def _play(self, jaws: Any, pockets: Any) -> float:
        """Return how far the jaws turn clockwise until they meet the pockets' far ends (rad)."""
        low, high = 0.0, math.pi
        first = jaws.intersection(pockets).area
        for _ in range(40):
            middle = (low + high) / 2.0
            spun = affinity.rotate(jaws, -middle, (0, 0), use_radians=True)
            low, high = (low, middle) if spun.intersection(pockets).area > first + 1e-3 else (middle, high)
        return low

    def gap_mm(self, wind: float, cam: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Return the gap of roller and cam (mm), the normal towards the roller, and the point, both in the body."""
        centre = self.lever_mm * np.array([math.cos(self.lever_rad + wind), math.sin(self.lever_rad + wind)])
        seen = turned(centre - self.axis, -cam)
        away = seen - self.start
        share = np.clip((away * self.edge).sum(axis=1) / self.edge_square, 0.0, 1.0)
        nearest = away - share[:, None] * self.edge
        square = (nearest**2).sum(axis=1)
        index = int(square.argmin())
        distance = math.sqrt(square[index])
        # counter-clockwise outline: the inside is to the left
        side = self.edge[index, 0] * away[index, 1] - self.edge[index, 1] * away[index, 0]
        sign = -1.0 if side > 0.0 and 0.0 < share[index] < 1.0 else 1.0
        normal = turned(sign * nearest[index] / distance, cam)
        point = self.axis + turned(seen - nearest[index], cam)
        return sign * distance - self.roller_mm, normal, point

    def wind_at(self, cam: float) -> float:
        """Return the wind angle at which the roller lies on the cam."""
        low, high = -0.2, self.files.loop["spring"]["wind_rad"] + 0.2
        for _ in range(50):
            middle = (low + high) / 2.0
            low, high = (middle, high) if self.gap_mm(middle, cam)[0] < 0.0 else (low, middle)
        return high

    def run(
        self, motor: dict[str, float], play: float | None = None, longest_s: float = 0.3, step_s: float = STEP_S
    ) -> Outcome:
        """Simulate a release with one of the manifest's assumed motors; `play` (rad) replaces the measured one.

        It ends when roller and cam have parted and the cam has struck its gear, after `longest_s` at the latest.
        """
        play = self.play if play is None else play
        spring = self.files.loop["spring"]
        rate, wound = spring["stiffness_nm_per_rad"], spring["wind_rad"]
        lever, train, backlash = (
            motor["lever_nm_per_rad"],
            motor["train_nm_per_rad"],
            math.radians(motor["backlash_deg"]),
        )
        arm_m, lift = self.lever_mm / 1000.0, self._end_of_lift(wound)
        tip_inertia = motor["roller_kg_m2"]
        masses = np.array([self.cam_kg_m2, motor["gear_kg_m2"], motor["rotor_kg_m2"]])
        above = self.wind_at(lift)
        contact = motor["contact_nm_per_rad"] / self._arm_m(above, lift) ** 2
        weight = self.leg.at(above)[2]
        both = 1.0 / (1.0 / lever + 1.0 / motor["contact_nm_per_rad"])
        wind = (both * above - weight) / (both + rate)
        roller = wind + both * (above - wind) / lever
        turn, speed = np.array([lift, lift, lift]), np.full(3, motor["cam_rad_s"])
        before = math.radians(0.2)
        wind_rate = roller_rate = (above - self.wind_at(lift - before)) / before * motor["cam_rad_s"]
        kick = blow = 0.0
        left = kept = raised = 0.0
        parted = struck = math.inf
        share = damping(motor["rebound"])
        damp = [2.0 * share * math.sqrt(train * a * b / (a + b)) for a, b in itertools.pairwise(masses)]
        damp_roller = 2.0 * DAMPING * math.sqrt(contact * tip_inertia) / arm_m
        damp_lever = 0.04 * math.sqrt(lever * tip_inertia)
        for step in range(int(longest_s / step_s)):
            if step * step_s > max(parted, struck) + AFTER_S:
                break
            gap, normal, point = self.gap_mm(roller, float(turn[0]))
            force = 0.0
            centre = self.lever_mm * np.array([math.cos(self.lever_rad + roller), math.sin(self.lever_rad + roller)])
            arm = (normal[1] * centre[0] - normal[0] * centre[1]) / 1000.0
            off = (point - self.axis) / 1000.0
            cam_arm = off[0] * normal[1] - off[1] * normal[0]
            if gap < 0.0:
                closing = -(arm * roller_rate + cam_arm * speed[0])
                force = max(-contact * gap / 1000.0 + damp_roller * closing, 0.0)
            inertia, bend, weight = self.leg.at(wind)
            if force > 0.0:
                left = step * step_s
                kept = 0.5 * rate * wind**2 + 0.5 * inertia * wind_rate**2 + raised
            bent = lever * (roller - wind) + damp_lever * (roller_rate - wind_rate)
            wind_rate += step_s * (bent - rate * max(wind, 0.0) - weight - 0.5 * bend * wind_rate**2) / inertia
            roller_rate += step_s * (force * arm - bent) / tip_inertia
            friction = motor["friction_mm"] / 1000.0 * force * math.tanh(speed[0] / 0.05)
            dog = _flanks(turn[0] - turn[1], speed[0] - speed[1], play, train, damp[0])
            head = _flanks(turn[1] - turn[2], speed[1] - speed[2], backlash, train, damp[1])
            speed[0] += step_s * (force * cam_arm - friction - dog) / masses[0]
            speed[1] += step_s * (dog - head) / masses[1]
            speed[2] = max(speed[2] + step_s * head / masses[2], motor["cam_rad_s"])  # the motor still runs
            blow, kick = max(blow, dog), max(kick, head)
            parted = min(parted, step * step_s) if gap > 0.0 and step * step_s > left + APART_S else parted
            struck = min(struck, step * step_s) if dog > 0.0 else struck
            raised += step_s * weight * wind_rate  # what lifted the body is not lost
            wind, roller, turn = wind + step_s * wind_rate, roller + step_s * roller_rate, turn + step_s * speed
        ratio = self.files.manifest["drive"]["release"]["gear_ratio"]
        return Outcome(kept / (0.5 * rate * wound**2), kick / ratio, blow, math.degrees(play), left)

    def _arm_m(self, roller: float, cam: float) -> float:
        """Return the arm of the contact's force about the leg's joint."""
        _, normal, _ = self.gap_mm(roller, cam)
        centre = self.lever_mm * np.array([math.cos(self.lever_rad + roller), math.sin(self.lever_rad + roller)])
        return float(normal[1] * centre[0] - normal[0] * centre[1]) / 1000.0

    def _end_of_lift(self, wound: float) -> float:
        """Return the cam's turn at which the roller stands highest, less a degree."""
        turns = np.radians(np.arange(300.0, 316.0, 0.25))
        winds = [self.wind_at(turn) for turn in turns]
        assert abs(max(winds) - wound) < 0.01
        return float(turns[int(np.argmax(winds))]) - math.radians(0.5)


def damping(rebound: float) -> float:
    """Return the damping, as a share of the critical one, with which a spring that only pushes throws a mass back."""
    shares = np.linspace(0.0, 0.5, 501)
    step, thrown = 0.01, []
    for share in shares[::10]:  # a mass of 1 on a spring of 1
        place, speed = 0.0, 1.0
        while True:
            push = place + 2.0 * share * speed
            if push < 0.0:
                break
            speed -= step * push
            place += step * speed
        thrown.append(-speed)
    return float(np.interp(-rebound, -np.array(thrown), shares[::10]))


def _flanks(ahead: float, faster: float, free: float, stiffness: float, damping: float) -> float:
    """Return the torque of a driven part on its driver that is ahead of it, free to run ahead by an angle."""
    if ahead < 0.0:
        return min(stiffness * ahead + damping * faster, 0.0)
    if ahead > free:
        return max(stiffness * (ahead - free) + damping * faster, 0.0)
    return 0.0
