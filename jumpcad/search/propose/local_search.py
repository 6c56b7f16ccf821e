"""The neighbours of the best design, evaluated when proposals gain nothing, and how a search knows that.

The score of a printed robot has steps of a per cent, where a section grows or a part takes another place. The processes
smooth over them, and promise nothing where a ridge of steps goes on. Points a step away along each axis (compass
search: Kolda, Lewis and Torczon, SIAM Review 2003) and some aslant are estimated, and the best of them are evaluated;
near and far ones where a proposal promises nothing.
"""

import itertools
from collections.abc import Sequence

import numpy as np

from jumpcad.search.propose.acquisition import DIGITS
from jumpcad.search.space import Space
from jumpcad.search.study.trial import Trial
from jumpcad.transforms import Array

STEP = 0.02
"""Distance of a neighbour, in the unit cube; judgement: 0.8 % of a link's length, 1.4° of the toes' angle."""
DRAWN, DRAWN_STEP = 8, 0.04
"""Points that are drawn besides, and how far away each coordinate typically is; judgement: ridges run aslant."""
WITHIN = 0.005
"""Of a neighbour's estimate: how much less than the best's it may be; judgement: about what it is wrong by."""
HOPELESS, FARTHEST = 1e-8, 6.25
"""Of the best score: what a proposal promises that promises nothing. Neighbours are then up to so many times as far
away, an eighth of the unit cube along an axis; judgement."""
STALLED = 4
"""Steps in a row without a gain after which neighbours are evaluated; judgement."""


def idle_steps(trials: Sequence[Trial], best: float, least_gain: float) -> int:
    """Return how many steps of `bo` in a row, up to the last, gained less than a share of the best score before them.

    `best` is that before the first of the trials; while no score is above 0, no step counts.
    """
    idle = 0
    for (phase, _), step in itertools.groupby(trials, key=lambda trial: (trial.phase, trial.step)):
        together = list(step)
        found = max(trial.score or 0.0 for trial in together)
        if phase == "bo" and "theta" in together[0].proposal:
            idle = 0 if best <= 0.0 or found / best - 1.0 > least_gain else idle + 1
        best = max(best, found)
    return idle


def neighbours(space: Space, best: Trial, generator: np.random.Generator, wider: float = 1.0) -> list[Array]:
    """Return points (d,) near a trial that differ along the axes of numbers on whose bounds it does not lie.

    A step away along each of them, both ways, and `DRAWN` points that are drawn at such a distance; all of them so many
    times `wider`.
    """
    centre = space.to_unit(best.variant)
    inside = (centre > 0.5 * STEP) & (centre < 1.0 - 0.5 * STEP) & (np.array(space.categories) == 0)
    ways = wider * STEP * np.eye(space.dimension)[inside]
    drawn = wider * DRAWN_STEP * inside * generator.standard_normal((DRAWN, space.dimension))
    return list(space.snap(np.clip(centre + np.vstack([ways, -ways, drawn]), 0.0, 1.0).round(DIGITS)))
