"""`Trial`: one finished evaluation of a search, and questions about many of them."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from jumpcad.design import Design
from jumpcad.search.methods import METHODS
from jumpcad.search.objective import Evaluation
from jumpcad.search.variant import Key, Variant
from jumpcad.workshop.varied import Value

PHASES = ("sample", "sweep", *METHODS, "widen", "margin", "bounds", "robust")
"""All phases, in the order in which a study goes through them; the last three examine designs near the best."""
SEARCH_PHASES = PHASES[:-3]
LEARNING_PHASES = tuple(name for name, method in METHODS.items() if method.learns)
"""Phases that, after a first step, start from the hyperparameters of the step before."""


@dataclass(frozen=True, repr=False)
class Trial:
    """One finished evaluation: where and why the search proposed the design, the outcome, and the score.

    Parameters
    ----------
    phase, step, place
        Where in the search the design was proposed.
    design, evaluation
        What was evaluated, and the outcome.
    score
        By the study's objective; None where the design is rejected.
    model
        Digest of the model that evaluated it.
    duration_s
        How long that took.
    proposal
        What the method predicted when it proposed the design.
    workshop
        Values of the workshop that the search varies, by key.
    """

    phase: str
    step: int
    place: int
    design: Design
    evaluation: Evaluation
    score: float | None
    model: str
    duration_s: float
    proposal: Mapping[str, Any] = field(default_factory=dict)
    workshop: Mapping[str, Value] = field(default_factory=dict)

    @cached_property
    def key(self) -> Key:
        """What identifies what was evaluated."""
        return self.variant.key

    @property
    def variant(self) -> Variant:
        """What was evaluated: the design, in the workshop with its values."""
        return Variant(self.design, self.workshop)

    @property
    def cost(self) -> int:
        """How many robots were built and simulated for it."""
        return self.evaluation.cost

    @property
    def position(self) -> tuple[int, int, int]:
        """Where the trial stands in its study."""
        return PHASES.index(self.phase), self.step, self.place

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        evaluation = self.evaluation
        margins = {one.name: {"margin": one.margin, "unit": one.unit} for one in evaluation.findings}
        return {
            "phase": self.phase,
            "score": self.score,
            "fitness": evaluation.metrics.get("fitness") if evaluation.feasible else 0.0,
            "verdict": evaluation.verdict,
            "detail": evaluation.detail,
            "design": self.design.model_dump(),
            **({"workshop": dict(self.workshop)} if self.workshop else {}),
            "metrics": dict(evaluation.metrics),
            "margins": margins,
        }

    def __repr__(self) -> str:
        outcome = " ".join(self.evaluation.reasons)[:80] if self.score is None else f"score {self.score:.4g}"
        return f"<Trial {self.phase} {self.step}.{self.place}: {outcome}>"


def feasible_trials(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that have a score, best first; of equals, the first."""
    return sorted((trial for trial in trials if trial.score is not None), key=lambda trial: -(trial.score or 0.0))


def best_trial(trials: Sequence[Trial]) -> Trial | None:
    """Return the trial with the highest score, the first of equals; None where every design is rejected."""
    return next(iter(feasible_trials(trials)), None)


def searched(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that the search proposed, without those of the robust pick and the active bounds."""
    return [trial for trial in trials if trial.phase in SEARCH_PHASES]


def count_rejections(trials: Sequence[Trial]) -> dict[str, int]:
    """Return how many trials each reason rejected, most frequent first."""
    return dict(Counter(reason for trial in trials for reason in trial.evaluation.reasons).most_common())
