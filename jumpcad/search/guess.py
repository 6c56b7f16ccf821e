"""A guess of what a printed robot does, in milliseconds, from the robots that were built.

Mass, inertia and all other figures of the robots that were built are fitted by quadratics of the parameters; a robot
with the fitted figures pushes off. Of printed robots near the best, a dozen that were built guess the score of others
within about a tenth.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.search.models import RobotModel
from jumpcad.search.objective import Evaluation, Objective, find_objective
from jumpcad.search.space import Space
from jumpcad.search.stand_in import EXTENTS, LAID, stand_in
from jumpcad.search.trial import Trial
from jumpcad.search.variant import NOTHING, Variant
from jumpcad.simulation import simulate
from jumpcad.transforms import Array

MARK = "laid_coil_mm"
"""A figure that only robots have that were built to be guessed from."""
FITTED = 300
"""Most robots that figures are fitted to: the nearest to the best."""
REACH = 0.25
"""Distance from the best, in ranges, at which a robot counts half as much; judgement."""
RIDGE = 1e-3
FEW_RIDGE = 1e-2
"""Of the second order where the robots are fewer than `FEW`: then they do not say it."""
FEW = 80
FOLDS = 5
LIMITS = 6
"""Limits that are fitted too: those that reject most."""
STATICS = ("tips", "too_weak")
MARGIN, LOG = "margin ", "log "


@dataclass(frozen=True)
class Guess:
    """What is expected: a score, None of what does not jump, and the margins of limits."""

    score: float | None
    margins: Mapping[str, float]


@dataclass(frozen=True)
class Fit:
    """Coefficients of the quadratics, and the errors of guesses of designs that were held out.

    What is positive in all robots, as masses are, is fitted by its logarithm, and stays positive.

    Parameters
    ----------
    rows
        How many trials, without those that were screened, they were fitted to.
    coefficients
        Of each figure, of its logarithm as ``log NAME``, and of each limit as ``margin NAME``: (features,).
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

    def predict(self, unit: Array, laid: Mapping[str, float] = NOTHING) -> dict[str, float]:
        """Return figures and margins at a point (d,) of the unit cube, of a robot with these figures of its layout."""
        row = np.append(features(unit[None])[0], _of_layout(laid) if laid else [])
        values = (self._matrix * row).sum(axis=1)
        pairs = zip(self._names, values.tolist(), strict=True)
        return {n.removeprefix(LOG): math.exp(value) if n.startswith(LOG) else value for n, value in pairs}


class Guesser:
    """Makes guesses for one search from fitted figures.

    Parameters
    ----------
    space, model, objective
        Of the search: a printed robot, whose workshop does not vary.
    engine
        Simulates the stand-ins.
    first
        Design of a robot that was built: in what is neither fitted nor follows from the design, all others are like it.
    """

    def __init__(self, space: Space, model: RobotModel, objective: Objective, engine: str, first: Trial) -> None:
        self.space, self.model, self.engine = space, model, engine
        self.objective = find_objective(objective.neighbours_of) if objective.neighbours_of else objective
        self.like = build(first.design, model.varied(first.workshop).workshop)

    def __call__(self, one: Variant, fit: Fit, laid: Mapping[str, float] = NOTHING) -> Guess | None:
        """Return what a variant would do; None where its jump cannot be guessed. `laid`: figures of its layout."""
        try:
            return self._guessed(one.design, fit.predict(self.space.to_unit(one), laid), fit.bias)
        except (JumpcadError, OverflowError):  # a dead point, or figures far from all that was built
            return None

    def _guessed(self, design: Design, figures: Mapping[str, float], bias: float) -> Guess:
        margins = {name.removeprefix(MARGIN): value for name, value in figures.items() if name.startswith(MARGIN)}
        if errors(geometry_findings(design)):
            return Guess(None, margins)
        jump = simulate(stand_in(design, figures, self.like), self.model.settings, self.engine)
        margins |= {finding.name: finding.margin for finding in jump.findings if finding.name in STATICS}
        if jump.verdict != "jump":
            return Guess(None, margins)
        found = {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
        size = max(design.l_max_mm / 1000.0, *(figures[name] for name in EXTENTS))
        found = {**figures, **found, "size_m": size, "body_lengths": found["ballistic_range_m"] / size}
        return Guess(bias * (self.objective.score(Evaluation("jump", found)) or 0.0), margins)


class Table:
    """What is fitted: figures of robots that were built, and margins of limits.

    With figures of their layouts, no limits: a robot that was laid out has met those that reject before, and what was
    not built has no figures.
    """

    def __init__(self, space: Space, trials: Sequence[Trial], centre: Array, laid: bool = False) -> None:
        if laid:
            trials = [trial for trial in trials if MARK in trial.evaluation.metrics]
        units = np.array([space.to_unit(trial.variant) for trial in trials])
        distance = np.abs(units - centre).max(axis=1)
        order = np.sort(np.argsort(distance, kind="stable")[:FITTED])
        self.trials = [trials[index] for index in order]
        self._units = units[order]
        self._features = features(self._units)
        self._weights = 1.0 / (1.0 + (distance[order] / REACH) ** 2)
        self._columns = dict(self._figures())
        if laid:
            more = np.array([_of_layout(trial.evaluation.metrics) for trial in self.trials])
            self._features = np.hstack([self._features, more])
        else:
            self._columns |= dict(self._margins())

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
                solvers[key] = _solver(self._features[known], self._weights[known], len(self._units[0]))
            found[name] = solvers[key] @ values[known]
        return found

    def _figures(self) -> Iterator[tuple[str, Array]]:
        held = [trial.evaluation.metrics for trial in self.trials]
        marked = [MARK in metrics for metrics in held]
        common = set.intersection(*(set(metrics) for metrics, has in zip(held, marked, strict=True) if has))
        for name in sorted(common - LAID.keys()):
            values = np.array([m[name] if has else np.nan for m, has in zip(held, marked, strict=True)])
            positive = np.nanmin(values) > 0.0
            yield (LOG + name, np.log(values)) if positive else (name, values)

    def _margins(self) -> Iterator[tuple[str, Array]]:
        margins = [{one.name: one.margin for one in trial.evaluation.findings} for trial in self.trials]
        reasons = list(itertools.chain.from_iterable(trial.evaluation.reasons for trial in self.trials))
        names = [name for name in dict.fromkeys(reasons) if name not in STATICS]
        for name in sorted(names, key=lambda name: (-reasons.count(name), name))[:LIMITS]:
            values = np.array([one.get(name, np.nan) for one in margins])  # of several parts, the last
            if np.isfinite(values).sum() >= FEW and np.nanmax(values) > 0.0:
                yield MARGIN + name, values


def features(units: Array) -> Array:
    """Return 1, the coordinates and their products (n, 1 + d + d·(d + 1)/2) of points (n, d) of the unit cube."""
    x = 2.0 * units - 1.0
    first, second = np.triu_indices(x.shape[1])
    return np.hstack([np.ones((len(x), 1)), x, x[:, first] * x[:, second]])


def _of_layout(laid: Mapping[str, float]) -> Array:
    """Return the features (k,) of a layout."""
    return np.array([laid[name] / unit for name, unit in LAID.items()])


def _solver(features_: Array, weights: Array, dimension: int) -> Array:
    """Return the matrix (k, n) that takes values to the coefficients of weighted ridge regression."""
    weighted = features_ * weights[:, None]
    second = RIDGE if len(features_) >= FEW else FEW_RIDGE
    products = dimension * (dimension + 1) // 2
    ridge = [
        1e-9,
        *[RIDGE] * dimension,
        *[second] * products,
        *[RIDGE] * (features_.shape[1] - 1 - dimension - products),
    ]
    found: Array = np.linalg.solve(weighted.T @ features_ + weights.sum() * np.diag(ridge), weighted.T)
    return found


def learned_rows(known: int, least: int, growth: float) -> int:
    """Return how many of the `known` trials to learn from: `least` times the greatest power of `growth`; 0 of fewer."""
    if known < least:
        return 0
    return min(known, round(least * growth ** math.floor(math.log(known / least, growth) + 1e-9)))
