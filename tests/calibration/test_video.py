"""A ballistic flight is recovered from its points, and its gravity and speed tell a wrong unit or clock."""

import math
import re

import numpy as np
import pytest

from jumpcad.calibration.video import seen_takeoff
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

SPEED, ANGLE, FASTEST = 1.25, 48.0, 1.5


def flight(noise_m: float = 0.0, seed: int = 1) -> Array:
    """Return points (24, 3) of a flight, seen at 120 frames a second."""
    t = np.arange(24) / 120.0 + 3.0
    fall = t - t[0]
    x = SPEED * math.cos(math.radians(ANGLE)) * fall
    z = SPEED * math.sin(math.radians(ANGLE)) * fall - 0.5 * 9.81 * fall**2
    noise = noise_m * np.random.default_rng(seed).standard_normal((2, 24))
    return np.column_stack([t, x + 0.4 + noise[0], z + 0.1 + noise[1]])


def test_speed_and_angle_at_the_first_point() -> None:
    seen = seen_takeoff(flight(), "here", FASTEST)
    assert (seen.speed_m_s, seen.angle_deg) == pytest.approx((SPEED, ANGLE), rel=1e-9)
    assert seen.speed_error_m_s < 1e-9


def test_the_standard_error_is_that_of_repeated_fits() -> None:
    """Gauss: the slope of a line through points with deviation s has the deviation s / sqrt(sum((t - mean)²))."""
    t = np.arange(24) / 120.0
    expected = 0.002 / math.sqrt(float(np.sum((t - t.mean()) ** 2)))
    found = [seen_takeoff(flight(0.002, seed), "here", FASTEST).speed_error_m_s for seed in range(200)]
    assert np.mean(np.square(found)) == pytest.approx(expected**2, rel=0.04)  # four numbers are fitted to 48


def test_the_angles_error_is_in_degrees() -> None:
    """A velocity that is off by e square to it turns by e over the speed, as fits of 200 noisy flights do."""
    seen = [seen_takeoff(flight(0.002, seed), "here", FASTEST) for seed in range(200)]
    scatter = np.std([one.angle_deg for one in seen])
    assert np.mean([one.angle_error_deg for one in seen]) == pytest.approx(scatter, rel=0.15)
    assert np.mean([one.speed_error_m_s for one in seen]) == pytest.approx(
        np.std([s.speed_m_s for s in seen]), rel=0.15
    )


def test_a_wrong_unit_with_any_clock_is_put_right_by_what_the_error_says() -> None:
    """Lengths s times too large, seen n times too slow, fall with g·s/n² at s/n times the speed: n² = s hides in g."""
    for scale in (1.0, 100.0, 1000.0, 1.0 / 0.0254):
        for slow in (1.0, 1.25, 2.0, 4.8, 8.0, 9.6, 33.3, 1000.0, 0.5, 0.125, math.sqrt(scale)):
            points = flight() * np.array([slow, scale, scale])
            if scale == slow == 1.0:
                continue
            with pytest.raises(JumpcadError) as caught:
                seen_takeoff(points, "here", FASTEST)
            way = str(caught.value).split(": ", maxsplit=2)[2]
            found = []
            for one in way.split("; or x and z")[:2]:
                divide, clock = (re.search(f"{word} ([0-9.e-]+)", one) for word in ("by", "slow_motion ="))
                right = np.array([1.0, *[1.0 / float(divide[1]) if divide else 1.0] * 2])
                found.append(seen_takeoff(points * right, "here", FASTEST, float(clock[1]) if clock else 1.0).speed_m_s)
            assert any(abs(one - SPEED) < 1e-3 * SPEED for one in found), f"{scale}, {slow}: {caught.value}: {found}"


def test_a_slow_motion_that_is_wrong_is_corrected() -> None:
    with pytest.raises(JumpcadError, match=r"the clock is 8 times too fast: say slow_motion = 1 in \[\[videos\]\]"):
        seen_takeoff(flight(), "here", FASTEST, slow_motion=8.0)


def test_points_of_no_jump_of_this_robot() -> None:
    thrown = flight() + (flight() - flight()[0]) * [0.0, 3.0, 0.0]
    for points, message in (
        (flight() * [1.0, 1.0, -1.0], "z points down"),
        (flight() * [1.0, 1.0, 0.0], "keep only the points between take-off and touchdown"),
        (thrown, "start with 3.47 m/s, where the springs give up to 1.5: "),
    ):
        with pytest.raises(JumpcadError) as caught:
            seen_takeoff(points, "here", FASTEST)
        assert message in str(caught.value)


def test_noise_is_no_clock() -> None:
    """Half a millimetre over 12 points of 1/240 s leaves g uncertain by 19 %; points on the ground are no noise."""
    t, clocks = np.arange(12) / 240.0, 0
    for seed in range(1000):
        noise = 5e-4 * np.random.default_rng(seed).standard_normal((2, 12))
        points = np.column_stack([t, 0.9 * t + noise[0], 0.9 * t - 4.905 * t * t + noise[1]])
        try:
            assert seen_takeoff(points, "here", FASTEST).speed_m_s == pytest.approx(0.9 * math.sqrt(2.0), rel=0.05)
        except JumpcadError:
            clocks += 1
    assert clocks < 10  # beyond three standard errors are 3 of 1000
    t = np.arange(90) / 240.0
    noise = 5e-4 * np.random.default_rng(1).standard_normal((2, 90))
    landed = np.column_stack([t, 0.9 * t + noise[0], np.maximum(0.9 * t - 4.905 * t * t, 0.0) + noise[1]])
    with pytest.raises(JumpcadError, match="keep only the points between take-off and touchdown"):
        seen_takeoff(landed, "here", FASTEST)


def test_a_flight_backwards() -> None:
    with pytest.raises(JumpcadError, match="x must point forwards"):
        seen_takeoff(flight() * np.array([1.0, -1.0, 1.0]), "here", FASTEST)
    with pytest.raises(JumpcadError, match="z upwards"):  # the way down alone
        seen_takeoff(flight()[13:], "here", FASTEST)
