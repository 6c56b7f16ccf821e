"""Leads of sensor and motor: clear of what moves; as much wire is bought as is cut."""

import math

import pytest
from support.built import built

from jumpcad.bundle.wiring import wires
from jumpcad.checks.leads import lead_findings


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_leads_keep_away_from_what_moves(name: str) -> None:
    (finding,) = lead_findings(built(name))
    assert finding.name == "wires_clear"
    assert finding.severity == "info", finding.message


def test_the_bill_has_the_wire_that_is_cut() -> None:
    """Silicone wire AWG 28: 2.2 g/m."""
    robot = built("kenan-2.0")
    cut = sum(length for *_, length in wires(robot)) / 1000.0
    bought = {item.name: item for item in robot.hardware if item.name.startswith("wiring_wire_")}
    assert sum(item.mass_kg for item in bought.values()) == pytest.approx(0.0022 * cut)
    for colour in {colour for *_, colour, length in wires(robot) if length}:
        metres = sum(length for *_, other, length in wires(robot) if other == colour) / 1000.0
        ordered = float(bought[f"wiring_wire_{colour}"].article.split(",")[-1].removesuffix(" m"))
        assert metres <= ordered + 1e-9
        assert ordered - metres < 0.1


def test_a_lead_is_not_shorter_than_the_straight_line() -> None:
    robot = built("kenan-2.0")
    places = {item.name: 1000.0 * item.mass.com_m for item in robot.hardware}
    for _, start, end, _, length in wires(robot):
        if length and start.part in places and end.part in places:
            assert length >= math.dist(places[start.part], places[end.part])
