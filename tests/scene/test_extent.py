"""Length, width and height of a robot, against the corners of all its meshes."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.mechanism.poses import body_poses
from jumpcad.scene.extent import _corners_m, extent_m
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import in_metres


def test_the_extent_is_that_of_everything_on_the_robot() -> None:
    robot = built("kenan-2.0")
    poses = body_poses(robot)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for one in visuals(robot):
        pose = poses[one.body] @ one.T_body_mesh
        points = one.mesh.vertices / 1000.0 @ pose[:3, :3].T + pose[:3, 3]
        low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
    assert extent_m(robot) == pytest.approx(high - low, abs=2e-5)


@pytest.mark.parametrize("printed", [False, True])
def test_a_small_part_within_the_box_of_a_larger_one_may_reach_farther(
    monkeypatch: pytest.MonkeyPatch, printed: bool
) -> None:
    """Two squares of 14.1 mm, one lying and one standing, come with boxes of 20 mm about their corners.

    Turned by 45° they reach 7.1 mm, in boxes that reach 14.1; cubes of 5 mm lie 7 mm from the middle on one side of
    each axis and 6 mm on the other.
    """
    monkeypatch.setattr("jumpcad.scene.extent.body_poses", lambda _: {"body": np.eye(4)})

    def piece(corners_mm: list[tuple[float, float]], half_mm: float, pose: np.ndarray) -> SimpleNamespace:
        outline = np.array(corners_mm)
        bounds = np.array([[*outline.min(axis=0), -half_mm], [*outline.max(axis=0), half_mm]])
        return SimpleNamespace(
            shape=SimpleNamespace(outline_mm=outline, bounds_mm=bounds), body="body", T_body_part=pose
        )

    turns = [Rotation.from_euler("z", 45, degrees=True), Rotation.from_euler("zx", (45, 90), degrees=True)]
    poses = np.tile(np.eye(4), (8, 1, 1))
    poses[:2, :3, :3] = [turn.as_matrix() for turn in turns]
    poses[2:5, :3, 3], poses[5:, :3, 3] = 7.0 * np.eye(3), -6.0 * np.eye(3)
    square = [(10.0, 0.0), (0.0, 10.0), (-10.0, 0.0), (0.0, -10.0)]
    cube = [(2.5, 2.5), (-2.5, 2.5), (-2.5, -2.5), (2.5, -2.5)]
    things = [piece(square, 0.5, pose) for pose in poses[:2]] + [piece(cube, 2.5, pose) for pose in poses[2:]]
    parts = [SimpleNamespace(drawing=SimpleNamespace(shape=one.shape), placements=[one]) for one in things]
    robot = SimpleNamespace(hardware=[], parts=parts) if printed else SimpleNamespace(hardware=things, parts=[])
    assert extent_m(robot) == pytest.approx(np.full(3, 0.018))  # type: ignore[arg-type]


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (30.0, 20.0, 10.0), (-140.0, 65.0, 200.0)])
def test_a_prism_turned_anyhow_has_the_box_of_its_mesh(turn: tuple[float, float, float]) -> None:
    """Of a part of several outlines the box contains the mesh."""
    robot, pose = built("kenan-2.0"), np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", turn, degrees=True).as_matrix()
    pose[:3, 3] = [40.0, -70.0, 25.0]
    exact = 0
    for part in robot.parts:
        points = part.mesh.vertices @ pose[:3, :3].T + pose[:3, 3]
        low, high = 1000.0 * _corners_m(part.drawing.shape, in_metres(pose))
        assert (low <= points.min(axis=0) + 0.02).all(), part.name
        assert (high >= points.max(axis=0) - 0.02).all(), part.name
        exact += np.allclose([low, high], [points.min(axis=0), points.max(axis=0)], atol=0.02)
    assert exact >= 3
