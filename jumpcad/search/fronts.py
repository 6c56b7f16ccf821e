"""Fronts of score against a cost: the costs by name, the trials on a front, and a measure of the whole front."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.search.study.objective import OBJECTIVES, Objective
from jumpcad.search.study.trial import Trial
from jumpcad.transforms import Array

REFERENCE_ENERGY_J = 1.5
"""Energy of the hypervolume's reference point, whose score is 0."""


@check_arguments
def energy_j(design: Design) -> float:
    """Return the energy of a design's loaded springs (J); infinite if it has no assembled pose."""
    try:
        return design.spring_energy_j
    except CannotBuildError:
        return np.inf


def energies_j(values: Array) -> Array:
    """Return the energies (n,) of designs given as vectors (n, 8), as `energy_j` does of each; see `Design`."""
    l2, c, d, _, ratio, rest_deg, stiffness_nmm_per_deg, _ = values.T
    rest, l3, l4 = np.radians(rest_deg), c * l2, d * l2
    rise, surplus = (l3 - l2) * np.sin(rest), l3 - l2
    assembled = l4 > np.maximum(np.abs(rise), surplus)
    # not numpy's arcsine, whose last digit differs between processors
    beta = np.array([math.asin(sine) for sine in np.where(assembled, rise / l4, 0.0).tolist()])
    stiffness = stiffness_nmm_per_deg * 180.0 / np.pi / 1000.0
    return np.asarray(np.where(assembled, 0.5 * stiffness * (ratio * (rest + beta)) ** 2, np.inf))


@dataclass(frozen=True)
class Cost:
    """What a front weighs the score against.

    `reference` is that of the hypervolume's reference point, `worst` what a rejected design counts as; both as `of`
    gives them.
    """

    figure: Objective
    reference: float
    worst: float
    less_is_better: bool = True  # else a front seeks more of both
    of_design: Callable[[Design], float] | None = None  # where it is a closed form of the design

    @property
    def name(self) -> str:
        return self.figure.name

    def of(self, trial: Trial) -> float:
        """Return what is to be small: the figure, or its negative; infinite where a trial has none."""
        if self.of_design is not None:
            return self.of_design(trial.design)
        try:
            figure = float(self.figure.figure(trial.evaluation.metrics))
        except (KeyError, ZeroDivisionError):
            return math.inf
        return figure if self.less_is_better else -figure

    def shown(self, cost: float) -> float:
        """Return the figure of a cost, as people read it."""
        return cost if self.less_is_better else 0.0 - cost

    def describe(self) -> dict[str, str]:
        """Return what a study remembers of it: nothing of energy in the springs, which it need not name."""
        return {} if self is SPRING_ENERGY else {"against": self.name}


SPRING_ENERGY = Cost(
    Objective("spring-energy", "energy in the springs", "J", lambda m: m["spring_energy_j"]),
    REFERENCE_ENERGY_J, 10.0, of_design=energy_j,
)  # fmt: skip
ELECTRICAL_ENERGY = Cost(
    Objective("electrical-energy", "electrical energy of a winding", "J", lambda m: m["electrical_energy_j"]),
    20.0, 200.0,
)  # fmt: skip
COSTS: Mapping[str, Cost] = {
    cost.name: cost
    for cost in (
        ELECTRICAL_ENERGY,
        SPRING_ENERGY,
        Cost(Objective("mass", "mass", "kg", lambda m: m["mass_kg"]), 0.3, 3.0),
        Cost(Objective("winding-time", "time of a winding", "s", lambda m: m["winding_time_s"]), 30.0, 300.0),
    )
}
"""By name; the reference points are beyond what robots within the default bounds have."""


def find_cost(name: str) -> Cost:
    """Return a cost by its name, or for the name of an objective the cost of having less of it."""
    if name in COSTS:
        return COSTS[name]
    if name in OBJECTIVES:
        return Cost(OBJECTIVES[name], 0.0, 10.0, less_is_better=False)
    known = [*COSTS, *OBJECTIVES]
    raise JumpcadError(f"against = {name!r} is none of {', '.join(known)}{did_you_mean(name, known)}")


def described_cost(identity: Mapping[str, Any]) -> Cost:
    """Return the cost of a study by what it remembers."""
    return find_cost(identity.get("against", SPRING_ENERGY.name))


@check_arguments
def front(trials: Sequence[Trial], cost: Cost = SPRING_ENERGY) -> list[Trial]:
    """Return the trials whose score no other trial reaches at less cost, sorted by cost.

    Where a score is above 0, those that are not are left out: a jump backwards is no cheap jump.
    """
    scored = [trial for trial in trials if trial.score is not None]
    best, chosen = 0.0 if any((trial.score or 0.0) > 0.0 for trial in scored) else -math.inf, []
    for trial in sorted(scored, key=lambda trial: (cost.of(trial), -(trial.score or 0.0))):
        if trial.score is not None and trial.score > best:
            best = trial.score
            chosen.append(trial)
    return chosen


@check_arguments
def hypervolume(trials: Sequence[Trial], reference: float | None = None, cost: Cost = SPRING_ENERGY) -> float:
    """Return the area that a front dominates, from score 0 and a reference cost (score units times those of the cost).

    Without a reference it is the cost's own, as `Cost.of` gives costs.
    """
    last = cost.reference if reference is None else reference
    chosen = [trial for trial in front(trials, cost) if cost.of(trial) < last and (trial.score or 0.0) > 0.0]
    ends = [cost.of(trial) for trial in chosen[1:]] + [last]
    return sum((trial.score or 0.0) * (end - cost.of(trial)) for trial, end in zip(chosen, ends, strict=False))
