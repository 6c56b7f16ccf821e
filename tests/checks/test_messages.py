"""What a finding says in words is what it says in numbers."""

import math
import re

import pytest
from support.built import built

from jumpcad.checks import constraint_findings
from jumpcad.robot import Robot

SHOWN = {"rad": 180.0 / math.pi, "rad/s": 180.0 / math.pi, "N·m": 1000.0}
"""Angles are said in degrees, torques in mN·m."""
ROBOTS = {
    "kenan-2.0": lambda: built("kenan-2.0"),
    "best-bo": lambda: built("best-bo"),
    "legs with bars": lambda: built("kenan-2.0", leg="carbon-strip-3x6"),
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]()


def said(message: str, value: float) -> bool:
    """Whether a message has a value, rounded to the digits that it has."""
    for text in re.findall(r"-?\d+(?:\.\d+)?", message):
        digits = len(text.partition(".")[2])
        if abs(float(text) - value) <= max(0.006 * abs(value), 0.5 * 10.0**-digits + 1e-9):
            return True
    return False


def test_messages_have_value_and_limit_in_the_unit_that_they_name(robot: Robot) -> None:
    """And the margin is the difference of the two."""
    compared = 0
    for finding in constraint_findings(robot):
        factor = SHOWN.get(finding.unit, 1.0)
        for value in (finding.value, finding.limit):
            if value is not None:
                assert said(finding.message, factor * value), (finding.name, value, finding.message)
        if finding.value is not None and finding.limit is not None:
            compared += 1
            assert abs(finding.limit - finding.value) == pytest.approx(abs(finding.margin), abs=1e-9), finding.name
    assert compared > 30
