"""Checked limits and their remedies as data, and the words of a remedy: for command line, search and report."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import Any, Literal, get_args

Severity = Literal["info", "warning", "error"]
SEVERITIES: tuple[Severity, ...] = get_args(Severity)
TRIVIAL = 0.1
"""Use of a limit below which it is trivially kept, and does not count as one; judgement."""
DEGREES = 180.0 / math.pi
SHOWN_AS = {"rad": ("°", DEGREES), "rad/s": ("°/s", DEGREES), "J": ("mJ", 1000.0), "N·m": ("mN·m", 1000.0)}
"""The unit that people read instead of another one, and the factor."""


@dataclass(frozen=True)
class Basis:
    """How a limit is computed: its formula in plain text, with names and units, and where formula and limit are from.

    The source is a handbook, a standard, a data sheet, a measurement, or "judgement". Every module that makes findings
    has them in a table `BASIS` by the findings' names; `*` stands for the end of names that share a formula.
    """

    formula: str
    source: str


@dataclass(frozen=True)
class Change:
    """A way out: a design's parameter or a workshop's setting, by its whole key, and which way it is to go.

    `note` is said behind it, of "choose" before it: what is chosen. `value` is one that cures, where it is known.
    """

    key: str
    way: Literal["lower", "raise", "bring nearer to 1", "choose"]
    note: str = ""
    value: float | None = None

    @property
    def direction(self) -> int | None:
        """The sign of the change of a number, 0 of one that is brought nearer to 1; None where none is asked for."""
        return None if self.value is not None else {"lower": -1, "raise": 1, "bring nearer to 1": 0}.get(self.way)

    @property
    def row(self) -> "Change | str":
        """What it has in common with those that are said in one row with it."""
        return self if self.direction is None else self.way


Ways = tuple[Change | str, ...]
Remedy = str | Ways
"""Ways out, the first one best; those that are no key's change are said in words."""


def lower(*keys: str, note: str = "") -> Ways:
    """Return the ways out of lowering one of some keys."""
    return tuple(Change(key, "lower", note if key == keys[-1] else "") for key in keys)


def higher(*keys: str, note: str = "") -> Ways:
    """Return the ways out of raising one of some keys."""
    return tuple(Change(key, "raise", note if key == keys[-1] else "") for key in keys)


def nearer_to_1(key: str) -> Ways:
    """Return the way out of bringing a ratio nearer to 1."""
    return (Change(key, "bring nearer to 1"),)


def choose(kind: str, *keys: str) -> Ways:
    """Return the ways out of choosing, such as "a smaller" bought.roller."""
    return tuple(Change(key, "choose", kind) for key in keys)


def in_words(remedy: Remedy) -> str:
    """Return a remedy as a user reads it, such as "lower a or b, or raise c (a longer body)"."""
    if isinstance(remedy, str):
        return remedy
    said = []
    for row, group in groupby(remedy, lambda one: one if isinstance(one, str) else one.row):
        if isinstance(row, Change) and row.way == "choose":
            said.append(f"choose {row.note} {row.key}")
        elif isinstance(row, Change):
            said.append(f"{row.way.split()[0]} {row.key} to {row.value:g}{row.note and f' ({row.note})'}")
        elif row in ("lower", "raise", "bring nearer to 1"):
            (verb, *more), ways = row.split(" ", 1), [one for one in group if isinstance(one, Change)]
            *first, last = (f"{one.key}{one.note and f' ({one.note})'}" for one in ways)
            said.append(" ".join([verb, " or ".join(filter(None, [", ".join(first), last])), *more]))
        else:
            said.append(row)
    return ", or ".join(said)


@dataclass(frozen=True)
class Finding:
    """One checked limit, by the name of its check, such as `leg_strength`.

    The severity is `info` where the limit is kept; else `warning`, or `error` where it forbids the robot. The margin is
    negative where the limit is violated, and in `unit`. The message says what was found, `ways` what to change,
    `remedy` that in words. Value and limit are what was found and what is allowed, in `unit`; None where no single
    number is compared. `grows` names the factor of `jumpcad.strength.growth.Growth` that makes the part
    stronger, if any does.
    """

    name: str
    severity: Severity
    margin: float
    unit: str
    message: str
    ways: Remedy
    value: float | None = None
    limit: float | None = None
    grows: str = ""

    @property
    def remedy(self) -> str:
        """What to change, in words."""
        return in_words(self.ways)

    @property
    def use(self) -> float | None:
        """Share of the limit that is used, 1 at the limit: value / limit of a maximum, limit / value of a minimum.

        None where one of the two is unknown, or where they are not positive and their ratio says nothing.
        """
        if self.value is None or self.limit is None or not self.limit > 0.0:
            return None
        is_maximum = (self.margin < 0.0) == (self.limit < self.value)
        used, whole = (self.value, self.limit) if is_maximum else (self.limit, self.value)
        return used / whole if used >= 0.0 and whole > 0.0 else None

    @property
    def is_note(self) -> bool:
        """Whether it says something that has no limit."""
        return self.value is not None and self.limit is None

    @property
    def counts(self) -> bool:
        """Whether it is one of the limits that are counted: not a note, and not used by less than `TRIVIAL`."""
        return self.severity != "info" or not (self.is_note or (self.use is not None and self.use < TRIVIAL))

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        data = vars(self) | {"ways": self.remedy}
        return {"remedy" if key == "ways" else key: value for key, value in data.items()}


def bare(name: str, severity: Severity, margin: float, unit: str) -> Finding:
    """Return a finding without texts and numbers but its margin: what a study keeps."""
    return Finding(name, severity, margin, unit, "", "")


def at_most(
    name: str, value: float, allowed: float, unit: str, message: str, ways: Remedy, violated: Severity = "error",
    grows: str = "",
) -> Finding:  # fmt: skip
    """Return the finding of a value that may be as large as what is allowed."""
    return limit(name, allowed - value, unit, message, ways, violated, value=value, allowed=allowed, grows=grows)


def at_least(
    name: str, value: float, needed: float, unit: str, message: str, ways: Remedy, violated: Severity = "error",
    grows: str = "",
) -> Finding:  # fmt: skip
    """Return the finding of a value that may be as small as what is needed."""
    return limit(name, value - needed, unit, message, ways, violated, value=value, allowed=needed, grows=grows)


def limit(
    name: str, margin: float, unit: str, message: str, ways: Remedy, violated: Severity = "error", *,
    value: float | None = None, allowed: float | None = None, grows: str = "",
) -> Finding:  # fmt: skip
    """Return the finding of a limit that is violated where its margin is negative, or not a number.

    For a limit that is not one number against another; see `at_most` and `at_least` for those that are.
    """
    severity: Severity = "info" if margin >= 0 else violated
    found, bound = (None if one is None else float(one) for one in (value, allowed))  # they may be numpy's
    return Finding(name, severity, float(margin), unit, message, ways, found, bound, grows)


def least(findings: Iterable[Finding]) -> dict[str, Finding]:
    """Return, by name, the finding with the least margin: a limit may be checked on several parts or floors."""
    found: dict[str, Finding] = {}
    for one in findings:
        if one.name not in found or one.margin < found[one.name].margin:
            found[one.name] = one
    return found


def errors(findings: Iterable[Finding]) -> list[Finding]:
    """Return the findings that forbid the robot."""
    return [finding for finding in findings if finding.severity == "error"]
