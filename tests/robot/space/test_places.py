"""Places against a search of all of them, one by one."""

import math

import numpy as np
import pytest
from support.each import each

from jumpcad.errors import CannotBuildError
from jumpcad.robot.space.places import BATCH, best_place, grid_candidates
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, disc


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
