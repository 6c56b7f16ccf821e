"""Leads of sensor and motor: clear of what moves; as much wire is bought as is cut."""

import math

import numpy as np
import pytest
import shapely
from support.built import built

from jumpcad.bundle.drawings.wiring import wires
from jumpcad.robot.electronics import limits as leads
from jumpcad.robot.electronics.leads import way_in
from jumpcad.robot.electronics.limits import lead_findings
from jumpcad.robot.space.room import disc


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_leads_keep_away_from_what_moves(name: str) -> None:
    (finding,) = lead_findings(built(name))
    assert finding.name == "wires_clear"
    assert finding.severity == "info", finding.message
    assert finding.limit - 0.6 == pytest.approx(1.0, abs=0.15)  # of air beside a lead of 1.2 mm


@pytest.mark.parametrize(("beside_mm", "severity"), [(-1.2, "error"), (0.0, "error"), (1.2, "error"), (3.0, "info")])
def test_what_moves_across_a_lead_or_close_beside_it_is_found(
    monkeypatch: pytest.MonkeyPatch, beside_mm: float, severity: str
) -> None:
    """A thin disc across the middle of the motor's leads outside the plate, to their left or right by up to 1.5 mm."""
    robot = built("kenan-2.0")
    start, end = way_in(robot.layout, "motor")[:2]
    middle, y = (start + end)[[0, 2]] / 2.0, start[1] + beside_mm
    monkeypatch.setattr(leads, "moving_obstacles", lambda layout: [disc("fan", middle, 2.0, (y - 0.1, y + 0.1))])
    (finding,) = lead_findings(robot)
    assert finding.severity == severity


@pytest.mark.parametrize(
    "aside", [(0.0, 1.5), (0.0, -1.5), (1.5, 0.0), (-1.5, 0.0), (0.0, 4.0), (0.0, -40.0), (-40.0, 0.0)]
)
def test_the_gap_is_from_a_leads_middle_to_what_moves(
    monkeypatch: pytest.MonkeyPatch, aside: tuple[float, float]
) -> None:
    """A disc of 2 mm across the leads outside the plate, its middle beside the middle of their way: touching or not."""
    robot = built("kenan-2.0")
    start, end = way_in(robot.layout, "motor")[:2]
    place, y = (start + end)[[0, 2]] / 2.0 + aside, start[1]
    monkeypatch.setattr(leads, "moving_obstacles", lambda layout: [disc("fan", place, 2.0, (y - 0.1, y + 0.1))])
    (finding,) = lead_findings(robot)
    line = shapely.LineString([start[[0, 2]], end[[0, 2]]])
    assert finding.value == pytest.approx(line.distance(shapely.Point(place)) - 2.0, abs=0.1)


@pytest.mark.parametrize("part", ["sensor", "motor"])
@pytest.mark.parametrize("stretch", [0, 1, 2])
def test_what_moves_anywhere_along_a_lead_is_found(monkeypatch: pytest.MonkeyPatch, part: str, stretch: int) -> None:
    """A ball in the middle of each stretch: beside the plate, through its hole, and from there to the trays."""
    robot = built("kenan-2.0")
    layout, way = robot.layout, way_in(robot.layout, part)
    tray = layout.electronics.middle_mm(layout.tray_mm)
    way.append(np.array([tray[0], way[-1][1], tray[1]]))
    x, y, z = (way[stretch] + way[stretch + 1]) / 2.0
    monkeypatch.setattr(leads, "moving_obstacles", lambda layout: [disc("ball", (x, z), 0.1, (y - 0.1, y + 0.1))])
    (finding,) = lead_findings(robot)
    assert (finding.severity, finding.message.split("'")[0]) == ("error", f"the {part}")


@pytest.mark.parametrize("part", ["sensor", "motor"])
@pytest.mark.parametrize(("beside_mm", "severity"), [(-1.7, "info"), (-1.5, "error"), (1.5, "error"), (1.7, "info")])
def test_inside_the_plates_a_lead_runs_beside_its_plate(
    monkeypatch: pytest.MonkeyPatch, part: str, beside_mm: float, severity: str
) -> None:
    """A ball half way to the trays is in its way where it is within 1.5 mm to the left or right of it."""
    layout, way = built("kenan-2.0").layout, way_in(built("kenan-2.0").layout, part)
    x, z = (way[-1][[0, 2]] + layout.electronics.middle_mm(layout.tray_mm)) / 2.0
    y = way[-1][1] + beside_mm
    monkeypatch.setattr(leads, "moving_obstacles", lambda layout: [disc("ball", (x, z), 0.1, (y - 0.05, y + 0.05))])
    (finding,) = lead_findings(built("kenan-2.0"))
    assert finding.severity == severity


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


@pytest.mark.parametrize("part", ["sensor", "motor"])
def test_leads_from_outside_pass_their_plate_square_to_it(part: str) -> None:
    layout = built("kenan-2.0").layout
    _, outside, inside = way_in(layout, part)
    low, high = layout.lateral.left_plate if part == "sensor" else layout.lateral.right_plate
    assert outside[[0, 2]].tolist() == inside[[0, 2]].tolist()
    hole = layout.fittings.left_mm if part == "sensor" else layout.fittings.right_mm
    assert outside[[0, 2]] == pytest.approx(hole)
    assert min(outside[1], inside[1]) < low < high < max(outside[1], inside[1])
    assert abs(inside[1]) < abs(outside[1])
