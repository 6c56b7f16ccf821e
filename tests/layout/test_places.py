"""Places against a search of all of them, one by one."""

import math
from contextlib import nullcontext

import numpy as np
import pytest

from jumpcad.errors import CannotBuildError
from jumpcad.layout.places import BATCH, best_place, grid_candidates, ring_candidates
from jumpcad.layout.room import EVERYWHERE, Obstacle, disc

ORIGIN = np.zeros(2)


def to_origin(places: np.ndarray) -> np.ndarray:
    return np.hypot(*places.T)


def chosen(obstacles: list[Obstacle], places: np.ndarray, half: tuple[float, float], angle: float = 0.0) -> int:
    return best_place("box", obstacles, places, half, angle, (0.0, 1.0), to_origin, "make room")


def test_a_ring_is_at_its_radius_in_its_directions() -> None:
    centre = np.array([3.0, -4.0])
    places, angles = ring_candidates(centre, 12.5)
    offset = places - centre
    np.testing.assert_allclose(np.hypot(*offset.T), 12.5, atol=1e-6)  # places are whole nanometres
    np.testing.assert_array_equal(places, np.round(places, 6))
    around = np.angle(np.exp(1j * (np.arctan2(offset[:, 1], offset[:, 0]) - angles)))
    np.testing.assert_allclose(around, 0.0, atol=1e-7)
    np.testing.assert_allclose(np.diff(angles), 2 * math.pi / len(places))


def test_a_grid_has_every_node_once() -> None:
    places = grid_candidates((-4.0, 2.0), (0.0, 4.0), 2.0)
    assert {tuple(place) for place in places.tolist()} == {(x, z) for x in (-4.0, -2.0, 0.0) for z in (0.0, 2.0)}
    assert len(places) == 6


@pytest.mark.parametrize("seed", range(8))
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


def test_of_equals_the_first() -> None:
    places = np.array([[5.0, 0.0], [0.0, 5.0], [-5.0, 0.0]])
    assert chosen([], places, (1.0, 1.0)) == 0
    assert chosen([disc("d", (5.0, 0.0), 1.0, EVERYWHERE)], places, (1.0, 1.0)) == 1


def test_what_is_beside_the_box_across_the_robot_is_not_in_its_way() -> None:
    assert chosen([disc("d", ORIGIN, 9.0, (1.0, 2.0))], np.zeros((1, 2)), (1.0, 1.0)) == 0


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


@pytest.mark.parametrize(("short_mm", "free"), [(-1e-3, True), (0.0, True), (5e-7, True), (5e-6, False)])
def test_what_just_touches_is_free(short_mm: float, free: bool) -> None:
    """A synthesised drive may leave a clearance of exactly 0: a shortfall of less than a nanometre is none."""
    wheel, place = disc("wheel", (10.0, 0.0), 6.0 + short_mm, EVERYWHERE), np.zeros((1, 2))
    with nullcontext() if free else pytest.raises(CannotBuildError, match="no room for the box"):
        assert chosen([wheel], place, (4.0, 1.0)) == 0
