"""What a study file holds, as validated data: one record for each trial, and what else a study remembers.

A file may come from elsewhere, or be damaged: what is read has been written by a search, or is refused.
"""

import json
import re
from collections.abc import Sequence
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.files.complaints import shown
from jumpcad.files.records import Name, Text
from jumpcad.search.methods import LEARNING_PHASES, STAGES
from jumpcad.search.study.trial import PLACE, Count, Trial, one_of
from jumpcad.search.study.variant import MADE, Tolerances

KEY = re.compile(r"[^.\x00-\x1f\x7f]{1,80}(\.[^.\x00-\x1f\x7f]{1,80}){1,3}")
"""Dotted keys of a workshop."""

_TRIAL = TypeAdapter(Trial)
COLUMNS = (*PLACE, "score", "record")
"""Of a row: the position of its trial, which is the key, the score, and all of the trial as JSON."""


def to_row(trial: Trial) -> tuple[Any, ...]:
    record = json.dumps(_TRIAL.dump_python(trial), ensure_ascii=False, separators=(",", ":"))
    return *trial.position, trial.score, record


def read_trial(row: Sequence[Any], free: int, keys: Sequence[str]) -> Trial:
    """Return the trial of a row of a search with so many `free` numbers and names, and these keys of the workshop."""
    try:
        trial: Trial = validated(_TRIAL.validate_json, "record", row[-1])
        if tuple(row[:4]) != trial.position:
            raise JumpcadError("record: is that of another row")
        _require_proposal(trial, free)
        made = MADE if trial.phase == "robust" else ()
        if [key for key in trial.workshop if key in keys or key not in made] != list(keys):
            raise JumpcadError(f"workshop: has {shown(list(trial.workshop))}, not the keys of the study's space")
        return trial
    except JumpcadError as error:
        raise JumpcadError(f"row {' '.join(map(shown, row[:4]))}: {error}") from None


def _require_proposal(trial: Trial, free: int) -> None:
    """Require that what a method predicted fits a space of so many free numbers and names."""
    thetas, tried = trial.proposal.get("theta", {}), trial.proposal.get("tried", [])
    others = [value for name, value in trial.proposal.items() if name not in ("theta", "tried")]
    if trial.phase in LEARNING_PHASES and trial.step and "theta" not in trial.proposal:
        raise JumpcadError("proposal.theta: missing")
    if not (
        (isinstance(thetas, dict) and all(3 <= len(theta) <= free + 2 for theta in thetas.values()))
        and (isinstance(tried, list) and all(1 <= len(point) <= free for point in tried))
        and all(isinstance(value, float) for value in others)
    ):
        raise JumpcadError(f"proposal: is none of a search with {free} free numbers and names")


class _Model(TomlTable):
    model_config = ConfigDict(extra="allow")

    name: Name
    workshop: dict[str, Any] | None = None


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


class _Identity(TomlTable):
    """What readers of a study need; the writer compares the rest."""

    model_config = ConfigDict(extra="allow")

    model: _Model
    objective: Name
    objective_unit: Text = ""
    method: Name
    seed: Count
    space: _Space
    making: Tolerances | None = None
    against: Name | None = None
    objective_code: str = ""
    versions: dict[str, str] | None = None


class _Stage(TomlTable):
    method: Annotated[str, AfterValidator(one_of(STAGES))]
    evaluations: Count
    initial: Count = 0


class _Ended(TomlTable):
    by: Literal["evaluations", "until", "hours", "space", "proposals"]
    until_percent: Annotated[float, Field(ge=0, le=100)] = 0.0
    hours: Annotated[float, Field(ge=0, le=1e6)] = 0.0


REMEMBERED: dict[str, TypeAdapter[Any]] = {
    "identity": TypeAdapter(_Identity),
    "stages": TypeAdapter(Annotated[list[_Stage], Field(min_length=1)]),
    "ended": TypeAdapter(_Ended | None),
}
"""What a study may remember under a key; anything under others."""


def validated(validate: Any, key: str, value: Any) -> Any:
    """Return what a validator makes of a value, or refuse it with the place of what is wrong."""
    try:
        return validate(value)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(str(step) for step in (key, *first["loc"]) if step != "")
        raise JumpcadError(f"{place if place.isprintable() else shown(place)}: {first['msg']}") from None
