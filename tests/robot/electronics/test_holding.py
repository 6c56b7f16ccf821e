"""Holding force of strap and ties against a landing, by Newton."""

from dataclasses import replace

import pytest
from support.built import built

from jumpcad.robot.electronics.limits import holding_findings
from jumpcad.robot.load_case import LoadCase


def test_the_strap_holds_the_battery_at_twice_the_landing() -> None:
    robot = built("best-bo")
    (finding,) = holding_findings(robot)
    assert finding.name == "electronics_hold"
    (battery,) = [item for item in robot.hardware if item.name == "battery"]
    pull = 2.0 * battery.mass_kg * LoadCase(robot).landing_n / robot.mass_kg
    assert finding.value == pytest.approx(pull)
    assert finding.limit == pytest.approx(25.0 / 3.0)
    assert finding.severity == "info"
    assert f"a landing of {LoadCase(robot).landing_n / robot.mass_kg:.0f} m/s² the battery " in finding.message
    assert f"the battery pulls with {pull:.1f} N on its strap, which holds {25.0 / 3.0:.1f} N" in finding.message
    weak = robot.workshop.seats.model_copy(update={"strap_n": 1.0})
    loose = replace(robot, workshop=robot.workshop.model_copy(update={"seats": weak}))
    assert next(iter(holding_findings(loose))).severity == "error"


def test_of_what_is_tied_the_heaviest_is_named_where_ties_hold_less_than_straps() -> None:
    robot = built("best-bo")
    seats = robot.workshop.seats.model_copy(update={"tie_n": 0.3, "strap_n": 100.0})
    (finding,) = holding_findings(replace(robot, workshop=robot.workshop.model_copy(update={"seats": seats})))
    tied = [*robot.layout.electronics.boards, "plug", "capacitor"]
    heaviest = max((item for item in robot.hardware if item.name in tied), key=lambda item: item.mass_kg)
    pull = 2.0 * heaviest.mass_kg * LoadCase(robot).landing_n / robot.mass_kg
    assert (finding.value, finding.limit) == pytest.approx((pull, 0.1))
    assert f"the {heaviest.name} pulls with {pull:.1f} N on its cable tie, which holds 0.1 N" in finding.message
