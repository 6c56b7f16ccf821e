"""Figures of robots that were built, and margins of limits, fitted by quadratics of the parameters."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.space import Space
from jumpcad.search.study.trial import Trial
from jumpcad.transforms import Array

MARK = "laid_coil_mm"
"""A figure that only robots have that were built to be guessed from."""
FITTED = 300
"""Most robots that figures are fitted to: the nearest to the best."""
REACH = 0.25
"""Distance from the best, in ranges, at which a robot counts half as much; judgement."""
RIDGE = 1e-3
FEW, FEW_MORE = 80, 10.0
"""Where the robots are fewer, the ridge of the second order is so many times larger: then they do not say it."""
LIMITS = 6
"""Limits that are fitted too: those that reject most."""
KNOWN = 20
"""Least robots of which a limit's margin is known, for it to be fitted."""
STATICS = ("tips", "too_weak")
MARGIN, LOG = "margin ", "log "


class Table:
    """What is fitted: figures of robots that were built, and margins of limits.

    Parameters
    ----------
    space, trials
        The space, and trials of which some were built.
    centre
        The point (d,) about which they are fitted.
    laid
        Whether figures of layouts tell too. What was not built has none.
    limits
        Whether margins are fitted; else only of trials that were not laid out: one that was has met the limits that
        reject before.
    reach, ridge
        How far from the centre a robot counts half as much, in ranges, and how little the coefficients are believed.
    """

    def __init__(
        self,
        space: Space,
        trials: Sequence[Trial],
        centre: Array,
        laid: bool = False,
        limits: bool | None = None,
        reach: float = REACH,
        ridge: float = RIDGE,
    ) -> None:
        if laid:
            trials = [trial for trial in trials if MARK in trial.evaluation.metrics]
        units = np.array([space.to_unit(trial.variant) for trial in trials])
        distance = np.abs(units - centre).max(axis=1)
        order = np.sort(np.argsort(distance, kind="stable")[:FITTED])
        self.trials = [trials[index] for index in order]
        self.distance = distance[order]
        """Of the trials from the centre, in ranges."""
        self._ridge, self._dimension = ridge, units.shape[1]
        self._features = features(units[order])
        self._weights = 1.0 / (1.0 + (self.distance / reach) ** 2)
        self._columns = dict(self._figures())
        if laid:
            more = np.array([of_layout(trial.evaluation.metrics) for trial in self.trials])
            self._features = np.hstack([self._features, more])
        if limits or (limits is None and not laid):
            self._columns |= dict(self._margins())

    def coefficients(self) -> dict[str, Array]:
        """Return the coefficients of every column."""
        return {name: solver @ values[known] for name, values, known, solver in self._solved()}

    def held_out(self) -> list[dict[str, float]]:
        """Return the columns of each trial as a fit without it predicts them.

        What a value adds to its own prediction is known (its leverage): no fit is made anew.
        """
        found = {}
        for name, values, known, solver in self._solved():
            predicted = self._features @ (solver @ values[known])
            leverage = np.einsum("ij,ji->i", self._features[known], solver)
            predicted[known] -= leverage / (1.0 - leverage) * (values[known] - predicted[known])
            found[name] = predicted.tolist()
        return [dict(zip(found, row, strict=True)) for row in zip(*found.values(), strict=True)]

    def _solved(self) -> Iterator[tuple[str, Array, Array, Array]]:
        """Yield each column, its values, where they are known, and the matrix that takes them to coefficients."""
        solvers: dict[bytes, Array] = {}
        for name, values in self._columns.items():
            known = np.isfinite(values)
            key = known.tobytes()
            if key not in solvers:
                solvers[key] = self._solver(known)
            yield name, values, known, solvers[key]

    def _solver(self, known: Array) -> Array:
        """Return the matrix (k, n) that takes values of `known` trials to coefficients of weighted ridge regression."""
        rows, weights, d = self._features[known], self._weights[known], self._dimension
        weighted = rows * weights[:, None]
        second = self._ridge * (1.0 if len(rows) >= FEW else FEW_MORE)
        products = d * (d + 1) // 2
        more = rows.shape[1] - 1 - d - products
        ridge = [1e-9, *[self._ridge] * d, *[second] * products, *[self._ridge] * more]
        found: Array = np.linalg.solve(weighted.T @ rows + weights.sum() * np.diag(ridge), weighted.T)
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
            if np.isfinite(values).sum() >= KNOWN and np.nanmax(values) > 0.0:
                yield MARGIN + name, values


def features(units: Array) -> Array:
    """Return 1, the coordinates and their products (n, 1 + d + d·(d + 1)/2) of points (n, d) of the unit cube."""
    x = 2.0 * units - 1.0
    first, second = np.triu_indices(x.shape[1])
    return np.hstack([np.ones((len(x), 1)), x, x[:, first] * x[:, second]])


def figures_of(columns: Mapping[str, float]) -> dict[str, float]:
    """Return the figures, and margins, of fitted columns."""
    return {n.removeprefix(LOG): math.exp(value) if n.startswith(LOG) else value for n, value in columns.items()}


def of_layout(laid: Mapping[str, float]) -> Array:
    """Return the features (k,) of a layout."""
    return np.array([laid[name] / unit for name, unit in LAID.items()])


def learned_rows(known: int, least: int, growth: float) -> int:
    """Return how many of the `known` trials to learn from: `least` times the greatest power of `growth`; 0 of fewer."""
    if known < least:
        return 0
    return min(known, round(least * growth ** math.floor(math.log(known / least, growth) + 1e-9)))
