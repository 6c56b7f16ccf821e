"""A ballistic flight is recovered from its points, and its gravity tells a wrong scale or clock."""

import math
import re

import numpy as np
import pytest

from jumpcad.calibration.video import seen_takeoff
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


def test_gravity_tells_a_wrong_unit_and_a_wrong_clock_of_any_rate() -> None:
    """Lengths n times too large fall n times as fast; a clock n times too slow shows a gravity of g/n²."""
    cases = {
        (1.0, 1000.0, 1000.0): r"9.81e\+03 m/s² instead of 9.81: x and z are in mm: divide them by 1000",
        (1.0, 100.0, 100.0): "x and z are in cm: divide them by 100; or the clock is 10 times too fast",
        (1.0, 1.0, -1.0): "z points down",
        (1.0, 1.0, 0.0): "keep only the points between take-off and touchdown",
    }
    for slow in (1.25, 2.0, 4.8, 8.0, 9.6, 33.3, 1000.0):
        cases[slow, 1.0, 1.0] = rf"the clock is {slow:g} times too slow: say slow_motion = {slow:g} in \[\[videos\]\]"
        cases[1.0 / slow, 1.0, 1.0] = rf"the clock is {slow:g} times too fast: say slow_motion = {1.0 / slow:.4g} in"
    for scale, message in cases.items():
        with pytest.raises(JumpcadError) as caught:
            seen_takeoff(flight() * np.array(scale), "here")
        assert re.search(message, str(caught.value)), f"{scale}: {caught.value}"


def test_a_flight_backwards() -> None:
    with pytest.raises(JumpcadError, match="x must point forwards"):
        seen_takeoff(flight() * np.array([1.0, -1.0, 1.0]), "here")
    with pytest.raises(JumpcadError, match="z upwards"):  # the way down alone
        seen_takeoff(flight()[13:], "here")
