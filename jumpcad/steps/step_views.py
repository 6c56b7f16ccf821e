"""The pictures of assembly steps: parts in place, parts put on (drawn apart from their places), labels, view."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.renderer import View
from jumpcad.scene.visuals import Visual
from jumpcad.solids.tube import DrawnWire
from jumpcad.steps.assembly_steps import LEFT, LOWER, UPPER, Inset, Move, Step, assembly_steps, travel
from jumpcad.transforms import Array, chained

FROM_LEFT = View(yaw_deg=62.0, pitch_deg=28.0)
"""From the left, from where parts are put on the axles."""
FROM_RIGHT = View(yaw_deg=-118.0, pitch_deg=28.0)
APART_M = 0.006
"""Least distance between parts that are drawn apart; judgement."""
NEAREST_M = 0.03
"""Least half size of the frame around what a step puts on."""
DIGITS = 8
"""Of lengths in m: the last digits of sums and sines differ between processors."""
FARTHEST_M = 0.11
"""Largest distance from its place at which a part is drawn; judgement: beyond, the picture becomes too small."""


@dataclass(frozen=True)
class Label:
    """A text for a part whose middle is drawn at `at_m` (3,) and belongs at `place_m` (3,), in the world (m)."""

    text: str
    at_m: Array
    place_m: Array


@dataclass(frozen=True)
class StepView:
    """A picture: parts with their poses (4, 4) in the world (m), which of them are pale, labels, direction of view.

    `frame_m` (n, 3) are points that it must contain; `turns_m` are curves (k, 3) that show a sense of rotation.
    """

    name: str
    title: str
    things: tuple[Visual, ...]
    poses: tuple[Array, ...]
    pale: tuple[bool, ...]
    labels: tuple[Label, ...]
    frame_m: Array
    view: View
    turns_m: tuple[Array, ...] = ()


TURNS = {"power": ("motor_shaft", 0), "trial": ("cam_gear", 1)}
"""What turns in a step, and its sense about +y; 0: the motor's, see `motor_sense`."""
NEAR_ARM, FAR_ARM = 0.6, 0.05
"""Where on the arm of the nearer and of the farther spring a label points to, from the arm's end to the coil: what the
pin does not hide, as seen from the side of the nearer; judgement."""
TRAY_LABEL = {"electronics_tray_lower": (0.46, 0.05, 0.0), "electronics_tray_upper": (-0.4, 0.35, 0.0)}
"""Where on a tray a label points to, where nothing hides it: from its middle, in shares of its size; judgement."""
TURN_M = 0.008
"""Least radius of an arrow that shows a sense of rotation."""
NAMELESS = ("motor_shaft", "wiring_wire", "wiring_heat")
"""Parts without a label, by the beginnings of their names: the motor's shaft, and wires."""
BENCH = {"power": (LEFT, UPPER, LOWER)}
"""Assemblies that lie on the bench beside the step's own, connected by wires, by the step's key."""
BENCH_M = 0.012
"""Distance between them."""


def motor_sense(robot: Robot) -> int:
    """Return the motor's sense of rotation about +y, where the cam's is +1: -1 with one gear stage, +1 with two."""
    return -1 if len(robot.layout.drive.train.stages) == 1 else 1


def step_views(robot: Robot) -> dict[str, list[StepView]]:
    """Return the pictures of every step by its key: the step first, then its details."""
    poses = body_poses(robot)
    built: dict[str, list[Visual]] = {}
    views: dict[str, list[StepView]] = {}
    for step in assembly_steps(robot):
        there = built.setdefault(step.onto, [])
        before = list(there)
        for placed in step.placed:
            if placed.move.brings and not placed.move.trial:
                built.pop(placed.move.brings)
            there += [] if placed.move.trial else placed.things
        if not before and not step.placed:
            continue
        moved = _apart(robot, step, poses, before)
        beside = {name: built.get(name, []) for name in BENCH.get(step.key, ())}
        views[step.key] = [_view(step.key, step.title, step, before, moved, poses, None, motor_sense(robot), beside)]
        if step.key == "boards":
            views[step.key][0] = _with_usb(views[step.key][0], robot, "USB socket")
        for inset in step.insets:
            if any(re.fullmatch(inset.framed, thing.name) for thing in there):
                stay = {name: by for name, by in moved.items() if not re.fullmatch(inset.placed, name)}
                view = _view(inset.name, inset.title, step, before, stay, poses, inset)
                views[step.key].append(_with_usb(view, robot, inset.usb) if inset.usb else view)
    return views


def _with_usb(view: StepView, robot: Robot, words: str) -> StepView:
    """Return a view with a label at the controller's USB socket, if it has a place: the end towards its plate."""
    if robot.layout.fittings.usb_mm is None:
        return view
    inwards = robot.layout.electronics.inwards("controller")
    index = next(index for index, thing in enumerate(view.things) if thing.name == "controller")
    corners = _corners(view.things[index], view.poses[index])
    end = np.round(corners[inwards * corners[:, 1] <= (inwards * corners[:, 1]).min() + APART_M].mean(axis=0), DIGITS)
    return replace(view, labels=(*view.labels, Label(words, end, end)))


def label_of(thing: Visual) -> str:
    """Return a part's name as it is written on pictures."""
    name = re.sub(r"^wiring_", "", thing.name)
    if name.startswith("spring_left") or name.startswith("spring_right"):
        side = "left" if "left" in name else "right"
        return f"{'right' if side == 'left' else 'left'}-hand spring"
    name = re.sub(r"(_screw)_(left|right)$", r"\1", name)
    name = re.sub(r"_\d+(?=_|$)", "", name)
    return name.replace("_", " ")


def _view(
    name: str, title: str, step: Step, before: list[Visual], moved: dict[str, Array], poses: dict[str, Array],
    inset: Inset | None, motor: int = 1, beside: Mapping[str, list[Visual]] | None = None,
) -> StepView:  # fmt: skip
    """Return the picture of a step, or of a detail of it.

    `before` are the parts in place, `moved` the offsets (3,) of those drawn apart, `motor` is `motor_sense`,
    `beside` the assemblies beside it on the bench.
    """
    added = [thing for placed in step.placed for thing in placed.things]
    if inset is None:
        added = [thing for thing in added if not re.fullmatch(step.behind, thing.name)]
    moved, beside = moved | _on_bench(before, beside or {}, poses), beside or {}
    things = [*before, *added, *(thing for others in beside.values() for thing in others)]
    if inset is not None:
        things = [thing for thing in things if re.fullmatch(inset.shown, thing.name)]
    new = {thing.name for thing in added}
    at = [_at_place(thing, poses) for thing in things]
    for pose, thing in zip(at, things, strict=True):
        pose[:3, 3] += moved.get(thing.name, 0.0)
    framed = [
        index for index, thing in enumerate(things)
        if (re.fullmatch(inset.framed, thing.name) if inset else thing.name in new or not new)
    ]  # fmt: skip
    corners = np.concatenate([_corners(things[index], at[index]) for index in framed])
    places = [_corners(things[index], _at_place(things[index], poses)) for index in framed]
    if not inset:
        middle = corners.mean(axis=0)
        corners = np.concatenate([corners, *places, [middle - NEAREST_M, middle + NEAREST_M]])
    pale = tuple(thing.name not in new and bool(new) for thing in things)
    right = sum(placed.move.along == "from the right" for placed in step.placed)  # as most moves of a step come
    view = View(*inset.view_deg) if inset else FROM_RIGHT if right > len(step.placed) / 2 else FROM_LEFT
    near = "spring_left" if view.yaw_deg > 0.0 else "spring_right"
    labels = _labels(things, at, poses, new if not inset else {things[i].name for i in framed}, step, near)
    if any(beside.values()):
        labels += tuple(_bench_label(name, others, moved, poses) for name, others in beside.items() if others)
        labels += (_bench_label("right plate", before, moved, poses),)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
    corners = middle + (inset.room if inset else 1.0) * (corners - middle)
    turning, sense = TURNS.get(step.key, ("", 0))
    turns = [
        _turn(thing, pose, sense or motor)
        for thing, pose in zip(things, at, strict=True)
        if thing.name == turning and not inset
    ]
    return StepView(name, title, tuple(things), tuple(at), pale, labels, corners, view, tuple(turns))


def _on_bench(before: list[Visual], beside: Mapping[str, list[Visual]], poses: dict[str, Array]) -> dict[str, Array]:
    """Return the offsets (3,) of the assemblies `beside` the parts `before`, by part: one behind, the others below."""
    moved: dict[str, Array] = {}
    if not before or not beside:
        return moved
    there = np.concatenate([_corners(thing, _at_place(thing, poses)) for thing in before])
    ahead, bottom = float(there[:, 0].max()), float(there[:, 2].min()) - BENCH_M
    behind = float(there[:, 0].min()) - BENCH_M
    for index, others in enumerate(filter(None, beside.values())):
        corners = np.concatenate([_corners(thing, _at_place(thing, poses)) for thing in others])
        low, high = corners.min(axis=0), corners.max(axis=0)
        if index == 0:
            by = np.array([behind - high[0], 0.0, 0.0])
        else:
            by = np.array([ahead - high[0], 0.0, bottom - high[2]])
            ahead -= float(high[0] - low[0]) + 2.0 * BENCH_M
        moved |= {thing.name: np.round(by, DIGITS) for thing in others}
    return moved


def _bench_label(name: str, others: list[Visual], moved: dict[str, Array], poses: dict[str, Array]) -> Label:
    """Return the label of an assembly on the bench, at its first part: its plate or tray."""
    first = others[0]
    middle = np.round(_corners(first, _at_place(first, poses)).mean(axis=0) + moved.get(first.name, 0.0), DIGITS)
    return Label(name, middle, middle)


def _turn(thing: Visual, pose: Array, sense: int) -> Array:
    """Return three quarters of a circle (40, 3) around a part's left end, in its sense about +y, in the world (m)."""
    low, high = thing.mesh.bounds / 1000.0
    radius = max(TURN_M, 1.15 * float(high[0] - low[0]) / 2.0)
    corners = _corners(thing, pose)
    middle = corners.mean(axis=0)
    angle = sense * np.linspace(0.0, 1.5 * np.pi, 40)
    y = np.full_like(angle, corners[:, 1].max() + 0.001)
    # about +y from z towards x: counter-clockwise as seen from the left
    return np.column_stack([middle[0] + radius * np.sin(angle), y, middle[2] + radius * np.cos(angle)])


def _apart(robot: Robot, step: Step, poses: dict[str, Array], before: list[Visual]) -> dict[str, Array]:
    """Return the offsets (3,) by which parts of a step are drawn back along their paths, by name (m).

    Parts on one path are apart, also from a part whose hole they pass. Those of the first move stay in place, unless
    there are parts before them.
    """
    moved: dict[str, Array] = {}
    stacked: list[tuple[Array, Array, float]] = []
    for placed in step.placed:
        first = placed.things[0]
        way = travel(robot, first, placed.move, poses[first.body])
        if placed.move.way == "laid" and placed.move.along == Move.along:
            continue
        corners = np.concatenate([_corners(thing, _at_place(thing, poses)) for thing in placed.things])
        along = np.einsum("ni,i->n", corners, way)
        back = 2.0 * APART_M if before or step.placed[0] is not placed else 0.0
        holed = [
            (way, _corners(thing, _at_place(thing, poses)), 0.0)
            for thing in before
            if placed.move.through and re.fullmatch(placed.move.through, thing.name)
        ]
        for other_way, other, offset in (*stacked, *holed):
            if (other_way * way).sum() > 0.99 and _beside(corners, other, way):
                # its front must stay behind the rear of what comes before it
                back = max(back, offset + float(along.max() - np.einsum("ni,i->n", other, way).min()) + APART_M)
        back = min(back, FARTHEST_M)
        stacked.append((way, corners, back))
        for thing in placed.things:
            own = way if placed.move.brings else travel(robot, thing, placed.move, poses[thing.body])
            moved[thing.name] = np.round(-back * own, DIGITS)
    return moved


def _beside(one: Array, other: Array, way: Array) -> bool:
    """Tell whether two sets of corners (n, 3) overlap as seen along a path."""
    across = np.cross(way, [0.0, 0.0, 1.0] if abs(way[2]) < 0.9 else [1.0, 0.0, 0.0])
    for axis in (across, np.cross(way, across)):
        a, b = (np.einsum("ni,i->n", corners, axis) for corners in (one, other))
        if a.min() >= b.max() or b.min() >= a.max():
            return False
    return True


def _labels(
    things: list[Visual], at: list[Array], poses: dict[str, Array], wanted: set[str], step: Step, near: str
) -> tuple[Label, ...]:
    """Return one label for all parts of one name, and one for a whole assembly; `near` is the nearer spring."""
    brought = {thing.name: placed.move.brings for placed in step.placed for thing in placed.things}
    found: dict[str, list[tuple[Array, Array]]] = {}
    for thing, pose in zip(things, at, strict=True):
        if thing.name in wanted and not thing.name.startswith(NAMELESS):
            text = brought.get(thing.name, "") or label_of(thing)
            ends = (
                _seen_at(thing, one, NEAR_ARM if thing.name == near else FAR_ARM)
                for one in (pose, _at_place(thing, poses))
            )
            here, there = (np.round(end, DIGITS) for end in ends)
            found.setdefault(text, []).append((here, there))
    return tuple(
        Label(text if len(ends) == 1 or text in brought.values() or "spring" in text else f"{len(ends)} x {text}",
              *ends[0])
        for text, ends in found.items()
    )  # fmt: skip


def _seen_at(thing: Visual, pose: Array, along_arm: float) -> Array:
    """Return where a label points to (3,) in the world (m): a part's middle, of bent wire a point of its first arm."""
    shape = thing.shape
    if not isinstance(shape, DrawnWire):
        corners = _corners(thing, pose)
        beside = np.array(TRAY_LABEL.get(thing.name, (0.0, 0.0, 0.0)))
        return np.asarray(corners.mean(axis=0) + beside * np.ptp(corners, axis=0))
    end, bend = shape.points_mm[:2] / 1000.0
    on_body = end + along_arm * (bend - end) - thing.T_body_mesh[:3, 3]
    point = np.einsum("ji,j->i", thing.T_body_mesh[:3, :3], on_body)
    return np.asarray(np.einsum("ij,j->i", pose[:3, :3], point) + pose[:3, 3])


def _corners(thing: Visual, pose: Array) -> Array:
    """Return the corners (8, 3) of a part's bounding box in the world (m)."""
    return np.asarray(np.round(thing.corners_at(pose), DIGITS))


def _at_place(thing: Visual, poses: dict[str, Array]) -> Array:
    """Return the pose (4, 4) in the world of a part in its place on the standing robot (m)."""
    return chained(poses[thing.body], thing.T_body_mesh)
