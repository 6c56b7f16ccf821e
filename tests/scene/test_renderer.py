"""Pictures show what is there, hide what is hidden, and draw the edges between."""

import numpy as np
import pytest
import trimesh

from jumpcad.scene.camera import View
from jumpcad.scene.renderer import Renderer, borders, creases

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
