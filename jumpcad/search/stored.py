"""Validation of what is read from a study file: it may come from elsewhere, or be damaged."""

import math
import re
import sys
from array import array
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.files.complaints import shown
from jumpcad.files.names import Name, Text
from jumpcad.findings import SEVERITIES, Finding, bare, is_bare
from jumpcad.search.methods import METHODS
from jumpcad.search.objective import Evaluation

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


class _Identity(TomlTable):
    """What readers of a study need; the writer compares the rest."""

    model_config = ConfigDict(extra="allow")

    model: _Named
    objective: Name
    method: Name
    seed: Count
    space: Annotated[dict[str, _Range], AfterValidator(_whole)]
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
    widen: bool = False


def _spread(finding: Any) -> Any:
    """Return a finding that is a list of name, severity, margin and unit as a mapping."""
    if not isinstance(finding, list) or len(finding) != 4:
        return finding
    return dict(zip(("name", "severity", "margin", "unit"), finding, strict=True)) | {"message": "", "remedy": ""}


_REMEMBERED: dict[str, TypeAdapter[Any]] = {
    "identity": TypeAdapter(_Identity),
    "stages": TypeAdapter(Annotated[list[_Stage], Field(min_length=1)]),
}
_METRICS = TypeAdapter(dict[str, float], config=STRICT)
_FINDINGS = TypeAdapter(tuple[Annotated[Finding, BeforeValidator(_spread)], ...], config=STRICT)
_WORKSHOP = TypeAdapter(dict[str, Finite | Text], config=STRICT)
_PROPOSAL = TypeAdapter(dict[str, Finite | dict[str, list[Logarithm]]], config=STRICT)


def require_remembered(key: str, value: Any) -> None:
    """Reject what a study cannot have remembered as its `identity` or its `stages`.

    Raises
    ------
    JumpcadError
        Saying what is wrong.
    """
    _validated(_REMEMBERED[key].validate_python, key, value)


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


def stored_evaluation(record: Mapping[str, Any]) -> Evaluation:
    """Return the outcome of a row, whose texts are still bytes.

    Raises
    ------
    JumpcadError
        If it is not one that was written.
    """
    metrics = _validated(_METRICS.validate_json, "metrics", record["metrics"])
    findings = _validated(_FINDINGS.validate_json, "findings", record["findings"])
    verdict = stored_text(record, "verdict")
    for name in (verdict, *metrics, *(finding.name for finding in findings)):
        if not WORD.fullmatch(name):
            raise JumpcadError(f"{shown(name)} is not the name of a verdict, a finding or a figure")
    for name, value in metrics.items():
        if not abs(value) <= LARGEST:
            raise JumpcadError(f"{name} = {value:g} is not a plausible figure")
    for finding in findings:
        for figure in ("margin", "value", "limit"):
            number = getattr(finding, figure)
            if number is not None and math.isnan(number):  # infinite is allowed: the audit of a run that diverged
                raise JumpcadError(f"the {figure} of {finding.name} is not a number")
    whole = Evaluation(verdict, metrics, findings, stored_text(record, "detail"))
    return StoredEvaluation(whole)


class StoredEvaluation(Evaluation):
    """An evaluation read from a study, equal to the one that was written.

    Figures and margins are packed as numbers, their names shared by all rows: 50,000 rows would take 2 GB otherwise.
    """

    def __init__(self, whole: Evaluation) -> None:
        findings = whole.findings
        held = {
            "verdict": sys.intern(whole.verdict), "detail": whole.detail, "_reasons": _shared(whole.reasons),
            "_feasible": whole.feasible, "_cost": whole.cost,
            "_names": _shared(tuple(whole.metrics)), "_values": array("d", whole.metrics.values()).tobytes(),
            "_limits": _shared(tuple((one.name, one.unit) for one in findings)),
            "_severities": bytes(SEVERITIES.index(one.severity) for one in findings),
            "_margins": array("d", (one.margin for one in findings)).tobytes(),
            "_texts": () if all(map(is_bare, findings)) else findings,
        }  # fmt: skip
        self.__dict__.update(held)

    @property
    def metrics(self) -> Mapping[str, float]:
        """Named figures."""
        held = self.__dict__
        return dict(zip(held["_names"], array("d", held["_values"]), strict=True))

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Findings, bare ones unless an early version of the program wrote them."""
        held = self.__dict__
        rows = zip(held["_limits"], held["_severities"], array("d", held["_margins"]), strict=True)
        found = tuple(bare(name, SEVERITIES[code], margin, unit) for (name, unit), code, margin in rows)
        return held["_texts"] or found

    @property
    def feasible(self) -> bool:
        """As of what was written."""
        return bool(self.__dict__["_feasible"])

    @property
    def reasons(self) -> tuple[str, ...]:
        """As of what was written."""
        reasons: tuple[str, ...] = self.__dict__["_reasons"]
        return reasons

    @property
    def cost(self) -> int:
        """As of what was written."""
        return int(self.__dict__["_cost"])

    @property
    def bare(self) -> Evaluation:
        """A plain evaluation with bare findings."""
        return Evaluation(self.verdict, self.metrics, self.findings, self.detail).bare

    def __eq__(self, other: object) -> bool:
        """Whether another evaluation, stored or not, is the same."""
        if not isinstance(other, Evaluation):
            return NotImplemented
        return (self.verdict, self.detail, self.metrics, self.findings) == (
            other.verdict, other.detail, dict(other.metrics), other.findings,
        )  # fmt: skip

    __hash__ = None  # type: ignore[assignment]


@lru_cache(maxsize=4096)
def _shared(names: tuple[Any, ...]) -> tuple[Any, ...]:
    return names


def stored_proposal(record: Mapping[str, Any], free: int) -> dict[str, Any]:
    """Return what the method predicted of a row's design; hyperparameters fit a space of `free` parameters.

    Raises
    ------
    JumpcadError
        If it is not one that was written.
    """
    proposal: dict[str, Any] = _validated(_PROPOSAL.validate_json, "proposal", record["proposal"])
    thetas = proposal.get("theta", {})
    if not isinstance(thetas, dict) or any(not 3 <= len(theta) <= free + 2 for theta in thetas.values()):
        raise JumpcadError(f"proposal.theta: must be lists of at most {free + 2} hyperparameters")
    return proposal or _NONE


def stored_workshop(record: Mapping[str, Any], keys: Sequence[str], more: Sequence[str] = ()) -> dict[str, Any]:
    """Return the workshop's values of a row in a search of these keys; it may have some `more`.

    Raises
    ------
    JumpcadError
        If they are not numbers and names, or belong to other keys.
    """
    values: dict[str, Any] = _validated(_WORKSHOP.validate_json, "workshop", record["workshop"])
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


def _validated(validate: Any, key: str, value: Any) -> Any:
    try:
        return validate(value)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(str(step) for step in (key, *first["loc"]))
        raise JumpcadError(f"{place if place.isprintable() else shown(place)}: {first['msg']}") from None
