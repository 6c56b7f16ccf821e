"""Measurement files: what the shipped ones say is not known, and one line for each thing that is not said."""

from pathlib import Path

import pytest

from jumpcad.calibration.measurements import Measurements, SpringRate, load_measurements
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
