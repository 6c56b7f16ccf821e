"""Figures of robots that were built, fitted by quadratics of the parameters and by figures of the layout."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Self

import numpy as np

from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.space import Space
from jumpcad.search.study.objective import EQUALS
from jumpcad.search.study.trial import Trial, typical_size
from jumpcad.transforms import Array

MARK = "laid_coil_mm"
"""A figure that only robots have that were built to be learned from."""
FITTED = 300
"""Most robots that figures are fitted to: the nearest to the best."""
REACH = 0.25
"""Distance from the best, in scales of the space, at which a robot counts half as much; judgement."""
LEARNED, SLACK = 2, 0.2
"""Robots that a limit has rejected, from which on its margins are fitted, and by how much a margin may be missed, in
arcsinh of its typical size; judgement."""
NO_LIMITS: Mapping[str, float] = MappingProxyType({})
RIDGE = 1e-3
FEW, FEW_MORE = 80, 10.0
"""Where the robots are fewer, the ridge of the second order is so many times larger: then they do not say it."""


class FittedFigures:
    """Coefficients of every figure that all robots have; of its logarithm where it is positive in all of them.

    So masses stay positive. Weighted ridge regression about a point; see `of`. There are coefficients (features +
    layout figures,) of logarithms of what is `positive` and of `others`, by name, and (layout figures, features) of the
    layout's own figures. `sizes` are typical margins of the limits that rejected robots: their figures are
    arcsinh(margin / size).
    """

    def __init__(
        self, positive: Mapping[str, Array], others: Mapping[str, Array], layouts: Array, scale: Array | float = 1.0,
        sizes: Mapping[str, float] = NO_LIMITS,
    ) -> None:  # fmt: skip
        self._scale, self._logarithms, self._layouts = scale, len(positive), layouts
        self._names = [*positive, *others]
        self._sizes = sizes
        self._matrix = np.array([*positive.values(), *others.values()])

    def margins(self, figures: Mapping[str, float]) -> tuple[dict[str, float], bool]:
        """Return the margins of the limits that rejected robots, and whether all are likely kept."""
        margins = {name: size * math.sinh(figures[name]) for name, size in self._sizes.items()}
        return margins, all(figures[name] > -SLACK for name in margins)

    @classmethod
    def of(cls, space: Space, trials: Sequence[Trial], centre: Array) -> Self:
        """Fit the figures of trials with a `MARK`, the nearest to a point (d,) of the unit cube."""
        units = np.array([space.to_unit(trial.variant) for trial in trials])
        distance = (np.abs(units - centre) / space.scale).max(axis=1)
        order = np.sort(np.argsort(distance, kind="stable")[:FITTED])
        metrics = [trials[index].evaluation.metrics for index in order]
        plain, weights = features(units[order], space.scale), 1.0 / (1.0 + (distance[order] / REACH) ** 2)
        laid = np.array([of_layout(one) for one in metrics])
        solver = _solver(np.hstack([plain, laid]), weights, units.shape[1])
        positive, others, sizes = {}, {}, {}
        for name in sorted(set.intersection(*map(set, metrics)) - LAID.keys()):
            values = np.array([one[name] for one in metrics])
            if values.min() > 0.0:
                positive[name] = solver @ np.log(values)
            else:
                others[name] = solver @ values
        evaluations = [trials[index].evaluation for index in order]
        rejections = Counter(name for one in evaluations for name in one.missed)
        for name in sorted(name for name, count in rejections.items() if count >= LEARNED and EQUALS not in name):
            margins = np.array([one.margins.get(name, np.nan) for one in evaluations])
            if np.isfinite(margins).all():
                sizes[name] = typical_size(margins)
                others[name] = solver @ np.arcsinh(margins / sizes[name])
        return cls(positive, others, (_solver(plain, weights, units.shape[1]) @ laid).T, space.scale, sizes)

    def predict(self, unit: Array, laid: Mapping[str, float] | None) -> dict[str, float]:
        """Return the figures at a point (d,) of the unit cube, of a robot with these figures of its layout.

        Without them, of a robot whose layout is about that of the robots beside it.
        """
        plain = features(unit[None], self._scale)[0]
        layout = (self._layouts * plain).sum(axis=1) if laid is None else of_layout(laid)
        values = (self._matrix * np.append(plain, layout)).sum(axis=1).tolist()
        values[: self._logarithms] = map(math.exp, values[: self._logarithms])
        return dict(zip(self._names, values, strict=True))


def _solver(rows: Array, weights: Array, d: int) -> Array:
    """Return the matrix (k, n) that takes values of the rows (n, k) to coefficients of weighted ridge regression."""
    weighted = rows * weights[:, None]
    second = RIDGE * (1.0 if len(rows) >= FEW else FEW_MORE)
    products = d * (d + 1) // 2
    more = rows.shape[1] - 1 - d - products
    ridge = [1e-9, *[RIDGE] * d, *[second] * products, *[RIDGE] * more]
    found: Array = np.linalg.solve(weighted.T @ rows + weights.sum() * np.diag(ridge), weighted.T)
    return found


def features(units: Array, scale: Array | float = 1.0) -> Array:
    """Return 1, the coordinates and their products (n, 1 + d + d·(d + 1)/2) of points (n, d) of the unit cube.

    The coordinates are from its middle, in halves of a scale (d,).
    """
    x = (2.0 * units - 1.0) / scale
    first, second = np.triu_indices(x.shape[1])
    return np.hstack([np.ones((len(x), 1)), x, x[:, first] * x[:, second]])


def of_layout(laid: Mapping[str, float]) -> Array:
    """Return the features (k,) of a layout."""
    return np.array([laid[name] / unit for name, unit in LAID.items()])
