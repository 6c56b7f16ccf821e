"""Length, width and height of a robot, against the corners of all its meshes."""

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
