"""Measurement files: what the shipped ones say is not known, and one line for each thing that is not said."""

from pathlib import Path

import pytest

from jumpcad.calibration.measurements import (
    FloorTest,
    Jumps,
    Measurements,
    SpringRate,
    contradictions,
    load_measurements,
)
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.paper.reproduction import PUBLISHED_RESULTS

HEAD = 'design = "kenan-2.0"\nsource = "mine"\nrelease = "dog"\n'


def test_shipped_files_have_the_published_figures_and_say_what_is_unknown() -> None:
    published = {row.template: row.measured for row in PUBLISHED_RESULTS if row.measured}
    assert template_names("measurements") == sorted(published)
    for name, row in published.items():
        measured, _ = load_measurements(name)
        (jumps,) = measured.jumps
        assert jumps.distance_mm == (1000.0 * row.distance_m,)
        assert jumps.height_mm == (1000.0 * row.height_m,)
        assert jumps.battery_j == (row.electrical_energy_j,)
        assert (jumps.distance_of, jumps.height_of, measured.release) == ("unknown", "unknown", "unknown")
        assert measured.mass.robot_g is None
        assert {text.partition(":")[0] for text in measured.unknown} >= {"mass", "floor", "distance", "height"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[[jumps]]\ndistance_mm = [250.0]", r"jumps.distance_mm = 250.0: what was measured\? say distance_of ="),
        ("[[jumps]]\nheight_mm = [80.0]", r"height_mm = 80.0: what was measured\? say height_of = \"rise\""),
        ('[[jumps]]\nheight_of = "rise"', r"height_of = 'rise': is of nothing: give height_mm too"),
        ("[[jumps]]", r"holds no value: give distance_mm, height_mm or battery_j"),
        ('[[jumps]]\ndistance_mm = [1.0, 2.0]\ndistance_of = "unknown"\njumps = 1', r"jumps = 1: must be at least 2"),
        ("[[jumps]]\nbattery_j = [1.0, 2.0, 3.0]\njumps = 2", r"jumps = 2: must be at least 3, the values given"),
        ("[spring]\nrate_nmm_per_deg = 9.2", r"rate_nmm_per_deg = 9.2: of one spring or of both\? say springs = 1"),
        ("[mass]\nrobot_error_g = 1.0", r"is the error of nothing: give robot_g too"),
        ("[mass]\nrobot_g = 58.0\nrobot_error_g = 30.0", r"robot_error_g = 30.0: .* must be at most a half of it, 29$"),
        ("[mass]\nrobot_g = -3.0", r"mass.robot_g = -3.0: must be more than 0"),
        ("[floor]\nslope_deg = [95.0]", r"must be less than 90"),
        ("[floor]\nslope_deg = [0.0]", r"must be more than 0$"),
        ("[floor]\npull_n = [0.0]", r"must be more than 0$"),
        ('[[jumps]]\ndistance_mm = [250.0]\ndistance_of = "toe"', r"must be 'centre-of-mass', 'first-touchdown'"),
    ],
)
def test_what_is_not_said_is_asked_for_in_one_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + text)
    with pytest.raises(JumpcadError, match=message) as caught:
        load_measurements(path)
    assert "\n" not in str(caught.value)
    assert "mine.toml" in str(caught.value)


def test_a_rate_of_one_spring_counts_twice() -> None:
    said = {"design": "kenan-2.0", "source": "mine", "release": "dog"}
    one, both = (Measurements(**said, spring={"rate_nmm_per_deg": 4.6, "springs": count}) for count in (1, 2))
    assert one.spring.both_nmm_per_deg == 2.0 * 4.6
    assert both.spring.both_nmm_per_deg == 4.6


def test_a_rate_is_known_to_three_percent_unless_said() -> None:
    """docs/calibration.md: a measured rate (3 %)."""
    assert SpringRate(rate_nmm_per_deg=4.5, springs=1).error_share == 0.03


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
