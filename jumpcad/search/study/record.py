"""What a study file holds, as validated data: one record for each trial, and what else a study remembers.

A file may come from elsewhere, or be damaged: what is read has been written by a search, or is refused.
"""

import json
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.files.complaints import shown
from jumpcad.files.names import Name, Text
from jumpcad.findings import Severity, bare
from jumpcad.search.phases import LEARNING_PHASES, METHODS, PHASES
from jumpcad.search.pick.tolerances import MADE
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

KEY = re.compile(r"[^.\x00-\x1f\x7f]{1,80}(\.[^.\x00-\x1f\x7f]{1,80}){1,3}")
"""Dotted keys of a workshop."""
LARGEST = 1e12
"""Above any figure of a jumping robot."""


def _one_of(names: Iterable[str]) -> Callable[[str], str]:
    def require(name: str) -> str:
        if name not in names:
            raise PydanticCustomError("value_error", "is none of {names}", {"names": ", ".join(names)})
        return name

    return require


Phase = Annotated[str, AfterValidator(_one_of(PHASES))]
Count = Annotated[int, Field(ge=0)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Figure = Annotated[float, Field(ge=-LARGEST, le=LARGEST)]
Margin = Annotated[float, Field(ge=float("-inf"))]  # not NaN; infinite is that of a run that diverged
Share = Annotated[float, Field(ge=0, le=1)]
Logarithm = Annotated[float, Field(ge=-100, le=100)]
Word = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,79}$")]
"""Names of verdicts, findings, figures and parameters."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class _Place(_Strict):
    phase: Phase
    run: Count
    step: Count
    place: Count
    score: Figure | None


class _Record(_Strict):
    """What stands of a trial in the column `record`, as JSON; of findings name, severity, margin and unit."""

    design: Annotated[list[float], Field(min_length=len(PARAMETERS), max_length=len(PARAMETERS))]
    workshop: dict[str, Finite | Text]
    model: str
    verdict: Word
    metrics: dict[Word, Figure]
    findings: list[tuple[Word, Severity, Margin, str]]
    detail: str
    proposal: dict[str, Finite | dict[str, list[Logarithm]] | list[list[Share]]]
    duration_s: Figure


COLUMNS = (*_Place.model_fields, "record")
"""Of a row; the position of its trial is the key."""


def to_row(trial: Trial) -> tuple[Any, ...]:
    """Return the columns of a trial."""
    evaluation = trial.evaluation
    record = {
        "design": trial.design.to_vector(),
        "workshop": dict(trial.workshop),
        "model": trial.model,
        "verdict": evaluation.verdict,
        "metrics": dict(evaluation.metrics),
        "findings": [(one.name, one.severity, one.margin, one.unit) for one in evaluation.findings],
        "detail": evaluation.detail,
        "proposal": dict(trial.proposal),
        "duration_s": trial.duration_s,
    }
    return *trial.position, trial.score, json.dumps(record, ensure_ascii=False, separators=(",", ":"))


def read_trial(row: Sequence[Any], free: int, keys: Sequence[str]) -> Trial:
    """Return the trial of a row of a search with so many `free` parameters, and these keys of the workshop.

    Raises
    ------
    JumpcadError
        Naming the row, if no search wrote it.
    """
    try:
        at = validated(_Place.model_validate, "", dict(zip(COLUMNS[:-1], row, strict=False)))
        one = validated(_Record.model_validate_json, "record", row[-1])
        evaluation = Evaluation(one.verdict, one.metrics, tuple(bare(*finding) for finding in one.findings), one.detail)
        trial = Trial(
            at.phase, at.step, at.place, Design.from_vector(one.design), evaluation, at.score, one.model,
            one.duration_s, one.proposal, one.workshop, at.run,
        )  # fmt: skip
        _require_proposal(trial, free)
        made = MADE if trial.phase == "robust" else ()
        if [key for key in trial.workshop if key in keys or key not in made] != list(keys):
            raise JumpcadError(f"workshop: has {shown(list(trial.workshop))}, not the keys of the study's space")
        return trial
    except JumpcadError as error:
        raise JumpcadError(f"row {' '.join(map(shown, row[:4]))}: {error}") from None


def _require_proposal(trial: Trial, free: int) -> None:
    """Require that what a method predicted fits a space of so many free parameters."""
    proposal = trial.proposal
    thetas = proposal.get("theta", {})
    if trial.phase in LEARNING_PHASES and trial.step and not thetas:
        raise JumpcadError("proposal.theta: missing")
    if not isinstance(thetas, dict) or any(not 3 <= len(theta) <= free + 2 for theta in thetas.values()):
        raise JumpcadError(f"proposal.theta: must be lists of 3 to {free + 2} hyperparameters")
    tried = proposal.get("tried", [])
    if not isinstance(tried, list) or any(not 1 <= len(point) <= free for point in tried):
        raise JumpcadError(f"proposal.tried: must be lists of 1 to {free} coordinates")
    if any(not isinstance(value, float) for name, value in proposal.items() if name not in ("theta", "tried")):
        raise JumpcadError("proposal: must be numbers, besides theta and tried")


class _Named(TomlTable):
    model_config = ConfigDict(extra="allow")

    name: Name


class _Range(TomlTable):
    lower: float | None = None
    upper: float | None = None
    fixed: float | Text | None = None
    choices: Annotated[list[float] | list[Text], Field(min_length=1)] | None = None


def _whole(space: dict[str, _Range]) -> dict[str, _Range]:
    if tuple(space)[: len(PARAMETERS)] != PARAMETERS:
        raise PydanticCustomError("value_error", "must have all eight parameters of a design, in their order")
    for name, part in space.items():
        if name not in PARAMETERS and not KEY.fullmatch(name):
            raise PydanticCustomError("value_error", "{name} is no key of a workshop", {"name": shown(name)})
        if name in PARAMETERS and isinstance((part.choices or [part.fixed])[0], str):
            raise PydanticCustomError("value_error", "{name} must be numbers", {"name": name})
        if list(part.model_fields_set) not in (["fixed"], ["choices"]) and part.model_fields_set != {"lower", "upper"}:
            raise PydanticCustomError("value_error", f"{name} must be fixed, have lower and upper, or choices")
    return space


_Space = Annotated[dict[str, _Range], AfterValidator(_whole)]


class _Making(TomlTable):
    length_mm: float
    rate: float
    mass: float
    floor: float
    printed: bool


class _Identity(TomlTable):
    """What readers of a study need; the writer compares the rest."""

    model_config = ConfigDict(extra="allow")

    model: _Named
    objective: Name
    method: Name
    seed: Count
    space: _Space
    making: _Making | None = None


class _Stage(TomlTable):
    method: Annotated[str, AfterValidator(_one_of(METHODS))]
    evaluations: Count
    initial: Count = 0


class _Ended(TomlTable):
    by: Literal["evaluations", "until", "hours", "space", "proposals"]
    until_percent: Annotated[float, Field(ge=0, le=100)] = 0.0
    hours: Annotated[float, Field(ge=0, le=1e6)] = 0.0


class _Candidate(TomlTable):
    trial: tuple[Phase, Count, Count, Count]
    parameters_score: Figure
    print_score: Figure
    rejections: dict[Word, Count]
    neighbours: Count


class _Bound(TomlTable):
    name: Text
    side: Literal["lower", "upper"]
    value: float
    beyond: float
    worth: float | None
    reason: Text


class _Pick(TomlTable):
    designs: Count
    evaluations: Count
    candidates: list[_Candidate] | None = None
    bounds: list[_Bound] | None = None


_REMEMBERED: dict[str, TypeAdapter[Any]] = {
    "identity": TypeAdapter(_Identity),
    "stages": TypeAdapter(Annotated[list[_Stage], Field(min_length=1)]),
    "ended": TypeAdapter(_Ended | None),
    "picks": TypeAdapter(list[_Pick]),
}


def remembered(key: str, text: str) -> Any:
    """Return what a study remembered under a key, as plain data.

    Raises
    ------
    JumpcadError
        Saying what is wrong, if no search wrote it.
    """
    kind = _REMEMBERED.get(key, TypeAdapter(Any))
    validated(kind.validate_json, key, text)
    return json.loads(text)


def validated(validate: Any, key: str, value: Any) -> Any:
    """Return what a validator makes of a value, or refuse it with the place of what is wrong."""
    try:
        return validate(value)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(str(step) for step in (key, *first["loc"]) if step != "")
        raise JumpcadError(f"{place if place.isprintable() else shown(place)}: {first['msg']}") from None
