"""A Gaussian process over the unit cube, of numbers and of names."""

import math
from collections.abc import Sequence
from typing import Self

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
_VARIANCE, _LENGTH, _NOISE = (1e-2, 1e3), (0.05, 10.0), (1e-6, 1e-1)
"""Least and greatest hyperparameters; a length scale at its greatest: the axis has no effect."""
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

    Parameters
    ----------
    x, y
        Points (n, d) and values (n,).
    theta
        Logarithms of the hyperparameters, (k + 2,): variance, a length scale for each axis of `one_hot`, noise.
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
        covariance = self._covariance(points)
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

    def _covariance(self, points: Array) -> Array:
        """Return the covariance (m, n) of points with the data."""
        covariance: Array = self._variance * _matern(self._distance(one_hot(points, self.categories)))
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


def _likeliest(x: Array, y: Array, start: Sequence[float] | None) -> list[float]:
    """Return the logarithms of the hyperparameters (k + 2,) with the largest likelihood near a start.

    Few steps are made; the next fit starts where this one ends.
    """
    lengths = x.shape[1]
    first = [0.0, *[math.log(0.5)] * lengths, math.log(1e-4)] if start is None else start
    bounds = np.log([_VARIANCE, *[_LENGTH] * lengths, _NOISE])
    found = minimize(
        lambda theta: _unlikeliness(theta, x, y), first, method="L-BFGS-B", jac=True, bounds=bounds,
        options={"maxiter": _FIT_STEPS},
    )  # fmt: skip
    theta: list[float] = found.x.tolist()
    return theta


def _unlikeliness(theta: Array, x: Array, y: Array) -> tuple[float, Array]:
    """Return minus the logarithm of the likelihood of values (n,) at points (n, k), and its slopes (k + 2,).

    Rasmussen and Williams 2006, eq. 5.8 and 5.9; sums over pairs of points are products of matrices.
    """
    variance, *lengths, noise = np.exp(theta).tolist()
    scaled = x / np.array(lengths)
    distance = math.sqrt(5.0) * squareform(pdist(scaled))
    smooth = variance * _matern(distance)
    factor = cholesky(smooth + (noise + JITTER) * np.eye(len(x)), lower=True, check_finite=False)
    alpha = cho_solve((factor, True), y, check_finite=False)
    weights = np.outer(alpha, alpha) - cho_solve((factor, True), np.eye(len(x)), check_finite=False)
    pairs = 5.0 / 3.0 * variance * weights * (1.0 + distance) * np.exp(-distance)
    of_lengths = pairs.sum(axis=1) @ scaled**2 - ((pairs @ scaled) * scaled).sum(axis=0)
    slopes = [0.5 * (weights * smooth).sum(), *of_lengths, 0.5 * noise * np.trace(weights)]
    value = 0.5 * y @ alpha + np.log(factor.diagonal()).sum() + 0.5 * len(x) * math.log(2.0 * math.pi)
    return float(value), -np.array(slopes)
