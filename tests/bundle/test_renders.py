"""The renders and the animated jump of a robot."""

import io

import numpy as np
import pytest
from PIL import Image
from support.built import built

from jumpcad.bundle import renders
from jumpcad.bundle import renders as module
from jumpcad.bundle.renders import exploded, jump_gif
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.labels import STRIPES
from jumpcad.scene.renderer import aimed, paletted
from jumpcad.scene.visuals import visuals
from jumpcad.simulation import Settings, simulate


def test_exploding_keeps_the_order_across_the_robot(small_robot: Robot) -> None:
    things = visuals(small_robot)
    poses = [body_poses(small_robot)[thing.body] @ thing.T_body_mesh for thing in things]
    moved = dict(zip((thing.name for thing in things), exploded(things, poses), strict=True))
    offset = {name: moved[name][1, 3] - pose[1, 3] for name, pose in zip(moved, poses, strict=True)}
    assert offset["leg_axle"] == offset["main_leg"] == 0.0
    assert 0.0 < offset["roller"] < offset["body_plate_left"] < offset["ring_1"]
    assert offset["ring_2"] < offset["body_plate_right"] < 0.0


def test_pads_of_wide_toes_go_no_farther_aside_than_the_bodys_outermost_part() -> None:
    """The toes reach 62 mm aside, the sensor's mount, which is outside of all else of the body, 27 mm."""
    robot = built("kenan-2.0")
    things, bodies = visuals(robot), body_poses(robot)
    poses = [bodies[thing.body] @ thing.T_body_mesh for thing in things]
    moved = exploded(things, poses)
    offset = {thing.name: new[1, 3] - old[1, 3] for thing, new, old in zip(things, moved, poses, strict=True)}
    assert offset["toe_left_pad"] == pytest.approx(offset["sensor_mount"]) == max(offset.values())
    assert offset["toe_right_pad"] == pytest.approx(-offset["toe_left_pad"])


@pytest.mark.thorough
def test_the_floors_stripes_are_a_scale_for_the_jump(small_robot: Robot) -> None:
    """Measured in stripes of 100 mm, the blue body goes as far across the picture as it was simulated to."""
    jump = simulate(small_robot, Settings(flight="simulated", trajectory=True))
    assert jump.trajectory is not None
    gif = Image.open(io.BytesIO(jump_gif(small_robot, jump.trajectory, (560, 350))))
    middles = []
    for number in (0, gif.n_frames - 1):
        gif.seek(number)
        frame = np.asarray(gif.convert("RGB")).astype(int)
        blue = frame[40:, :, 2] - frame[40:, :, 0] > 30
        middles.append(np.nonzero(blue)[1].mean())
    dark = np.abs(frame.mean(axis=2) - np.mean(STRIPES[1])) < 3.0
    widths = np.concatenate([np.diff(np.nonzero(np.diff(row.astype(int)))[0]) for row in dark[-60:]])
    stripe = np.median(widths[widths > 50])  # others are cut by feet
    moved_m = float(jump.trajectory.position_m[-1, 0, 0] - jump.trajectory.position_m[0, 0, 0])
    assert 0.1 * (middles[1] - middles[0]) / stripe == pytest.approx(moved_m, rel=0.1)


def test_the_caption_says_how_much_slower_the_jump_is_shown(
    small_robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The time from the first to the last frame as the file shows it, over that of the jump; stripes of 100 mm."""
    jump, captions = simulate(small_robot, Settings(flight="simulated", trajectory=True)), set()

    def note(picture: Image.Image, camera: object, frame_m: object, caption: str) -> Image.Image:
        captions.add(caption)
        return picture

    monkeypatch.setattr(module, "with_floor", note)
    assert jump.trajectory is not None
    gif = Image.open(io.BytesIO(jump_gif(small_robot, jump.trajectory, (60, 40))))
    (caption,) = captions
    shown_s = (gif.n_frames - 1) * gif.info["duration"] / 1000.0
    times = jump.trajectory.time_s
    assert caption == f"slow motion, {shown_s / (times[-1] - times[0]):.0f} times; stripes of 100 mm"


def test_every_picture_marks_where_front_and_left_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a camera sees a point ahead of the robot, and one to the left of it, against the picture's middle."""
    marked: list[dict[str, np.ndarray]] = []
    monkeypatch.setattr(renders, "labelled", lambda picture, *_: marked.append(_[-1]) or picture)

    class Blank:
        def picture(self, _poses: object, size: tuple[int, int], *_: object) -> Image.Image:
            return Image.new("RGB", size)

    robot = built("kenan-2.0")
    views = [view for _, view in renders.named_views(robot)]
    numbers = {thing.name: index for view in views for index, thing in enumerate(view.things)}
    for view in views:
        renders._picture(view, dict.fromkeys(numbers, 0), Blank(), (560, 520))  # type: ignore[arg-type]
    assert len(marked) == len(views) > 20
    for view, marks in zip(views, marked, strict=True):
        middle = view.frame_m.mean(axis=0)
        (camera, size), step = (aimed(view.frame_m, view.view, 1.0), (500, 500)), 0.001 * np.eye(3)
        seen = camera.seen(np.array([middle, middle + step[0], middle + step[1]]), size)[0]
        for way, (name, mark) in zip(seen[1:] - seen[0], marks.items(), strict=True):
            assert mark @ way > 0.99 * np.hypot(*way) * np.hypot(*mark), (view.title, name)
        assert [*marks] == ["front", "left"]


def test_a_palette_keeps_the_ground_and_changes_no_colour_visibly() -> None:
    """A ramp of all shades of one colour, and greys that are nearly white, on a white ground."""
    shades = np.full((40, 256, 3), 255, dtype=np.uint8)
    shades[10:20] = np.linspace(224, 254, 256)[:, None]
    shades[20:] = np.arange(256)[:, None] * np.array([1.0, 0.6, 0.2])
    picture = paletted(Image.fromarray(shades))
    assert picture.mode == "P"
    assert len(picture.getcolors() or []) <= 256
    drawn, seen = (shades.astype(int), np.asarray(picture.convert("RGB")).astype(int))
    assert (seen[:10] == 255).all()
    assert np.abs(seen - drawn).max() <= 16
