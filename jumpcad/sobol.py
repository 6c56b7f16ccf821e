"""Evenly spread points of the unit cube: scrambled Sobol points (Owen 1998) by scipy."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from jumpcad.transforms import Array


def sobol(dimension: int, count: int, generator: "np.random.Generator") -> "Array":
    """Return the first points (count, dimension) of a sequence that a generator scrambles; `count` a power of two."""
    from scipy.stats import qmc  # takes half a second to import; most processes of a search need no points

    points: Array = qmc.Sobol(dimension, seed=generator).random(count)
    return points
