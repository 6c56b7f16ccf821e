"""What a finding says in words is what it says in numbers."""

import ast
from pathlib import Path

import pytest
from support.built import built
from support.said import keys, well_told

import jumpcad
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


def test_every_key_that_a_way_out_names_is_one_of_a_design_or_a_workshop() -> None:
    """In full, as a user has to write it."""
    named = set()
    for path in Path(jumpcad.__file__).parent.rglob("*.py"):
        for call in (node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Call)):
            maker = call.func.id if isinstance(call.func, ast.Name) else ""
            if maker in ("lower", "higher", "nearer_to_1", "choose", "Change"):
                first, last = {"choose": (1, None), "Change": (0, 1)}.get(maker, (0, None))
                named |= {arg.value for arg in call.args[first:last] if isinstance(arg, ast.Constant)}
    assert len(named) > 30
    assert named <= keys(), named - keys()
