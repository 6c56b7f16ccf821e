"""Pictures of a robot: at rest, loaded (`compressed` in file names), exploded, its steps, jump and whole motion."""

import io
from collections.abc import Iterator, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
from PIL import Image
from scipy.spatial.transform import Rotation

from jumpcad.bundle.motion import recorded_poses
from jumpcad.mechanism.model import BODY, body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.labels import STRIPE_M, labelled, with_floor
from jumpcad.scene.renderer import COMPRESSION, Renderer, View, aimed, paletted, png_of
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.simulation.jump import Trajectory
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.steps.step_views import StepView, step_views
from jumpcad.transforms import Array, chained, pose_at

SIZE = (560, 520)
MARGIN = 190
"""Pixels on either side, for names."""
INSET_SIZE = (420, 360)
COMPASS = MappingProxyType({"front": 0, "left": 1})
"""What every picture of a bundle marks: axes of the standing robot."""
ROOM = 1.12
"""Size of the picture's frame over that of the view's."""


def named_views(robot: Robot) -> Iterator[tuple[str, StepView]]:
    """Yield the names and views of the pictures, in the order of the steps."""
    views = step_views(robot)
    for number, step in enumerate(assembly_steps(robot), start=1):
        for index, view in enumerate(views.get(step.key, [])):
            yield f"step-{number}" if index == 0 else f"step-{number}-{view.name}", view


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


RENDERS = ("rest", "compressed", "exploded")
RENDER_SIZE = (600, 450)
JUMP_SIZE = (560, 350)
JUMP_FRAMES = 36
FRAME_MS = 50
PALETTE = 64
EXPLOSION = 2.4
"""Shift of a part along y in the exploded view, over the distance of its outer face from the middle plane."""
CENTRED_M = 0.004
"""Parts whose centre is nearer to the middle plane are not shifted."""
EXPLODED_VIEW = View(yaw_deg=-34.0, pitch_deg=24.0)
JUMP_VIEW = View(yaw_deg=-80.0, pitch_deg=6.0)


def renders(robot: Robot, scene: Renderer | None = None) -> dict[str, bytes]:
    """Return the PNG files of a robot at rest, loaded and exploded, by their names in `RENDERS`.

    `scene` has the meshes of its visible parts, if it is there already.
    """
    things = visuals(robot)
    scene = scene or _renderer(things)
    rest, loaded = _poses(things, body_poses(robot)), _poses(things, body_poses(robot, 1.0))
    scenes = ((rest, View()), (loaded, View()), (exploded(things, rest), EXPLODED_VIEW))
    return {
        name: png_of(
            labelled(scene.picture(poses, RENDER_SIZE, view, corners_of(things, poses)), [], compass=compass(view))
        )
        for name, (poses, view) in zip(RENDERS, scenes, strict=True)
    }


def rest_picture(robot: Robot, size: tuple[int, int] = RENDER_SIZE) -> bytes:
    """Return the PNG file of a robot at rest."""
    things = visuals(robot)
    poses = _poses(things, body_poses(robot))
    return png_of(_renderer(things).picture(poses, size, View(), corners_of(things, poses)))


def all_pictures(robot: Robot) -> dict[str, bytes]:
    """Return the PNG files of a robot, of all steps (`step-3`) and of their details (`step-3-springs`), by name."""
    things = visuals(robot)
    scene, number = _renderer(things), {thing.name: index for index, thing in enumerate(things)}
    return renders(robot, scene) | {
        name: _picture(view, number, scene, SIZE if name.count("-") == 1 else INSET_SIZE)
        for name, view in named_views(robot)
    }


def jump_gif(robot: Robot, trajectory: Trajectory, size: tuple[int, int] = JUMP_SIZE) -> bytes:
    """Return an animated GIF of a recorded jump on a striped floor, in equal time steps from the release on."""
    things = visuals(robot)
    times = np.linspace(trajectory.time_s[0], trajectory.time_s[-1], JUMP_FRAMES)
    moments = np.searchsorted(trajectory.time_s, times, side="right") - 1
    frames = [_poses(things, recorded_poses(trajectory, moment)) for moment in moments]
    corners = np.concatenate([corners_of(things, poses) for poses in frames])
    scene = _renderer(things)
    camera = aimed(corners, JUMP_VIEW, size[0] / size[1])
    slower = 0.001 * FRAME_MS * (JUMP_FRAMES - 1) / (times[-1] - times[0])
    caption = f"slow motion, {slower:.0f} times; stripes of {1000.0 * STRIPE_M:.0f} mm"
    pictures = [scene.picture(poses, size, JUMP_VIEW, corners) for poses in frames]
    return gif([with_floor(picture, camera, corners, caption) for picture in pictures])


def exploded(things: Sequence[Visual], poses: Sequence[Array]) -> list[Array]:
    """Return the poses of the exploded view: every part is shifted along y by `EXPLOSION` times a distance.

    The distance is that of the part's outer face from the middle plane, at most that of the body's outermost part.
    Parts centred on the middle plane are not shifted: legs, and parts that go from plate to plate.
    """
    body = [(thing, pose) for thing, pose in zip(things, poses, strict=True) if thing.body == BODY]
    widest = float(np.abs(corners_of([thing for thing, _ in body], [pose for _, pose in body])[:, 1]).max())
    moved = []
    for thing, pose in zip(things, poses, strict=True):
        y = corners_of([thing], [pose])[:, 1]
        centre = float((pose[1, :3] * thing.mesh.centroid).sum() / 1000.0 + pose[1, 3])
        outer = (
            float(np.clip(y.max() if centre > 0.0 else y.min(), -widest, widest)) if abs(centre) > CENTRED_M else 0.0
        )
        moved.append(pose_at(pose[:3, :3], pose[:3, 3] + [0.0, EXPLOSION * outer, 0.0]))
    return moved


def _renderer(things: Sequence[Visual]) -> Renderer:
    return Renderer([(thing.mesh, thing.colour) for thing in things])


def _poses(things: Sequence[Visual], bodies: dict[str, Array]) -> list[Array]:
    return [chained(bodies[thing.body], thing.T_body_mesh) for thing in things]


def corners_of(things: Sequence[Visual], poses: Sequence[Array]) -> Array:
    """Return the corners (8·n, 3) of the parts' bounding boxes in the world (m)."""
    return np.concatenate([thing.corners_at(pose) for thing, pose in zip(things, poses, strict=True)])


def gif(pictures: list[Image.Image], frame_ms: int = FRAME_MS) -> bytes:
    """Return an endless GIF whose frames share one palette."""
    width, height = pictures[0].size
    sheet = Image.new("RGB", (width, height * len(pictures)))
    for row, picture in enumerate(pictures):
        sheet.paste(picture, (0, row * height))
    palette = sheet.quantize(PALETTE, dither=Image.Dither.NONE)
    first, *rest = (picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures)
    stream = io.BytesIO()
    first.save(stream, "GIF", save_all=True, append_images=rest, duration=frame_ms, loop=0)
    return stream.getvalue()


MOTION_SIZE = (640, 330)
MOTION_VIEW = View(yaw_deg=-72.0, pitch_deg=9.0)
FRAME_S = 0.1
RENAMED = {"drop": "release"}


def motion_gif(
    robot: Robot, data: dict[str, Any], size: tuple[int, int] = MOTION_SIZE, view: View = MOTION_VIEW
) -> bytes:
    """Return the animated picture of `viewer_data`, one frame each tenth of a second that the viewer shows."""
    things = visuals(robot)
    turning = {one["node"]: one for one in data["turning"]}
    times = np.array(data["show_s"])
    moments = np.searchsorted(times, np.arange(0.0, times[-1], FRAME_S), side="right") - 1
    poses = []
    for moment in moments:
        rows = {name: np.array(frames[moment]) for name, frames in data["frames"].items()}
        bodies = {name: pose_at(Rotation.from_quat(row[3:]).as_matrix(), row[:3]) for name, row in rows.items()}
        turned = [chained(bodies[one.body], _turned(turning.get(one.name), data, moment)) for one in things]
        poses.append([chained(pose, thing.T_body_mesh) for pose, thing in zip(turned, things, strict=True)])
    corners = np.concatenate([corners_of(things, one) for one in poses])
    camera = aimed(corners, view, size[0] / size[1])
    scene = _renderer(things)
    pictures = []
    for moment, one in zip(moments, poses, strict=True):
        phase = data["phase"][moment]
        name, _, number = phase.partition(" ")
        title = RENAMED.get(name, name) + (f", jump {number}" if number else "")
        caption = f"{title}{data['phases'][phase]}; stripes of {1000.0 * STRIPE_M:.0f} mm"
        pictures.append(with_floor(scene.picture(one, size, view, corners), camera, corners, caption))
    return gif(pictures, round(1000.0 * FRAME_S))


def _turned(axis: dict[str, Any] | None, data: dict[str, Any], moment: int) -> Array:
    """Return the turn (4, 4) of what the motor moves, about its axis across the body."""
    if axis is None:
        return np.eye(4)
    angle = axis["per_cam"] * data["cam_rad" if axis["node"] == "cam" else "gear_rad"][moment]
    turn = Rotation.from_euler("y", angle).as_matrix()
    centre = np.array([axis["axis_m"][0], 0.0, axis["axis_m"][1]])
    return pose_at(turn, centre - turn @ centre)
