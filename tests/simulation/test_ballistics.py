"""Flights without air and through it, against textbooks, an own integration, and the engines."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import needs
from support.built import built

from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.ballistics import ballistics, drag_per_m
from jumpcad.transforms import Array

STILL = np.zeros(3)


def test_ballistics_against_integration() -> None:
    """The flight integrated numerically until it falls through its height at release."""
    start, takeoff, velocity, gravity = (
        np.array([0.1, 0, 0.05]),
        np.array([0.13, 0, 0.08]),
        np.array([1.4, 0, 2.1]),
        9.81,
    )

    def landed(_: float, y: Array) -> float:
        return float(y[1] - start[2])

    landed.terminal, landed.direction = True, -1  # type: ignore[attr-defined]
    path = solve_ivp(
        lambda _, y: [y[2], y[3], 0.0, -gravity], (0, 5), [takeoff[0], takeoff[2], velocity[0], velocity[2]],
        events=landed, rtol=1e-10, atol=1e-12, max_step=0.01, dense_output=True,
    )  # fmt: skip
    flight = ballistics(start, takeoff, velocity, gravity)
    assert flight.range_m == pytest.approx(path.y_events[0][0][0] - start[0], rel=1e-8)
    heights = path.sol(np.linspace(0, path.t[-1], 100_001))[1]
    assert flight.rise_m == pytest.approx(heights.max() - start[2], rel=1e-8)
    assert flight.angle_deg == pytest.approx(math.degrees(math.atan(1.5)))


def test_ballistics_from_level_ground_is_the_textbook_range() -> None:
    """v²·sin(2θ)/g."""
    speed, angle = 3.0, math.radians(40)
    velocity = speed * np.array([math.cos(angle), 0.0, math.sin(angle)])
    flight = ballistics(np.zeros(3), np.zeros(3), velocity, 9.81)
    assert flight.range_m == pytest.approx(speed**2 * math.sin(2 * angle) / 9.81)


@pytest.mark.parametrize(("up_m_s", "lift_m"), [(0.5, -0.1), (1.4, -0.1), (1.4007142, -0.1), (0.5, -0.02), (2.0, -0.1)])
def test_who_leaves_lower_than_it_started_flies_to_that_height_or_to_its_highest_point(
    up_m_s: float, lift_m: float
) -> None:
    """√(2·g·0.1 m) = 1.4007 m/s are needed to come back to it."""
    gravity, start = 9.81, np.array([0.1, 0.2, 0.3])
    flight = ballistics(start, start + np.array([0.05, 0.0, lift_m]), np.array([1.2, 0.0, up_m_s]), gravity)
    apex_s, fallen_m = up_m_s / gravity, lift_m + up_m_s**2 / (2.0 * gravity)
    assert flight.rise_m == pytest.approx(fallen_m)
    falls_s = math.sqrt(2.0 * fallen_m / gravity) if fallen_m > 0.0 else 0.0
    assert flight.range_m == pytest.approx(0.05 + 1.2 * (apex_s + falls_s))
    assert flight.speed_m_s == pytest.approx(math.hypot(1.2, up_m_s))


def test_a_stone_thrown_up_through_air_rises_as_the_textbook_says() -> None:
    """ln(1 + k·v²/g)/(2·k) high, with k of the square of speed (Timoshenko and Young, Advanced Dynamics, ch. 1)."""
    per_m, speed = 0.08, 5.0
    flight = ballistics(STILL, STILL, np.array([0.0, 0.0, speed]), 9.81, per_m)
    assert flight.rise_m == pytest.approx(math.log(1.0 + per_m * speed**2 / 9.81) / (2.0 * per_m), rel=1e-6)
    assert flight.place_m(np.array([math.atan(speed * math.sqrt(per_m / 9.81)) / math.sqrt(per_m * 9.81)]))[
        0
    ].imag == pytest.approx(flight.rise_m, rel=1e-6)


def test_seven_grams_with_15_square_centimetres_lose_a_fifth_of_their_height() -> None:
    """5.96 m/s at 75°: 1.69 m without air, 1.38 m through it, in small steps and here; and the way along."""
    per_m, angle = drag_per_m(15.6e-4, 0.007), math.radians(75.0)
    velocity = 5.96 * np.array([math.cos(angle), 0.0, math.sin(angle)])
    free, braked = (ballistics(STILL, STILL, velocity, 9.81, k) for k in (0.0, per_m))
    place, speed, step, top = np.zeros(2), velocity[[0, 2]].copy(), 1e-5, 0.0
    while speed[1] > 0.0 or place[1] > 0.0:
        speed -= step * (per_m * math.hypot(*speed) * speed + np.array([0.0, 9.81]))
        place += step * speed
        top = max(top, place[1])
    assert free.rise_m == pytest.approx(1.69, abs=0.005)
    assert braked.rise_m == pytest.approx(1.38, abs=0.005)
    assert braked.rise_m == pytest.approx(top, rel=1e-3)
    assert braked.range_m == pytest.approx(place[0], rel=1e-3)


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_air_acts_on_range_time_and_touchdown_in_every_engine(engine: str) -> None:
    """A tenth of a square metre: the simulated flight lands when and where the path does, nearer than without air."""
    if engine != "planar":
        needs.package(engine)
    robot = built("best-bo")
    free, braked = (simulate(robot, Settings(flight="simulated", drag_area_m2=area), engine) for area in (0.0, 0.1))
    assert braked.air_time_s is not None
    assert braked.ballistic_range_m < 0.85 * free.ballistic_range_m
    assert braked.air_time_s < free.air_time_s
    assert braked.touchdown_distance_m < 0.85 * free.touchdown_distance_m
    assert braked.takeoff_speed_m_s == free.takeoff_speed_m_s
    assert braked.turn_rate_deg_s == free.turn_rate_deg_s
