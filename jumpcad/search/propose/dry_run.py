"""What a proposal is tried on before a robot is built: its estimate, which counts as no evaluation.

Near the best designs half of the proposals have no room for some part. What dry runs showed is learned like trials, and
the next proposal is better. All of it follows from the trials and from the points that are kept with them, so that a
resumed search goes on alike.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from jumpcad.findings import bare
from jumpcad.search.estimate.estimate import Estimator
from jumpcad.search.models import PrintedModel
from jumpcad.search.propose.initial_designs import ranked_points
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import SCREENED, Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

TRIED = "tried"
"""What the note of a trial calls the points of the dry runs of its step."""
FIRST = 32
"""Designs that are estimated first: the best by the quick robot."""
ESTIMATED, FAILED = 160, 160
"""Most estimates that are learned from besides those of trials, and most failures: the last ones. Estimates are made
anew with every fit, and the time of a step grows with both."""


class DryRun:
    """Tries variants of one search for a printed robot: others are simulated as quickly.

    What other phases or runs tried is not looked at.
    """

    def __init__(self, evaluator: Evaluator, phase: str, seed: int, run: int) -> None:
        assert isinstance(evaluator.model, PrintedModel)
        self._evaluator, self._phase, self._seed, self._run = evaluator, phase, seed, run
        self._space = evaluator.space
        self.estimator = Estimator(evaluator.space, evaluator.model, evaluator.objective)
        self._variants: dict[tuple[float, ...], Variant] = {}
        self._prior = {trial.key for trial in evaluator.prior}
        self._passed_over: list[Variant] = []
        self._failures: dict[Key, Trial | None] = {}  # until figures are fitted anew

    @cached_property
    def ranked(self) -> list[Array]:
        """Points (d,) with which the quick robot jumps, the best first."""
        return ranked_points(self._evaluator, np.random.default_rng([self._seed, 5]))

    def starts_with(self, variant: Variant) -> bool:
        """Whether a search may start with a variant. If its parts have no room, that is learned."""
        if not isinstance(self.estimator.layout(variant), Evaluation):
            return True
        self._passed_over.append(variant)
        return False

    def learn(self, trials: Sequence[Trial]) -> None:
        """Learn the robots that were built; what was tried for any of these trials is laid out once more."""
        tried = [*self._passed_over, *self.tried(trials, ())]
        self.look_at(tried)
        self.estimator.learn(trials)
        self._failures.clear()
        if self.estimator.ready:
            jumped = [trial.variant for trial in trials if self._evaluator.unrequired(trial) is not None]
            self.look_at([*map(self._variant, self.ranked[:FIRST]), *tried, *jumped])

    def look_at(self, variants: Iterable[Variant]) -> None:
        """Lay out and estimate, on all cores, what was not yet."""
        self.estimator.look_at(variants, self._evaluator.shared)

    def rough(self, points: Sequence[Array] | Array) -> Array:
        """Return about the scores (n,) of points (n, d), without their layouts; -inf of what would not do."""
        found = (self.estimator.rough(self._variant(point)) for point in points)
        return np.array([one.score if one and one.kept and one.score else -math.inf for one in found])

    def score(self, variant: Variant, required: bool = True) -> float | None:
        """Return the estimated score of a variant; None where it has no room, does not jump or misses a requirement.

        Without what is `required`, also of one that misses it.
        """
        estimate = self.estimator(variant)
        return None if estimate is None or (required and not estimate.kept) else estimate.score

    def failure(self, variant: Variant) -> Trial | None:
        """Return what a variant is learned as that has no room, stays on the ground or misses what is required.

        None of another one. Whether what misses it keeps all limits is not known.
        """
        if variant.key not in self._failures:
            laid, estimate = self.estimator.layout(variant), self.estimator(variant)
            outcome = laid if isinstance(laid, Evaluation) else None
            if outcome is None and estimate is not None and not (estimate.kept and estimate.score is not None):
                verdict, margins = "no_takeoff" if estimate.score is None else SCREENED, estimate.margins.items()
                findings = [bare(name, "error" if margin < 0.0 else "info", margin, "") for name, margin in margins]
                outcome = Evaluation(verdict, {}, tuple(findings))
            place = "", 0, 0, variant.design
            stayed = outcome and Trial(*place, outcome.bare, None, "", 0.0, {}, variant.workshop)
            self._failures[variant.key] = stayed or None
        return self._failures[variant.key]

    def failures(self, trials: Sequence[Trial], tried: Sequence[Array]) -> list[Trial]:
        """Return the last that were tried for `trials` and since then and did not hold, as if they were trials."""
        found = map(self.failure, [*self._passed_over, *self.tried(trials, tried)])
        return [one for one in found if one is not None][-FAILED:]

    def estimates(self, trials: Sequence[Trial], tried: Sequence[Array]) -> Mapping[Key, tuple[Array, float]]:
        """Return points (d,) and estimated scores, by key, of what was tried and of the trials that jumped."""
        if not self.estimator.ready:
            return {}
        first = [self._variant(point) for point in self.ranked[:FIRST]]
        failures = ((one, self.failure(one)) for one in self.tried(trials, tried))
        held = [one for one, failure in failures if failure is None or failure.evaluation.verdict == SCREENED]
        jumped = [trial.variant for trial in trials if self._evaluator.unrequired(trial) is not None]
        variants = [*[*first, *held][-ESTIMATED:], *jumped]
        scores = ((one, self.score(one, required=False)) for one in variants)
        return {one.key: (self._space.to_unit(one), score) for one, score in scores if score is not None}

    def tried(self, trials: Sequence[Trial], tried: Sequence[Array]) -> list[Variant]:
        """Return what was tried for `trials` and since then."""
        at = self._phase, self._run
        ours = (one for one in trials if one.position[:2] == at and one.step and one.key not in self._prior)
        kept = (point for trial in ours for point in trial.proposal.get(TRIED, ()))
        return [self._variant(point) for point in (*kept, *tried) if len(point) == self._space.dimension]

    def _variant(self, point: Sequence[float] | Array) -> Variant:
        key = tuple(point)
        if key not in self._variants:
            self._variants[key] = self._space.to_variant(point)
        return self._variants[key]
