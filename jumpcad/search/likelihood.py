"""Hyperparameters of a Gaussian process by maximum likelihood, with the kernel of `Surrogate`."""

import math

import numpy as np
from scipy.linalg.lapack import dpotrf, dpotri, dpotrs
from scipy.spatial.distance import squareform

from jumpcad.transforms import Array

JITTER = 1e-8
"""Added to the variance of every measurement, besides its noise, in units of that of the values."""
VARIANCE, LENGTH, NOISE = (1e-2, 1e3), (0.05, 10.0), (1e-6, 1e-1)
"""Bounds of the hyperparameters: the variance, the length scale of an axis, the variance of the noise."""
START = (1.0, 0.5, 1e-4)
"""Where the first fit starts."""
_UNLIKELY = 1e10
"""Of a covariance that is not positive definite."""


class Likelihood:
    """The likelihood of measurements under a process, as a function of its hyperparameters.

    Parameters
    ----------
    x, y
        Points (n, k) and values (n,), in units of their spread.
    """

    def __init__(self, x: Array, y: Array) -> None:
        self._y = y
        self._rows, self._columns = np.triu_indices(len(y), 1)
        self._squares = ((x[self._rows] - x[self._columns]) ** 2).T

    def negative(self, theta: Array) -> tuple[float, Array]:
        """Return the negative logarithm of the likelihood, and its derivatives (k + 2,).

        `theta` are logarithms of variance, length scales and noise (Rasmussen and Williams 2006, eq. 2.30 and 5.9).
        """
        variance, *lengths, noise = np.exp(theta).tolist()
        inverse_squares = 1.0 / np.square(lengths)
        distance = np.sqrt(5.0 * (inverse_squares @ self._squares))
        decay = variance * np.exp(-distance)
        pairs = (1.0 + distance + distance**2 / 3.0) * decay
        covariance = squareform(pairs)
        np.fill_diagonal(covariance, variance + noise + JITTER)
        chol, failed = dpotrf(covariance, lower=1)
        if failed:
            return _UNLIKELY, np.zeros_like(theta)
        weights, _ = dpotrs(chol, self._y, lower=1)
        inverse, _ = dpotri(chol, lower=1)
        value = 0.5 * self._y @ weights + np.log(chol.diagonal()).sum() + 0.5 * len(self._y) * math.log(2.0 * math.pi)
        # half the trace of (inverse − weights·weightsᵀ)·dK: each pair stands for two elements
        off = inverse[self._columns, self._rows] - weights[self._rows] * weights[self._columns]
        on = float((inverse.diagonal() - weights**2).sum())
        slopes = self._squares @ (off * (1.0 + distance) * decay) * inverse_squares * (5.0 / 3.0)
        return float(value), np.array([off @ pairs + 0.5 * variance * on, *slopes, 0.5 * noise * on])
