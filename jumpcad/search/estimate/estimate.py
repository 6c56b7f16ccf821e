"""The estimate of a printed robot before it is built, in milliseconds: its layout, its masses, its jump.

The layout is exact: what has no room for a part is refused as its evaluation refuses it. Masses, inertias and other
figures are fitted to the robots that were built so far, and a robot with these figures pushes off in the plane. Near
the best, a dozen robots tell the score of others within a tenth, later within a hundredth.
"""

import itertools
import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.process import MapOnCores
from jumpcad.robot.robot import Robot
from jumpcad.search.estimate.estimated_robot import EXTENTS, LAID, estimated_robot
from jumpcad.search.models import PrintedModel, plain_figures
from jumpcad.search.space import Space
from jumpcad.search.study.objective import EQUALS, Evaluation, Objective
from jumpcad.search.study.trial import Trial, best_trial, typical_size
from jumpcad.search.study.variant import NOTHING, Key, Variant
from jumpcad.simulation import simulate
from jumpcad.transforms import Array

BUILT_FIGURE = "laid_coil_mm"
"""A figure that only robots have that were built to be learned from."""
FITTED = 300
"""Most robots that figures are fitted to: the nearest to the best."""
REACH = 0.25
"""Distance from the best, in scales of the space, at which a robot counts half as much; judgement."""
LEARNED, SLACK = 2, 0.2
"""Robots that a limit has rejected, from which on its margins are fitted, and by how much a margin may be missed, in
arcsinh of its typical size; so much less after each of the last in a row that it rejected, up to four; judgement."""
RIDGE = 1e-3
FEW, FEW_MORE = 80, 10.0
"""Where the robots are fewer, the ridge of the second order is so many times larger: then they do not say it."""
LEAST, GROWTH = 8, 1.3
"""Robots from which on figures are fitted: anew of so many times more, and after a rejected one and the next."""
STATICS = ("tips", "too_weak")
"""Limits that a jump has margins of."""


class FittedFigures:
    """Coefficients of every figure that all robots have; of its logarithm where it is positive in all of them.

    Weighted ridge regression about a point; see `of`. Coefficients (features + layout figures,) of logarithms of what
    is `positive` and of `others`, by name, and (layout figures, features) of the layout's own figures. `sizes` are
    typical margins of the limits that rejected robots, and their slacks: their figures are arcsinh(margin / size).
    """

    def __init__(
        self, positive: Mapping[str, Array], others: Mapping[str, Array], layouts: Array, scale: Array | float = 1.0,
        sizes: Mapping[str, tuple[float, float]] = NOTHING,
    ) -> None:  # fmt: skip
        self._scale, self._logarithms, self._layouts, self._sizes = scale, len(positive), layouts, sizes
        self._names, self._matrix = [*positive, *others], np.array([*positive.values(), *others.values()])

    def margins(self, figures: Mapping[str, float]) -> tuple[dict[str, float], bool]:
        """Return the margins of the limits that rejected robots, and whether all are likely kept."""
        margins = {name: size * math.sinh(figures[name]) for name, (size, _) in self._sizes.items()}
        return margins, all(figures[name] > -slack for name, (_, slack) in self._sizes.items())

    @classmethod
    def of(cls, space: Space, trials: Sequence[Trial], centre: Array) -> Self:
        """Fit the figures of trials with a `BUILT_FIGURE`, the nearest to a point (d,) of the unit cube."""
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
                size = typical_size(margins)
                in_a_row = next((k for k, one in enumerate(evaluations[::-1]) if name not in one.missed), len(margins))
                sizes[name] = size, SLACK * (1.0 - min(in_a_row, 4))
                others[name] = solver @ np.arcsinh(margins / size)
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
    return np.asarray(np.linalg.solve(weighted.T @ rows + weights.sum() * np.diag(ridge), weighted.T))


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


@dataclass(frozen=True)
class Estimate:
    """What is expected: a score, None of what does not jump, and the margins of `STATICS` and of requirements."""

    score: float | None
    margins: Mapping[str, float]
    kept: bool = True
    """Whether all is kept that is required."""


class Estimator:
    """Estimates variants of one search from the trials that it learned; where the workshop varies, layouts alone."""

    def __init__(self, space: Space, model: PrintedModel, objective: Objective) -> None:
        self._space, self._model, self._objective = space, model, objective
        self._layouts: dict[Key, Mapping[str, float] | Evaluation] = {}
        self._estimates: dict[Key, Estimate | None] = {}
        self._figures: FittedFigures | None = None
        self._rows = 0
        self._like: Robot | None = None

    @property
    def ready(self) -> bool:
        """Whether enough robots were built to estimate the jump of others."""
        return self._figures is not None

    def learn(self, trials: Sequence[Trial]) -> None:
        """Fit the figures of the robots that were built, if there are enough new ones among some trials."""
        built = [] if self._space.varies_workshop else [one for one in trials if BUILT_FIGURE in one.evaluation.metrics]
        power = math.floor(math.log(len(built) / LEAST, GROWTH) + 1e-9) if len(built) >= LEAST else 0
        rejected = [False, *(any(EQUALS not in name for name in one.evaluation.missed) for one in built)]
        last = max((number for number, two in enumerate(itertools.pairwise(rejected), 1) if any(two)), default=0)
        rows = min(len(built), max(round(LEAST * GROWTH**power), last))
        if len(built) < LEAST or rows == self._rows:
            return
        known = built[:rows]
        if self._like is None:  # in what is neither fitted nor follows from the design, all others are like it
            self._like = build(known[0].design, self._model.varied(known[0].workshop).workshop)
        centre = self._space.to_unit((best_trial(known) or known[0]).variant)
        self._figures, self._rows = FittedFigures.of(self._space, known, centre), rows
        self._estimates.clear()

    def look_at(self, variants: Iterable[Variant], shared: MapOnCores) -> None:
        """Lay out and estimate what was not yet, by a function that shares the work among cores."""
        asked = {one.key: one for one in variants}
        new = [one for key, one in asked.items() if key not in self._layouts]
        self._layouts |= zip((one.key for one in new), shared(self._model.laid_out, new), strict=True)
        for variant in asked.values():
            self(variant)

    def layout(self, variant: Variant) -> Mapping[str, float] | Evaluation:
        """Return figures of a variant's layout, or the outcome of one that has no room."""
        if variant.key not in self._layouts:
            self._layouts[variant.key] = self._model.laid_out(variant)
        return self._layouts[variant.key]

    def refuses(self, variant: Variant) -> bool:
        """Whether a variant was laid out and has no room."""
        return isinstance(self._layouts.get(variant.key), Evaluation)

    def __call__(self, variant: Variant) -> Estimate | None:
        """Return what a variant would do; None where it has no room, or its jump cannot be estimated."""
        if not self.ready:
            return None
        if variant.key not in self._estimates:
            laid = self.layout(variant)
            self._estimates[variant.key] = None if isinstance(laid, Evaluation) else self.rough(variant, laid)
        return self._estimates[variant.key]

    def rough(self, variant: Variant, laid: Mapping[str, float] | None = None) -> Estimate | None:
        """Return about what a variant would do if it has room; better with the figures of its layout."""
        if self._figures is None:
            return None
        try:
            return self._jump(variant.design, self._figures.predict(self._space.to_unit(variant), laid))
        except (JumpcadError, OverflowError):  # a dead point, or figures far from all that was built
            return None

    def _jump(self, design: Design, figures: Mapping[str, float]) -> Estimate:
        assert self._like is not None
        assert self._figures is not None
        if errors(geometry_findings(design)):
            return Estimate(None, {})
        robot = estimated_robot(design, figures, self._like)
        jump = simulate(robot, self._model.estimate_settings, self._model.estimate_engine)
        margins, kept = self._figures.margins(figures)
        margins |= {finding.name: finding.margin for finding in jump.findings if finding.name in STATICS}
        if jump.verdict != "jump":
            return Estimate(None, margins)
        found = plain_figures(jump)
        size = max(design.l_max_mm / 1000.0, *(figures[name] for name in EXTENTS))
        found = {**figures, **found, "size_m": size, "body_lengths": found["touchdown_distance_m"] / size}
        found |= self._model.robust(robot, self._model.estimate_settings)
        others = self._model.on_floors(robot, self._model.estimate_settings, self._model.estimate_engine)
        asked = self._model.required(Evaluation("jump", found), others)
        score = self._objective.unrequired(asked) or 0.0
        return Estimate(score, {**margins, **asked.margins}, kept=kept and not asked.reasons)
