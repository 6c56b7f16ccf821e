"""A tier of the screen: guesses of scores from fitted figures, corrected by the robots beside them, and their errors.

What a guess misses is about the same for designs that are alike: the ratio of exact scores to guessed ones is smooth
(kriging). Its deviation is small beside robots that are known, and tells how far off a guess may be; by how many
deviations, robots tell that were held out.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from jumpcad.search.estimate.estimate import Fit, Guesser
from jumpcad.search.estimate.fitting import STATICS, Table, of_layout
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

BESIDE, TRIED = 30, 20
"""Robots whose ratios are learned, the nearest to the best, and those of them on which guesses are tried."""
PAIRS = 8
"""Least of them that jump, so that they tell an error."""
SURE = 95.0
"""Percentile of the held-out errors of scores that a guess must exceed."""
CAREFUL = 2.0
"""How many times the worst error of its margin a limit must be missed by; judgement: robots tell little of what has
no room."""
REACH, RIDGE = 0.1, {False: 1e-3, True: 1e-4}
"""Of fits without and with the layout, see `Table`: errors on robots of a search were the smallest."""
LENGTH, NOISE = 0.3, 0.003
"""Length scale of the ratios (ranges), and their noise as a share of their variance; judgement."""
MORE, LESS = "more", "less"
"""Errors of a score: how many deviations the logarithm of the exact one may be above a guess, and below (negative)."""


@dataclass(frozen=True)
class Expected:
    """What a variant would score, at least and at most; no score where it does not jump. `fails`: for certain."""

    score: float | None
    least: float
    most: float
    fails: bool


class Tier:
    """Guesses for one search, without or with figures of the layout.

    Parameters
    ----------
    space, guesser
        Of the search.
    laid
        Whether the layout is known.
    """

    def __init__(self, space: Space, guesser: Guesser, laid: bool) -> None:
        self._space, self._guesser, self._laid = space, guesser, laid
        self.fit = Fit(0, {}, {})
        self._ratios: dict[Key, float | None] = {}
        self._process: Surrogate | None = None

    def learn(self, trials: Sequence[Trial]) -> None:
        """Fit the figures of robots that were built, and measure what guesses of them are worth."""
        near = self._nearest(trials)
        centre = self._space.to_unit(near[0].variant)
        table = Table(self._space, trials, centre, self._laid, True, REACH, RIDGE[self._laid])
        self.take(Fit(len(trials), table.coefficients(), {}))
        self.fit = replace(self.fit, errors=self._errors(table, near))

    def take(self, fit: Fit) -> None:
        """Take up a fit."""
        self.fit, self._ratios, self._process = fit, {}, None

    def correct(self, trials: Sequence[Trial]) -> None:
        """Learn what guesses of the robots nearest to the best miss, also of those that were not fitted."""
        near = [trial for trial in self._nearest(trials) if self._ratio(trial) is not None]
        self._process = self._ratios_of(near) if len(near) >= PAIRS else None

    def guess(self, one: Variant, laid: Mapping[str, float]) -> Expected | None:
        """Return what a variant would do; None where its jump cannot be guessed."""
        guess, errors = self._guesser(one, self.fit, laid), self.fit.errors
        if guess is None:
            return None
        fails = any(margin < -errors.get(name, math.inf) for name, margin in guess.margins.items())
        if guess.score is None:  # what tips or is too weak by a guess may stand after all
            unsure = any(guess.margins.get(name, 0.0) < 0.0 for name in STATICS)
            return Expected(None, 0.0, math.inf if unsure else 0.0, fails)
        if self._process is None or MORE not in errors:
            return Expected(guess.score, 0.0, math.inf, fails)
        ratio, deviation = _at(self._process, self._place(one, laid))
        score = guess.score * math.exp(ratio)
        holds = all(margin >= 0.0 for margin in guess.margins.values())
        least = score * math.exp(errors[LESS] * deviation) if holds else 0.0
        return Expected(score, least, score * math.exp(errors[MORE] * deviation), fails)

    def _errors(self, table: Table, near: Sequence[Trial]) -> dict[str, float]:
        """Return errors of guesses of robots from the others: of scores in deviations, of margins in their units."""
        held_out = {trial.key: columns for trial, columns in zip(table.trials, table.held_out(), strict=True)}
        off: list[float] = []
        wrong: dict[str, list[float]] = {}
        for trial in near[:TRIED]:
            guess = self._guesser.from_columns(trial.design, held_out[trial.key])
            if guess is None:
                continue
            for name, margin in trial.evaluation.margins.items():
                if name in guess.margins:
                    wrong.setdefault(name, []).append(margin - guess.margins[name])
            others = [one for one in near if one is not trial and self._ratio(one) is not None]
            ratio = log_ratio(trial.score, guess.score)
            if ratio is not None and len(others) >= PAIRS:
                mean, deviation = _at(self._ratios_of(others), self._place(trial.variant, trial.evaluation.metrics))
                off.append((ratio - mean) / deviation)
        errors = {name: CAREFUL * max(map(abs, values)) for name, values in wrong.items()}
        if off:
            less, more = np.percentile(off, [100.0 - SURE, SURE]).tolist()
            errors |= {LESS: min(less, 0.0), MORE: max(more, 0.0)}
        return errors

    def _nearest(self, trials: Sequence[Trial]) -> list[Trial]:
        """Return the best trial and those nearest to it."""
        best = best_trial(trials)
        assert best is not None
        units = np.array([self._space.to_unit(trial.variant) for trial in trials])
        distance = np.abs(units - self._space.to_unit(best.variant)).max(axis=1)
        return [trials[place] for place in np.argsort(distance, kind="stable")[:BESIDE]]

    def _ratio(self, trial: Trial) -> float | None:
        """Return the logarithm of the exact score of a robot over the guessed one."""
        if trial.key not in self._ratios:
            guess = self._guesser(trial.variant, self.fit, trial.evaluation.metrics if self._laid else {})
            self._ratios[trial.key] = None if guess is None else log_ratio(trial.score, guess.score)
        return self._ratios[trial.key]

    def _ratios_of(self, trials: Sequence[Trial]) -> Surrogate:
        x = np.array([self._place(trial.variant, trial.evaluation.metrics) for trial in trials])
        y = np.array([self._ratio(trial) for trial in trials])
        theta = [0.0, *[math.log(LENGTH)] * x.shape[1], math.log(NOISE)]
        return Surrogate(x, y, theta, fit=False, units=(float(np.median(y)), 1.0))

    def _place(self, one: Variant, laid: Mapping[str, float]) -> Array:
        """Return the point (d,) of a variant; with the layout (d + k,), so that what leaps is far away."""
        unit = self._space.to_unit(one)
        return np.append(unit, of_layout(laid)) if self._laid else unit


def log_ratio(exact: float | None, guessed: float | None) -> float | None:
    """Return the logarithm of an exact score over a guessed one; None where one of them is none, or not positive."""
    if exact is None or guessed is None or min(exact, guessed) <= 0.0:
        return None
    return math.log(exact / guessed)


def _at(process: Surrogate, place: Array) -> tuple[float, float]:
    """Return mean and standard deviation, the values' scatter included, at a place (d,)."""
    mean, deviation = process.predict(place[None])
    return float(mean[0]), math.hypot(float(deviation[0]), process.scatter)
