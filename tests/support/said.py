"""What a finding says in words of its value and its limit."""

import math
import re

from jumpcad.findings import Finding

SHOWN = {"rad": 180.0 / math.pi, "rad/s": 180.0 / math.pi, "N·m": 1000.0}
"""Angles are said in degrees, torques in mN·m."""


def said(message: str, value: float) -> bool:
    """Whether a message has a value, rounded to the digits that it has."""
    for text in re.findall(r"-?\d+(?:\.\d+)?", message):
        digits = len(text.partition(".")[2])
        if abs(float(text) - value) <= max(0.006 * abs(value), 0.5 * 10.0**-digits + 1e-9):
            return True
    return False


def says_its_numbers(finding: Finding) -> bool:
    """Whether a finding's message has its value and its limit, as far as they are known, in the unit that it names."""
    known = [value for value in (finding.value, finding.limit) if value is not None]
    return all(said(finding.message, SHOWN.get(finding.unit, 1.0) * value) for value in known)
