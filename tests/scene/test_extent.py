"""Length, width and height of a robot, against the corners of all its meshes."""

import numpy as np
import pytest
from support.built import built

from jumpcad.mechanism.poses import body_poses
from jumpcad.scene.extent import extent_m
from jumpcad.scene.visuals import visuals


def test_the_extent_is_that_of_everything_on_the_robot() -> None:
    robot = built("kenan-2.0")
    poses = body_poses(robot)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for one in visuals(robot):
        pose = poses[one.body] @ one.T_body_mesh
        points = one.mesh.vertices / 1000.0 @ pose[:3, :3].T + pose[:3, 3]
        low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
    assert extent_m(robot) == pytest.approx(high - low, abs=2e-5)
