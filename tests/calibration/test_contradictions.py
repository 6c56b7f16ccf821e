"""Measurements that contradict each other, each by plane arithmetic."""

import pytest

from jumpcad.calibration.contradictions import contradictions
from jumpcad.calibration.measurements import FloorTest, Jumps, Measurements


def found(standing_m: float = 0.05, **measured: object) -> list[str]:
    given = Measurements.model_construct(**{"floor": FloorTest(), "jumps": ()} | measured)
    return list(contradictions(given, standing_m, weight_n=2.0))


@pytest.mark.parametrize(
    ("test", "words"),
    [
        ({"pull_n": (0.19,)}, "friction of 0.095"),
        ({"pull_n": (4.1,)}, "friction of 2.05"),
        ({"slope_deg": (5.0,)}, "friction of 0.0875"),
        ({"slope_deg": (64.0,)}, "friction of 2.05"),
        (
            {"pull_n": (1.0,), "slope_deg": (46.0,)},
            "floor.pull_n = 1 is a friction of 0.50, and floor.slope_deg = 46 one of 1.04",
        ),
        (
            {"pull_n": (1.5, 0.4, 1.0)},
            "floor.pull_n = 0.4 is a friction of 0.20, and floor.pull_n = 1.5 one of 0.75",
        ),
        ({"pull_n": (1.0, 1.9)}, None),
        ({"pull_n": (0.21, 0.41)}, None),
        ({"slope_deg": (45.0,), "pull_n": (1.1,)}, None),
    ],
)  # fmt: skip
def test_a_floor_has_one_friction_of_a_floor(test: dict[str, tuple[float, ...]], words: str | None) -> None:
    """Pull over weight, 2 N, and the slope's tangent: 0.1 to 2, and no two twice as far apart."""
    said = found(floor=FloorTest(**test))
    assert len(said) == (words is not None)
    assert words is None or words in said[0]


def jumps(kind: str, *values: float) -> Jumps:
    return Jumps(distance_mm=values, distance_of=kind)  # type: ignore[arg-type]


def test_distances_of_one_robot_agree_within_a_factor_of_three() -> None:
    assert found(jumps=(jumps("first-touchdown", 100.0, 299.0),)) == []
    for series in (
        (jumps("first-touchdown", 100.0), jumps("first-touchdown", 310.0)),
        (jumps("first-touchdown", 200.0, 310.0), jumps("first-touchdown", 100.0, 150.0)),
    ):
        (said,) = found(jumps=series)
        assert "100 and 310, both first-touchdown: one robot does not jump 3.1 times" in said


def test_a_robot_does_not_rest_far_before_its_touchdown() -> None:
    """Means of 200 mm: three quarters are 150 mm."""
    touched = jumps("first-touchdown", 190.0, 210.0)
    assert found(jumps=(touched, jumps("resting-place", 151.0))) == []
    (said,) = found(jumps=(touched, jumps("resting-place", 149.0)))
    assert "the resting place, 149, lies before the first touchdown, 200" in said
    assert found(jumps=(jumps("resting-place", 149.0),)) == []


def test_a_rise_is_less_than_the_height_above_the_floor() -> None:
    """Standing 50 mm high, a rise of 100 mm is 150 mm above the floor; 45 mm are what three deviations allow."""

    def heights(absolute: float) -> tuple[Jumps, ...]:
        return tuple(Jumps(height_mm=(mm,), height_of=of) for mm, of in ((100.0, "rise"), (absolute, "absolute")))  # type: ignore[arg-type]

    assert found(jumps=heights(106.0)) == []
    (said,) = found(jumps=heights(104.0))
    assert "a rise of 100 is 150 mm above the floor, and the absolute height is 104" in said


@pytest.mark.parametrize(("mean_mm", "refused"), [(49.9, True), (50.0, True), (50.1, False)])
def test_an_absolute_height_is_above_that_of_the_standing_robot(mean_mm: float, refused: bool) -> None:
    """Of two jumps, by their mean, standing 50 mm high."""
    series = Jumps(height_mm=(mean_mm - 5.0, mean_mm + 5.0), height_of="absolute")
    assert [one.partition(" is not above the 50 mm")[1] != "" for one in found(jumps=(series,))] == [True] * refused
