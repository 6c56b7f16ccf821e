"""One sign convention: a positive angle turns about +y, so that what points forwards turns downwards."""

import math

import numpy as np
import pytest

from jumpcad.transforms import (
    chained,
    direction,
    in_metres,
    pose_about_y,
    pose_about_z,
    pose_at,
    quaternion_about_y,
    rotation_about_y,
    turned_about_y,
)

ANGLES = [-2.0, -0.3, 0.0, 0.7, math.pi / 2, 3.0]


def test_a_quarter_turn_takes_forwards_to_downwards() -> None:
    np.testing.assert_allclose(direction(math.pi / 2), [0.0, -1.0], atol=1e-15)
    np.testing.assert_allclose(turned_about_y([1.0, 0.0], math.pi / 2), [0.0, -1.0], atol=1e-15)
    np.testing.assert_allclose(rotation_about_y(math.pi / 2) @ [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], atol=1e-15)
    np.testing.assert_allclose(pose_about_z(math.pi / 2) @ [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], atol=1e-15)


@pytest.mark.parametrize("angle", ANGLES)
def test_every_way_to_turn_about_y_is_the_same(angle: float) -> None:
    x, z = turned_about_y([0.3, -1.2], angle)
    for rotation in (rotation_about_y(angle), pose_about_y(angle, (0.0, 0.0))[:3, :3]):
        np.testing.assert_allclose(rotation @ [0.3, 5.0, -1.2], [x, 5.0, z], atol=1e-15)
    np.testing.assert_allclose(turned_about_y([1.0, 0.0], angle), direction(angle), atol=1e-15)


@pytest.mark.parametrize("angle", ANGLES)
def test_a_quaternion_turns_by_twice_its_own_angle(angle: float) -> None:
    """v + 2w(u x v) + 2u x (u x v), Rodrigues' formula in terms of the quaternion (w, u)."""
    w, *u = quaternion_about_y(angle)
    v = np.array([0.3, 5.0, -1.2])
    turned = v + 2.0 * w * np.cross(u, v) + 2.0 * np.cross(u, np.cross(u, v))
    np.testing.assert_allclose(turned, rotation_about_y(angle) @ v, atol=1e-14)


def test_chained_poses_are_one_after_the_other() -> None:
    first, second = pose_about_y(0.4, (1.0, 2.0)), pose_at(rotation_about_y(-1.1), [0.5, 0.0, -3.0])
    point = np.array([0.2, 0.3, 0.4, 1.0])
    np.testing.assert_allclose(chained(first, second) @ point, first @ (second @ point), atol=1e-14)


def test_metres_are_a_thousandth_and_turns_stay() -> None:
    pose = pose_about_y(0.4, (1000.0, -250.0))
    metres = in_metres(pose)
    np.testing.assert_array_equal(metres[:3, :3], pose[:3, :3])
    np.testing.assert_allclose(metres[:3, 3], [1.0, 0.0, -0.25])
    assert pose[0, 3] == 1000.0


@pytest.mark.parametrize("angle", ANGLES)
def test_poses_turn_and_move_and_do_not_stretch(angle: float) -> None:
    """A rotation's inverse is its transpose, its determinant 1; the last row of a pose is (0, 0, 0, 1)."""
    rotation = rotation_about_y(angle)
    poses = {
        "y": pose_about_y(angle, (3.0, -2.0)), "z": pose_about_z(angle), "at": pose_at(rotation, [3.0, 7.0, -2.0]),
    }  # fmt: skip
    poses |= {"chained": chained(poses["y"], poses["z"]), "metres": in_metres(poses["at"])}
    for pose in poses.values():
        np.testing.assert_array_equal(pose[3], [0.0, 0.0, 0.0, 1.0])
        np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-14)
        assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
    np.testing.assert_array_equal(poses["y"][:3, 3], [3.0, 0.0, -2.0])
    np.testing.assert_array_equal(poses["at"][:3, 3], [3.0, 7.0, -2.0])
    np.testing.assert_array_equal(poses["z"][:3, 3], np.zeros(3))
