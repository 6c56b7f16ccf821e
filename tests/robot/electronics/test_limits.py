"""Kits that fit, and what is said of those that do not: every finding with which range misses which."""

import math
import tempfile
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
import shapely
from support.built import built
from support.each import each
from support.said import well_told
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.bundle.drawings.wiring import wires
from jumpcad.bundle.firmware import numbers
from jumpcad.design import load_design
from jumpcad.electronics.supply import Link, chosen_parts
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding
from jumpcad.robot.electronics import limits as leads
from jumpcad.robot.electronics.leads import way_in
from jumpcad.robot.electronics.limits import _voltage, electronics_findings, holding_findings, lead_findings, links
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.room import disc
from jumpcad.workshop import load_workshop

KITS = ("light-1s", "strong-2s")
CELL = """[bought]
battery = "mine"
[batteries.mine]
description = "a cell"
source = "x"
length_mm = 35
width_mm = 20
height_mm = 6
mass_g = 8
voltage_v = 3.7
"""
"""Of no stated current."""


@lru_cache
def robot_in(shop_toml: str) -> Robot:
    """Return Kenan 2.0 in a workshop."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "my.toml"
        path.write_text(shop_toml, encoding="utf-8")
        return build(load_design("kenan-2.0"), load_workshop(path))


def found(shop_toml: str) -> dict[str, Finding]:
    """Return its findings, by name."""
    return {finding.name: finding for finding in electronics_findings(robot_in(shop_toml))}


def beside(monkeypatch: pytest.MonkeyPatch, x: float, y: float, z: float, radius_mm: float) -> Finding:
    """Return what is found of the leads where a thin disc alone moves."""
    thin = (y - 0.05, y + 0.05)
    monkeypatch.setattr(leads, "moving_obstacles", lambda layout: [disc("fan", (x, z), radius_mm, thin)])
    (finding,) = lead_findings(built("kenan-2.0"))
    return finding


@pytest.mark.parametrize("kit", KITS)
def test_both_kits_meet_every_limit(kit: str) -> None:
    findings = found(f'[bought]\nkit = "{kit}"')
    assert not [f"{f.name}: {f.message}" for f in findings.values() if f.severity != "info"]
    assert [name for name, finding in findings.items() if not well_told(finding)] == []
    assert {"supply_voltage_controller", "supply_voltage_driver", "supply_voltage_motor"} <= findings.keys()
    assert ("supply_voltage_regulator" in findings) == (kit == "strong-2s")


def test_two_cells_on_a_board_for_one_are_refused_with_both_ranges() -> None:
    finding = found('[bought]\nbattery = "lipo-2s-180"')["supply_voltage_controller"]
    assert finding.severity == "error"
    assert (finding.value, finding.limit) == (8.4, 4.2)
    assert finding.margin == pytest.approx(-4.2)
    assert "to 8.40 V and bears 3.20 to 4.20 V" in finding.message
    assert "bought.kit" in finding.remedy
    assert "\n" not in finding.message + finding.remedy


def test_one_cell_is_too_little_for_a_driver_that_needs_more() -> None:
    """As the TB6612 or the A3144 do: 4.5 V at least, the empty cell has 3.3 V less what its resistance takes."""
    text = '[bought]\ndriver = "mine"\n[boards.mine]\nlike = "drv8833"\nsource = "x"\nsupply_v = { VM = [4.5, 13.5] }'
    finding = found(text)["supply_voltage_driver"]
    assert finding.severity == "error"
    assert finding.limit == 4.5
    assert finding.value == pytest.approx(3.3, abs=0.1)
    assert finding.value < 3.3


def test_a_board_of_unknown_range_is_named() -> None:
    text = '[bought]\ndriver = "mine"\n[boards.mine]\nlike = "drv8833"\nsource = "x"\nsupply_v = {}'
    assert found(text)["supply_voltage_driver"].severity == "warning"


def test_a_switch_that_burns_under_a_blocked_motor_is_an_error() -> None:
    """The common slide switch bears 0.3 A; the MP motor draws 0.44 A when blocked on a full cell."""
    finding = found("[bought]")["motor_current_switch"]
    assert finding.value == pytest.approx(4.2 / (6.0 / 0.67 + 0.15 + 0.36))
    text = '[bought]\nbattery = "weak"\n[batteries.weak]\nlike = "lipo-1s-300"\nsource = "x"\ndischarge_a = 0.3'
    assert found(text)["motor_current_battery"].severity == "error"


def test_a_battery_whose_current_nobody_states_is_named() -> None:
    """Unknown is neither met nor violated."""
    finding = found(f"{CELL}capacity_mah = 300")["motor_current_battery"]
    assert finding.severity == "warning"
    assert "0.44 A" in finding.message
    assert "not known" in finding.message


def test_charging_is_measured_against_the_battery() -> None:
    """The controller's charger gives 370 mA; a battery that is not said to bear more gets 1 C at most."""
    assert found("[bought]")["charging_current"].severity == "info"
    small = like("battery", "lipo-1s-300", "capacity_mah = 150.0\ncharge_ma = 150.0")
    finding = found(small)["charging_current"]
    assert (finding.severity, finding.value, finding.limit) == ("error", 370.0, 150.0)
    assert "charges own with 370 mA; 150 mA are allowed" in finding.message
    assert "bought.battery" in finding.remedy
    text = small.replace("150.0\ncharge_ma = 150.0", "500.0\ncharge_ma = 500.0")
    assert found(text)["charging_current"].severity == "info"
    assert "charging_current" not in found('[bought]\nkit = "strong-2s"')


def test_a_battery_without_a_rating_is_charged_with_1_c() -> None:
    finding = found(f"{CELL}capacity_mah = 350")["charging_current"]
    assert (finding.severity, finding.limit) == ("error", 350.0)
    assert "1 C" in finding.message


def test_a_pin_that_the_board_lacks_is_refused_in_one_line() -> None:
    with pytest.raises(CannotBuildError, match=r"^xiao-esp32c3 has no GPIO at D77: name another pin in"):
        numbers(robot_in('[bought.pins]\nmotor = "D77"'))


def like(kind: str, of: str, figures: str) -> str:
    """Return a workshop whose battery or driver is a shipped one with other figures."""
    table = {"battery": "batteries", "driver": "boards"}[kind]
    return f'[bought]\n{kind} = "own"\n[{table}.own]\nlike = "{of}"\nsource = "x"\n{figures}'


HIGH = like("battery", "lipo-1s-300", "voltage_v = 120.0\nempty_v = 110.0\nfull_v = 135.0\ncapacity_mah = 10.0")
"""A battery whose voltage nothing here bears."""
BLOCKED = '[bought]\nmotors = ["own"]\n[motors.own]\nlike = "n20-298-mp"\nsource = "x"\nstall_current_a = 6.0'
"""A motor of 1 ohm, which draws 2.8 A when blocked."""


@each(
    ("name", "text"),
    [
        ("supply_voltage_controller", HIGH),
        ("supply_voltage_driver", HIGH),
        ("supply_voltage_switch", HIGH),
        ("supply_voltage_plug", HIGH),
        ("supply_voltage_capacitor", HIGH),
        ("supply_voltage_regulator", HIGH.replace("[bought]", '[bought]\nkit = "strong-2s"')),
        ("supply_voltage_motor", BLOCKED.replace("stall_current_a = 6.0", "bears_v = [3.4, 6.0]")),
        ("motor_current_driver", BLOCKED),
        ("motor_current_battery", BLOCKED),
        ("motor_current_switch", BLOCKED),
        ("motor_current_plug", BLOCKED),
        ("motor_current_wire", BLOCKED),
    ],
)
def test_every_link_is_refused_beyond_what_it_bears(name: str, text: str) -> None:
    finding = found(text)[name]
    assert finding.severity == "error"
    assert finding.margin < 0.0
    assert finding.remedy


def test_a_board_of_unknown_inputs_is_a_warning_at_its_limit() -> None:
    """What it bears is not known: neither room nor excess is claimed."""
    (found,) = [_voltage(Link("controller", "my board", "", (3.0, 4.2), None, "x"))]
    assert (found.severity, found.margin) == ("warning", 0.0)
    assert "gets 3.00 to 4.20 V; what it bears is not known" in found.message
    known = _voltage(Link("driver", "d", "VM", (3.0, 4.2), (2.7, 4.0), "x"))
    assert (known.severity, known.value, known.limit) == ("error", 4.2, 4.0)
    assert known.margin == pytest.approx(-0.2)
    low = _voltage(Link("driver", "d", "VM", (3.0, 3.0), (3.4, 4.0), "x"))
    assert (low.value, low.limit) == (3.0, 3.4)
    assert low.margin == pytest.approx(-0.4)
    assert "d at VM gets 3.00 V and bears 3.40 to 4.00 V" in low.message


@pytest.mark.parametrize(
    ("bears_v", "margin", "severity"),
    [
        ((3.3, 4.2), 0.0, "info"), ((3.3 + 1e-12, 4.2), 0.0, "info"), ((3.3, 4.2 - 1e-12), 0.0, "info"),
        ((3.3, 4.1), -0.1, "error"), ((3.5, 5.0), -0.2, "error"), ((3.0, 4.7), 0.3, "info"), ((3.1, 4.7), 0.2, "info"),
    ],
)  # fmt: skip
def test_a_board_that_gets_just_what_it_bears_has_nothing_left_and_is_no_error(
    bears_v: tuple[float, float], margin: float, severity: str
) -> None:
    """But for the last digits of its volts; else what is left at the end that is nearer."""
    finding = _voltage(Link("driver", "a driver", "VM", (3.3, 4.2), bears_v, "another"))
    assert (finding.margin, finding.severity) == (pytest.approx(margin, abs=1e-9), severity)
    assert finding.margin == 0.0 or abs(finding.margin) > 0.01


def test_an_empty_battery_has_less_where_the_motor_draws_most() -> None:
    """Its resistance times the largest current of winding, not the mean one; a full one may stand still."""
    robot = built("kenan-2.0")
    battery, train = chosen_parts(robot.workshop).battery, robot.layout.drive.train
    assert train.peak_current_a > train.mean_current_a
    empty, full = battery.range_v
    (driver,) = (link for link in links(robot) if link.role == "driver")
    assert driver.gets_v == pytest.approx((empty - train.peak_current_a * battery.ohm, full))


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
    loose = replace(robot, workshop=workshop_with(robot.workshop, seats={"strap_n": 1.0}))
    assert next(iter(holding_findings(loose))).severity == "error"


def test_of_what_is_tied_the_heaviest_is_named_where_ties_hold_less_than_straps() -> None:
    robot = built("best-bo")
    shop = workshop_with(robot.workshop, seats={"tie_n": 0.3, "strap_n": 100.0})
    (finding,) = holding_findings(replace(robot, workshop=shop))
    tied = [*robot.layout.electronics.boards, "plug", "capacitor"]
    heaviest = max((item for item in robot.hardware if item.name in tied), key=lambda item: item.mass_kg)
    pull = 2.0 * heaviest.mass_kg * LoadCase(robot).landing_n / robot.mass_kg
    assert (finding.value, finding.limit) == pytest.approx((pull, 0.1))
    assert f"the {heaviest.name} pulls with {pull:.1f} N on its cable tie, which holds 0.1 N" in finding.message


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
    start, end = way_in(built("kenan-2.0").layout, "motor")[:2]
    x, _, z = (start + end) / 2.0
    assert beside(monkeypatch, x, start[1] + beside_mm, z, 2.0).severity == severity


@pytest.mark.parametrize(
    "aside", [(0.0, 1.5), (0.0, -1.5), (1.5, 0.0), (-1.5, 0.0), (0.0, 4.0), (0.0, -40.0), (-40.0, 0.0)]
)
def test_the_gap_is_from_a_leads_middle_to_what_moves(
    monkeypatch: pytest.MonkeyPatch, aside: tuple[float, float]
) -> None:
    """A disc of 2 mm across the leads outside the plate, its middle beside the middle of their way: touching or not."""
    start, end = way_in(built("kenan-2.0").layout, "motor")[:2]
    place = (start + end)[[0, 2]] / 2.0 + aside
    finding = beside(monkeypatch, place[0], start[1], place[1], 2.0)
    line = shapely.LineString([start[[0, 2]], end[[0, 2]]])
    assert finding.value == pytest.approx(line.distance(shapely.Point(place)) - 2.0, abs=0.1)


@pytest.mark.parametrize("part", ["sensor", "motor"])
@pytest.mark.parametrize("stretch", [0, 1, 2])
def test_what_moves_anywhere_along_a_lead_is_found(monkeypatch: pytest.MonkeyPatch, part: str, stretch: int) -> None:
    """A ball in the middle of each stretch: beside the plate, through its hole, and from there to the trays."""
    layout, way = built("kenan-2.0").layout, way_in(built("kenan-2.0").layout, part)
    tray = layout.electronics.middle_mm(layout.tray_mm)
    way.append(np.array([tray[0], way[-1][1], tray[1]]))
    finding = beside(monkeypatch, *(way[stretch] + way[stretch + 1]) / 2.0, 0.1)
    assert (finding.severity, finding.message.split("'")[0]) == ("error", f"the {part}")


@pytest.mark.parametrize("part", ["sensor", "motor"])
@pytest.mark.parametrize(("beside_mm", "severity"), [(-1.7, "info"), (-1.5, "error"), (1.5, "error"), (1.7, "info")])
def test_inside_the_plates_a_lead_runs_beside_its_plate(
    monkeypatch: pytest.MonkeyPatch, part: str, beside_mm: float, severity: str
) -> None:
    """A ball half way to the trays is in its way where it is within 1.5 mm to the left or right of it."""
    layout, way = built("kenan-2.0").layout, way_in(built("kenan-2.0").layout, part)
    x, z = (way[-1][[0, 2]] + layout.electronics.middle_mm(layout.tray_mm)) / 2.0
    assert beside(monkeypatch, x, way[-1][1] + beside_mm, z, 0.1).severity == severity


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
