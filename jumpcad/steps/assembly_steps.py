"""The assembly steps of one robot: which parts are put on, from which side, with which tool.

The order for any robot is data, `templates/guides/assembly_order.toml`. Its parts are named by regular expressions;
those that a robot lacks are left out.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from jumpcad.files import read_toml, templates_folder
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.transforms import Array, chained

ROBOT, LOWER, UPPER, LEFT = "robot", "lower tray", "upper tray", "left plate"
"""Assemblies that other modules name: the robot is built up on the right plate, the others on the bench."""


@dataclass(frozen=True)
class Tool:
    """A straight tool: the cylinder along the fastener's axis, from its end outwards, that must be free (mm).

    Lengths and diameters are those of a usual screwdriver, key or pair of pliers.
    """

    name: str
    diameter_mm: float
    length_mm: float


@dataclass(frozen=True)
class Move:
    """Things that take their place together, by the pattern of their names.

    They come `along` a side, `head last` for screws and pins, `from outside` for toes, `from the leg`, `into its notch`
    for a hoop of the cage, `into its mount`, or `sideways` for a clip: from any side that is free.

    `way` is how the path is checked. `straight`: along its whole length, on the shapes; `bent`: over the part's own
    size only, for split pins, which pliers bring; `snapped`: likewise, sideways onto a groove; `laid`: not at all, for
    what is soldered or flexible. Parts `past` may be in the way, because one of the two yields; those `through` have a
    hole on the path: the picture shows what moves before it.

    `tool` fastens them, from the side `reach`: by default `along`, else one of its values. A `trial` is taken off again
    at the end of the step. `brings` is an assembly of an earlier step that is put on as one piece, `retention` the
    kinds of axle retention with which this move is needed (empty: all), `lacks` the pattern of things with which it is
    made in a later step.
    """

    parts: str
    along: str = "from the left"
    way: Literal["straight", "snapped", "bent", "laid"] = "straight"
    past: str = ""
    through: str = ""
    tool: Tool | None = None
    reach: str = ""
    trial: bool = False
    brings: str = ""
    retention: tuple[str, ...] = ()
    lacks: str = ""


@dataclass(frozen=True)
class Inset:
    """A detail of a step that has a picture of its own, seen from a direction (yaw and pitch).

    `shown` and `framed` are patterns of the parts that it shows and frames, `room` is the size of the frame over that
    of the framed parts. Of what the step puts on, `placed` is drawn in its place. `usb` are words for the controller's
    USB socket.
    """

    name: str
    title: str
    shown: str
    framed: str
    view_deg: tuple[float, float]
    room: float = 1.0
    placed: str = ""
    usb: str = ""


@dataclass(frozen=True)
class Plan:
    """A step for any robot: its moves onto an assembly. Its words are in `templates/guides/steps/KEY.md.j2`.

    `behind` is the pattern of what a plate hides in the step's picture: an inset shows it.
    """

    key: str
    title: str
    onto: str = ROBOT
    moves: tuple[Move, ...] = ()
    insets: tuple[Inset, ...] = ()
    behind: str = ""


def _plan(step: dict[str, Any], tools: dict[str, Tool]) -> Plan:
    """Return a step of the file; its moves name their tools."""
    moves = []
    for move in step.pop("moves", ()):
        tool = tools[move.pop("tool")] if "tool" in move else None
        moves.append(Move(**{"parts": "", "tool": tool} | move | {"retention": tuple(move.get("retention", ()))}))
    insets = tuple(Inset(**inset) for inset in step.pop("insets", ()))
    return Plan(**step, moves=tuple(moves), insets=insets)


_data, _ = read_toml(templates_folder() / "guides" / "assembly_order.toml")
TOOLS = {name: Tool(**tool) for name, tool in _data["tools"].items()}
ORDER: tuple[Plan, ...] = tuple(_plan(step, TOOLS) for step in _data["steps"])
"""What is done, in this order."""


SIDES: dict[str, Array] = {
    "from the left": np.array([0.0, -1.0, 0.0]),
    "from the right": np.array([0.0, 1.0, 0.0]),
    "from below": np.array([0.0, 0.0, 1.0]),
    "from above": np.array([0.0, 0.0, -1.0]),
    "from the front": np.array([-1.0, 0.0, 0.0]),
    "from behind": np.array([1.0, 0.0, 0.0]),
    "from the front and below": np.array([-1.0, 0.0, 1.0]) / np.sqrt(2.0),
}
"""Directions of travel, unit vectors in the world (x forwards, y to the left, z up)."""
REST = "Everything else"


@dataclass(frozen=True)
class MovedParts:
    """The parts of one move."""

    move: Move
    things: tuple[Visual, ...]


@dataclass(frozen=True)
class Step(Plan):
    """A step of one robot, with what it puts on."""

    placed: tuple[MovedParts, ...] = ()

    @property
    def added(self) -> tuple[Visual, ...]:
        """What is put on for the first time, without assemblies that come from earlier steps."""
        return tuple(
            thing for placed in self.placed if not (placed.move.brings or placed.move.trial) for thing in placed.things
        )


@decided_once
def assembly_steps(robot: Robot) -> tuple[Step, ...]:
    """Return the steps that a robot needs; everything on it is put on in exactly one of them."""
    left = list(visuals(robot))
    names = [thing.name for thing in left]
    built: dict[str, list[Visual]] = {}
    steps = []
    for plan in ORDER:
        placed = tuple(_placed(plan, robot, names, left, built))
        if not placed and plan.moves:
            continue
        steps.append(Step(**vars(plan), placed=placed))
    if left:
        steps.append(Step("rest", REST, placed=(MovedParts(Move(".*", way="laid"), tuple(left)),)))
    return tuple(steps)


def travel(robot: Robot, thing: Visual, move: Move, T_world_body: Array) -> Array:
    """Return the direction (3,) in the world in which a part moves to its place on the standing robot.

    `T_world_body` (4, 4) is the pose of the part's body. What comes from above comes square to its tray, which may be
    inclined; toes come from outside onto the foot's stubs, their screws with their heads last.
    """
    if move.along == "from above":
        return -T_world_body[:3, 2]
    if move.along in SIDES:
        return SIDES[move.along]
    if move.along == "sideways":
        return SIDES["from the front"]
    own = chained(T_world_body, thing.T_body_mesh)[:3, :3]
    if move.along == "head last":
        return np.asarray(own[:, 2] * (-1.0 if _head_up(thing) else 1.0))
    if move.along in ("into its notch", "into its mount"):
        return -own[:, 1] if move.along == "into its notch" else own[:, 0]
    if move.along == "from outside":
        return np.asarray(own[:, 1] * (1.0 if thing.name == "toe_left" else -1.0))
    if move.along == "from the leg":
        x, z = robot.layout.stop.behind
        return np.asarray(np.einsum("ij,j->i", T_world_body[:3, :3], np.array([x, 0.0, z])))
    raise ValueError(f"no direction {move.along}")


def _head_up(thing: Visual) -> bool:
    """Tell whether a screw's or pin's head is at the upper end of its mesh: the end that is wider along x."""
    low, high = thing.mesh.bounds[:, 2]
    ends = thing.mesh.vertices
    width = [np.ptp(ends[np.abs(ends[:, 2] - z) < 1e-3][:, 0]) for z in (low, high)]
    return bool(width[1] > width[0])


def _placed(
    plan: Plan, robot: Robot, names: list[str], left: list[Visual], built: dict[str, list[Visual]]
) -> Iterator[MovedParts]:
    """Yield a step's moves with the robot's parts; they are taken from `left` and added to `built`, by assembly."""
    there = built.setdefault(plan.onto, [])
    for move in plan.moves:
        if move.retention and robot.layout.retention not in move.retention:
            continue
        if move.lacks and any(re.fullmatch(move.lacks, name) for name in names):
            continue
        if move.brings:
            things = list(built.get(move.brings, [])) if move.trial else built.pop(move.brings, [])
        else:
            things = [thing for thing in left if re.fullmatch(move.parts, thing.name)]
            left[:] = [thing for thing in left if thing not in things or move.trial]
        if things:
            there += [] if move.trial else things
            yield MovedParts(move, tuple(things))
