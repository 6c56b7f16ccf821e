"""A ballistic flight is recovered from its points, and its gravity tells a wrong scale or clock."""

import math
from pathlib import Path

import numpy as np
import pytest

from jumpcad.calibration.video import read_points, seen_takeoff
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

SPEED, ANGLE = 1.25, 48.0


def flight(noise_m: float = 0.0, seed: int = 1) -> Array:
    """Return points (24, 3) of a flight, seen at 120 frames a second."""
    t = np.arange(24) / 120.0 + 3.0
    fall = t - t[0]
    x = SPEED * math.cos(math.radians(ANGLE)) * fall
    z = SPEED * math.sin(math.radians(ANGLE)) * fall - 0.5 * 9.81 * fall**2
    noise = noise_m * np.random.default_rng(seed).standard_normal((2, 24))
    return np.column_stack([t, x + 0.4 + noise[0], z + 0.1 + noise[1]])


def test_speed_and_angle_at_the_first_point() -> None:
    seen = seen_takeoff(flight(), "here")
    assert (seen.speed_m_s, seen.angle_deg) == pytest.approx((SPEED, ANGLE), rel=1e-9)
    assert seen.speed_error_m_s < 1e-9


def test_the_standard_error_is_that_of_repeated_fits() -> None:
    """Gauss: the slope of a line through points with deviation s has the deviation s / sqrt(sum((t - mean)²))."""
    t = np.arange(24) / 120.0
    expected = 0.002 / math.sqrt(float(np.sum((t - t.mean()) ** 2)))
    found = [seen_takeoff(flight(0.002, seed), "here").speed_error_m_s for seed in range(200)]
    assert np.mean(np.square(found)) == pytest.approx(expected**2, rel=0.04)  # four numbers are fitted to 48


def test_the_angles_error_is_in_degrees() -> None:
    """A velocity that is off by e square to it turns by e over the speed, as fits of 200 noisy flights do."""
    seen = [seen_takeoff(flight(0.002, seed), "here") for seed in range(200)]
    scatter = np.std([one.angle_deg for one in seen])
    assert np.mean([one.angle_error_deg for one in seen]) == pytest.approx(scatter, rel=0.15)
    assert np.mean([one.speed_error_m_s for one in seen]) == pytest.approx(
        np.std([s.speed_m_s for s in seen]), rel=0.15
    )


@pytest.mark.parametrize(
    ("scale", "message"),
    [
        ((1.0, 1000.0, 1000.0), r"9.81e\+03 m/s² instead of 9.81: x and z are in mm: divide them by 1000"),
        ((1.0, 100.0, 100.0), "x and z are in cm"),
        ((10.0, 1.0, 1.0), "t is 10 times too long: slow motion"),
        ((1000.0, 1.0, 1.0), "t is in ms"),
        ((1.0, 1.0, -1.0), "z points down"),
        ((1.0, 1.0, 2.0), "keep only the points between take-off and touchdown"),
    ],
)
def test_gravity_tells_a_wrong_unit(scale: tuple[float, float, float], message: str) -> None:
    with pytest.raises(JumpcadError, match=message):
        seen_takeoff(flight() * np.array(scale), "here")


def test_a_flight_backwards() -> None:
    with pytest.raises(JumpcadError, match="x must point forwards"):
        seen_takeoff(flight() * np.array([1.0, -1.0, 1.0]), "here")
    with pytest.raises(JumpcadError, match="z upwards"):  # the way down alone
        seen_takeoff(flight()[13:], "here")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"no column t: the first line must be t,x,z"),
        ("t,x,y\n", r"no column z"),
        ("t,x,z\n0,0,0\n", r"1 point: too few, mark at least 6"),
        ("t,x,z\n0,0,a\n", r"points.csv:2: '0,0,a' must be three numbers"),
        ("t,x,z\n0,0,nan\n", r"must be finite"),
        ("t,x,z\n" + "0,0,0\n" * 8, r"t must grow"),
        ("t,x,z\n" + "".join(f"{t},0,0\n" for t in (0, 1, 2, 3, 3, 4, 5, 6)), r"t must grow"),
    ],
)
def test_bad_files(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(JumpcadError, match=message):
        read_points(path)


def test_columns_in_any_order_and_empty_lines(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    rows = [f"{x},{z},{t}" for t, x, z in flight()]
    path.write_text("x, z, t\n" + "\n\n".join(rows) + "\n")
    assert np.array_equal(read_points(path), flight())


@pytest.mark.parametrize("cell", ["1" * 300_000, '"' + "1,\n" * 150_000])
def test_a_cell_that_is_too_long_is_one_line(tmp_path: Path, cell: str) -> None:
    path = tmp_path / "long.csv"
    path.write_text(f"t,x,z\n0.0,0.0,0.0\n{cell},1.0,1.0\n")
    with pytest.raises(
        JumpcadError, match=r"long\.csv:\d+: cannot be read as CSV: field larger than field limit"
    ) as caught:
        read_points(path)
    assert "\n" not in str(caught.value)
