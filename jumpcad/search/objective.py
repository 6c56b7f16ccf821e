"""The outcome of one evaluation, and the score that an objective gives it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from jumpcad.arguments import typed
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.findings import Finding, errors

QUARANTINED = "quarantined"
"""Verdict of a design whose evaluation failed twice: ended its worker, or ran past its limit."""


@dataclass(frozen=True, repr=False)
class Evaluation:
    """The outcome of evaluating one design.

    ``metrics`` are named figures with the unit in the name; ``findings`` hold the margins of all limits that were
    checked before the verdict; ``detail`` adds what verdict and findings do not say.
    """

    verdict: str
    metrics: Mapping[str, float] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    detail: str = ""

    @property
    def feasible(self) -> bool:
        """Whether the design jumps and no finding is an error."""
        return self.verdict == "jump" and not errors(self.findings)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Names of the findings that reject the design; the verdict if there is none."""
        names = tuple(dict.fromkeys(finding.name for finding in errors(self.findings)))
        return names or (() if self.feasible else (self.verdict,))

    def __repr__(self) -> str:
        outcome = "feasible" if self.feasible else f"rejected by {' '.join(self.reasons)[:80]}"
        return f"<Evaluation {self.verdict}: {outcome}, fitness {self.metrics.get('fitness', 0.0):.4g}>"


class Model(Protocol):
    """What evaluates designs: a picklable, pure function of the design."""

    def __call__(self, design: Design, /) -> Evaluation:
        """Evaluate a design. Raises `JumpcadError` only if no design would work."""

    def admits(self, design: Design, /) -> bool:
        """Whether a design is worth an evaluation, as far as that is known within microseconds."""

    def describe(self) -> dict[str, Any]:
        """Return all that decides an evaluation, as plain data."""

    def versions(self) -> dict[str, str]:
        """Return the versions of the packages that decide an evaluation."""

    @property
    def digest(self) -> str:
        """A hash of description and versions."""


@dataclass(frozen=True)
class Objective:
    """A score to be maximised; a rejected design has none."""

    name: str
    meaning: str
    unit: str
    figure: Callable[[Mapping[str, float]], float]

    def score(self, evaluation: Evaluation) -> float | None:
        """Return the score of a feasible evaluation, None of a rejected one.

        Raises
        ------
        JumpcadError
            If the model behind the evaluation does not give the figures that the objective needs, or one of them is 0
            where it divides.
        """
        if not evaluation.feasible:
            return None
        try:
            return float(self.figure(evaluation.metrics))
        except ZeroDivisionError:
            raise JumpcadError(
                f"the objective {self.name} of an evaluation divides by 0: its figures are wrong"
            ) from None
        except KeyError as missing:
            raise JumpcadError(
                f"the objective {self.name} needs {missing.args[0]}, which this model does not give: "
                f"choose another --objective or --model"
            ) from None


def _range_m(metrics: Mapping[str, float]) -> float:
    # The published model has no ballistic range; its base distance is what its study calls distance.
    return metrics["base_distance_m"] if "base_distance_m" in metrics else metrics["ballistic_range_m"]


def _range_per_joule(metrics: Mapping[str, float]) -> float:
    return _range_m(metrics) / metrics["spring_energy_j"]


OBJECTIVES: dict[str, Objective] = {
    objective.name: objective
    for objective in (
        Objective("fitness", "range over the longest link", "body lengths", lambda m: m["fitness"]),
        Objective("range", "range of the jump", "m", _range_m),
        Objective("rise", "rise of the centre of mass", "m", lambda m: m["com_rise_m"]),
        Objective("range-per-joule", "range per joule in the springs", "m/J", _range_per_joule),
        Objective("jumps-per-joule", "jumps per joule of electricity", "1/J", lambda m: 1.0 / m["electrical_energy_j"]),
    )
}


@typed
def find_objective(name: str) -> Objective:
    """Return an objective by its name."""
    if name not in OBJECTIVES:
        raise JumpcadError(
            f"{name!r} is not one of the objectives {', '.join(OBJECTIVES)}{did_you_mean(name, OBJECTIVES)}"
        )
    return OBJECTIVES[name]
