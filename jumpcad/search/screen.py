"""A screen for searches of many candidates: what the guess of a candidate leaves out is not built.

What a guess is worth is measured on robots that were held out. A candidate is left out only if it fails, or scores less
than the best known, by more than that error. A guess is never a score: what is proposed as the best was built.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from jumpcad.search.guess import FOLDS, MARK, Fit, Guess, Guesser, Table, learned_rows
from jumpcad.search.models import RobotModel
from jumpcad.search.objective import SCREENED, Objective
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial, best_trial
from jumpcad.search.variant import Variant

LEAST, GROWTH = 80, 1.2
"""Robots from which on the screen works; it is fitted anew when there are so many times more."""
SURE = 95.0
"""Percentile of the held-out errors that a guess must exceed."""


class Screen:
    """Guesses for one search; see `Fit` for what it learns.

    Parameters
    ----------
    space, model, objective
        Of the search: a printed robot, whose workshop does not vary.
    """

    def __init__(self, space: Space, model: RobotModel, objective: Objective) -> None:
        self.space, self.model, self.objective = space, model, objective
        self._guesser: Guesser | None = None
        self.fit: Fit | None = None

    def learn(self, trials: Sequence[Trial], kept: Mapping[str, Any] | None = None) -> bool:
        """Fit the trials of the search so far, or take up the fit that was kept; return whether it is a new one."""
        known = [trial for trial in trials if trial.evaluation.verdict != SCREENED]
        rows = learned_rows(len(known), LEAST, GROWTH)
        if rows == 0 or (self.fit is not None and self.fit.rows == rows):
            return False
        known = known[:rows]
        best = best_trial(known)
        if best is None or sum(MARK in trial.evaluation.metrics for trial in known) < LEAST:
            return False
        if self._guesser is None:
            self._guesser = Guesser(self.space, self.model, self.objective, self.model.screen_engine, best)
        if kept is not None and kept["rows"] == rows:
            self.fit = Fit.from_record(kept)
            return False
        with threadpool_limits(1):  # sums in a fixed order give the same bits however many cores there are
            self.fit = replace(self._fitted(known, best), rows=rows)
        return True

    def guess(self, one: Variant) -> Guess | None:
        """Return what a variant would do; None where nothing is known yet, or its jump cannot be guessed."""
        return None if self.fit is None or self._guesser is None else self._guesser(one, self.fit)

    def leaves_out(self, guess: Guess, best: float) -> bool:
        """Whether a guess fails, or is worse than the best score known, by more than its error."""
        assert self.fit is not None
        error = self.fit.errors
        if any(margin < -error.get(name, np.inf) for name, margin in guess.margins.items()):
            return True
        return (guess.score or 0.0) + error["score"] < best

    def _fitted(self, trials: Sequence[Trial], best: Trial) -> Fit:
        table = Table(self.space, trials, self.space.to_unit(best.variant))
        held = list(self._held_out(table))
        pairs = [(guess.score, trial.score) for guess, trial in held if guess.score and trial.score]
        bias = float(np.median([exact / guessed for guessed, exact in pairs])) if pairs else 1.0
        nearest = sorted(pairs, key=lambda pair: -pair[1])[: max(LEAST // 3, len(pairs) // 3)]
        good = [exact - bias * guessed for guessed, exact in nearest]
        wrong: dict[str, list[float]] = {"score": good}
        for guess, trial in held:
            for finding in trial.evaluation.findings:
                if finding.name in guess.margins:
                    wrong.setdefault(finding.name, []).append(finding.margin - guess.margins[finding.name])
        # One side: how much better than guessed the best third is, and how much the limits are.
        error = {name: float(np.percentile(values, SURE)) for name, values in wrong.items() if values}
        return Fit(0, table.coefficients(), {"score": np.inf} | error, bias)

    def _held_out(self, table: Table) -> Iterator[tuple[Guess, Trial]]:
        """Yield guesses of trials from fits without them."""
        assert self._guesser is not None
        for fold in range(FOLDS):
            part = Fit(0, table.coefficients(fold), {})
            for trial in table.trials[fold::FOLDS]:
                guess = self._guesser(trial.variant, part)
                if guess is not None:
                    yield guess, trial
