"""The camera sees all that it is aimed at, in perspective."""

import numpy as np
import pytest

from jumpcad.scene.camera import View, aimed


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
