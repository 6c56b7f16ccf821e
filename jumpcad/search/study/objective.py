"""The outcome of one evaluation, and the score that an objective gives it."""

import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, ConfigDict, Field, PlainSerializer

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files import did_you_mean
from jumpcad.findings import Finding, Severity, bare, errors, least
from jumpcad.search.study.own_objective import LARGEST, SUFFIX, TriedFigures, own_function

Word = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,79}$")]
"""A name of a verdict or figure."""
Reason = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,79}([<>]=-?[0-9][0-9.e+-]{0,24})?$")]
"""A name of a finding: a word, or a requirement as `Requirement.findings` names it."""
Figure = Annotated[float, Field(ge=-LARGEST, le=LARGEST)]
Margin = Annotated[float, Field(ge=float("-inf"))]  # not NaN; infinite is that of a run that diverged
if TYPE_CHECKING:
    Findings = tuple[Finding, ...]
else:  # a study keeps name, severity, margin and unit of each
    Findings = Annotated[
        list[tuple[Reason, Severity, Margin, str]],
        AfterValidator(lambda rows: tuple(bare(*row) for row in rows)),
        PlainSerializer(lambda findings: [(one.name, one.severity, one.margin, one.unit) for one in findings]),
    ]

SCREENED, GUESSED = "screened", "guessed_score"
"""Verdict of a candidate that a screen left out, and the figure that it had for its score."""
CANNOT_BUILD = "cannot_build"
"""Verdict of a design that has no robot."""
OWN_UNIT = "own units"
"""Of an own objective without a unit."""
EQUALS = "="
"""In the name of a finding that a requirement has, and in no other."""
QUARANTINED = "quarantined"
"""Verdict of a design whose evaluation failed twice: ended its worker, or ran past its limit."""


@dataclass(frozen=True, repr=False)
class Evaluation:
    """The outcome of evaluating one design.

    ``metrics`` are named figures with the unit in the name; ``findings`` hold the margins of all limits that were
    checked before the verdict; ``detail`` adds what verdict and findings do not say.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    verdict: Word
    metrics: Mapping[Word, Figure] = field(default_factory=dict)
    findings: Findings = ()
    detail: str = ""

    @property
    def feasible(self) -> bool:
        """Whether the design jumps and no finding is an error."""
        return self.verdict == "jump" and not errors(self.findings)

    @cached_property
    def reasons(self) -> tuple[str, ...]:
        """Names of the findings that reject the design; the verdict if there is none."""
        names = tuple(dict.fromkeys(finding.name for finding in errors(self.findings)))
        return names or (() if self.feasible else (self.verdict,))

    @cached_property
    def only_misses_required(self) -> bool:
        """Whether it jumps and keeps all limits, but misses what is required."""
        return self.verdict == "jump" and not self.feasible and all(EQUALS in reason for reason in self.reasons)

    @cached_property
    def margins(self) -> Mapping[str, float]:
        """The least margin of each limit, by name."""
        return {name: one.margin for name, one in least(self.findings).items()}

    @cached_property
    def met(self) -> frozenset[str]:
        """Names of limits that some part meets."""
        return frozenset(one.name for one in self.findings if one.severity != "error")

    @cached_property
    def missed(self) -> frozenset[str]:
        """Names of limits that some part does not meet."""
        return frozenset(one.name for one in errors(self.findings))

    @property
    def bare(self) -> "Evaluation":
        """What studies keep: findings of name, severity, unit and six digits of margin only, without what is no number.

        Ninety findings with their texts are 30 kB; who wants to read them evaluates the design again.
        """
        margins = [-math.inf if math.isnan(one.margin) else float(f"{one.margin:.6g}") for one in self.findings]
        kept = [bare(one.name, one.severity, to, one.unit) for one, to in zip(self.findings, margins, strict=True)]
        figures = {name: value for name, value in self.metrics.items() if -LARGEST <= value <= LARGEST}  # nor is NaN
        return replace(self, findings=tuple(kept), metrics=figures)

    def __repr__(self) -> str:
        outcome = "feasible" if self.feasible else f"rejected by {' '.join(self.reasons)[:80]}"
        return f"<Evaluation {self.verdict}: {outcome}, fitness {self.metrics.get('fitness', 0.0):.4g}>"


@dataclass(frozen=True)
class Objective:
    """A score to be maximised; a rejected design has none. ``code`` is the hash of an own objective's function."""

    name: str
    meaning: str
    unit: str
    figure: Callable[[Mapping[str, float]], float]
    code: str = ""

    def __reduce__(self) -> tuple[Any, ...]:
        """Be pickled as a study keeps it: by name, and an own one without its function."""
        return described_objective, (self.describe(),)

    def describe(self) -> dict[str, str]:
        """Return what a study remembers of it."""
        own = {"objective_code": self.code, "objective_unit": self.unit} if self.code else {}
        return {"objective": self.name} | {key: value for key, value in own.items() if value != OWN_UNIT}

    def shown(self, score: float) -> str:
        """Return a score with its unit, if that is known."""
        return f"{score:.6g}" if self.unit == OWN_UNIT else f"{score:.6g} {self.unit}"

    def score(self, evaluation: Evaluation) -> float | None:
        """Return the score of a feasible evaluation, None of a rejected one."""
        return self.unrequired(evaluation) if evaluation.feasible else None

    def unrequired(self, evaluation: Evaluation) -> float | None:
        """Return the score as if nothing was required; None of what is rejected otherwise. Raises as `score`."""
        if not (evaluation.feasible or evaluation.only_misses_required):
            return None
        try:
            return float(self.figure(evaluation.metrics))
        except (KeyError, ZeroDivisionError) as error:
            why = "divides by 0" if isinstance(error, ZeroDivisionError) else f"lacks {error.args[0]}"
            raise JumpcadError(f"the objective {self.name} of an evaluation {why}: its figures are wrong") from None

    def uses(self, name: str, names: Iterable[str]) -> bool:
        """Whether it asks for one of these figures of a jump."""
        tried = TriedFigures([one for one in names if one != name], 1.0)
        with suppress(JumpcadError, ZeroDivisionError):
            self.figure(tried)
        return name in tried.lacking

    def require(self, names: Iterable[str], what: str = "the objective") -> None:
        """Require that it needs no other figures than these; an own function is tried on figures of 1 and of 0."""
        names = [*names]
        for tried in (TriedFigures(names, 1.0), TriedFigures(names, 0.0)):
            with suppress(JumpcadError, ZeroDivisionError):  # what else these do says nothing of a jump's figures
                self.figure(tried)
            for name in tried.lacking:
                raise JumpcadError(
                    f"{what} {self.name} needs {without_controls(name)[:80]}, which this model does not give"
                    f"{instead_of(name, names)}; `jumpcad list figures` names all"
                )


def instead_of(name: str, names: Iterable[str]) -> str:
    """Return what to take instead of a figure that a model does not give, or which robots have it."""
    from jumpcad.evaluation import FIGURES

    if name in FIGURES:
        return ": printed robots alone have it"
    return did_you_mean(name, names, 0.55) or ": choose another figure or --model"


def _range_m(metrics: Mapping[str, float]) -> float:
    # The published model has no ballistic range; its base distance is what its study calls distance.
    return metrics["base_distance_m"] if "base_distance_m" in metrics else metrics["ballistic_range_m"]


CHARGE = "range × jumps of a full battery, put on its feet each time"
OBJECTIVES: dict[str, Objective] = {
    objective.name: objective
    for objective in (
        Objective("body_lengths", "touchdown over the robot's size", "body lengths", lambda m: m["body_lengths"]),
        Objective("touchdown", "way to the touchdown", "m", lambda m: m["touchdown_distance_m"]),
        Objective("robust", "touchdown that nine of ten robots as made reach", "m", lambda m: m["robust_touchdown_m"]),
        Objective("rest", "way to where it comes to rest", "m", lambda m: m["rest_distance_m"]),
        Objective("fitness", "range over the longest link", "link lengths", lambda m: m["fitness"]),
        Objective("range", "range of the jump", "m", _range_m),
        Objective("rise", "rise of the centre of mass", "m", lambda m: m["com_rise_m"]),
        Objective(
            "range-per-joule", "range per joule of electricity", "m/J", lambda m: _range_m(m) / m["electrical_energy_j"]
        ),
        Objective(
            "range-per-spring-joule", "range per joule in springs", "m/J", lambda m: _range_m(m) / m["spring_energy_j"]
        ),
        Objective("metres-per-charge", CHARGE, "m", lambda m: _range_m(m) * m["jumps_per_charge"]),
        Objective("jumps-per-joule", "jumps per joule of electricity", "1/J", lambda m: 1.0 / m["electrical_energy_j"]),
    )
}


@check_arguments
def find_objective(objective: str | Callable[..., Any]) -> Objective:
    """Return an objective: by its name, as `FILE.py:FUNCTION`, or a function of the figures of a jump."""
    if isinstance(objective, str):
        if objective in OBJECTIVES:
            return OBJECTIVES[objective]
        if f"{SUFFIX}:" not in objective:
            raise JumpcadError(
                f"{objective!r} is not one of the objectives {', '.join(OBJECTIVES)}"
                f"{did_you_mean(objective, OBJECTIVES) or f'; an own one is FILE{SUFFIX}:FUNCTION'}"
            )
    name, figure, code, unit = own_function(objective)
    return _own(name, unit, figure, code)


def described_objective(identity: Mapping[str, Any]) -> Objective:
    """Return the objective of a study for its pictures; the function of an own one is not kept, and does not score."""
    if "objective_code" not in identity:
        return find_objective(identity["objective"])

    def unknown(_metrics: Mapping[str, float]) -> float:
        raise JumpcadError("the study keeps the scores of its own objective, not the function")

    return _own(identity["objective"], identity.get("objective_unit", ""), unknown, identity["objective_code"])


def _own(name: str, unit: str, figure: Callable[[Mapping[str, float]], float], code: str) -> Objective:
    return Objective(name, name if unit else "own objective", unit or OWN_UNIT, figure, code)
