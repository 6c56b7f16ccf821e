"""Propagation: indices of functions whose indices are known, and the robot's interval."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad.robot import Robot
from jumpcad.settings import Draws, Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.uncertain import _first_order, uncertain_jump


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


def test_indices_of_a_sum_and_a_product() -> None:
    """y = 3a + 4b + 0c of independent normals: 9/25, 16/25, 0. y = a + a·b: 1/2 for a, and none for b alone."""
    rng = np.random.default_rng(0)
    a, b, c = rng.standard_normal((3, 4096, 1))
    figures = np.concatenate([3 * a + 4 * b, a + a * b], axis=1)
    found = _first_order({"a": a, "b": b, "c": c}, figures, np.arange(4096))
    assert found[:, 0] == pytest.approx([9 / 25, 16 / 25, 0.0], abs=0.02)
    assert found[:, 1] == pytest.approx([0.5, 0.0, 0.0], abs=0.04)


def test_a_group_of_two_counts_together() -> None:
    rng = np.random.default_rng(0)
    pair, other = rng.standard_normal((4096, 2)), rng.standard_normal((4096, 1))
    figures = pair[:, :1] ** 2 + pair[:, 1:] + other  # variances 2, 1 and 1
    found = _first_order({"pair": pair, "other": other}, figures, np.arange(4096))
    assert found[:, 0] == pytest.approx([0.75, 0.25], abs=0.03)


def test_interval_holds_the_jump_and_shrinks_with_a_calibration(robot: Robot) -> None:
    nominal = simulate(robot, Settings(), "planar").ballistic_range_m
    vague = uncertain_jump(robot, Settings(), "planar", samples=64)
    draws = Draws(spring_efficiency=(0.99, 1.0, 1.01) * 10, pin_friction=(0.24, 0.25, 0.26) * 10)
    sharp = uncertain_jump(robot, Settings(draws=draws), "planar", samples=64)
    widths = []
    for found in (vague, sharp):
        low, _, high = found.quantiles["ballistic_range_m"]
        assert low < nominal < high
        widths.append(high - low)
        assert (found.jumps, found.jumps_share) == (64, 1.0)
    assert widths[1] < widths[0]
    assert (vague.calibrated, sharp.calibrated) == (False, True)
    share = [found.first_order["calibration"]["ballistic_range_m"] for found in (vague, sharp)]
    assert share[1] < share[0]


def test_the_workshop_says_how_much_springs_scatter(robot: Robot) -> None:
    safety = robot.workshop.safety.model_copy(update={"spring_rate_scatter": 0.0})
    exact = replace(robot, workshop=robot.workshop.model_copy(update={"safety": safety}))
    found = uncertain_jump(exact, Settings(), "planar", samples=32)
    assert found.first_order["springs"]["ballistic_range_m"] == pytest.approx(0.0, abs=1e-9)
