"""The outcome of a row of a study file, read and kept small: rows share the names of their figures and limits."""

import math
import re
import sys
from array import array
from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, Any

from pydantic import BeforeValidator, TypeAdapter

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.findings import SEVERITIES, Finding, bare, is_bare
from jumpcad.search.objective import Evaluation
from jumpcad.search.stored import LARGEST, STRICT, WORD, stored_text, validated

LETTERS = "".join(severity[0] for severity in SEVERITIES)
"""Of severities, in a row."""
NUMBERED = re.compile(rb"\[\d")
"""How figures and findings begin whose names are kept by a number."""


def _spread(finding: Any) -> Any:
    """Return a finding that is a list of name, severity, margin and unit as a mapping."""
    if not isinstance(finding, list) or len(finding) != 4:
        return finding
    return dict(zip(("name", "severity", "margin", "unit"), finding, strict=True)) | {"message": "", "remedy": ""}


_METRICS = TypeAdapter(dict[str, float], config=STRICT)
_VALUES = TypeAdapter(tuple[int, list[float]], config=STRICT)
_MARGINS = TypeAdapter(tuple[int, str, list[float]], config=STRICT)
_FINDINGS = TypeAdapter(tuple[Annotated[Finding, BeforeValidator(_spread)], ...], config=STRICT)
_NAMES = TypeAdapter(list[str] | list[tuple[str, str]], config=STRICT)


def stored_names(text: bytes) -> tuple[Any, ...]:
    """Return a list of names, or of names with units, that rows share.

    Raises
    ------
    JumpcadError
        If it is not one that was written.
    """
    return tuple(validated(_NAMES.validate_json, "names", text))


def stored_evaluation(record: Mapping[str, Any], names: Mapping[int, Any]) -> Evaluation:
    """Return the outcome of a row, whose texts are still bytes, and whose `names` are kept by their numbers.

    Raises
    ------
    JumpcadError
        If it is not one that was written.
    """
    metrics, findings = _stored_metrics(record["metrics"], names), _stored_findings(record["findings"], names)
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


def _stored_metrics(text: bytes, names: Mapping[int, Any]) -> dict[str, float]:
    """Return the figures of a row: their names' number and values, or in earlier formats a mapping."""
    if not NUMBERED.match(text):
        metrics: dict[str, float] = validated(_METRICS.validate_json, "metrics", text)
        return metrics
    number, values = validated(_VALUES.validate_json, "metrics", text)
    return dict(zip(_named("metrics", number, names, str, len(values)), values, strict=True))


def _stored_findings(text: bytes, names: Mapping[int, Any]) -> tuple[Finding, ...]:
    """Return the findings of a row: their names' number, severities and margins, or each with all it has."""
    if not NUMBERED.match(text):
        return tuple(validated(_FINDINGS.validate_json, "findings", text))
    number, letters, margins = validated(_MARGINS.validate_json, "findings", text)
    if len(letters) != len(margins) or set(letters) - set(LETTERS):
        raise JumpcadError(f"findings: {shown(letters)} are not the severities of {len(margins)} findings")
    rows = zip(_named("findings", number, names, tuple, len(margins)), letters, margins, strict=True)
    return tuple(bare(name, SEVERITIES[LETTERS.index(letter)], margin, unit) for (name, unit), letter, margin in rows)


def _named(key: str, number: int, names: Mapping[int, Any], kind: type, count: int) -> tuple[Any, ...]:
    """Return the names of that number, which must be as many as are counted."""
    found: tuple[Any, ...] = names.get(number, ())
    if len(found) != count or any(not isinstance(one, kind) for one in found):
        raise JumpcadError(f"{key}: number {number} of the names is not that of {count} {key}")
    return found


class StoredEvaluation(Evaluation):
    """An evaluation read from a study, equal to the one that was written.

    Figures and margins are packed as numbers, their names shared by all rows: 50,000 rows would take 2 GB otherwise.
    """

    def __init__(self, whole: Evaluation) -> None:
        findings = whole.findings
        held = {
            "verdict": sys.intern(whole.verdict), "detail": whole.detail, "_reasons": _shared(whole.reasons),
            "_feasible": whole.feasible,
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
