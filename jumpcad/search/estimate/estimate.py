"""The estimate of a printed robot before it is built, in milliseconds: its layout, its masses, its jump.

The layout is exact: what has no room for a part is refused as its evaluation refuses it. Masses, inertias and other
figures are fitted to the robots that were built so far, and a robot with these figures pushes off in the plane. Near
the best, a dozen robots tell the score of others within a tenth, later within a hundredth.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.process import Shared
from jumpcad.robot.robot import Robot
from jumpcad.search.estimate.estimated_robot import EXTENTS, estimated_robot
from jumpcad.search.estimate.fitted_figures import MARK, FittedFigures
from jumpcad.search.models import PrintedModel, plain_figures
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, Objective
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.simulation import simulate

LEAST, GROWTH = 8, 1.3
"""Robots from which on figures are fitted; they are fitted anew when there are so many times more."""
STATICS = ("tips", "too_weak")
"""Limits that a jump has margins of."""


@dataclass(frozen=True)
class Estimate:
    """What is expected: a score, None of what does not jump, and the margins of `STATICS` and of requirements."""

    score: float | None
    margins: Mapping[str, float]
    kept: bool = True
    """Whether all is kept that is required."""


class Estimator:
    """Estimates variants of one search; all follows from the trials that it learned.

    Where the workshop varies, layouts alone are known.
    """

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
        built = [] if self._space.varies_workshop else [one for one in trials if MARK in one.evaluation.metrics]
        rows = learned_rows(len(built))
        if rows in (0, self._rows):
            return
        known = built[:rows]
        if self._like is None:  # in what is neither fitted nor follows from the design, all others are like it
            self._like = build(known[0].design, self._model.varied(known[0].workshop).workshop)
        centre = self._space.to_unit((best_trial(known) or known[0]).variant)
        self._figures, self._rows = FittedFigures.of(self._space, known, centre), rows
        self._estimates.clear()

    def look_at(self, variants: Iterable[Variant], shared: Shared) -> None:
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
            self._estimates[variant.key] = None if isinstance(laid, Evaluation) else self._estimated(variant, laid)
        return self._estimates[variant.key]

    def rough(self, variant: Variant) -> Estimate | None:
        """Return about what a variant would do if it has room; its layout is not looked at."""
        return self._estimated(variant, None)

    def _estimated(self, variant: Variant, laid: Mapping[str, float] | None) -> Estimate | None:
        if self._figures is None:
            return None
        try:
            return self._jump(variant.design, self._figures.predict(self._space.to_unit(variant), laid))
        except (JumpcadError, OverflowError):  # a dead point, or figures far from all that was built
            return None

    def _jump(self, design: Design, figures: Mapping[str, float]) -> Estimate:
        """Return the estimate of a design's robot with these figures."""
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


def learned_rows(known: int) -> int:
    """Return how many of the `known` robots to learn: `LEAST` times the greatest power of `GROWTH`; 0 of fewer."""
    if known < LEAST:
        return 0
    return min(known, round(LEAST * GROWTH ** math.floor(math.log(known / LEAST, GROWTH) + 1e-9)))
