"""Scrambled Sobol points: one in each dyadic interval of every axis (Sobol 1967), whatever scrambles them."""

import numpy as np
import pytest

from jumpcad.sobol import sobol


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
