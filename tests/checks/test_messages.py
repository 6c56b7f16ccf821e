"""What a finding says in words is what it says in numbers."""

import pytest
from support.built import built
from support.said import well_told

from jumpcad.building import build
from jumpcad.checks import constraint_findings
from jumpcad.design import load_design
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop, varied

ROBOTS = {
    "kenan-2.0": lambda: built("kenan-2.0"),
    "best-bo": lambda: built("best-bo"),
    "legs with bars": lambda: built("kenan-2.0", leg="carbon-strip-3x6"),
    "cage": lambda: build(load_design("best-printable"), varied(load_workshop(), {"cage.rod": "glass-1.5"})),
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]()


def test_messages_have_value_and_limit_in_the_unit_that_they_name(robot: Robot) -> None:
    """And the margin is the difference of the two."""
    compared = 0
    for finding in constraint_findings(robot):
        assert well_told(finding), (finding.name, finding.value, finding.limit, finding.message, finding.remedy)
        if finding.value is not None and finding.limit is not None:
            compared += 1
            assert abs(finding.limit - finding.value) == pytest.approx(abs(finding.margin), abs=1e-9), finding.name
    assert compared > 30
