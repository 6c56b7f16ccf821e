"""What is made of a design instead of it: neighbours within the tolerances of printing and of the other parameters."""

import numpy as np
from scipy.stats import qmc

from jumpcad.design import PARAMETERS, Design
from jumpcad.mechanism.variants import design_within_limits, with_length_errors
from jumpcad.transforms import Array

SAMPLES = 16
"""Neighbours of each kind."""
PERCENT = 1.0
PERCENTILE = 10


def varied_parameters(design: Design, generator: np.random.Generator) -> list[Design]:
    """Return designs with every parameter varied evenly within ±1 %, and within a design's limits."""
    factors = 1.0 + PERCENT / 100.0 * _even(len(PARAMETERS), generator)
    return [design_within_limits(np.array(design.to_vector()) * factor) for factor in factors]


def varied_lengths(design: Design, tolerance_mm: float, generator: np.random.Generator) -> list[Design]:
    """Return designs whose links l2…l5 each vary evenly within a tolerance (mm)."""
    return [with_length_errors(design, error) for error in tolerance_mm * _even(4, generator)]


def tenth(scores: list[float]) -> float:
    """Return the score that nine of ten reach: the 10th percentile, the lowest of ten or fewer."""
    return float(np.percentile(scores, PERCENTILE, method="lower"))


def _even(dimension: int, generator: np.random.Generator) -> Array:
    """Return evenly spread points (SAMPLES, dimension) of the cube from -1 to 1."""
    points: Array = qmc.Sobol(dimension, seed=generator).random(SAMPLES)
    return 2.0 * points - 1.0
