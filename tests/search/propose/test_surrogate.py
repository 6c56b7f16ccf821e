"""A Gaussian process against scikit-learn's own predictions, and its slope against differences."""

import numpy as np
import pytest
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

from jumpcad.search.propose.surrogate import JITTER, Surrogate, one_hot


@pytest.fixture
def data():
    generator = np.random.default_rng(0)
    x = generator.random((40, 3))
    return x, np.sin(4 * x[:, 0]) + x[:, 1] ** 2


def test_predictions_are_those_of_scikit_learn(data):
    x, y = data
    ours = Surrogate(x, y)
    kernel = (ConstantKernel() * Matern([1.0] * 3, nu=2.5) + WhiteKernel()).clone_with_theta(ours.theta)
    theirs = GaussianProcessRegressor(kernel, alpha=JITTER, normalize_y=True, optimizer=None).fit(x, y)
    points = np.random.default_rng(1).random((50, 3))
    mean, deviation = theirs.predict(points, return_std=True)
    our_mean, our_deviation = ours.predict(points)
    assert our_mean == pytest.approx(mean, abs=1e-9)
    noise = theirs.kernel_.k2.noise_level * y.std() ** 2
    assert our_deviation**2 + noise == pytest.approx(deviation**2, abs=1e-9)


def test_fitting_finds_the_axis_that_does_not_matter(data):
    lengths = np.exp(Surrogate(*data).theta[1:4])
    assert lengths[2] > 5.0 > lengths[0]


@pytest.mark.parametrize("count", [2, 5, 40])
@pytest.mark.parametrize("names", [0, 3])
def test_conditioning_on_the_own_mean_changes_it_nowhere_and_makes_nothing_less_sure(data, count, names):
    """Where the last axis is one of three names too."""
    x, y = data
    before = Surrogate(x[:count], y[:count], categories=(0, 0, names))
    point = np.array([0.5, 0.5, 0.5])
    after = before.condition_on(point)
    points = np.random.default_rng(3).random((200, 3))
    (mean, deviation), (same, surer) = before.predict(points), after.predict(points)
    assert same == pytest.approx(mean, abs=1e-9)
    assert (surer <= deviation * (1.0 + 1e-9)).all()
    assert after.predict(point[None])[1] < 0.3 * before.predict(point[None])[1]


def test_an_axis_of_names_becomes_one_for_each_name():
    """A number, three names, a number: two different names are 1 apart, and the nearest name is meant."""
    points = np.array([[0.25, 0.0, 0.75], [0.25, 0.5, 0.75], [0.5, 0.9, 1.0]])
    root = np.sqrt(0.5)
    assert one_hot(points, (0, 3, 0)) == pytest.approx(np.array([
        [0.25, root, 0.0, 0.0, 0.75], [0.25, 0.0, root, 0.0, 0.75], [0.5, 0.0, 0.0, root, 1.0],
    ]))  # fmt: skip


def test_values_scatter_about_the_function_by_the_root_of_their_noise(data):
    """In units of the values' deviation, or of those that are given; far from all points nothing is known."""
    x, y = data
    theta = [0.0, *[np.log(0.2)] * 3, np.log(0.01)]
    plain, given = Surrogate(x, y, theta, fit=False), Surrogate(x, y, theta, fit=False, units=(0.5, 4.0))
    assert plain.theta == given.theta == pytest.approx(theta)
    assert plain.scatter == pytest.approx(0.1 * y.std())
    assert given.scatter == pytest.approx(0.1 * 4.0)
    far = np.full((1, 3), 99.0)
    for one, centre, spread in ((plain, y.mean(), y.std()), (given, 0.5, 4.0)):
        mean, deviation = one.predict(far)
        assert (mean[0], deviation[0]) == pytest.approx((centre, spread))


@pytest.mark.parametrize("value", [2.5, 0.1])
def test_values_that_are_all_equal_are_expected_everywhere(data, value):
    """What rounding leaves between them, as of 39 times 0.1, is no scale: others may be anything."""
    x, values = data[0][:39], np.full(39, value)
    assert (values.std() > 0.0) == (value == 0.1)
    theta = [0.0, *[np.log(0.2)] * 3, np.log(0.01)]
    for known in (Surrogate(x, values), Surrogate(x, values, theta, fit=False)):
        mean, deviation = known.predict(np.random.default_rng(1).random((9, 3)))
        assert mean == pytest.approx(np.full(9, value))
        assert np.isfinite(deviation).all()
    assert known.predict(np.full((1, 3), 99.0))[1] == pytest.approx(1.0)


def test_a_fit_finds_by_how_much_values_scatter(data):
    """Measurements that are off by a sixth of the function's deviation: a share of 1/37 of their variance."""
    x, y = data
    noise = y.std() / 6.0
    seen = y + noise * np.random.default_rng(4).choice([-1.0, 1.0], len(y))
    assert Surrogate(x, seen).scatter == pytest.approx(noise, rel=0.4)
