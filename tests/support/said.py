"""What a finding says in words: its value and its limit, and what can be changed."""

import math
import re
from functools import cache

from pydantic import BaseModel

from jumpcad.catalogue import Battery, Board
from jumpcad.design import Design
from jumpcad.findings import Change, Finding
from jumpcad.workshop import Workshop

SHOWN = {"rad": 180.0 / math.pi, "rad/s": 180.0 / math.pi, "N·m": 1000.0}
"""Angles are said in degrees, torques in mN·m."""


def said(message: str, value: float) -> bool:
    """Whether a message has a value, rounded to the digits that it has."""
    for text in re.findall(r"-?\d+(?:\.\d+)?", message):
        digits = len(text.partition(".")[2])
        if abs(float(text) - value) <= max(0.006 * abs(value), 0.5 * 10.0**-digits + 1e-9):
            return True
    return False


@cache
def keys() -> frozenset[str]:
    """Return the names of a design's numbers, of a board's or a battery's, and of a workshop's settings in full."""
    found = {*Design.model_fields, *Battery.model_fields, *Board.model_fields}
    for section, field in Workshop.model_fields.items():
        if isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel):
            for key in field.annotation.model_fields:
                found.add(f"{section}.{key}")
    return frozenset(found)


def well_told(finding: Finding) -> bool:
    """Whether a message has value and limit in the unit that it names, and a remedy names settings that there are."""
    known = [value for value in (finding.value, finding.limit) if value is not None]
    named = re.findall(r"\b[a-z]+(?:\.[a-z0-9_]+)+\b|\b[a-z0-9]+(?:_[a-z0-9]+)+\b", finding.remedy)
    factor = SHOWN.get(finding.unit, 1.0)
    return all(said(finding.message, factor * value) for value in known) and keys().issuperset(named)


def ways(finding: Finding) -> list[tuple[str, float]]:
    """Return the numbers of a design that a remedy tells to lower or to raise, each with a factor that does so."""
    changes = [one for one in finding.ways if isinstance(one, Change) and one.key in Design.model_fields]
    return [(one.key, 1.0 + 0.03 * one.direction) for one in changes if one.direction]
