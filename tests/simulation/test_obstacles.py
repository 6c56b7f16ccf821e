"""What a flight passes over and lands on, against stones whose ways are parabolas."""

import numpy as np
import pytest
from support.built import built

from jumpcad.simulation import simulate
from jumpcad.simulation.obstacles import obstacles

TIME_S = np.linspace(0.0, 2.0 * 3.0 / 9.81, 2000)
WAY_M, HEIGHT_M = 2.0 * TIME_S, 3.0 * TIME_S - 4.905 * TIME_S**2
TOP_M = 3.0**2 / (2.0 * 9.81)


def test_a_stone_passes_over_a_bar_as_high_as_its_apex_and_lands_on_a_step_as_high() -> None:
    found = obstacles((WAY_M + 1j * HEIGHT_M)[:, None], WAY_M, 0.0)
    half_way = 1000.0 * 2.0 * 3.0 / 9.81
    assert found.clears_bar_mm == pytest.approx(1000.0 * TOP_M, rel=0.01)
    assert found.bar_distance_mm == pytest.approx(half_way, rel=0.05)
    assert found.lands_on_mm == pytest.approx(1000.0 * TOP_M, rel=0.02)


def test_two_stones_behind_each_other_clear_what_both_pass_and_land_where_both_are_above() -> None:
    """The second flies 0.1 m lower: it decides on the bar; the edge of a step must lie below both."""
    both = np.stack([WAY_M + 1j * HEIGHT_M, WAY_M - 0.3 + 1j * (HEIGHT_M - 0.1)], axis=1)[HEIGHT_M > 0.1]
    found = obstacles(both, both.real[:, 0] - 0.15, both[0, 0].real)
    assert found.clears_bar_mm == pytest.approx(1000.0 * (TOP_M - 0.1), rel=0.02)
    assert found.lands_on_mm <= 1000.0 * (TOP_M - 0.1) + 1.0


def test_what_does_not_fly_farther_than_it_is_long_clears_no_bar() -> None:
    both = np.stack([WAY_M + 1j * HEIGHT_M, WAY_M - 5.0 + 1j * HEIGHT_M], axis=1)
    assert obstacles(both, WAY_M - 2.5, float(WAY_M[0])).clears_bar_mm == 0.0
    assert simulate(built("kenan-2.0"), engine="planar").clears_bar_mm == 0.0  # 0.19 m long, 0.17 m far


def test_what_flies_straight_up_passes_over_nothing() -> None:
    found = obstacles((0.3 + 1j * HEIGHT_M)[:, None], np.full(len(TIME_S), 0.3), 0.3)
    assert (found.clears_bar_mm, found.lands_on_mm) == (0.0, 0.0)


def test_a_robots_lowest_point_stays_below_its_centre_of_mass() -> None:
    jump = simulate(built("best-printable"), engine="planar")
    assert jump.com_rise_m is not None
    assert 0.5 < jump.clears_bar_mm / (1000.0 * jump.com_rise_m) < 1.05
    assert jump.bar_distance_mm > 0.0
