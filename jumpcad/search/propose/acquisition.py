"""Where to evaluate next: the maximum of expected improvement times probability of feasibility over a space."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.space import Space, apart
from jumpcad.search.study.variant import Variant
from jumpcad.transforms import Array

CANDIDATES = 512
"""Points spread over the space."""
LOCAL = 64
"""Points near each of the best designs."""
STARTS, RANKED, APART = 6, 256, math.nextafter(0.05, 1.0)
"""Points from which the acquisition is maximised locally, among the best, and their least distance along some axis."""
REDRAWN = 0.3
"""Probability with which a name is drawn again near a good design."""
DIGITS = 4
"""Of the coordinates of a proposal."""
HELD_BONUS = 0.2
"""What another candidate must promise more, in logarithms, than one that held in a dry run; judgement."""
_STEP = 1e-6
"""Of the numerical gradient."""
_FIRST_STEPS, _STEPS = 16, 40
"""Most iterations of all local maximisations together, and of the best one when it goes on alone."""


@dataclass(frozen=True)
class Proposal:
    """A variant to evaluate, its point (d,), and the logarithms of its expected improvement and P(feasible)."""

    variant: Variant
    unit: Array
    log_improvement: float
    log_feasible: float

    @property
    def log_value(self) -> float:
        return self.log_improvement + self.log_feasible

    def promised_gain(self, best: float) -> float:
        """Return what it promises to gain, as a share of the best score; infinite where no score is above 0.

        To first order: the process predicts the square root of the score, so a share of it is worth twice as much.
        """
        return 2.0 * math.exp(min(self.log_value, 100.0)) / math.sqrt(best) if best > 0.0 else math.inf


def propose(
    space: Space, posterior: SearchPosterior, best: float, elite: Array, admits: Callable[[Variant], bool],
    generator: np.random.Generator, penalty: Callable[[Array], Array] | None = None, held: Sequence[Array] = (),
) -> Proposal | None:  # fmt: skip
    """Return the variant with the largest acquisition found, or None if no candidate is admitted.

    `best` is the score to be improved; near the points (k, d) of the `elite` more candidates are drawn. The `penalty`
    of points (m, d) is subtracted from the logarithm. Points (d,) that `held` are candidates, worth `HELD_BONUS` more.
    """

    def log_acquisition(points: Array) -> Array:
        value = posterior.log_improvement(points, best) + posterior.log_feasible(points)
        return value if penalty is None else value - penalty(points)

    candidates = [space.spread(CANDIDATES, generator)]
    for point in elite:
        scale = 10.0 ** generator.uniform(-3, -0.7, (LOCAL, 1))
        near = point + scale * space.scale * generator.standard_normal((LOCAL, space.dimension))
        for axis in np.flatnonzero(space.categories):
            near[:, axis] = np.where(generator.random(LOCAL) < REDRAWN, generator.random(LOCAL), point[axis])
        candidates.append(space.snap(near))
    points = space.snap(np.vstack(candidates).round(DIGITS))
    values = log_acquisition(points)
    order = np.argsort(-values, kind="stable")
    starts = points[order[apart(points[order[:RANKED]], APART, STARTS)]]
    climbed = _climb(space, log_acquisition, starts, _FIRST_STEPS)
    highest = climbed[[log_acquisition(climbed).argmax()]]
    tops = space.snap(np.vstack([_climb(space, log_acquisition, highest, _STEPS), climbed]).round(DIGITS))
    points, values = np.vstack([tops, points[order]]), np.concatenate([log_acquisition(tops), values[order]])
    if held:
        points = np.vstack([*held, points])
        values = np.concatenate([log_acquisition(np.array(held)) + HELD_BONUS, values])
    for index in np.argsort(-values, kind="stable"):
        variant = space.to_variant(points[index])
        if admits(variant):
            at = points[index][None]
            improvement, feasible = posterior.log_improvement(at, best), posterior.log_feasible(at)
            return Proposal(variant, points[index], float(improvement[0]), float(feasible[0]))
    return None


def _climb(space: Space, function: Callable[[Array], Array], starts: Array, steps: int) -> Array:
    """Return points (m, d) nearer to local maxima than starts (m, d) in the unit cube; choices keep their values.

    The sum of the function over all of them is maximised: a prediction of many points takes hardly longer than of one.
    """
    moving = [index for index, parameter in enumerate(space.free) if not parameter.choices]
    if not moving:
        return starts
    count, axes = len(starts), np.arange(len(moving))

    def negative(coordinates: Array) -> tuple[float, Array]:
        # Values and forward differences (backward at the upper bound) in one prediction.
        at = coordinates.reshape(count, -1)
        signs = np.where(at > 0.5, -_STEP, _STEP)
        stack = np.repeat(starts[:, None], len(moving) + 1, axis=1)
        stack[:, :, moving] = at[:, None]
        stack[:, axes + 1, moving] += signs
        values = function(stack.reshape(-1, space.dimension)).reshape(count, -1)
        return -values[:, 0].sum(), ((values[:, :1] - values[:, 1:]) / signs).ravel()

    found = minimize(
        negative, starts[:, moving].ravel(), method="L-BFGS-B", jac=True, bounds=[(0.0, 1.0)] * (count * len(moving)),
        options={"maxiter": steps},
    )  # fmt: skip
    ends = starts.copy()
    ends[:, moving] = np.clip(found.x, 0.0, 1.0).reshape(count, -1)
    return ends
