"""A Gaussian process over the unit cube, of numbers and of names."""

import math
import warnings
from collections.abc import Callable, Sequence
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


def one_hot(points: Array, categories: Sequence[int]) -> Array:
    """Return points (m, d) of the cube in the axes of the process (m, k): one for every name, with 0 or 1/√2.

    Two different names are then 1 apart for length scales of 1 (Hamming distance). `categories` has the number of names
    of each axis of the cube; 0 for an axis of numbers.
    """
    if not any(categories):
        return points
    columns = []
    for column, count in zip(points.T, categories, strict=True):
        chosen = np.round(column * max(count - 1, 1))
        columns += [(chosen == number) * np.sqrt(0.5) for number in range(count)] or [column]
    return np.column_stack(columns)


class Surrogate:
    """A Gaussian process over the unit cube: constant times Matérn 5/2 with one length scale per axis, plus noise.

    Of points x (n, d) and values y (n,). `theta` are logarithms of the hyperparameters, (k + 2,): variance, a length
    scale for each axis of `one_hot`, noise; they are improved by maximum likelihood if `fit`, or without any. For
    `categories` see `one_hot`; empty: all are numbers. `units` are what counts as 0 and 1; None: mean and deviation.
    """

    def __init__(
        self, x: Array, y: Array, theta: Sequence[float] | None = None, fit: bool = True,
        categories: Sequence[int] = (), units: tuple[float, float] | None = None,
    ) -> None:  # fmt: skip
        self.categories = tuple(categories) or (0,) * x.shape[1]
        seen = one_hot(x, self.categories)
        spread = float(np.std(y))
        self._centre, self._spread = units or (float(np.mean(y)), spread if spread > ALL_EQUAL else 1.0)
        values = (y - self._centre) / self._spread
        self.theta = _likeliest(seen, values, theta) if fit or theta is None else list(theta)
        self.x, self.y, self._seen = x, y, seen
        self._variance, *lengths, noise = np.exp(self.theta).tolist()
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
        covariance = self._variance * _matern(self._distance(one_hot(points, self.categories)))
        half, _ = dtrtrs(self._chol, covariance.T, lower=True)
        variance = np.maximum(self._variance - np.einsum("ij,ij->j", half, half), 1e-12)
        return self._centre + self._spread * (covariance @ self._alpha), self._spread * np.sqrt(variance)

    def condition_on(self, point: Array) -> Self:
        """Return the process with its own mean at a point (d,) added as a measurement (kriging believer).

        In the same units: its mean stays the same everywhere.
        """
        mean, _ = self.predict(point[None])
        x, y, units = np.vstack([self.x, point]), np.append(self.y, mean), (self._centre, self._spread)
        return type(self)(x, y, self.theta, False, self.categories, units)

    def _distance(self, points: Array) -> Array:
        """Return the distances (m, n) of points (m, k) from the data: √5·r, in length scales of the kernel.

        By |a − b|² = |a|² − 2·a·b + |b|², with the middle of the data as origin: one product of matrices. What rounding
        leaves of a distance, 1e-6, is far below a length scale.
        """
        scaled = (points - self._middle) / self._lengths
        squares = scaled @ self._scaled
        squares *= -2.0
        squares += np.einsum("ij,ij->i", scaled, scaled)[:, None] + self._squares
        return np.asarray(np.sqrt(5.0 * np.maximum(squares, 0.0)))


def _matern(distance: Array) -> Array:
    """Return the correlation at a distance √5·r (Rasmussen and Williams 2006, eq. 4.17)."""
    return np.asarray((1.0 + distance + distance**2 / 3.0) * np.exp(-distance))


def _likeliest(x: Array, y: Array, start: Sequence[float] | None) -> list[float]:
    """Return the logarithms of the hyperparameters (k + 2,) with the largest likelihood near a start.

    Few steps are made; the next fit starts where this one ends.
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    smooth = ConstantKernel(1.0, (1e-2, 1e3)) * Matern([0.5] * x.shape[1], (0.05, 10.0), nu=2.5)
    kernel = smooth + WhiteKernel(1e-4, (1e-6, 1e-1))
    begun = kernel if start is None else kernel.clone_with_theta(np.array(start))

    def improve(objective: Callable[..., Any], at: Array, bounds: Array) -> tuple[Array, float]:
        limits = list(map(tuple, bounds))
        found = minimize(objective, at, method="L-BFGS-B", jac=True, bounds=limits, options={"maxiter": _FIT_STEPS})
        return found.x, found.fun

    regressor = GaussianProcessRegressor(begun, alpha=JITTER, optimizer=improve)
    with warnings.catch_warnings():
        # a length scale at its upper bound: the axis has no effect
        warnings.simplefilter("ignore", ConvergenceWarning)
        regressor.fit(x, y)
    return list(map(float, regressor.kernel_.theta))
