"""A Gaussian process over the unit cube, of numbers and of names."""

import math
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Self

import numpy as np
from scipy.linalg import cho_solve, cholesky
from scipy.linalg.lapack import dtrtrs
from scipy.optimize import minimize
from scipy.spatial.distance import pdist, squareform

from jumpcad.transforms import Array

JITTER = 1e-8
"""Added to the variance of every measurement, besides its noise, in units of that of the values."""
ALL_EQUAL = 10.0 * float(np.finfo(float).eps)
"""Standard deviation of values below which they are equal."""
_FIT_STEPS = 30


class ProcessAxes:
    """Axes of the process for axes of the unit cube: an axis of names becomes one per name, with 0 or 1/√2 (one-hot).

    The distance between two different names is then 1 (Hamming distance), with one length scale for all of them.

    Parameters
    ----------
    categories
        Number of names of each axis of the cube; 0 for an axis of numbers.
    """

    def __init__(self, categories: Sequence[int]) -> None:
        self._categories = categories
        self.origin = np.repeat(np.arange(len(categories)), [max(count, 1) for count in categories])
        """Index of the axis of the cube for each axis of the process (k,)."""

    def expand(self, points: Array) -> Array:
        """Return points (m, d) of the cube in the axes of the process (m, k)."""
        if not any(self._categories):
            return points
        columns = []
        for column, count in zip(points.T, self._categories, strict=True):
            if count:
                chosen = np.round(column * max(count - 1, 1))
                columns += [(chosen == number) * np.sqrt(0.5) for number in range(count)]
            else:
                columns.append(column)
        return np.column_stack(columns)

    def unfold(self, theta: Array) -> Array:
        """Return hyperparameters (d + 2,) with the length scale of an axis of names repeated for each name (k + 2,)."""
        return np.concatenate([theta[:1], theta[1:-1][self.origin], theta[-1:]])

    def fold(self, slopes: Array) -> Array:
        """Return derivatives (k + 2,) with respect to the process's hyperparameters for those of the cube (d + 2,)."""
        return np.concatenate([slopes[:1], np.bincount(self.origin, slopes[1:-1]), slopes[-1:]])

    def folded(self, theta: Array) -> Array:
        """Return the hyperparameters (d + 2,) that `unfold` repeated."""
        first = np.searchsorted(self.origin, np.arange(len(self._categories)))
        return np.concatenate([theta[:1], theta[1:-1][first], theta[-1:]])


class Surrogate:
    """A Gaussian process over the unit cube: constant times Matérn 5/2 with one length scale per axis, plus noise.

    Parameters
    ----------
    x, y
        Points (n, d) and values (n,).
    theta
        Logarithms of the hyperparameters, (d + 2,).
    fit
        Whether to improve them by maximum likelihood, as without `theta` too.
    categories
        Number of names of each axis; 0 for an axis of numbers. Empty: all are numbers.
    units
        What counts as 0 and as 1 of the values; their mean and standard deviation if None.
    """

    def __init__(
        self,
        x: Array,
        y: Array,
        theta: Sequence[float] | None = None,
        fit: bool = True,
        categories: Sequence[int] = (),
        units: tuple[float, float] | None = None,
    ) -> None:
        self.categories = tuple(categories) or (0,) * x.shape[1]
        self._axes = ProcessAxes(self.categories)
        seen = self._axes.expand(x)
        spread = float(np.std(y))
        self._centre, self._spread = units or (float(np.mean(y)), spread if spread > ALL_EQUAL else 1.0)
        values = (y - self._centre) / self._spread
        start = None if theta is None else self._axes.unfold(np.array(theta))
        logarithms = _likeliest(seen, values, start, self._axes) if fit or start is None else start
        self.x, self.y, self._seen = x, y, seen
        self.theta: list[float] = self._axes.folded(logarithms).tolist()
        self._variance, *lengths, noise = np.exp(logarithms).tolist()
        self.scatter = self._spread * math.sqrt(noise)
        """Standard deviation of a value about the function."""
        self._lengths = np.array(lengths)
        self._middle = seen.mean(axis=0)
        self._scaled = np.ascontiguousarray(((seen - self._middle) / self._lengths).T)
        self._squares = np.einsum("ij,ij->j", self._scaled, self._scaled)
        covariance = self._variance * squareform(_matern(math.sqrt(5.0) * pdist(seen / self._lengths)))
        np.fill_diagonal(covariance, self._variance + noise + JITTER)
        self._chol = cholesky(covariance, lower=True, check_finite=False)
        self._alpha = cho_solve((self._chol, True), values, check_finite=False)

    def predict(self, points: Array) -> tuple[Array, Array]:
        """Return mean (m,) and standard deviation (m,) of the noise-free function at points (m, d)."""
        covariance = self._covariance(points)
        half, _ = dtrtrs(self._chol, covariance.T, lower=True)
        variance = np.maximum(self._variance - np.einsum("ij,ij->j", half, half), 1e-12)
        return self._centre + self._spread * (covariance @ self._alpha), self._spread * np.sqrt(variance)

    def slope(self, points: Array) -> Array:
        """Return the gradient (m, d) of the mean at points (m, d); 0 along axes of names."""
        points = self._axes.expand(points)
        distance = self._distance(points)
        weights = (1.0 + distance) * np.exp(-distance) * self._alpha
        pull = weights @ self._seen - weights.sum(axis=1, keepdims=True) * points
        slope = self._spread * self._variance * (5.0 / 3.0) * pull / self._lengths**2
        first = np.searchsorted(self._axes.origin, np.arange(len(self.categories)))
        along: Array = np.where(self.categories, 0.0, slope[:, first])
        return along

    def condition_on(self, point: Array) -> Self:
        """Return the process with its own mean at a point (d,) added as a measurement (kriging believer).

        In the same units: its mean stays the same everywhere.
        """
        mean, _ = self.predict(point[None])
        x, y, units = np.vstack([self.x, point]), np.append(self.y, mean), (self._centre, self._spread)
        return type(self)(x, y, self.theta, False, self.categories, units)

    def _covariance(self, points: Array) -> Array:
        """Return the covariance (m, n) of points with the data."""
        covariance: Array = self._variance * _matern(self._distance(self._axes.expand(points)))
        return covariance

    def _distance(self, points: Array) -> Array:
        """Return the distances (m, n) of points (m, k) from the data: √5·r, in length scales of the kernel.

        By |a − b|² = |a|² − 2·a·b + |b|², with the middle of the data as origin: one product of matrices. What rounding
        leaves of a distance, 1e-6, is far below a length scale.
        """
        scaled = (points - self._middle) / self._lengths
        squares = scaled @ self._scaled
        squares *= -2.0
        squares += np.einsum("ij,ij->i", scaled, scaled)[:, None] + self._squares
        distance: Array = np.sqrt(5.0 * np.maximum(squares, 0.0))
        return distance


def _matern(distance: Array) -> Array:
    """Return the correlation at a distance √5·r (Rasmussen and Williams 2006, eq. 4.17)."""
    correlation: Array = (1.0 + distance + distance**2 / 3.0) * np.exp(-distance)
    return correlation


def _likeliest(x: Array, y: Array, start: Array | None, axes: ProcessAxes) -> Array:
    """Return the logarithms of the hyperparameters (k + 2,) with the largest likelihood near a start.

    Few steps are made; the next fit starts where this one ends.
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor

    regressor = GaussianProcessRegressor(
        _kernel(x.shape[1], start), alpha=JITTER, optimizer=partial(_improve, axes=axes)
    )
    with warnings.catch_warnings():
        # a length scale at its upper bound: the axis has no effect
        warnings.simplefilter("ignore", ConvergenceWarning)
        regressor.fit(x, y)
    theta: Array = regressor.kernel_.theta
    return theta


def _kernel(dimension: int, theta: Array | None) -> Any:
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    kernel = ConstantKernel(1.0, (1e-2, 1e3)) * Matern([0.5] * dimension, (0.05, 10.0), nu=2.5) + WhiteKernel(
        1e-4, (1e-6, 1e-1)
    )
    return kernel if theta is None else kernel.clone_with_theta(theta)


def _improve(objective: Callable[..., Any], start: Array, bounds: Array, axes: ProcessAxes) -> tuple[Array, float]:
    """Maximise the likelihood with few steps; the next fit starts where this one ends."""

    def of_axes(theta: Array) -> tuple[float, Array]:
        value, slopes = objective(axes.unfold(theta))
        return value, axes.fold(slopes)

    limits = np.column_stack([axes.folded(side) for side in np.asarray(bounds).T])
    found = minimize(
        of_axes, axes.folded(start), method="L-BFGS-B", jac=True, bounds=list(map(tuple, limits)),
        options={"maxiter": _FIT_STEPS},
    )  # fmt: skip
    return axes.unfold(found.x), found.fun
