"""Assembly: every part has a free path to its place, and every fastener is reached by its tool (mm).

Paths are straight. The volume that a stack sweeps along its axis, or square to it, is again a stack and is computed
exactly. For other shapes the obstacle is swept in the opposite direction; where this is not possible either, positions
along the path are sampled.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from operator import attrgetter

import numpy as np

from jumpcad.checks.interference import Piece, box_of, may_share, shared_volume_mm3
from jumpcad.findings import Basis, Finding, Remedy, choose, higher, lower
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.cage.limits import ELSEWHERE
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.solids.outline import disc
from jumpcad.solids.overlap import swept
from jumpcad.solids.stack import Stack
from jumpcad.steps.assembly_steps import SIDES, MovedParts, Step, Tool, assembly_steps, travel
from jumpcad.transforms import Array, chained

AROUND = ("from the front", "from behind", "from above", "from below")
"""Sides from which a clip may be put on."""
OF_FOOT = ("ankle_pin", "toe_")
"""Beginnings of the names of what the foot's toes may stand in the way of."""
TOLERANCE_MM2 = 0.05
"""Section that may be shared along a path: facets of circles that touch, as of an axle in its bore."""
BEYOND_MM = 5.0
"""Distance from all present parts at which paths begin."""
SAMPLES_MM = 0.5
"""Distance of sampled positions."""
FREE = f"at most {TOLERANCE_MM2:g} mm² are covered"
SHARED = f"volume shared with what is there/length ≤ {TOLERANCE_MM2:g} mm²"
BASIS = {
    "assembly_paths": Basis(
        f"{SHARED}, of every part on its straight path; length: the shorter of path and obstacle along it",
        "swept solids; tolerance: facets of circles",
    ),
    "tool_access": Basis(
        f"{SHARED}, of the room of every fastener's tool; length: the shorter of tool and obstacle along it",
        "solids; tools: jumpcad/steps/assembly_steps.py; tolerance: facets of circles",
    ),
}


@dataclass(frozen=True)
class Blocked:
    """A path or a tool with an obstacle, and the area of its cross section that the obstacle covers (mm²)."""

    step: Step
    name: str
    by: str
    share_mm2: float


def paths(ways: Iterable["Way"]) -> Iterator[tuple["Way", Blocked | None]]:
    """Yield every move along a path, with its largest obstacle, or None."""
    for way in ways:
        if way.placed.move.way != "laid":
            found = [_in_the_way(way, mover, path) for mover, path in zip(way.movers, way.paths_mm, strict=True)]
            yield way, max((one for one in found if one), key=attrgetter("share_mm2"), default=None)


def tools(ways: Iterable["Way"]) -> Iterator[tuple[Tool, str, Blocked | None]]:
    """Yield every fastener's tool, the fastener's name, and the tool's largest obstacle, or None."""
    for way in ways:
        if (tool := way.placed.move.tool) is not None:
            for mover, path in zip(way.movers, way.paths_mm, strict=True):
                yield tool, mover.name, _tool_blocked(way, tool, mover, path)


def assembly_findings(robot: Robot) -> list[Finding]:
    """Return `assembly_paths` and `tool_access`, one for each that is blocked, or one that says that none is."""
    ways = assembly_ways(robot)
    moves, fasteners = list(paths(ways)), list(tools(ways))
    blocked_paths = [blocked for *_, blocked in moves if blocked]
    blocked_tools = [blocked for *_, blocked in fasteners if blocked]
    return [
        *_findings("assembly_paths", blocked_paths, f"all {len(moves)} moves of the assembly have a free path: {FREE}"),
        *_findings("tool_access", blocked_tools, f"the tool reaches all {len(fasteners)} fasteners: {FREE}"),
    ]


def _findings(name: str, blocked: list[Blocked], none: str) -> Iterator[Finding]:
    for one in blocked:
        what = "path" if name == "assembly_paths" else "tool"
        message = f"{one.by} blocks the {what} of {one.name} in step {one.step.title}: it covers "
        message += f"{one.share_mm2:.2f} mm²; {TOLERANCE_MM2:g} mm² are allowed"
        longer = higher("carrying_link_mm", "d_coef", note="a longer body")
        ways: Remedy = longer + choose("another", "bought.retention")
        if one.name.startswith(OF_FOOT):
            ways = lower("ground_link_angle_deg", note="toes that point more ahead")
        elif "cage_" in (one.name[:5], one.by[:5]):
            ways = ELSEWHERE
        margin = TOLERANCE_MM2 - one.share_mm2
        yield Finding(name, "error", margin, "mm²", message, ways, value=one.share_mm2, limit=TOLERANCE_MM2)
    if not blocked:
        yield Finding(name, "info", TOLERANCE_MM2, "mm²", none, "nothing to do", limit=TOLERANCE_MM2)


@dataclass(frozen=True)
class Way:
    """One move: the moving parts, the path (3,) of each, and the parts that are already there, in the world (mm)."""

    step: Step
    placed: MovedParts
    movers: list[Piece]
    paths_mm: list[Array]
    there: list[Piece]


def assembly_ways(robot: Robot) -> list[Way]:
    poses = body_poses(robot)
    pieces = {thing.name: _piece(thing, poses[thing.body]) for thing in visuals(robot)}
    built: dict[str, list[Piece]] = {}
    ways = []
    for step in assembly_steps(robot):
        there = built.setdefault(step.onto, [])
        for placed in step.placed:
            if placed.move.brings and not placed.move.trial:
                built.pop(placed.move.brings)
            way = Way(step, placed, [pieces[thing.name] for thing in placed.things], [], [*there])
            for thing, mover in zip(placed.things, way.movers, strict=True):
                side = travel(robot, thing, placed.move, poses[thing.body])
                if placed.move.way == "snapped":
                    way.paths_mm.append(_snapped(way, mover, side))
                else:
                    back = _depth(mover, side) if placed.move.way == "bent" else _reach(mover, there, side)
                    way.paths_mm.append(back * side)
            ways.append(way)
            there += way.movers
        tried = {thing.name for placed in step.placed if placed.move.trial for thing in placed.things}
        there[:] = [piece for piece in there if piece.name not in tried]
    return ways


def _snapped(way: Way, mover: Piece, side: Array) -> Array:
    """Return the path (3,) of a clip by its own size, from the first free one of four sides around its axle."""
    around = [side] if way.placed.move.along != "sideways" else [SIDES[name] for name in AROUND]
    paths: list[Array] = [_depth(mover, one) * one for one in around]
    return next((path for path in paths if _in_the_way(way, mover, path) is None), paths[0])


def _piece(thing: Visual, T_world_body: Array) -> Piece:
    """Return a part at its place in the world (mm)."""
    pose = chained(T_world_body, thing.T_body_mesh)
    pose[:3, 3] *= 1000.0
    return Piece(thing.name, thing.body, thing.source.shape, pose)


def _in_the_way(way: Way, mover: Piece, path_mm: Array) -> Blocked | None:
    """Return the largest obstacle of a part on its path."""
    length = float(np.linalg.norm(path_mm))
    if length == 0.0:
        return None
    low, high = box_of(mover, mover.T_body_part)
    low, high = np.minimum(low, low - path_mm), np.maximum(high, high - path_mm)
    room = _swept(mover, path_mm)
    blocked = []
    for other in way.there:
        other_low, other_high = box_of(other, other.T_body_part)
        apart = bool((low >= other_high).any() or (other_low >= high).any())
        if apart or _passes(way.placed, other.name) or may_share(mover.name, other.name):
            continue
        share = _covered(mover, room, other, path_mm) / min(length, _depth(other, path_mm / length))
        if share > TOLERANCE_MM2:
            blocked.append(Blocked(way.step, mover.name, other.name, share))
    return max(blocked, key=attrgetter("share_mm2"), default=None)


def _tool_blocked(way: Way, tool: Tool, fastener: Piece, path_mm: Array) -> Blocked | None:
    """Return the largest obstacle of a fastener's tool."""
    reach = way.placed.move.reach
    shaft = _tool(tool, fastener, -SIDES[reach] if reach in SIDES else -path_mm / np.linalg.norm(path_mm))
    blocked = []
    for other in (*way.there, *way.movers):
        if other is fastener or _passes(way.placed, other.name):
            continue
        share = _shared(shaft, other) / min(tool.length_mm, _depth(other, shaft.T_body_part[:3, 2]))
        if share > TOLERANCE_MM2:
            blocked.append(Blocked(way.step, fastener.name, other.name, share))
    return max(blocked, key=attrgetter("share_mm2"), default=None)


def _covered(mover: Piece, room: Piece | None, other: Piece, path_mm: Array) -> float:
    """Return the volume that a part shares with another on its path (mm³); an upper estimate where it is sampled.

    `room` is what the part sweeps, if that is known.
    """
    if room is not None:
        return _shared(room, other)
    if (swept_by_other := _swept(other, -path_mm)) is not None:
        return _shared(mover, swept_by_other)
    length = float(np.linalg.norm(path_mm))
    worst = 0.0
    for share in np.linspace(0.0, 1.0, int(length / SAMPLES_MM) + 2):
        pose = mover.T_body_part.copy()
        pose[:3, 3] -= share * path_mm
        worst = max(worst, shared_volume_mm3(mover, pose, other, other.T_body_part))
    return worst * length


def _swept(thing: Piece, path_mm: Array) -> Piece | None:
    if not isinstance(thing.shape, Stack):
        return None
    shape = swept(thing.shape, np.einsum("ji,j->i", thing.T_body_part[:3, :3], path_mm))
    return None if shape is None else Piece(thing.name, thing.body, shape, thing.T_body_part)


def _shared(a: Piece, b: Piece) -> float:
    return shared_volume_mm3(a, a.T_body_part, b, b.T_body_part)


def _depth(thing: Piece, along: Array) -> float:
    """Return how far a thing's box reaches in a direction (3,)."""
    corners = box_of(thing, thing.T_body_part) * along
    return float(corners.max(axis=0).sum() - corners.min(axis=0).sum())


def _reach(mover: Piece, there: list[Piece], along: Array) -> float:
    """Return how far back a part must be to be clear of all present parts."""
    if not there:
        return 0.0
    front = float((box_of(mover, mover.T_body_part) * along).max(axis=0).sum())
    rear = min(float((box_of(other, other.T_body_part) * along).min(axis=0).sum()) for other in there)
    return max(front - rear, 0.0) + BEYOND_MM


def _tool(tool: Tool, fastener: Piece, side: Array) -> Piece:
    """Return the room of a tool on a fastener, from its face towards a side."""
    low, high = fastener.shape.bounds_mm
    middle = fastener.T_body_part @ np.array([*(low + high) / 2.0, 1.0])
    corners = np.einsum("ij,nj->ni", fastener.T_body_part, fastener.corners)[:, :3]
    start = middle[:3] + side * (np.einsum("ni,i->n", corners, side).max() - middle[:3] @ side)
    pose = np.eye(4)
    across = np.array([0.0, 1.0, 0.0]) if abs(side[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    x = np.cross(across, side)
    x /= np.linalg.norm(x)
    pose[:3, :3] = np.column_stack([x, np.cross(side, x), side])
    pose[:3, 3] = start
    return Piece(tool.name, fastener.body, Stack.of([(0.0, tool.length_mm, disc(tool.diameter_mm))]), pose)


def _passes(placed: MovedParts, name: str) -> bool:
    return bool(placed.move.past) and re.fullmatch(placed.move.past, name) is not None
