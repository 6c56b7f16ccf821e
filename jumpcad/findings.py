"""Constraint violations as data: one list serves the command line, the search and the report."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

Severity = Literal["info", "warning", "error"]


@dataclass(frozen=True)
class Finding:
    """One checked limit.

    ``margin`` is signed, in ``unit``: negative means violated, and by how much.
    ``message`` says what was found, ``remedy`` what to change.
    """

    name: str
    severity: Severity
    margin: float
    unit: str
    message: str
    remedy: str

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return dict(vars(self))  # flat, so the slow deep copy of `asdict` is not needed


def limit(name: str, margin: float, unit: str, message: str, remedy: str, violated: Severity = "error") -> Finding:
    """Return the finding of a limit that is violated where its margin is negative."""
    return Finding(name, violated if margin < 0 else "info", float(margin), unit, message, remedy)


def errors(findings: Iterable[Finding]) -> list[Finding]:
    """Return the findings that forbid the robot."""
    return [finding for finding in findings if finding.severity == "error"]
