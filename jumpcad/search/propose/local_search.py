"""The neighbours of the best design, evaluated when proposals gain nothing, and how a search knows that.

The score of a printed robot has steps of a per cent, where a section grows or a part takes another place. The processes
smooth over them, and promise nothing where a ridge of steps goes on. Points a step away along each axis (compass
search: Kolda, Lewis and Torczon, SIAM Review 2003) and some aslant are estimated, and the best of them are evaluated;
near and far ones where a proposal promises nothing.
"""

import itertools
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from jumpcad.search.propose.acquisition import DIGITS, promised_gain
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


class Progress(NamedTuple):
    """How many steps of `bo` in a row gained too little, and how many of these in a row promised too little too."""

    idle: int
    low: int

    @classmethod
    def of(cls, trials: Sequence[Trial], best: float, least_gain: float) -> "Progress":
        """Return the progress of trials after a best score; `least_gain` is a share of the best."""
        idle = low = 0
        for promised, found in gains(trials, best):
            if found > least_gain:
                idle = low = 0
            else:
                idle, low = idle + 1, low + 1 if promised < least_gain else 0
        return cls(idle, low)


def gains(trials: Sequence[Trial], best: float = 0.0) -> Iterator[tuple[float, float]]:
    """Yield what each step of `bo` promised to gain, and what it gained, as shares of the best score before it.

    Of several proposals it is the most that one promised. Both are infinite while no score is above 0. `best` is the
    best score before the first of the trials.
    """
    for (phase, _), step in itertools.groupby(trials, key=lambda trial: (trial.phase, trial.step)):
        together = list(step)
        found = max(trial.score or 0.0 for trial in together)
        notes = [trial.proposal for trial in together if phase == "bo" and "theta" in trial.proposal]
        logarithms = [float(note["log_improvement"]) + float(note["log_feasible"]) for note in notes]
        if logarithms:
            yield promised_gain(max(logarithms), best), found / best - 1.0 if best > 0.0 else np.inf
        best = max(best, found)


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
