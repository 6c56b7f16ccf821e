"""The dog's rule of play, and its jaws in their pockets."""

import math

import pytest

from jumpcad.drive.dog import Dog, free_play_rad


@pytest.mark.parametrize(("roll_over_deg", "play_deg"), [(5.0, 12.0), (9.0, 12.0), (12.0, 15.0), (22.0, 25.0)])
def test_the_play_is_the_roll_over_and_3_degrees_and_at_least_12(roll_over_deg: float, play_deg: float) -> None:
    assert math.degrees(free_play_rad(math.radians(roll_over_deg))) == pytest.approx(play_deg)
    assert float(free_play_rad(math.radians(roll_over_deg), 0.5)) == 0.5


def test_a_jaw_fills_its_pocket_but_for_the_play_ahead_of_it() -> None:
    """The cam turns clockwise, so that it is pushed at a jaw's counter-clockwise end, the larger angle."""
    dog = Dog(math.radians(20.0), 14.0)
    for (begin, end), (low, high) in zip(dog.cam_jaws_rad, dog.pockets_rad, strict=True):
        assert high == end
        assert begin - low == pytest.approx(math.radians(20.0))
    (begin, first), (low, second) = dog.pockets_rad
    own = low - first, begin + 2.0 * math.pi - second  # the gear's own jaws, as wide as the cam's on average
    assert sum(own) / 2.0 == pytest.approx(dog.jaw_rad)
    assert 2.0 * (2.0 * dog.jaw_rad + dog.play_rad) == pytest.approx(2.0 * math.pi)


@pytest.mark.parametrize("play_deg", [12.0, 25.0])
def test_the_gear_fits_in_one_position_only(play_deg: float) -> None:
    """Turned by half a turn, and by as much as helps most, the cam's jaws overlap the pockets' ends by 6°."""
    dog = Dog(math.radians(play_deg), 14.0)

    def overlap_rad(turned_rad: float) -> float:
        jaws = [(begin + turned_rad, end + turned_rad) for begin, end in dog.cam_jaws_rad]
        over = 0.0
        for begin, end in jaws:
            middle = (begin + end) / 2.0
            low, high = min(
                (
                    (low + turn, high + turn)
                    for low, high in dog.pockets_rad
                    for turn in (-2.0 * math.pi, 0.0, 2.0 * math.pi)
                ),
                key=lambda pocket: abs(sum(pocket) / 2.0 - middle),
            )
            over += max(low - begin, 0.0) + max(end - high, 0.0)
        return over

    turns = [math.radians(step / 10.0) for step in range(-300, 301)]
    assert min(map(overlap_rad, turns)) == pytest.approx(0.0, abs=1e-9)
    assert min(overlap_rad(math.pi + turn) for turn in turns) == pytest.approx(math.radians(6.0), abs=1e-6)
    first, second = ((begin + end) / 2.0 for begin, end in dog.cam_jaws_rad)
    assert second - first == pytest.approx(math.pi + math.radians(play_deg / 2.0 + 3.0))
