"""Holding force of strap and ties against a landing, by Newton."""

from dataclasses import replace

import pytest
from support.built import built

from jumpcad.checks.holding import holding_findings
from jumpcad.checks.load_case import LoadCase


def test_the_strap_holds_the_battery_at_twice_the_landing() -> None:
    robot = built("best-bo")
    (finding,) = holding_findings(robot)
    assert finding.name == "electronics_hold"
    (battery,) = [item for item in robot.hardware if item.name == "battery"]
    pull = 2.0 * battery.mass_kg * LoadCase(robot).landing_n / robot.mass_kg
    assert finding.value == pytest.approx(pull)
    assert finding.limit == pytest.approx(25.0 / 3.0)
    assert finding.severity == "info"
    weak = robot.workshop.seats.model_copy(update={"strap_n": 1.0})
    loose = replace(robot, workshop=robot.workshop.model_copy(update={"seats": weak}))
    assert next(iter(holding_findings(loose))).severity == "error"
