"""Priors against scipy's distributions, and the stop's pad as a spring that does not pull."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats
from support.built import built

from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.simulation.mechanics import StopPad
from jumpcad.simulation.prior import QUANTILES, Prior, sobol

SHARES = (0.1, 0.5, 0.9)


@pytest.mark.parametrize(
    ("prior", "known"),
    [
        (Prior("normal", 0.95, 0.05, "x"), stats.norm(0.95, 0.05)),
        (Prior("lognormal", 0.25, 0.4, "x"), stats.lognorm(0.4, scale=0.25)),
        (Prior("uniform", 2.0, 5.0, "x"), stats.uniform(2.0, 3.0)),
        (Prior("half-normal", 0.0, 1.5, "x"), stats.halfnorm(scale=1.5)),
    ],
    ids=lambda one: getattr(one, "shape", ""),
)
def test_quantiles_are_those_of_the_distribution(prior: Prior, known: stats.rv_continuous) -> None:
    assert prior.quantiles(SHARES) == pytest.approx(known.ppf(SHARES))
    assert QUANTILES == SHARES  # what reports call 10, 50 and 90 %


def test_a_normal_is_cut_off_and_a_half_normal_stays_finite() -> None:
    assert Prior("normal", 1.0, 1.0, "x", 0.3).at(np.array([-2.0, 0.0])).tolist() == [0.3, 1.0]
    least, most = Prior("half-normal", 0.0, 1.0, "x").at(np.array([-40.0, 40.0]))
    assert least == 0.0
    assert 6.0 < most < 10.0


def test_the_pad_pushes_back_elastically_and_stops_the_leg_at_most() -> None:
    """k·(q - q0) of a slowly opening leg; within a step no more than I·w/dt and the springs' torque; never a pull."""
    robot = built("kenan-2.0")
    assert robot.stop is not None
    step_s, at, rate = 1e-3, robot.stop.angle_rad, robot.stop.stiffness_nm_per_rad
    pad, inertia = StopPad(robot, step_s), leg_inertia_kg_m2(robot, robot.stop.angle_rad)
    assert pad.torque_nm(at - 1e-4, 50.0) == 0.0
    assert pad.torque_nm(at + 1e-3, 50.0) == pytest.approx(rate * 1e-3)
    deep = pad.torque_nm(at + 1.0, 0.01)
    assert deep == pytest.approx(inertia * 0.01 / step_s + max(robot.spring.torque_nm(at + 1.0), 0.0))
    assert deep < rate
    assert pad.torque_nm(at + 1e-3, -50.0) == 0.0
    free = SimpleNamespace(stop=None, spring=robot.spring)
    assert StopPad(free, step_s).torque_nm(math.pi, 9.0) == 0.0  # type: ignore[arg-type]


@pytest.mark.parametrize("dimension", [1, 3, 20])
def test_every_axis_has_one_point_in_each_of_its_equal_parts(dimension: int) -> None:
    points = sobol(dimension, 64, np.random.default_rng(7))
    assert points.shape == (64, dimension)
    assert np.array_equal(np.sort(np.floor(64.0 * points), axis=0), np.repeat(np.arange(64.0)[:, None], dimension, 1))


def test_a_generator_decides_the_points_and_two_differ() -> None:
    one, again, other = (sobol(4, 16, np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)


def test_points_are_scrambled() -> None:
    """Those of the sequence itself begin with the cube's corner and its middle, whatever the generator."""
    first = sobol(3, 2, np.random.default_rng(1))
    assert not np.array_equal(first, [[0.0] * 3, [0.5] * 3])
    assert (first > 0.0).all()
