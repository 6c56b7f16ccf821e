"""A guess of what a printed robot does, in milliseconds, from the robots that were built.

Mass, inertia and all other figures of the robots that were built are fitted by quadratics of the parameters; a robot
with the fitted figures pushes off. Of printed robots near the best, a dozen that were built guess the score of others
within about a tenth.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.search.estimate.estimated_robot import EXTENTS, stand_in
from jumpcad.search.estimate.fitting import MARGIN, STATICS, features, figures_of, of_layout
from jumpcad.search.models import RobotModel
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, Objective
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import NOTHING, Variant
from jumpcad.simulation import simulate
from jumpcad.transforms import Array

IMPOSSIBLE = (JumpcadError, OverflowError)
"""A dead point, or figures far from all that was built."""


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
        Of the score and of each limit's margin; see `Tier`.
    """

    rows: int
    coefficients: Mapping[str, Array]
    errors: Mapping[str, float]

    def to_record(self) -> dict[str, Any]:
        """Return plain data, as the study keeps it."""
        coefficients = {name: values.tolist() for name, values in self.coefficients.items()}
        return {"rows": self.rows, "coefficients": coefficients, "errors": dict(self.errors)}

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Self:
        """Return the fit that was kept."""
        coefficients = {name: np.array(values) for name, values in record["coefficients"].items()}
        return cls(record["rows"], coefficients, record["errors"])

    @cached_property
    def _names(self) -> list[str]:
        return list(self.coefficients)

    @cached_property
    def _matrix(self) -> Array:
        return np.array(list(self.coefficients.values()))

    def predict(self, unit: Array, laid: Mapping[str, float] = NOTHING) -> dict[str, float]:
        """Return figures and margins at a point (d,) of the unit cube, of a robot with these figures of its layout."""
        row = np.append(features(unit[None])[0], of_layout(laid) if laid else [])
        values = (self._matrix * row).sum(axis=1)
        return figures_of(dict(zip(self._names, values.tolist(), strict=True)))


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
        self.objective = objective
        self.like = build(first.design, model.varied(first.workshop).workshop)

    @classmethod
    def quick(cls, space: Space, model: RobotModel, objective: Objective, first: Trial) -> Self:
        """Return one with the engine and the settings of guesses."""
        return cls(space, replace(model, settings=model.guess_settings), objective, model.guess_engine, first)

    def __call__(self, one: Variant, fit: Fit, laid: Mapping[str, float] = NOTHING) -> Guess | None:
        """Return what a variant would do; None where its jump cannot be guessed. `laid`: figures of its layout."""
        try:
            return self._guessed(one.design, fit.predict(self.space.to_unit(one), laid))
        except IMPOSSIBLE:
            return None

    def from_columns(self, design: Design, columns: Mapping[str, float]) -> Guess | None:
        """Return what a design with these values of fitted columns would do; None where it cannot be guessed."""
        try:
            return self._guessed(design, figures_of(columns))
        except IMPOSSIBLE:
            return None

    def _guessed(self, design: Design, figures: Mapping[str, float]) -> Guess:
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
        return Guess(self.objective.score(Evaluation("jump", found)) or 0.0, margins)
