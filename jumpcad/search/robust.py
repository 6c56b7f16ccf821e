"""The robust pick: of the best designs, the one whose neighbours jump well too; and the cost of its active bounds.

Near some designs a thousandth of one parameter decides whether they jump; a printer is not that accurate.
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.stats import qmc

from jumpcad.design import PARAMETERS, Design
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.margin import propose_robust
from jumpcad.search.parameter import physical_limits
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial, feasible_trials
from jumpcad.transforms import Array

TENS = 3
"""Largest number of groups of ten, best first, that are examined."""
KEPT = 0.9
"""A robust score of this share of the best score ends the examination."""
SAMPLES = 16
PERCENT = 1.0
PERCENTILE = 10
APART = 0.02
WIDENING = 0.05


@dataclass(frozen=True, repr=False)
class Candidate:
    """A design among the best, and how well its neighbours jump.

    ``parameters_score`` and ``print_score`` are the 10th percentiles of the score when every parameter varies by ±1 %,
    and when every length varies by the tolerance of print and assembly; a rejected neighbour counts 0.
    ``rejections`` counts why neighbours were rejected.
    """

    trial: Trial
    parameters_score: float
    print_score: float
    rejections: dict[str, int]

    @property
    def robust_score(self) -> float:
        """The lower of both percentiles; candidates are ranked by it."""
        return min(self.parameters_score, self.print_score)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return {
            "score": self.trial.score,
            "robust_score": self.robust_score,
            "parameters_score": self.parameters_score,
            "print_score": self.print_score,
            "refusals": self.rejections,
            "design": self.trial.design.model_dump(),
        }

    def __repr__(self) -> str:
        rejected = sum(self.rejections.values())
        return (
            f"<Candidate: score {self.trial.score:.4g}, neighbours {self.robust_score:.4g}, "
            f"{rejected} of {2 * SAMPLES} rejected>"
        )


@dataclass(frozen=True)
class ActiveBound:
    """A bound of the search on which a design lies.

    ``worth`` is the change of the score if the parameter goes ``beyond`` it, the others unchanged; None where that
    design is rejected, for ``reason``.
    """

    name: str
    side: str
    value: float
    beyond: float
    worth: float | None
    reason: str = ""


def rank_candidates(evaluator: Evaluator, trials: Sequence[Trial], seed: int, tolerance_mm: float) -> list[Candidate]:
    """Evaluate the neighbours of the best of some trials and return these, most robust first.

    The best often lies on a constraint. If one of its neighbours is rejected, a few designs at a distance from the
    constraint join the first ten; if none of all these keeps most of the best score, the next tens follow.
    """
    chosen = best_apart(evaluator.space, trials, TENS * 10)
    tens = [chosen[start : start + 10] for start in range(0, len(chosen), 10)]
    first = (TENS + 1) * len(trials)
    candidates: list[Candidate] = []
    for turn, ten in enumerate(tens):
        candidates += _examined(evaluator, ten, first + turn, seed, tolerance_mm)
        if turn == 0 and candidates[0].rejections:
            off_edge = propose_robust(evaluator, trials, first, seed, PERCENT / 100.0 / math.sqrt(3.0))
            feasible = [trial for trial in off_edge if trial.score is not None]
            candidates += _examined(evaluator, feasible, first + TENS, seed, tolerance_mm)
        if max(candidate.robust_score for candidate in candidates) >= KEPT * (chosen[0].score or 0.0):
            break
    return sorted(candidates, key=lambda candidate: -candidate.robust_score)


def _examined(
    evaluator: Evaluator, chosen: Sequence[Trial], step: int, seed: int, tolerance_mm: float
) -> list[Candidate]:
    """Return candidates made of trials and the outcomes of their neighbours."""
    neighbours: list[tuple[int, str, Design]] = []
    for index, trial in enumerate(chosen):
        generator = np.random.default_rng([seed, 4, index])
        for kind, designs in (
            ("parameters", varied_parameters(trial.design, generator)),
            ("print", varied_lengths(trial.design, tolerance_mm, generator)),
        ):
            neighbours += [(index, kind, design) for design in designs]
    found = evaluator.evaluate([design for _, _, design in neighbours], "robust", step)
    candidates = []
    for index, trial in enumerate(chosen):
        scores: dict[str, list[float]] = {"parameters": [], "print": []}
        rejections: Counter[str] = Counter()
        for (owner, kind, _), neighbour in zip(neighbours, found, strict=True):
            if owner == index and neighbour is not None:
                scores[kind].append(neighbour.score or 0.0)
                rejections.update(neighbour.evaluation.reasons)
        tenth = {kind: float(np.percentile(values, PERCENTILE)) for kind, values in scores.items()}
        candidates.append(Candidate(trial, tenth["parameters"], tenth["print"], dict(sorted(rejections.items()))))
    return candidates


def best_apart(space: Space, trials: Sequence[Trial], count: int) -> list[Trial]:
    """Return the best feasible trials that differ by at least a fiftieth of a range in some parameter, best first."""
    chosen: list[Trial] = []
    for trial in feasible_trials(trials):
        unit = space.to_unit(trial.design)
        if all(np.abs(unit - space.to_unit(other.design)).max() >= APART for other in chosen):
            chosen.append(trial)
        if len(chosen) == count:
            break
    return chosen


def varied_parameters(design: Design, generator: np.random.Generator) -> list[Design]:
    """Return designs with every parameter varied evenly within ±1 %, and within a design's limits."""
    factors = 1.0 + PERCENT / 100.0 * _even(len(PARAMETERS), generator)
    return [_clipped(np.array(design.to_vector()) * factor) for factor in factors]


def varied_lengths(design: Design, tolerance_mm: float, generator: np.random.Generator) -> list[Design]:
    """Return designs whose links l2…l5 each vary evenly within a tolerance (mm)."""
    lengths = np.array([design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm])
    varied = []
    for error in tolerance_mm * _even(4, generator):
        l2, l3, l4, l5 = lengths + error
        varied.append(_clipped(np.array([l2, l3 / l2, l4 / l2, l5 / l2, *design.to_vector()[4:]])))
    return varied


def active_bounds(evaluator: Evaluator, trial: Trial, step: int) -> list[ActiveBound]:
    """Return the bounds on which a design lies, each with the change of the score a twentieth of the range beyond it.

    Bounds that are also limits of a design are left out.
    """
    found = []
    for parameter in evaluator.space.free:
        value = getattr(trial.design, parameter.name)
        lowest, highest = physical_limits(parameter.name)
        reach = WIDENING * parameter.width
        for side, bound, beyond in (
            ("lower", parameter.lower, max(lowest, parameter.lower - reach)),
            ("upper", parameter.upper, min(highest, parameter.upper + reach)),
        ):
            if abs(value - bound) <= 1e-3 * parameter.width and beyond != bound:
                found.append(ActiveBound(parameter.name, side, bound, beyond, None))
    designs = [trial.design.model_copy(update={bound.name: bound.beyond}) for bound in found]
    trials = evaluator.evaluate(designs, "bounds", step)
    return [_worth(bound, trial, beyond) for bound, beyond in zip(found, trials, strict=True) if beyond is not None]


def _worth(bound: ActiveBound, trial: Trial, beyond: Trial) -> ActiveBound:
    if beyond.score is None:
        return replace(bound, reason=", ".join(beyond.evaluation.reasons))
    return replace(bound, worth=beyond.score - (trial.score or 0.0))


def _even(dimension: int, generator: np.random.Generator) -> Array:
    """Return evenly spread points (SAMPLES, dimension) of the cube from -1 to 1."""
    points: Array = qmc.Sobol(dimension, seed=generator).random(SAMPLES)
    return 2.0 * points - 1.0


def _clipped(vector: Array) -> Design:
    limits = np.array([physical_limits(name) for name in PARAMETERS])
    return Design.from_vector(np.clip(vector, limits[:, 0], limits[:, 1]).tolist())
