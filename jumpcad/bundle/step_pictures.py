"""The pictures of assembly: one for each step with names and arrows, and details of some steps."""

from types import MappingProxyType

import numpy as np

from jumpcad.robot.robot import Robot
from jumpcad.scene.camera import View, aimed
from jumpcad.scene.labels import labelled
from jumpcad.scene.renderer import COMPRESSION, Renderer, paletted, png_of
from jumpcad.scene.visuals import Visual
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.steps.step_views import StepView, step_views
from jumpcad.transforms import Array

SIZE = (560, 520)
MARGIN = 190
"""Pixels on either side, for names."""
INSET_SIZE = (420, 360)
COMPASS = MappingProxyType({"front": 0, "left": 1})
"""What every picture of a bundle marks: axes of the standing robot."""
ROOM = 1.12
"""Size of the picture's frame over that of the view's."""


def step_pictures(robot: Robot, things: tuple[Visual, ...], scene: Renderer) -> dict[str, bytes]:
    """Return the PNG files of all steps (`step-3`) and their details (`step-3-springs`), by name.

    `scene` has the meshes of `things`, in their order.
    """
    number = {thing.name: index for index, thing in enumerate(things)}
    pictures = {}
    for name, view in named_views(robot):
        pictures[name] = _picture(view, number, scene, SIZE if name.count("-") == 1 else INSET_SIZE)
    return pictures


def named_views(robot: Robot) -> list[tuple[str, StepView]]:
    """Return the names and views of the pictures, in the order of the steps."""
    views = step_views(robot)
    named = []
    for number, step in enumerate(assembly_steps(robot), start=1):
        for index, view in enumerate(views.get(step.key, [])):
            named.append((f"step-{number}" if index == 0 else f"step-{number}-{view.name}", view))
    return named


def _picture(view: StepView, number: dict[str, int], scene: Renderer, size: tuple[int, int]) -> bytes:
    poses: list[Array | None] = [None] * len(number)
    pale = [False] * len(number)
    for thing, pose, hint in zip(view.things, view.poses, view.pale, strict=True):
        poses[number[thing.name]], pale[number[thing.name]] = pose, hint
    middle = (view.frame_m.min(axis=0) + view.frame_m.max(axis=0)) / 2.0
    frame = np.round(middle + ROOM * (view.frame_m - middle), 6)
    picture = scene.picture(poses, size, view.view, frame, pale)
    camera = aimed(frame, view.view, size[0] / size[1])
    points = np.array([[label.at_m, label.place_m] for label in view.labels]).reshape(-1, 2, 3)
    seen = np.round(camera.seen(points, size)[0], 2)
    names = [label.text for label in view.labels]
    turns = [np.round(camera.seen(curve, size)[0], 2) for curve in view.turns_m]
    sheet = labelled(picture, names, seen[:, 0], seen[:, 1], MARGIN, turns, compass(view.view))
    return png_of(paletted(sheet), compress_level=COMPRESSION)


def compass(view: View) -> dict[str, Array]:
    """Return where a picture has front and left: unit vectors (2,) or shorter, y downwards."""
    return {name: np.round(view.axes[:2, axis] * (1.0, -1.0), 6) for name, axis in COMPASS.items()}
