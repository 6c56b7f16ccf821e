"""Estimates corrected by the robots beside them, with how far off they may be: what a genetic algorithm need not build.

What an estimate misses is about the same for designs that are alike: the ratio of exact scores to estimated ones is
smooth (kriging). An estimate is never a score: what is proposed as the best was built.
"""

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from jumpcad.process import one_thread
from jumpcad.search.estimate.estimate import BUILT_FIGURE, Estimate, Estimator, of_layout
from jumpcad.search.models import PrintedModel
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation, Objective
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

BESIDE = 30
"""Robots whose ratios are learned: the nearest to the best."""
PAIRS = 16
"""Least of them that jump, so that they tell an error."""
LENGTH, NOISE = 0.3, 0.003
"""Length scale of the ratios (ranges) and their noise as a share of their variance, from which the fit starts."""
CAREFUL = 3.0
"""Standard deviations by which a score may be off; judgement."""
ROUGHLY = 1.1
"""How many times the estimated score a robot may have whose layout is not known; judgement."""
WORTH = 0.0005
"""Least gain, as a share of the best score, for which a robot is built: what a search ends by. With 0.003 a search
builds a third less, and ends 1 % lower (ten seeds)."""


Bounds = tuple[float | None, float, float]
"""What a variant scores about, at least and at most; no score where it does not jump."""


class Screen:
    """Leaves out candidates of one search whose estimates are too bad; its workshop does not vary."""

    def __init__(self, space: Space, model: PrintedModel, objective: Objective) -> None:
        self._space, self._model = space, model
        self._estimator = Estimator(space, model, objective)
        self._ratios: Surrogate | None = None

    def learn(self, trials: Sequence[Trial]) -> None:
        """Learn the robots of the search so far, and what estimates of the nearest to the best miss."""
        built = [one for one in trials if BUILT_FIGURE in one.evaluation.metrics]
        best = best_trial(built)
        if best is None:
            return
        with one_thread():
            self._estimator.learn(built)
            units = np.array([self._space.to_unit(trial.variant) for trial in built])
            distance = np.abs(units - self._space.to_unit(best.variant)).max(axis=1)
            near = [built[index] for index in np.argsort(distance, kind="stable")[:BESIDE]]
            known = []
            for one in near:
                estimate = self._estimator(one.variant)
                if estimate and min(one.score or 0.0, estimate.score or 0.0) > 0.0:
                    ratio = math.log((one.score or 0.0) / (estimate.score or 0.0))
                    known.append((self._place(one.variant, one.evaluation.metrics), ratio))
            places, ratios = (np.array([one[column] for one in known]) for column in (0, 1))
            theta = [0.0, *[math.log(LENGTH)] * places.shape[-1], math.log(NOISE)]
            self._ratios = None if len(known) < PAIRS else Surrogate(places, ratios, theta)

    def outcomes(self, variants: Iterable[Variant], best: float) -> dict[Key, Evaluation]:
        """Return the outcomes of the variants of a generation that need not be built.

        They are refused for certain, or worse than the best score, or than another of them, by more than the errors.
        """
        found, held, bar = {}, [], best * (1.0 + WORTH)
        for one in variants:
            if not self._model.admits(one.design):  # refused at once
                continue
            rough = self._estimator.rough(one)
            if rough is not None and rough.score is not None and ROUGHLY * rough.score < bar:
                found[one.key] = Evaluation(SCREENED, {GUESSED: rough.score})
                continue
            laid = self._model.refused_first(one.design) or self._estimator.layout(one)
            estimate = None if isinstance(laid, Evaluation) else self._estimator(one)
            if isinstance(laid, Evaluation):
                found[one.key] = laid.bare
            elif estimate is not None:
                score, least, most = self._bounds(estimate, self._place(one, laid))
                held.append((one, {} if score is None else {GUESSED: score}, most))
                bar = max(bar, least)
        return found | {one.key: Evaluation(SCREENED, guessed) for one, guessed, most in held if most < bar}

    def _bounds(self, estimate: Estimate, place: Array) -> Bounds:
        """Return the bounds of the score at a place; what tips or is too weak by an estimate may stand after all."""
        if estimate.score is None:
            return None, 0.0, math.inf if min(estimate.margins.values(), default=0.0) < 0.0 else 0.0
        if self._ratios is None:
            return estimate.score, 0.0, math.inf
        mean, deviation = self._ratios.predict(place[None])
        score = estimate.score * math.exp(float(mean[0]))
        error = math.exp(CAREFUL * math.hypot(float(deviation[0]), self._ratios.scatter))
        return (score, score / error, score * error) if estimate.kept else (None, 0.0, score * error)

    def _place(self, one: Variant, laid: Mapping[str, float]) -> Array:
        """Return the point (d + k,) of a variant and of its layout, so that what leaps is far away."""
        return np.append(self._space.to_unit(one), of_layout(laid))
