"""The first designs of a search: half are the best of many by a quick model, the others are evenly spread.

Of evenly spread designs of the printed robot, three quarters are rejected. The capsule robot is simulated in
milliseconds, and designs with which it jumps far are probably good. The other half covers errors of the quick model.
"""

import math

import numpy as np

from jumpcad.search.evaluator import Evaluator
from jumpcad.spread import sobol
from jumpcad.transforms import Array

SCREENED = 512
"""Designs that the quick model ranks (about a second)."""
APART = 0.1
"""Least difference between two of its best designs along some axis of the unit cube."""


def first_points(evaluator: Evaluator, count: int, generator: np.random.Generator) -> Array:
    """Return `count` points (count, dimension) of the unit cube to start with, evenly spread ones first."""
    spread = evaluator.space.spread(count, generator)
    quick = getattr(evaluator.model, "quick_score", None)
    if quick is None or count < 2:
        return spread
    points = evaluator.space.snap(sobol(evaluator.space.dimension, SCREENED, generator))
    scores = np.array([quick(evaluator.space.to_design(point), evaluator.objective) for point in points])
    chosen: list[Array] = []
    for index in np.argsort(-scores, kind="stable"):
        if len(chosen) == count // 2 or not math.isfinite(scores[index]):
            break
        if all(np.abs(points[index] - other).max() >= APART for other in chosen):
            chosen.append(points[index])
    return np.vstack([spread[: count - len(chosen)], *[point[None] for point in chosen]])
