"""What is believed of a quantity before it is measured, as a function of a standard normal."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import ndtr, ndtri

from jumpcad.transforms import Array

Shape = Literal["normal", "lognormal", "uniform", "half-normal"]
EDGE = 1e-12
"""Least probability that is turned back into a standard normal."""


@dataclass(frozen=True)
class Prior:
    """A prior: `normal` (mean, deviation), `lognormal` (median, deviation of the logarithm), `uniform` (least, most).

    `half-normal` is (0, scale): the absolute value of a normal. A normal one of a positive quantity ends at `least`.
    """

    shape: Shape
    first: float
    second: float
    source: str
    least: float = -math.inf

    def at(self, z: Array) -> Array:
        """Return the values at standard normals (...)."""
        if self.shape == "normal":
            return np.maximum(self.first + self.second * z, self.least)
        if self.shape == "lognormal":
            return self.first * np.exp(self.second * z)
        share = np.asarray(ndtr(z))
        if self.shape == "uniform":
            return self.first + (self.second - self.first) * share
        return self.second * np.asarray(ndtri(np.clip(0.5 * (1.0 + share), 0.5, 1.0 - EDGE)))

    def quantiles(self, shares: tuple[float, ...]) -> tuple[float, ...]:
        """Return quantiles."""
        return tuple(float(value) for value in self.at(ndtri(np.array(shares))))


SPRING_EFFICIENCY = Prior("normal", 0.95, 0.05, "judgement: coils rub on their mandrel and on each other", 0.3)
PIN_FRICTION = Prior("lognormal", 0.25, 0.4, "judgement: dry plastic on steel")
