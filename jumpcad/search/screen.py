"""A screen for searches of many candidates: a guess of what a printed robot does, in about a millisecond.

Mass, inertia and all other figures of the robots that were built are fitted by quadratics of the parameters; a robot
with the fitted figures pushes off in the plane. What the guess is worth is measured on robots that were held out.
A candidate is left out only if it fails, or scores less than the best known, by more than that error. A guess is
never a score: what is proposed as the best was built.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

from jumpcad.building import build
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.search.models import RobotModel
from jumpcad.search.objective import SCREENED, Evaluation, Objective
from jumpcad.search.space import Space
from jumpcad.search.stand_in import stand_in
from jumpcad.search.trial import Trial, best_trial
from jumpcad.search.variant import Variant
from jumpcad.simulation import simulate
from jumpcad.transforms import Array

MARK = "release_turn_rad"
"""A figure that only robots have that were built for a screen."""
LEAST, GROWTH = 80, 1.2
"""Robots from which on the screen works; it is fitted anew when there are so many times more."""
FITTED = 300
"""Most robots that it is fitted to: the nearest to the best."""
REACH = 0.25
"""Distance from the best, in ranges, at which a robot counts half as much; judgement."""
RIDGE = 1e-3
FOLDS = 5
SURE = 95.0
"""Percentile of the held-out errors that a guess must exceed."""
LIMITS = 6
"""Limits that are fitted too: those that reject most."""


@dataclass(frozen=True)
class Guess:
    """What the screen expects: a score, None of what does not jump, and the margins of limits."""

    score: float | None
    margins: Mapping[str, float]


@dataclass(frozen=True)
class Fit:
    """Coefficients of the quadratics, and the errors of guesses of designs that were held out.

    Parameters
    ----------
    rows
        How many trials, without those that were screened, they were fitted to.
    coefficients
        Of each figure and, as ``margin NAME``, of each limit: (features,).
    errors
        Of the score, as `score`, and of each limit's margin.
    bias
        Of exact scores over guessed ones, the median.
    """

    rows: int
    coefficients: Mapping[str, Array]
    errors: Mapping[str, float]
    bias: float = 1.0

    def to_record(self) -> dict[str, Any]:
        """Return plain data, as the study keeps it."""
        coefficients = {name: values.tolist() for name, values in self.coefficients.items()}
        return {"rows": self.rows, "coefficients": coefficients, "errors": dict(self.errors), "bias": self.bias}

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Self:
        """Return the fit that was kept."""
        coefficients = {name: np.array(values) for name, values in record["coefficients"].items()}
        return cls(record["rows"], coefficients, record["errors"], record["bias"])

    @cached_property
    def _names(self) -> list[str]:
        return list(self.coefficients)

    @cached_property
    def _matrix(self) -> Array:
        return np.array(list(self.coefficients.values()))

    def predict(self, unit: Array) -> dict[str, float]:
        """Return figures and margins at a point (d,) of the unit cube."""
        values = (self._matrix * features(unit[None])).sum(axis=1)
        return dict(zip(self._names, values.tolist(), strict=True))


class Screen:
    """Guesses for one search; see `Fit` for what it learns.

    Parameters
    ----------
    space, model, objective
        Of the search: a printed robot, whose workshop does not vary.
    """

    def __init__(self, space: Space, model: RobotModel, objective: Objective) -> None:
        self.space, self.model, self.objective = space, model, objective
        self.engine = model.screen_engine
        self._like: Mechanism | None = None
        self.fit: Fit | None = None

    def learn(self, trials: Sequence[Trial], kept: Mapping[str, Any] | None = None) -> bool:
        """Fit the trials of the search so far, or take up the fit that was kept; return whether it is a new one."""
        known = [trial for trial in trials if trial.evaluation.verdict != SCREENED]
        rows = learned_rows(len(known))
        if rows == 0 or (self.fit is not None and self.fit.rows == rows):
            return False
        known = known[:rows]
        best = best_trial(known)
        if best is None or sum(MARK in trial.evaluation.metrics for trial in known) < LEAST:
            return False
        self._like = self._like or build(best.design, self.model.workshop)
        if kept is not None and kept["rows"] == rows:
            self.fit = Fit.from_record(kept)
            return False
        self.fit = replace(self._fitted(known, best), rows=rows)
        return True

    def guess(self, one: Variant) -> Guess | None:
        """Return what a variant would do; None where nothing is known yet, or its jump cannot be guessed."""
        return None if self.fit is None else self._guess(one, self.fit)

    def leaves_out(self, guess: Guess, best: float) -> bool:
        """Whether a guess fails, or is worse than the best score known, by more than its error."""
        assert self.fit is not None
        error = self.fit.errors
        if any(margin < -error.get(name, np.inf) for name, margin in guess.margins.items()):
            return True
        return (guess.score or 0.0) + error["score"] < best

    def _guess(self, one: Variant, fit: Fit) -> Guess | None:
        figures = fit.predict(self.space.to_unit(one))
        margins = {name.removeprefix(MARGIN): value for name, value in figures.items() if name.startswith(MARGIN)}
        design = one.design
        if errors(geometry_findings(design)):
            return Guess(None, margins)
        assert self._like is not None
        try:
            jump = simulate(stand_in(design, figures, self._like), self.model.settings, self.engine)
        except JumpcadError:  # a dead point, or figures far from all that was built
            return None
        margins |= {finding.name: finding.margin for finding in jump.findings if finding.name in STATICS}
        if jump.verdict != "jump":
            return Guess(None, margins)
        found = {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
        found = figures | found | {"body_lengths": found["ballistic_range_m"] / figures["size_m"]}
        return Guess(fit.bias * (self.objective.score(Evaluation("jump", found)) or 0.0), margins)

    def _fitted(self, trials: Sequence[Trial], best: Trial) -> Fit:
        table = _Table(self.space, trials, self.space.to_unit(best.variant))
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

    def _held_out(self, table: "_Table") -> Iterator[tuple[Guess, Trial]]:
        """Yield guesses of trials from fits without them."""
        for fold in range(FOLDS):
            part = Fit(0, table.coefficients(fold), {})
            for trial in table.trials[fold::FOLDS]:
                guess = self._guess(trial.variant, part)
                if guess is not None:
                    yield guess, trial


def learned_rows(known: int) -> int:
    """Return how many of the `known` trials to learn from: `LEAST` times the greatest power of `GROWTH`; 0 of fewer."""
    if known < LEAST:
        return 0
    return round(LEAST * GROWTH ** math.floor(math.log(known / LEAST, GROWTH) + 1e-9))


STATICS = ("tips", "too_weak")
MARGIN = "margin "


class _Table:
    """What is fitted: figures of robots that were built, and margins of limits."""

    def __init__(self, space: Space, trials: Sequence[Trial], centre: Array) -> None:
        units = np.array([space.to_unit(trial.variant) for trial in trials])
        distance = np.abs(units - centre).max(axis=1)
        order = np.sort(np.argsort(distance, kind="stable")[:FITTED])
        self.trials = [trials[index] for index in order]
        self._features = features(units[order])
        self._weights = 1.0 / (1.0 + (distance[order] / REACH) ** 2)
        self._columns = dict(self._figures()) | dict(self._margins())

    def coefficients(self, left_out: int | None = None) -> dict[str, Array]:
        """Return the coefficients of every column, fitted without the trials of a fold."""
        kept = np.ones(len(self.trials), dtype=bool)
        if left_out is not None:
            kept[left_out::FOLDS] = False
        found, solvers = {}, {}
        for name, values in self._columns.items():
            known = kept & np.isfinite(values)
            key = known.tobytes()
            if key not in solvers:
                solvers[key] = _solver(self._features[known], self._weights[known])
            found[name] = solvers[key] @ values[known]
        return found

    def _figures(self) -> Iterator[tuple[str, Array]]:
        held = [trial.evaluation.metrics for trial in self.trials]
        marked = [MARK in metrics for metrics in held]
        common = set.intersection(*(set(metrics) for metrics, has in zip(held, marked, strict=True) if has))
        for name in sorted(common):
            yield name, np.array([m[name] if has else np.nan for m, has in zip(held, marked, strict=True)])

    def _margins(self) -> Iterator[tuple[str, Array]]:
        margins = [{one.name: one.margin for one in trial.evaluation.findings} for trial in self.trials]
        reasons = list(itertools.chain.from_iterable(trial.evaluation.reasons for trial in self.trials))
        names = [name for name in dict.fromkeys(reasons) if name not in STATICS]
        for name in sorted(names, key=lambda name: (-reasons.count(name), name))[:LIMITS]:
            values = np.array([one.get(name, np.nan) for one in margins])  # of several parts, the last
            if np.isfinite(values).sum() >= LEAST and np.nanmax(values) > 0.0:
                yield MARGIN + name, values


def features(units: Array) -> Array:
    """Return 1, the coordinates and their products (n, 1 + d + d·(d + 1)/2) of points (n, d) of the unit cube."""
    x = 2.0 * units - 1.0
    first, second = np.triu_indices(x.shape[1])
    return np.hstack([np.ones((len(x), 1)), x, x[:, first] * x[:, second]])


def _solver(features_: Array, weights: Array) -> Array:
    """Return the matrix (k, n) that takes values to the coefficients of weighted ridge regression."""
    weighted = features_ * weights[:, None]
    normal = weighted.T @ features_ + RIDGE * weights.sum() * np.diag([1e-6, *[1.0] * (features_.shape[1] - 1)])
    found: Array = np.linalg.solve(normal, weighted.T)
    return found
