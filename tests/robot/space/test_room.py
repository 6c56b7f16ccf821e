"""Clearances against distances on paper; leaving out far obstacles must not change what is free."""

import math

import numpy as np
import pytest

from jumpcad.robot.space.room import EVERYWHERE, box_obstacle, clearance, disc


def test_distance_from_a_box_to_a_disc():
    beside, corner, inside = (disc("d", at, 1.0, EVERYWHERE) for at in ((10.0, 0.0), (7.0, 6.0), (3.0, 0.0)))
    assert clearance([beside], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([5.0])
    assert clearance([beside], np.zeros((1, 2)), (4.0, 2.0), math.pi / 2, (0.0, 1.0), 10.0) == pytest.approx([7.0])
    assert clearance([corner], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([5.0 - 1.0])
    assert clearance([inside], np.zeros((1, 2)), (4.0, 2.0), 0.0, (0.0, 1.0), 10.0) == pytest.approx([-1.0 - 1.0])


@pytest.mark.parametrize("turn_deg", [30.0, -30.0, 130.0])
def test_a_box_is_turned_from_x_towards_z(turn_deg):
    """A disc of 1 mm is 5 mm before the end of a box of 8 x 4 mm, in the direction of its long side, and 1 mm aside."""
    turn = math.radians(turn_deg)
    along, across = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
    place = np.array([[3.0, -7.0]])
    ahead = disc("d", place[0] + 9.0 * along + across, 1.0, EVERYWHERE)
    assert clearance([ahead], place, (4.0, 2.0), turn, (0.0, 1.0), 20.0) == pytest.approx([4.0])


def test_what_is_beside_it_across_the_robot_is_not_in_the_way():
    wheel = disc("wheel", (0.0, 0.0), 5.0, (2.0, 4.0))
    assert clearance([wheel], np.zeros((1, 2)), (1.0, 1.0), 0.0, (4.0, 6.0)) == [np.inf]
    assert clearance([wheel], np.zeros((1, 2)), (1.0, 1.0), 0.0, (3.9, 6.0)) < 0


@pytest.mark.parametrize("half", [(6.0, 2.5), (1.3, 9.7)])
def test_a_box_of_points_reaches_as_far_as_the_box_and_leaves_only_notches(half: tuple[float, float]) -> None:
    """Discs of 1 mm radius within the turned box, so close that 0.3 mm inside its sides nothing is free."""
    turn, centre = math.radians(37.0), np.array([3.0, -8.0])
    box = box_obstacle("box", centre, half, turn, (1.0, 2.0))
    assert (box.name, box.y_mm) == ("box", (1.0, 2.0))
    along, across = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
    u, v = (box.points_mm - centre) @ along, (box.points_mm - centre) @ across
    assert np.abs(u).max() + box.radius_mm == pytest.approx(half[0])
    assert np.abs(v).max() + box.radius_mm == pytest.approx(half[1])
    tried = np.random.default_rng(1).uniform(-1.0, 1.0, (300, 2)) * (np.array(half) - 0.3)
    places = centre + tried[:, :1] * along + tried[:, 1:] * across
    corner = (np.abs(tried) > np.array(half) - 1.0).all(axis=1)
    assert (clearance([box], places[~corner], (0.0, 0.0), 0.0, EVERYWHERE)[:] < 0.15).all()
