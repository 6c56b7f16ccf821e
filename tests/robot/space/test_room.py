"""Clearances against distances on paper; leaving out far obstacles must not change what is free."""

import math

import numpy as np
import pytest
from support.each import each

from jumpcad.errors import CannotBuildError
from jumpcad.robot.space.room import (
    BATCH,
    EVERYWHERE,
    Obstacle,
    best_place,
    box_obstacle,
    clearance,
    disc,
    grid_candidates,
)


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


def to_origin(places: np.ndarray) -> np.ndarray:
    return np.hypot(*places.T)


def chosen(obstacles: list[Obstacle], places: np.ndarray, half: tuple[float, float], angle: float = 0.0) -> int:
    return best_place("box", obstacles, places, half, angle, (0.0, 1.0), to_origin, "make room")


@each("seed", range(8))
def test_the_nearest_free_place_of_many(seed: int) -> None:
    """Boxes among discs: a box meets a disc if the disc's centre is nearer to it than the radius."""
    rng = np.random.default_rng(seed)
    centres, radii = rng.uniform(-40.0, 40.0, (60, 2)), rng.uniform(1.0, 5.0, 60)
    centres[0], radii[0] = 0.0, 15.0  # the wanted place is taken, so that more than one batch is looked at
    half, turn = (4.0, 2.0), float(rng.uniform(0.0, math.pi))
    places = grid_candidates((-40.0, 40.0), (-40.0, 40.0), 2.0)
    cos, sin = math.cos(turn), math.sin(turn)
    nearest = math.inf
    for place in places:
        offset = (centres - place) @ np.array([[cos, -sin], [sin, cos]])
        beyond = np.maximum(np.abs(offset) - half, 0.0)
        if (np.hypot(*beyond.T) >= radii).all():
            nearest = min(nearest, math.hypot(*place))
    obstacles = [
        disc(f"disc {n}", centre, radius, EVERYWHERE)
        for n, (centre, radius) in enumerate(zip(centres, radii, strict=True))
    ]
    found = places[chosen(obstacles, places, half, turn)]
    assert np.count_nonzero(to_origin(places) < nearest) > BATCH
    assert math.hypot(*found) == pytest.approx(nearest)


def test_no_place_is_refused_with_what_is_missing_beside_what() -> None:
    """The box's edge at 9 mm is 1 mm inside the wheel's rim at 8 mm; in the other place it is deeper inside."""
    wheel, post = disc("wheel", (12.0, 0.0), 4.0, EVERYWHERE), disc("post", (-10.0, 0.0), 1.0, EVERYWHERE)
    with pytest.raises(
        CannotBuildError, match=r"^no room for the box: 1\.0 mm too little beside the wheel: make room$"
    ):
        chosen([wheel, post], np.array([[6.0, 0.0], [-10.0, 0.0]]), (3.0, 3.0))


def test_what_is_in_the_way_is_found_beside_the_box_as_it_is_turned() -> None:
    """Upright the box is 2 mm wide: the post is 0.5 mm inside it, and the wheel beside it is only met by a flat one."""
    obstacles = [
        disc("hub", (0.0, 0.0), 3.0, EVERYWHERE),
        disc("wheel", (23.5, 0.0), 1.6, EVERYWHERE),
        disc("post", (21.5, 0.0), 1.0, EVERYWHERE),
    ]
    places, turns = np.array([[0.0, 0.0], [20.0, 0.0]]), np.array([0.0, math.pi / 2.0])
    with pytest.raises(CannotBuildError, match=r"0\.5 mm too little beside the post") as refused:
        best_place("small box", obstacles, places, (4.0, 1.0), turns, (0.0, 1.0), to_origin, "make room")
    assert refused.value.limit == "room_small_box"
    assert refused.value.margin == pytest.approx(-0.5)
