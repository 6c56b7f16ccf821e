"""An animated GIF of the viewer's motion: slow where the robot is fast; cam and gears turn."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.bundle.renders import corners_of, gif
from jumpcad.robot.robot import Robot
from jumpcad.scene.camera import View, aimed
from jumpcad.scene.floor import STRIPE_M, with_floor
from jumpcad.scene.renderer import Renderer
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import Array, chained, pose_at

SIZE = (640, 330)
VIEW = View(yaw_deg=-72.0, pitch_deg=9.0)
FRAME_S = 0.1
RENAMED = {"drop": "release"}


def motion_gif(robot: Robot, data: dict[str, Any], size: tuple[int, int] = SIZE, view: View = VIEW) -> bytes:
    """Return the animated picture of `viewer_data`, one frame each tenth of a second that the viewer shows."""
    things = visuals(robot)
    turning = {one["node"]: one for one in data["turning"]}
    times = np.array(data["show_s"])
    moments = np.searchsorted(times, np.arange(0.0, times[-1], FRAME_S), side="right") - 1
    poses = []
    for moment in moments:
        bodies = {name: _pose(frames[moment]) for name, frames in data["frames"].items()}
        poses.append(
            [
                chained(chained(bodies[thing.body], _turned(turning.get(thing.name), data, moment)), thing.T_body_mesh)
                for thing in things
            ]
        )
    corners = np.concatenate([corners_of(things, one) for one in poses])
    camera = aimed(corners, view, size[0] / size[1])
    scene = Renderer([(thing.mesh, thing.colour) for thing in things])
    pictures = []
    for moment, one in zip(moments, poses, strict=True):
        phase = data["phase"][moment]
        name, _, number = phase.partition(" ")
        title = RENAMED.get(name, name) + (f", jump {number}" if number else "")
        caption = f"{title}{data['phases'][phase]}; stripes of {1000.0 * STRIPE_M:.0f} mm"
        pictures.append(with_floor(scene.picture(one, size, view, corners), camera, corners, caption))
    return gif(pictures, round(1000.0 * FRAME_S))


def _pose(seven: Sequence[float]) -> Array:
    return pose_at(Rotation.from_quat(seven[3:]).as_matrix(), np.array(seven[:3]))


def _turned(axis: dict[str, Any] | None, data: dict[str, Any], moment: int) -> Array:
    """Return the turn (4, 4) of what the motor moves, about its axis across the body."""
    if axis is None:
        return np.eye(4)
    angle = axis["per_cam"] * data["cam_rad" if axis["node"] == "cam" else "gear_rad"][moment]
    turn = Rotation.from_euler("y", angle).as_matrix()
    centre = np.array([axis["axis_m"][0], 0.0, axis["axis_m"][1]])
    return pose_at(turn, centre - turn @ centre)
