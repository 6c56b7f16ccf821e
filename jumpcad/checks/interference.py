"""Interference: exact intersection volumes of solids over the cam's lift, the roller's drop and up to the stop (mm).

Nearly every part is extruded along y, as all motion is in planes parallel to x-z, so most pairs are compared as flat
regions over common intervals of y; the others as solids.
"""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from manifold3d import Manifold

from jumpcad.findings import Basis, Finding, higher, lower
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.parts.part import Shape, Shaped
from jumpcad.robot.cage.limits import ELSEWHERE
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.overlap import overlap_volume_mm3
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array, pose_about_y

WAYS = higher("carrying_link_mm", "d_coef") + lower("compression_ratio")
WINDING_POSITIONS = 13
DROP_POSITIONS = 13
PAST_POSITIONS = 3
AHEAD_SHARES = (0.0, 0.5, 1.0)
"""Leg positions from rest to the end of the pad's deflection, each with the cam ahead of its gear by shares of the
play."""
TOLERANCE_MM3 = 0.05
"""Facets of two circles that touch share less than this."""
MARGIN_MM = 0.1
"""Around the box of another piece; what is farther away is left out where solids are compared."""
TURNING = ("cam", "cam_gear", "idler", "motor_pinion", "motor_shaft")
COUPLED = {"cam", "cam_gear"}
"""They turn as one, but where the cam has run ahead."""
INTENDED = (
    ("cap_screw", "body_plate_right", "thread"),
    ("sensor_screw", "body_plate_left", "thread"),
    ("switch_screw", "switch", "thread"),
    ("standoff", "standoff", "thread"),
    ("toe", "foot", "thread"),
    ("motor_pinion", "motor_shaft", "crush ribs"),
    ("steering_wheel", "steering_shaft", "crush ribs"),
    ("spring_left", "spring_left_leg_arm", "coil and arm are one wire"),
    ("spring_right", "spring_right_leg_arm", "coil and arm are one wire"),
    ("stop_pad", "main_leg", "the pad is compressed"),
)
"""Pairs of name prefixes that may share volume, and why."""
BASIS = {
    "interference": Basis(
        f"volume that two pieces share in any position ≤ {TOLERANCE_MM3:g} mm³",
        "solids, exact; tolerance: facets of circles",
    )
}


@dataclass(frozen=True)
class Piece(Shaped):
    """One printed or bought piece at its place in its body's frame."""

    name: str
    body: str
    shape: Shape
    T_body_part: Array

    @cached_property
    def corners(self) -> Array:
        """The corners (8, 4) of its bounding box in its own frame, homogeneous."""
        low, high = self.shape.bounds_mm
        return np.array([[*corner, 1.0] for corner in itertools.product(*zip(low, high, strict=True))])


@dataclass(frozen=True)
class Position:
    """One position of the mechanism: its name, leg angle and cam angle (rad).

    `ahead_rad` is how far the cam has run ahead of its gear, which stands at `cam_rad`.
    """

    label: str
    leg_rad: float
    cam_rad: float
    ahead_rad: float = 0.0


def pieces_of(robot: Robot) -> list[Piece]:
    """Return every piece of a robot, each copy separately."""
    printed = [
        Piece(part.name, placement.body, part.shape, placement.T_body_part)
        for part in robot.parts
        for placement in part.placements
    ]
    return printed + [Piece(item.name, item.body, item.shape, item.T_body_part) for item in robot.hardware]


def positions(robot: Robot) -> list[Position]:
    """Return the positions that are checked: the cam's lift, the roller's drop, rest, and past it.

    While the roller drops, the corner that it leaves has pushed the cam ahead of its gear by the dog's play.
    """
    cam, loaded = robot.layout.drive.cam, robot.design.compression_rad
    lift = np.linspace(0.0, cam.law.lift_rad, WINDING_POSITIONS)
    winding = [
        Position(f"loaded by {math.degrees(wind):.1f}°", -float(wind), float(turn))
        for turn, wind in zip(lift, cam.wind_rad(lift), strict=True)
    ]
    play = robot.layout.drive.dog.play_rad
    drop = [
        Position(f"dropping, at {math.degrees(wind):.1f}°", -float(wind), cam.law.lift_rad, play)
        for wind in np.linspace(loaded, 0.0, DROP_POSITIONS)
    ]
    at_rest = Position("at rest", 0.0, cam.geometry.free_rad)
    stop = robot.layout.stop
    past = [
        Position(f"{math.degrees(leg):.1f}° past rest", float(leg), cam.geometry.free_rad, share * play)
        for leg in np.linspace(0.0, stop.angle_rad + robot.stop_blow.give_rad, PAST_POSITIONS)[1:]
        for share in AHEAD_SHARES
    ]
    at_stop = Position("at the stop", stop.angle_rad, cam.geometry.free_rad)
    return [*winding, *drop, at_rest, *past, at_stop]


def overlaps(robot: Robot) -> Iterator[tuple[str, str, str, float]]:
    """Yield pairs of pieces that share more than the tolerance: names, position, volume (mm³); each pair's worst."""
    layout, pieces = robot.layout, pieces_of(robot)
    worst: dict[tuple[int, int], tuple[float, str]] = {}
    settled: set[tuple[int, int, float]] = set()
    for position in positions(robot):
        poses = [pose_of(piece, layout, robot.linkage, position) for piece in pieces]
        boxes = [box_of(piece, pose) for piece, pose in zip(pieces, poses, strict=True)]
        for i, j in _near(boxes):
            a, b = pieces[i], pieces[j]
            still = a.body == b.body and a.name not in TURNING and b.name not in TURNING
            together = still or {a.name, b.name} == COUPLED
            case = (i, j, 0.0 if still else position.ahead_rad)
            if (together and case in settled) or may_share(a.name, b.name):
                continue
            settled.add(case)
            volume = shared_volume_mm3(a, poses[i], b, poses[j], once=still)
            if volume > max(TOLERANCE_MM3, worst.get((i, j), (0.0, ""))[0]):
                worst[i, j] = (float(volume), position.label)
    for (i, j), (volume, label) in sorted(worst.items(), key=lambda item: -item[1][0]):
        yield pieces[i].name, pieces[j].name, label, volume


def interference_findings(robot: Robot) -> list[Finding]:
    """Return a finding per pair of pieces that collide, or one that says that none do."""
    found = [
        Finding(
            "interference", "error", TOLERANCE_MM3 - volume, "mm³",
            f"{a} and {b} share {volume:.2f} mm³ of {TOLERANCE_MM3:g} mm³, {label}",
            ELSEWHERE if "cage_" in (a[:5], b[:5]) else WAYS,
            value=volume, limit=TOLERANCE_MM3,
        )
        for a, b, label, volume in overlaps(robot)
    ]  # fmt: skip
    none = f"no two pieces share more than {TOLERANCE_MM3:g} mm³ in {WINDING_POSITIONS} positions of winding and "
    none += f"{DROP_POSITIONS} of the drop, and past rest to the stop"
    good = Finding("interference", "info", TOLERANCE_MM3, "mm³", none, "nothing to do", limit=TOLERANCE_MM3)
    return found or [good]


def shared_volume_mm3(a: Piece, T_a: Array, b: Piece, T_b: Array, once: bool = True) -> float:
    """Return the volume that two placed pieces share (mm³).

    Of pieces that are compared `once`, the solid is made only of what is near the other, which is much quicker.
    """
    parallel = abs(abs(T_a[:3, 2] @ T_b[:3, 2]) - 1.0) < 1e-9
    if isinstance(a.shape, Stack) and isinstance(b.shape, Stack) and parallel:
        return overlap_volume_mm3(a.shape, T_a, b.shape, T_b)
    near_a, near_b = _near_other(a, T_a, b, T_b, once), _near_other(b, T_b, a, T_a, once)
    if near_a is None or near_b is None:
        return 0.0
    return float((near_a.transform(T_a[:3]) ^ near_b.transform(T_b[:3])).volume())


def _near_other(piece: Piece, T: Array, other: Piece, T_other: Array, cut: bool) -> Manifold | None:
    """Return a piece's solid, or what of a stack is in the other's box with some margin; None where nothing is."""
    low, high = box_of(other, np.linalg.inv(T) @ T_other) + np.array([[-MARGIN_MM], [MARGIN_MM]])
    lowest, highest = piece.shape.bounds_mm
    if (low >= highest).any() or (lowest >= high).any():
        return None
    if not isinstance(piece.shape, Stack) or ((low <= lowest) & (highest <= high)).all():
        return piece.solid
    box = rectangle(high[:2] - low[:2], (low[:2] + high[:2]) / 2.0)
    level = [slab for slab in piece.shape.slabs if slab.z0_mm < high[2] and low[2] < slab.z1_mm]
    within = [(slab.z0_mm, slab.z1_mm, slab.region ^ box) for slab in level]
    if all(region.is_empty() for *_, region in within):
        return None
    return Stack.of(within).solid() if cut else piece.solid


def pose_of(piece: Piece, layout: Layout, linkage: Linkage, position: Position) -> Array:
    """Return the pose (4, 4) of a piece in the body's frame (mm)."""
    T_frame_piece: Array = _frames(linkage, position.leg_rad)[piece.body] @ piece.T_body_part
    if piece.name not in TURNING:
        return T_frame_piece
    ahead = position.ahead_rad if piece.name == "cam" else 0.0
    centre, turn = _train_turn(piece.name, layout, position.cam_rad + ahead)
    return pose_about_y(turn, centre) @ pose_about_y(0.0, -centre) @ T_frame_piece


@lru_cache(maxsize=8)
def _frames(linkage: Linkage, leg_rad: float) -> dict[str, Array]:
    """Return the poses (4, 4) of all bodies in the body's frame (mm)."""
    pose = linkage.pose([leg_rad])
    return {
        BODY: np.eye(4),
        MAIN_LEG: pose_about_y(linkage.rest_rad + leg_rad, linkage.back_pivot_mm),
        FRONT_LINK: pose_about_y(linkage.rest_rad + float(pose.front_rad[0]), linkage.front_pivot_mm),
        FOOT: pose_about_y(float(pose.foot_rad[0]), pose.ankle_mm[0]),
    }


def _train_turn(name: str, layout: Layout, cam_rad: float) -> tuple[Array, float]:
    """Return a turning piece's axis (2,) and its turn about +y at a cam angle; meshing wheels turn oppositely."""
    stages = layout.drive.train.stages
    if name in COUPLED:
        return layout.cam_axis_mm, cam_rad
    idler = -cam_rad * stages[-1].ratio
    if name == "idler" and layout.idler_mm is not None:
        return layout.idler_mm, idler
    return layout.motor_mm, idler if len(stages) == 1 else -idler * stages[0].ratio


def box_of(piece: Piece, pose: Array) -> Array:
    """Return lower and upper corner (2, 3) of a placed piece's bounding box."""
    corners = np.einsum("ij,nj->ni", pose, piece.corners)[:, :3]
    return np.stack([corners.min(axis=0), corners.max(axis=0)])


def _near(boxes: list[Array]) -> Iterator[tuple[int, int]]:
    """Yield the pairs of boxes that overlap."""
    low, high = np.stack([box[0] for box in boxes]), np.stack([box[1] for box in boxes])
    meet = ((low[:, None] < high[None] - 1e-6) & (low[None] < high[:, None] - 1e-6)).all(axis=-1)
    yield from zip(*np.nonzero(np.triu(meet, 1)), strict=True)


def may_share(a: str, b: str) -> bool:
    """Tell whether two pieces may share volume."""
    pairs = ((a, b), (b, a))
    return any(x.startswith(first) and y.startswith(second) for x, y in pairs for first, second, _ in INTENDED)
