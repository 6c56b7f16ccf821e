"""The renders and the animated jump of a robot."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from support.built import built

from jumpcad.bundle import renders as module
from jumpcad.bundle.renders import exploded, gif, jump_gif, renders
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.camera import View, aimed
from jumpcad.scene.floor import STRIPES, with_floor
from jumpcad.scene.visuals import visuals
from jumpcad.simulation import Settings, simulate


def test_three_different_pictures_of_the_size_asked(small_robot: Robot) -> None:
    files = renders(small_robot, (160, 120))
    assert list(files) == ["rest", "compressed", "exploded"]
    pictures = [Image.open(io.BytesIO(png)) for png in files.values()]
    assert {(picture.format, picture.size) for picture in pictures} == {("PNG", (160, 120))}
    assert len(set(files.values())) == 3
    assert all(np.asarray(picture).min() < 100 for picture in pictures)


def test_pictures_have_the_names_of_their_poses(small_robot: Robot) -> None:
    """At rest, with loaded springs, and at rest with its parts apart, from another side."""
    things, shown, seen = visuals(small_robot), [], []

    def picture(poses: list[np.ndarray], size: tuple[int, int], view: View, corners: np.ndarray) -> Image.Image:
        shown.append(np.array(poses))
        seen.append((size, view, corners.min(axis=0).tolist()))
        return Image.new("RGB", size)

    found = module._renders(SimpleNamespace(picture=picture), small_robot, things, (16, 12))  # type: ignore[arg-type]
    assert tuple(found) == ("rest", "compressed", "exploded")
    for drawn, loaded in zip(shown[:2], (0.0, 1.0), strict=True):
        bodies = body_poses(small_robot, loaded)
        np.testing.assert_allclose(drawn, [bodies[thing.body] @ thing.T_body_mesh for thing in things], atol=1e-12)
    np.testing.assert_allclose(shown[2], exploded(things, list(shown[0])))
    assert [size for size, *_ in seen] == [(16, 12)] * 3
    assert seen[0][1] == seen[1][1] != seen[2][1]
    assert seen[2][2][1] < seen[0][2][1]  # the frame is that of what is drawn


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


def test_the_jump_is_an_endless_gif_of_few_colours(small_robot: Robot) -> None:
    jump = simulate(small_robot, Settings(flight="simulated", trajectory=True))
    assert jump.trajectory is not None
    gif = Image.open(io.BytesIO(jump_gif(small_robot, jump.trajectory, (120, 80))))
    assert (gif.format, gif.size, gif.info["loop"]) == ("GIF", (120, 80), 0)
    assert gif.n_frames > 30
    centres = []
    for number in (0, gif.n_frames - 1):
        gif.seek(number)
        dark = np.asarray(gif.convert("L"))[20:] < 200  # below the caption
        centres.append(np.nonzero(dark.any(axis=0))[0].mean())
    assert centres[1] > centres[0] + 20, "x points to the right, and the robot jumps along x"


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


def test_what_is_drawn_stays_before_the_floor() -> None:
    frame = np.array([[x, y, z] for x in (0.0, 0.3) for y in (-0.05, 0.05) for z in (0.0, 0.2)])
    picture = Image.new("RGB", (300, 200), "white")
    picture.paste((200, 100, 30), (100, 40, 200, 190))
    floored = np.asarray(with_floor(picture, aimed(frame, View(-80.0, 6.0), 1.5), frame, "caption"))
    assert (floored[40:190, 100:200] == (200, 100, 30)).all()
    below = floored[120:, :100].reshape(-1, 3)
    assert {tuple(colour) for colour in below.tolist()} >= set(STRIPES)
    assert (floored[:30, :100].min(axis=2) < 150).any()


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


@pytest.mark.parametrize("frame_ms", [40, 120])
def test_frames_are_shown_for_as_long_as_asked(frame_ms: int) -> None:
    """In hundredths of a second, as GIF has it."""
    file = Image.open(io.BytesIO(gif([Image.new("RGB", (8, 8), colour) for colour in ("red", "blue")], frame_ms)))
    assert (file.n_frames, file.info["duration"]) == (2, frame_ms)
