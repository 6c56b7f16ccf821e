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

SPREAD, KEPT = 1024, 64
"""Points spread over the space, and how many of them are estimated: those that most probably keep all limits."""
BRED, PARENTS = 48, 8
"""Points of a further generation, and how many best ones they come from; judgement."""
REACHES = (0.2, 0.1, 0.05)
"""How far from its parent a child is, in the unit cube, generation by generation; half of its coordinates differ."""
BEST, APART = 6, 0.1
"""Points that are looked at closely, and the least difference between two of them along some axis."""
DOUBT = 0.5
"""Power of the probability to keep all limits: far from all that was built, it is too low; judgement."""


def far_points(
    space: Space,
    rough: Callable[[Variant], float],
    log_feasible: Callable[[Array], Array],
    elite: Array,
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
    elite
        Points (k, d) of the best designs so far: parents too.
    generator
        Random generator of the points.
    """

    def worth(points: Array) -> Array:
        scores = np.array([rough(space.to_variant(point)) for point in points])
        return scores * np.exp(DOUBT * log_feasible(points))

    spread = space.spread(SPREAD, generator).round(DIGITS)
    points = np.vstack([elite, space.snap(spread[np.argsort(-log_feasible(spread), kind="stable")[:KEPT]])])
    values = worth(points)
    for reach in REACHES:
        parents = points[np.argsort(-values, kind="stable")[:PARENTS]]
        moved = reach * generator.standard_normal((BRED, space.dimension))
        moved *= generator.random(moved.shape) < 0.5
        children = space.snap((parents[generator.integers(len(parents), size=BRED)] + moved).round(DIGITS))
        points, values = np.vstack([points, children]), np.append(values, worth(children))
    chosen: list[Array] = []
    for index in np.argsort(-values, kind="stable"):
        point = points[index]
        if values[index] > 0.0 and all(np.abs(point - other).max() >= APART for other in [*chosen, *elite[:1]]):
            chosen.append(point)
        if len(chosen) == BEST:
            break
    return chosen
