"""Clearances against distances on paper; leaving out far obstacles must not change what is free."""

import math

import numpy as np
import pytest

from jumpcad.layout.room import EVERYWHERE, Cloud, clearance, disc


def test_distance_from_a_box_to_a_disc():
    beside, corner, inside = (disc("d", at, 1.0, EVERYWHERE) for at in ((10.0, 0.0), (7.0, 6.0), (3.0, 0.0)))
    assert clearance([beside], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([5.0])
    assert clearance([beside], np.zeros((1, 2)), (4.0, 2.0), math.pi / 2, (0.0, 1.0), 10.0) == pytest.approx([7.0])
    assert clearance([corner], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([5.0 - 1.0])
    assert clearance([inside], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([-1.0 - 1.0])


def test_what_is_beside_it_across_the_robot_is_not_in_the_way():
    wheel = disc("wheel", (0.0, 0.0), 5.0, (2.0, 4.0))
    assert clearance([wheel], np.zeros((1, 2)), (1.0, 1.0), 0.0, (4.0, 6.0)) == [np.inf]
    assert clearance([wheel], np.zeros((1, 2)), (1.0, 1.0), 0.0, (3.9, 6.0)) < 0


def test_what_is_farther_away_than_asked_may_be_left_out():
    near, far = disc("near", (7.0, 0.0), 1.0, EVERYWHERE), disc("far", (70.0, 0.0), 1.0, EVERYWHERE)
    places = np.array([[0.0, 0.0], [66.0, 0.0]])
    assert clearance([near], places, (4.0, 2.0), 0.0, (0.0, 1.0), 2.1)[0] == pytest.approx(2.0)
    assert clearance([far], places, (0.0, 0.0), 0.0, (0.0, 1.0), 3.1)[1] == pytest.approx(3.0)
    assert clearance([far], places[:1], (0.0, 0.0), 0.0, (0.0, 1.0), 3.0) == [np.inf]


def test_far_points_left_out_change_nothing_that_collides():
    rng = np.random.default_rng(4)
    cloud = Cloud(rng.uniform(-60.0, 60.0, (400, 2)), rng.uniform(0.5, 4.0, 400))
    for _ in range(30):
        centres, half = rng.uniform(-50.0, 50.0, 2) + rng.uniform(-8.0, 8.0, (12, 2)), tuple(rng.uniform(0.0, 9.0, 2))
        angles = rng.uniform(0.0, math.pi, 12)
        near, whole = cloud.near(centres, half), cloud.clearance(centres, half, angles)
        found = near.clearance(centres, half, angles)
        assert len(near.radii_mm) < len(cloud.radii_mm)
        np.testing.assert_array_equal(found < 0, whole < 0)
        np.testing.assert_allclose(found[whole < 0], whole[whole < 0])
