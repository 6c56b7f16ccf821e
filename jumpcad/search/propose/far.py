"""Candidates from all of the space, bred on rough estimates: what processes that are fitted to few robots cannot know.

In the space of everything that can be built, a good region is a thousandth, and no evenly spread design lies in it.
Once some robots were built, masses are known roughly everywhere, and a jump in the plane tells what they are good for.
"""

from collections.abc import Callable

import numpy as np

from jumpcad.search.propose.acquisition import DIGITS
from jumpcad.search.space import Space
from jumpcad.search.study.variant import Variant
from jumpcad.transforms import Array

SPREAD, KEPT = 1024, 48
"""Points spread over the space, and how many of them are estimated: those that most probably keep all limits."""
BRED, PARENTS, GENERATIONS = 24, 8, 8
"""Points of a further generation, how many best ones they come from, and how often. Peaks in eight dimensions: these
240 estimates reach 0.86 of their height in the median, steps away from one parent each 0.06 to 0.48."""
BEYOND, NOISE = 0.25, (0.05, 0.02)
"""A child lies between its parents on each axis, or so much of their distance beyond (Eshelman and Schaffer, 1993,
BLX), and off by a normal noise, which ends smaller than it begins; judgement."""
BEST, APART = 6, 0.1
"""Points that are looked at closely, and the least difference between two of them along some axis."""
DOUBT = 0.5
"""Power of the probability to keep all limits: far from all that was built, it is too low; judgement."""


def far_points(
    space: Space,
    rough: Callable[[Variant], float],
    log_feasible: Callable[[Array], Array],
    generator: np.random.Generator,
) -> list[Array]:
    """Return the most promising points (d,), which are apart.

    Parameters
    ----------
    space
        The space.
    rough
        About what a variant scores, 0 of one that does not jump.
    log_feasible
        Logarithm of the probability (m,) that designs at points (m, d) keep all limits.
    generator
        Random generator of the points.
    """

    def worth(points: Array) -> Array:
        scores = np.array([rough(space.to_variant(point)) for point in points])
        return scores * np.exp(DOUBT * log_feasible(points))

    spread = space.spread(SPREAD, generator).round(DIGITS)
    points = space.snap(spread[np.argsort(-log_feasible(spread), kind="stable")[:KEPT]])
    values = worth(points)
    for noise in np.linspace(*NOISE, GENERATIONS):
        parents = points[np.argsort(-values, kind="stable")[:PARENTS]]
        first, second = parents[generator.integers(len(parents), size=(2, BRED))]
        children = first + generator.uniform(-BEYOND, 1.0 + BEYOND, first.shape) * (second - first)
        children = space.snap((children + noise * generator.standard_normal(first.shape)).round(DIGITS))
        points, values = np.vstack([points, children]), np.append(values, worth(children))
    chosen: list[Array] = []
    for index in np.argsort(-values, kind="stable"):
        point = points[index]
        if values[index] > 0.0 and all(np.abs(point - other).max() >= APART for other in chosen):
            chosen.append(point)
        if len(chosen) == BEST:
            break
    return chosen
