"""What is believed of a quantity before it is measured, as a function of a standard normal; evenly spread points."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import ndtr, ndtri

from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings, coefficients
from jumpcad.transforms import Array

Shape = Literal["normal", "lognormal", "uniform", "half-normal"]
QUANTILES = (0.1, 0.5, 0.9)
"""Probabilities of the quantiles that are reported."""
EDGE = 1e-12
"""Least probability in the upper tail of a half-normal, so that its quantile is finite."""


@dataclass(frozen=True)
class Prior:
    """A prior: `first` and `second` are the parameters of its distribution.

    They are mean and standard deviation (`normal`), median and standard deviation of the logarithm (`lognormal`), least
    and largest value (`uniform`), or 0 and scale (`half-normal`, the absolute value of a normal). A `normal` is cut off
    at `least`. `source` says where they come from.
    """

    shape: Shape
    first: float
    second: float
    source: str
    least: float = -math.inf

    def at(self, z: Array) -> Array:
        """Return the values (...) at standard normals (...)."""
        if self.shape == "normal":
            return np.maximum(self.first + self.second * z, self.least)
        if self.shape == "lognormal":
            return self.first * np.exp(self.second * z)
        share = np.asarray(ndtr(z))
        if self.shape == "uniform":
            return self.first + (self.second - self.first) * share
        return self.second * np.asarray(ndtri(np.clip(0.5 * (1.0 + share), 0.5, 1.0 - EDGE)))

    def quantiles(self, shares: tuple[float, ...]) -> tuple[float, ...]:
        """Return the quantiles at probabilities."""
        return tuple(float(value) for value in self.at(ndtri(np.array(shares))))


SPRING_EFFICIENCY = Prior("normal", 0.95, 0.05, "judgement: coils rub on their mandrel and on each other", 0.3)
PIN_FRICTION = Prior("lognormal", 0.25, 0.4, "judgement: dry plastic on steel")
PRINTED_MASS_SHARE = 0.04
"""Relative deviation of a printed robot's mass from the model's: that of parts from PrusaSlicer's mass."""
FLOOR_SHARE = 0.15
"""Standard deviation of the logarithm of an untested floor's friction; judgement: rubber slides at 0.6 to 1.0."""


def floors(mechanism: Mechanism, settings: Settings) -> tuple[Settings, ...]:
    """Return the settings on the slipperiest and the roughest floor that a robot may meet, by two deviations.

    None where the settings say what the floor is.
    """
    if settings.ground_friction is not None:
        return ()
    usual = coefficients(mechanism, settings).ground
    frictions = (usual * math.exp(sign * 2.0 * FLOOR_SHARE) for sign in (-1.0, 1.0))
    return tuple(settings.model_copy(update={"ground_friction": friction}) for friction in frictions)


def sobol(dimension: int, count: int, generator: np.random.Generator) -> Array:
    """Return evenly spread points (count, dimension) of the unit cube; `count` is a power of two.

    They are the first of Sobol's sequence, which the generator scrambles (Owen 1998), by scipy.
    """
    from scipy.stats import qmc  # takes half a second to import; most processes of a search need no points

    return np.asarray(qmc.Sobol(dimension, seed=generator).random(count))
