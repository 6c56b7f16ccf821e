"""The robust pick: of the best designs, the one whose neighbours jump well too; and the cost of its active bounds.

Most candidates are soon known to be worse than others, so few neighbours are spent on them. Near some designs a
thousandth of one parameter decides whether they jump; a printer is not that accurate.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import AfterValidator, ConfigDict, PlainSerializer

from jumpcad.design import PARAMETERS
from jumpcad.search.parameter import physical_limits
from jumpcad.search.space import Space, apart
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Figure, Reason
from jumpcad.search.study.trial import Count, Position, Trial, feasible_trials
from jumpcad.search.study.variant import SAMPLES, Tolerances, Variant, tenth

MOST_CANDIDATES = 16
"""Designs that the first round examines, at most."""
APART = 0.02
"""Least difference between two candidates in some parameter, over its range; judgement."""
ACTIVE = 1e-3
"""Largest distance from a bound that is active, over its range; judgement."""
WIDENING = 0.05
"""How far beyond an active bound a design is evaluated, over the bound's range; judgement."""
NOT_EXAMINED = "not examined: the robust pick has no evaluations or time left"
if TYPE_CHECKING:
    Kept = Trial
else:  # a study, which reads it, keeps its position
    Kept = Annotated[
        Position,
        AfterValidator(lambda position, reading: reading.context.trial(position)),
        PlainSerializer(lambda trial: trial.position),
    ]


@dataclass(frozen=True, repr=False)
class Candidate:
    """A design among the best, and how well its neighbours jump.

    ``parameters_score`` and ``print_score`` are the 10th percentiles of the score when every parameter varies by ±1 %,
    and within the tolerances of making: printed lengths, springs' rate, mass and the floor's friction. Each is the
    lowest of ten neighbours or fewer, and a rejected one counts 0, or less than any other where some are negative; one
    that only misses what was required counts half.
    ``rejections`` counts why neighbours were rejected, of ``neighbours`` that were evaluated, half of each kind. The
    design ``fails`` where a percentile is no more than a rejected one's score: it may not jump as it is made.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    trial: Kept
    parameters_score: Figure
    print_score: Figure
    rejections: dict[Reason, Count]
    neighbours: Count
    fails: bool = False

    @property
    def robust_score(self) -> float:
        """The lower of both percentiles; candidates are ranked by it."""
        return min(self.parameters_score, self.print_score)

    def to_dict(self) -> dict[str, Any]:
        return {
            "score": self.trial.score, "robust_score": self.robust_score, "parameters_score": self.parameters_score,
            "print_score": self.print_score, "refusals": self.rejections, "neighbours": self.neighbours,
            "fails": self.fails, "design": self.trial.design.model_dump(),
            **({"workshop": dict(self.trial.workshop)} if self.trial.workshop else {}),
        }  # fmt: skip

    def __repr__(self) -> str:
        rejected = f"{sum(self.rejections.values())} of {self.neighbours} rejected"
        return f"<Candidate: score {self.trial.score:.4g}, neighbours {self.robust_score:.4g}, {rejected}>"


@dataclass(frozen=True)
class ActiveBound:
    """A bound of the search on which a design lies.

    ``worth`` is the change of the score if the parameter goes ``beyond`` it, the others unchanged; None where that
    design is rejected, for ``reason``, or `unknown`.
    """

    name: str
    side: str
    value: float
    beyond: float
    worth: float | None
    reason: str = ""

    @property
    def unknown(self) -> bool:
        """Whether the design beyond it was not evaluated; the reason says why."""
        return self.reason == NOT_EXAMINED


def plan_rounds(evaluations: int) -> list[tuple[int, int]]:
    """Return candidates and new neighbours of each, round by round: every round halves the candidates.

    As many candidates as get two neighbours in every round; what a round leaves over goes to the next ones.
    """
    count = MOST_CANDIDATES
    while count > 1 and 2 * count * count.bit_length() > evaluations:
        count //= 2
    rounds, left, had = [], evaluations, 0
    while count:
        new = min(left // count.bit_length() // count, 2 * SAMPLES - had) // 2 * 2
        rounds.append((count, new))
        left, had, count = left - count * new, had + new, count // 2
    return rounds


def rank_candidates(
    evaluator: Evaluator, trials: Sequence[Trial], seed: int, evaluations: int, run: int = 0
) -> list[Candidate]:
    """Evaluate neighbours of the best of some trials, and return these, those that got farthest and do not fail first.

    Successive halving: the more robust half of the candidates gets more neighbours, until one is left. `run` is the
    number of this pick in the study, `evaluations` the most that it takes.
    """
    rounds = plan_rounds(evaluations)
    field = [_Examined(index, one) for index, one in enumerate(best_apart(evaluator.space, trials, rounds[0][0]))]
    left: list[_Examined] = []
    for turn, (count, new) in enumerate(rounds if field else ()):  # nothing jumps
        ranked = _ranked(field, left)
        field, left = ranked[:count], ranked[count:]
        _examine(evaluator, field, new, (run, turn), seed)
    return [one.candidate() for one in _ranked(field, left) if one.examined]


def _ranked(field: Sequence["_Examined"], left: Sequence["_Examined"]) -> list["_Examined"]:
    """Return all candidates, the most robust first, by as many neighbours of each as all of the field have.

    Who got further has been examined more, and stands before those that were left behind, unless it fails.
    """
    shared = min((one.examined for one in field), default=0) // 2
    ranked = [*sorted(field, key=lambda one: -one.robust_score(shared)), *left]
    return sorted(ranked, key=lambda one: one.fails)


class _Examined:
    """A candidate and what is known of its neighbours so far."""

    def __init__(self, index: int, trial: Trial) -> None:
        self.index, self.trial = index, trial
        self.scores: dict[str, list[float]] = {"parameters": [], "print": []}
        self.rejections: Counter[str] = Counter()
        self.rejected_score = 0.0

    @property
    def fails(self) -> bool:
        """Whether the lower percentile of its neighbours is no more than a rejected one's score."""
        return self.examined > 0 and self.robust_score() <= self.rejected_score

    @property
    def examined(self) -> int:
        """How many neighbours are known."""
        return sum(map(len, self.scores.values()))

    def robust_score(self, most: int | None = None) -> float:
        """Return the lower percentile of at most so many neighbours of each kind; the own score where none is known."""
        return min(self._tenth(kind, most) for kind in self.scores)

    def neighbours(self, new: int, seed: int, making: Tolerances) -> list[tuple[str, Variant]]:
        """Return the next neighbours, half of each kind."""
        generator = np.random.default_rng([seed, 4, self.index])
        one = self.trial.variant
        kinds = {"parameters": making.varied(one, generator), "print": making.neighbours(one, generator)}
        start, end = self.examined // 2, (self.examined + new) // 2
        return [(kind, variant) for kind, variants in kinds.items() for variant in variants[start:end]]

    def candidate(self) -> Candidate:
        percentiles = self._tenth("parameters"), self._tenth("print")
        return Candidate(self.trial, *percentiles, dict(sorted(self.rejections.items())), self.examined, self.fails)

    def _tenth(self, kind: str, most: int | None = None) -> float:
        scores = self.scores[kind][:most]
        return tenth(scores) if scores else self.trial.score or 0.0


def _examine(evaluator: Evaluator, field: Sequence[_Examined], new: int, at: tuple[int, int], seed: int) -> None:
    """Evaluate `new` more neighbours of each, in a run and step of the pick.

    A rejected one scores 0, or where some score is negative as far below the worst as the best is above it; one that
    only misses what was required, by the scatter of what is made, half of its score.
    """
    run, step = at
    making = evaluator.model.making
    asked = [(one, *neighbour) for one in field for neighbour in one.neighbours(new, seed, making)]
    limit = 0 if evaluator.expired() else None
    found = evaluator.evaluate([variant for _, _, variant in asked], "robust", step, limit, run=run)
    scores = [trial.score for trial in evaluator.trials if trial.score is not None]
    rejected = 2.0 * min(scores) - max(scores) if min(scores) < 0.0 else 0.0
    for (one, kind, _), trial in zip(asked, found, strict=True):
        if trial is not None:
            one.rejected_score = rejected
            score = evaluator.unrequired(trial)
            score = rejected if score is None else score
            one.scores[kind].append(score if trial.score is not None else (rejected + score) / 2.0)
            one.rejections.update(trial.evaluation.reasons)


def best_apart(space: Space, trials: Sequence[Trial], count: int) -> list[Trial]:
    """Return the best feasible trials that differ by at least a fiftieth of a range in some parameter, best first."""
    ranked = feasible_trials(trials)
    return [ranked[index] for index in apart((space.to_unit(one.variant) for one in ranked), APART, count)]


def named_bounds(space: Space, trial: Trial) -> list[ActiveBound]:
    """Return the bounds on which a design lies, but for those that are also limits of a design; none is examined."""
    found = []
    for parameter in space.free:
        if parameter.names or (parameter.choices and parameter in space.of_workshop):
            continue  # choices of a workshop end where it ends
        value = parameter.number(trial.variant.value(parameter.name))
        lowest, highest = physical_limits(parameter.name)
        reach = WIDENING * parameter.width
        for side, bound, beyond in (
            ("lower", parameter.lower, max(lowest, parameter.lower - reach)),
            ("upper", parameter.upper, min(highest, parameter.upper + reach)),
        ):
            if abs(value - bound) <= ACTIVE * parameter.width and beyond != bound:
                found.append(ActiveBound(parameter.name, side, bound, beyond, None, NOT_EXAMINED))
    return found


def active_bounds(
    evaluator: Evaluator, trial: Trial, evaluations: int = len(PARAMETERS), run: int = 0
) -> list[ActiveBound]:
    """Return the bounds on which a design lies, each with the change of the score a twentieth of the range beyond it.

    At most `evaluations` are examined, the others only named; `run` is the number of this pick in the study.
    """
    found = named_bounds(evaluator.space, trial)
    evaluations = 0 if evaluator.expired() else evaluations
    variants = [trial.variant.changed({bound.name: bound.beyond}) for bound in found]
    trials = evaluator.evaluate(variants, "bounds", 0, limit=evaluations, run=run)
    for place, beyond in enumerate(trials):
        if beyond is not None:
            worth = None if beyond.score is None else beyond.score - (trial.score or 0.0)
            reason = ", ".join(beyond.evaluation.reasons)
            found[place] = replace(found[place], worth=worth, reason=reason)
    return found
