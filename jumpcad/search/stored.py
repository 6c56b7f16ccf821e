"""Validation of what is read from a study file: it may come from elsewhere, or be damaged."""

import re
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.files.complaints import shown
from jumpcad.files.names import Name, Text
from jumpcad.search.methods import METHODS

STRICT = ConfigDict(strict=True, extra="forbid")
KEY = re.compile(r"[^.\x00-\x1f\x7f]{1,80}(\.[^.\x00-\x1f\x7f]{1,80}){1,3}")
"""Dotted keys of a workshop."""
WORD = re.compile(r"[A-Za-z]\w{0,79}", re.ASCII)
"""Names of verdicts, findings, figures and parameters."""
LARGEST = 1e12
"""Above any figure of a jumping robot."""

_ALL_GIVEN = set(PARAMETERS)
_NONE: dict[str, Any] = {}
"""Of rows without proposal or workshop, the same one."""

Count = Annotated[int, Field(ge=0)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1)]
Logarithm = Annotated[float, Field(ge=-100, le=100)]


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


class _Making(TomlTable):
    length_mm: float
    rate: float = 0.0
    mass: float = 0.0
    floor: float = 0.0
    printed: bool = False


_Space = Annotated[dict[str, _Range], AfterValidator(_whole)]


class _Identity(TomlTable):
    """What readers of a study need; the writer compares the rest."""

    model_config = ConfigDict(extra="allow")

    model: _Named
    objective: Name
    method: Name
    seed: Count
    space: _Space
    making: _Making | None = None
    tolerance_mm: Count | float = 0.0


def _is_method(name: str) -> str:
    if name not in METHODS:
        raise PydanticCustomError("value_error", "is none of {methods}", {"methods": ", ".join(METHODS)})
    return name


class _Stage(TomlTable):
    method: Annotated[str, AfterValidator(_is_method)]
    evaluations: Count
    initial: Count = 0


class _Ended(TomlTable):
    by: Literal["evaluations", "until", "hours", "space", "proposals"]
    until_percent: Annotated[float, Field(ge=0, le=100)] = 0.0
    hours: Annotated[float, Field(ge=0, le=1e6)] = 0.0


_REMEMBERED: dict[str, TypeAdapter[Any]] = {
    "identity": TypeAdapter(_Identity),
    "stages": TypeAdapter(Annotated[list[_Stage], Field(min_length=1)]),
    "ended": TypeAdapter(_Ended),
}
_WORKSHOP = TypeAdapter(dict[str, Finite | Text], config=STRICT)
_PROPOSAL = TypeAdapter(dict[str, Finite | dict[str, list[Logarithm]] | list[list[Share]]], config=STRICT)


def require_remembered(key: str, value: Any) -> None:
    """Reject what a study cannot have remembered as its `identity`, its `stages`, or what `ended` it.

    Raises
    ------
    JumpcadError
        Saying what is wrong.
    """
    validated(_REMEMBERED[key].validate_python, key, value)


def stored_design(record: Mapping[str, Any]) -> Design:
    """Return the design of a row.

    Raises
    ------
    JumpcadError
        If a parameter is not a number or out of range.
    """
    design = Design(**{name: record[name] for name in PARAMETERS})
    # Pydantic keeps the names of what was given with every design: 0.7 kB each, and all the same.
    object.__setattr__(design, "__pydantic_fields_set__", _ALL_GIVEN)
    return design


def stored_proposal(record: Mapping[str, Any], free: int) -> dict[str, Any]:
    """Return what the method predicted of a row's design; hyperparameters fit a space of `free` parameters.

    Raises
    ------
    JumpcadError
        If it is not one that was written.
    """
    proposal: dict[str, Any] = validated(_PROPOSAL.validate_json, "proposal", record["proposal"])
    thetas = proposal.get("theta", {})
    if not isinstance(thetas, dict) or any(not 3 <= len(theta) <= free + 2 for theta in thetas.values()):
        raise JumpcadError(f"proposal.theta: must be lists of at most {free + 2} hyperparameters")
    tried = proposal.get("tried", [])
    if not isinstance(tried, list) or any(not 1 <= len(point) <= free for point in tried):
        raise JumpcadError(f"proposal.tried: must be lists of at most {free} coordinates")
    if any(not isinstance(value, float) for name, value in proposal.items() if name not in ("theta", "tried")):
        raise JumpcadError("proposal: must be numbers, besides theta and tried")
    return proposal or _NONE


def stored_workshop(record: Mapping[str, Any], keys: Sequence[str], more: Sequence[str] = ()) -> dict[str, Any]:
    """Return the workshop's values of a row in a search of these keys; it may have some `more`.

    Raises
    ------
    JumpcadError
        If they are not numbers and names, or belong to other keys.
    """
    values: dict[str, Any] = validated(_WORKSHOP.validate_json, "workshop", record["workshop"])
    if [key for key in values if key in keys or key not in more] != list(keys):
        raise JumpcadError(f"workshop: has {shown(list(values))}, not the keys of the study's space")
    return values or _NONE


def stored_text(record: Mapping[str, Any], key: str) -> str:
    """Return a text of a row, which comes as bytes."""
    try:
        return bytes.decode(record[key], "utf-8")
    except (TypeError, UnicodeDecodeError):
        raise JumpcadError(f"{key} = {shown(record[key])} is not text") from None


def stored_count(record: Mapping[str, Any], key: str) -> int:
    """Return a number of a row that counts something."""
    value = record[key]
    if not isinstance(value, int) or value < 0:
        raise JumpcadError(f"{key} = {shown(value)} is not a whole number of at least 0")
    return value


def stored_figure(record: Mapping[str, Any], key: str) -> float:
    """Return a number of a row."""
    value = record[key]
    if not isinstance(value, float) or not abs(value) <= LARGEST:
        raise JumpcadError(f"{key} = {shown(value)} is not a plausible number")
    return value


def validated(validate: Any, key: str, value: Any) -> Any:
    """Return what a validator makes of a value, or refuse it with the place of what is wrong."""
    try:
        return validate(value)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(str(step) for step in (key, *first["loc"]))
        raise JumpcadError(f"{place if place.isprintable() else shown(place)}: {first['msg']}") from None
