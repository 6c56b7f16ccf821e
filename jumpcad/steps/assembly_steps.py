"""The assembly steps of one robot: which parts are put on, from which side, with which tool.

The order is data (`assembly_order`). Here it is applied to a robot: its parts are found by their names.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.robot.robot import Robot, decided_once
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.steps.assembly_order import ORDER, ROBOT, Move, Plan
from jumpcad.transforms import Array, chained

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
class Step:
    """One step: what is put on, and onto which assembly."""

    key: str
    title: str
    onto: str
    placed: tuple[MovedParts, ...]

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
        steps.append(Step(plan.key, plan.title, plan.onto, placed))
    if left:
        rest = MovedParts(Move(".*", way="laid"), tuple(left))
        steps.append(Step("rest", REST, ROBOT, (rest,)))
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
    if move.along == "into its notch":
        return -own[:, 1]
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
