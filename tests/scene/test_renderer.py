"""Pictures show what is there, hide what is hidden, and draw the edges between."""

import numpy as np
import pytest
import trimesh

from jumpcad.scene.renderer import Renderer, View, aimed, borders, creases

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
FRONT = View(yaw_deg=0.0, pitch_deg=0.0)
SIZE = (120, 90)


def at(x: float, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def taken(things: list, poses: list[np.ndarray], frame: np.ndarray, view: View = FRONT) -> np.ndarray:
    return np.asarray(Renderer(things).picture(poses, SIZE, view, frame)).astype(int)


def corners(*size_mm: float) -> np.ndarray:
    return trimesh.creation.box(size_mm).vertices / 1000.0


def test_a_cube_has_twelve_creases_and_a_rod_two_round_rims() -> None:
    lengths = np.linalg.norm(np.diff(creases(trimesh.creation.box((10, 20, 30))), axis=1)[:, 0], axis=1)
    assert sorted(lengths.round(9)) == [10] * 4 + [20] * 4 + [30] * 4
    rims = creases(trimesh.creation.cylinder(5.0, 40.0, sections=64))
    assert np.linalg.norm(np.diff(rims, axis=1)[:, 0], axis=1).sum() == pytest.approx(2 * 2 * np.pi * 5, rel=0.002)
    assert np.allclose(np.abs(rims[:, :, 2]), 20.0)


def test_borders_are_where_things_end() -> None:
    owner = np.array([[-1, -1, -1, -1], [-1, 3, 3, -1], [-1, 3, 4, -1]])
    assert borders(owner).astype(int).tolist() == [[0, 0, 0, 0], [0, 1, 1, 1], [0, 1, 1, 1]]


def test_a_plate_is_as_wide_as_its_share_of_the_frame() -> None:
    """Half as wide as what the picture holds, seen square: half the picture's width, red, with dark edges."""
    picture = taken([(trimesh.creation.box((1, 40, 20)), RED)], [np.eye(4)], corners(1, 80, 60))
    ink = (picture.sum(axis=2) < 3 * 255).any(axis=0)
    assert ink.sum() / SIZE[0] == pytest.approx(0.5 / 1.06, abs=0.02)
    middle = picture[SIZE[1] // 2, SIZE[0] // 2]
    assert middle[0] > 120
    assert middle[1:].max() < 60
    row = picture[SIZE[1] // 2]
    left = int(np.argmax(ink))
    assert row[left : left + 2].max() < 200
    assert (picture[:3] == 255).all()


def test_what_is_behind_a_plate_is_not_seen() -> None:
    plate, cube = (trimesh.creation.box((1, 40, 30)), RED), (trimesh.creation.box((9, 9, 9)), BLUE)
    frame = corners(40, 60, 45)
    alone = taken([plate], [at(0.0)], frame)
    assert np.array_equal(taken([plate, cube], [at(0.0), at(-0.015)], frame), alone)
    assert not np.array_equal(taken([plate, cube], [at(0.0), at(0.015)], frame), alone)


@pytest.mark.parametrize("view", [View(0.0, 0.0), View(), View(130.0, 60.0)])
def test_the_camera_sees_all_it_is_asked_to(view: View) -> None:
    points = np.random.default_rng(1).uniform(-0.1, 0.1, (200, 3)) * [1.0, 2.0, 0.5]
    camera = aimed(points, view, 4 / 3)
    yaw, pitch = np.radians([view.yaw_deg, view.pitch_deg])
    along = -np.array([np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), np.sin(pitch)])
    right = np.cross(along, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, along)
    rays = points - camera.eye_m
    depth = rays @ along
    slope = np.tan(np.radians(7.0))
    assert depth.min() > 0.0
    assert np.abs(rays @ right / depth).max() <= slope * 4 / 3 * 1.02
    assert np.abs(rays @ up / depth).max() <= slope * 1.02
    pixels, distance = camera.seen(points, (400, 300))
    assert np.allclose(distance, depth)
    assert np.allclose(pixels[:, 0], 200 + 150 * rays @ right / depth / slope)
    assert np.allclose(pixels[:, 1], 150 - 150 * rays @ up / depth / slope)


@pytest.mark.parametrize("aspect", [0.5, 2.0])
def test_a_flat_frame_fills_the_picture_but_for_its_margin(aspect: float) -> None:
    """Seen from the front, 6 % larger than what is framed on the side where it is tight, 14° from top to bottom."""
    points = np.array([[0.0, y, z] for y in (-0.1, 0.1) for z in (-0.1, 0.1)])
    camera = aimed(points, View(0.0, 0.0), aspect)
    half = 1.06 * 0.1 / min(aspect, 1.0)
    assert camera.eye_m == pytest.approx([half / np.tan(np.radians(7.0)), 0.0, 0.0])
    pixels, _ = camera.seen(points, (round(200 * aspect), 200))
    width = np.ptp(pixels[:, 0]) / (200.0 * aspect), np.ptp(pixels[:, 1]) / 200.0
    assert max(width) == pytest.approx(1.0 / 1.06)
