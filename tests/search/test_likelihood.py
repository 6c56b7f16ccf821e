"""The likelihood of a Gaussian process against scikit-learn's."""

import numpy as np
import pytest
from sklearn.gaussian_process import GaussianProcessRegressor
from support.kernels import matern

from jumpcad.search.likelihood import JITTER, LENGTH, NOISE, START, VARIANCE, Likelihood


def data(count):
    x = np.random.default_rng(0).random((count, 3))
    values = np.sin(4.0 * x[:, 0]) + x[:, 1] ** 2
    return x, (values - values.mean()) / values.std()


@pytest.mark.parametrize("count", [2, 5, 40])
def test_value_and_slopes_are_those_of_scikit_learn(count):
    x, y = data(count)
    theirs = GaussianProcessRegressor(matern(3), alpha=JITTER, optimizer=None).fit(x, y)
    for theta in np.log([[1.0, 0.5, 0.5, 0.5, 1e-4], [3.0, 0.2, 1.0, 8.0, 1e-2]]):
        value, slopes = theirs.log_marginal_likelihood(theta, eval_gradient=True)
        ours, ours_slopes = Likelihood(x, y).negative(theta)
        assert ours == pytest.approx(-value, rel=1e-9)
        assert ours_slopes == pytest.approx(-slopes, rel=1e-6, abs=1e-9)


def test_start_and_bounds_are_those_of_the_kernel():
    kernel = matern(3)
    assert np.exp(kernel.theta) == pytest.approx([START[0], *[START[1]] * 3, START[2]])
    assert np.exp(kernel.bounds) == pytest.approx(np.array([VARIANCE, LENGTH, LENGTH, LENGTH, NOISE]))


def test_points_that_contradict_each_other_without_noise_are_unlikely_not_an_error():
    """The covariance of equal points with a noise of 0 has no factor."""
    value, slopes = Likelihood(np.zeros((40, 3)), np.arange(40.0)).negative(np.array([40.0, 0.0, 0.0, 0.0, -90.0]))
    assert value > 1e9
    assert (slopes == 0.0).all()
