"""report.html: valid, self-contained, and correct for the robot."""

import base64
import json
import math
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from html.parser import HTMLParser
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import jumpcad
from jumpcad.building import build
from jumpcad.bundle.bom import Bill, BillLine, bill_of_materials
from jumpcad.bundle.compared import compared_of
from jumpcad.bundle.limits import limit_values
from jumpcad.bundle.page import ACCOUNT, file_values, robot_values, write_report
from jumpcad.bundle.uncertainty import uncertainty_of
from jumpcad.calibration.measurements import load_measurements
from jumpcad.checks import constraint_findings
from jumpcad.design import load_design
from jumpcad.dimensions import unit_of_key
from jumpcad.files import template_names
from jumpcad.files.rendering import fill
from jumpcad.findings import at_least, at_most, limit
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.simulation import Jump, Settings, simulate, uncertain_jump
from jumpcad.simulation.uncertain import Uncertainty

PNG = b"\x89PNG\r\n\x1a\n and so on"


@pytest.fixture(scope="module")
def robot() -> Robot:
    return build(load_design("kenan-2.0"), name="kenan-2.0")


@pytest.fixture(scope="module")
def jump(robot: Robot) -> Jump:
    return simulate(robot, Settings(flight="simulated", trajectory=True))


def parsed(page: str) -> ElementTree.Element:
    """Return the page's tree; any tag that is not closed, and any stray character, is an error."""
    return ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))


def cells(page: str) -> dict[str, list[str]]:
    rows = ([cell.text or "" for cell in row.iter("td")] for row in parsed(page).iter("tr"))
    return {row[0]: row for row in rows if row}


def section(name: str, **values: Any) -> str:
    return fill(f"report/{name}.html.j2", values)


def test_energies_are_shares_of_what_was_loaded_and_less_than_none_has_no_width() -> None:
    """Of 1 J, what rounding makes a little less than nothing is told, not drawn."""
    account = dict(zip(ACCOUNT, (0.7, 0.31, -0.01), strict=False))
    page = section("energy", jump=SimpleNamespace(energy_account_j=account), energy_words=ACCOUNT)
    assert re.findall(r"width: ([\d.]+)%", page) == ["70.00", "31.00", "0.00"]
    assert "Of 1000.0 mJ" in page
    assert "-1.0 %" in page


def test_without_a_take_off_there_is_no_account_and_a_verdict_is_told_in_words(robot: Robot, jump: Jump) -> None:
    assert section("energy", jump=SimpleNamespace(energy_account_j=None)) == ""
    fallen = replace(jump, verdict="falls_over", ballistic_range_m=None, energy=None, findings=())
    page = write_report(robot, {}, fallen)
    assert "It does not jump: falls over.</p>" in page
    assert "Where the energy goes" not in page


def test_says_how_sure_it_is(robot: Robot, jump: Jump) -> None:
    sure = Uncertainty(
        {"ballistic_range_m": [0.177, 0.196, 0.213], "com_rise_m": [0.057, 0.065, 0.074]},
        {
            "mass": {"ballistic_range_m": 0.25, "com_rise_m": 0.5},
            "floor": {"ballistic_range_m": 0.75, "com_rise_m": 0.0},
            "lengths": {"ballistic_range_m": 0.01, "com_rise_m": 0.02},
            "springs": {"ballistic_range_m": 0.03, "com_rise_m": 0.04},
            "calibration": {"ballistic_range_m": 0.05, "com_rise_m": 0.06},
        },
        {},
        128,
        0.95,
        False,
    )
    page = write_report(robot, {}, jump, sure=sure)
    assert cells(page)["range"][1:] == ["177 mm", "196 mm", "213 mm"]
    assert cells(page)["rise"][1:] == ["57 mm", "65 mm", "74 mm"]
    assert "<p>128 jumps by the planar engine" in page
    section = page.partition("<th>not known exactly</th>")[2].partition("</table>")[0]
    rows = re.findall(r"<tr><td>([^<]+)</td>(.*?)</tr>", section)
    shares = {name: re.findall(r"> (\d+) %", row) for name, row in rows}
    assert (shares["mass"], shares["friction of the floor"]) == (["25", "50"], ["75", "0"])  # of range, of rise
    assert shares["lengths of the links, as printed"] == ["1", "2"]
    assert shares["rate of the springs, as made"] == ["3", "4"]
    assert shares["springs' efficiency and friction of the pins"] == ["5", "6"]
    assert "<dd>177 to 213 mm</dd>" in page
    assert page.index("friction of the floor") < page.index("<td>mass</td>")  # what matters most comes first
    assert 'width: 75%"' in page
    assert "It jumps in 95 % of them." in page
    assert "How sure" not in write_report(robot, {}, jump)


@pytest.mark.thorough
def test_how_sure_agrees_with_other_jumps(robot: Robot) -> None:
    few, many = uncertainty_of(robot), uncertain_jump(robot, Settings(), "planar", seed=1, samples=128)
    assert few is not None
    for figure, near_m in (("ballistic_range_m", 0.004), ("com_rise_m", 0.002)):
        assert few.quantiles[figure] == pytest.approx(many.quantiles[figure], abs=near_m)


def test_a_prototype_stands_beside_what_was_measured(robot: Robot, jump: Jump) -> None:
    """The study measured 35 cm, 12 cm and 1.3 J; the distance is that of a resting place, the height is inside one."""
    page = write_report(robot, {}, jump)
    rows = {key: row for key, row in cells(page).items() if key.startswith(("distance, as", "height", "energy from"))}
    assert [row[1] for row in rows.values()] == ["350 mm"] * 3 + ["120 mm"] * 2 + ["1.30 J"]
    low, middle, high = (float(value) for value in rows["distance, as ballistic range"][2][:-3].split("…"))
    assert low < middle < high < 350.0
    low, _, high = (float(value) for value in rows["distance, as resting place"][2][:-3].split("…"))
    assert low < 350.0 < high
    assert "does not predict the measured distance" not in page
    assert "jumpcad calibrate kenan-1.0 --predict kenan-2.0" in page


def test_other_designs_have_no_such_section(robot: Robot, jump: Jump) -> None:
    design = robot.design.model_copy(update={"stiffness_nmm_per_deg": 9.3})
    assert compared_of(design) is None
    assert "prototype" not in write_report(replace(robot, design=design), {}, jump)


def test_shipped_predictions_are_of_the_shipped_measurements() -> None:
    """Their measured values are those of `templates/measurements`, and one prototype is predicted by the other."""
    names = template_names("compared")
    assert names == template_names("measurements")
    for name in names:
        found = compared_of(load_design(name))
        measured, _ = load_measurements(name)
        (series,) = measured.jumps
        assert found is not None
        assert (found.design, {found.design, found.calibrated_on}) == (name, set(names))
        values = {row.what: row.measured for row in found.rows}
        mean = (series.distance_mm[0] / 1000.0, series.height_mm[0] / 1000.0, series.battery_j[0])
        assert (values["distance"], values["height"], values["battery"]) == pytest.approx(mean)


def test_is_closed_html_that_asks_for_nothing_else(robot: Robot, jump: Jump) -> None:
    page = write_report(robot, {"rest": PNG}, jump)
    opened: list[str] = []

    class Reader(HTMLParser):
        def handle_starttag(self, tag: str, attrs: object) -> None:
            opened.append(tag)

        def handle_endtag(self, tag: str) -> None:
            assert opened.pop() == tag

    Reader(convert_charrefs=True).feed(page)
    assert opened == []
    assert re.findall(r"https?:|src=\"(?!data:)|href=\"(?!#)|<script", page) == []
    assert len(page) < 40_000
    (image,) = parsed(page).iter("img")
    assert base64.b64decode(image.attrib["src"].removeprefix("data:image/png;base64,")) == PNG


def test_says_what_the_robot_is(robot: Robot, jump: Jump) -> None:
    found = cells(write_report(robot, {}, jump))
    assert float(found["mass"][1]) == pytest.approx(1000.0 * robot.mass_kg, abs=0.05)
    assert float(found["spring energy"][1]) == pytest.approx(0.133, abs=0.001)  # the study's figure for Kenan 2.0
    assert {finding.name for finding in constraint_findings(robot)} <= set(found)
    assert {part.name for part in robot.parts} <= set(found)
    assert {thing.article for thing in robot.hardware} <= set(found)
    assert found["electronics_tray_upper"][2] == "1"


def test_each_figure_stands_beside_its_own_name(robot: Robot, jump: Jump) -> None:
    """In the table below and on the cards above; springs without a preload are loaded by the design's angle."""
    page, train = write_report(robot, {}, jump), robot.layout.drive.train
    found = cells(page)
    figures = {
        "spring angle, loaded": (math.degrees(robot.design.compression_rad), "°"), "gear ratio": (train.ratio, ": 1"),
        "winding time": (train.winding_s, "s"), "electrical energy of a jump": (train.electrical_j, "J"),
        "… of it, the boards' while winding": (train.boards_j, "J"),
        "motor current, mean": (1000.0 * train.mean_current_a, "mA"),
        "motor current, peak": (1000.0 * train.peak_current_a, "mA"),
    }  # fmt: skip
    for name, (value, unit) in figures.items():
        digits = len(found[name][1].partition(".")[2])
        assert float(found[name][1]) == pytest.approx(value, abs=0.51 * 10.0**-digits), name
        assert found[name][2] == unit
    for key, value in robot.design.model_dump().items():
        ((name, told, unit),) = (row for row in found.values() if row[0].startswith(f"{key}: "))
        assert (float(told), unit) == (pytest.approx(value), unit_of_key(key) or "ratio"), name
    assert found["gear motor"][1] == train.motor.name
    assert found["mass of the foot"][1] == f"{1000.0 * robot.bodies['foot'].mass_kg:.1f}"
    cards = dict(re.findall(r"<dt>([^<]*)</dt><dd>([^<]*)</dd>", page))
    assert jump.ballistic_range_m is not None
    assert jump.com_rise_m is not None
    assert cards == {
        "range": f"{1000.0 * jump.ballistic_range_m:.0f} mm", "rise": f"{1000.0 * jump.com_rise_m:.0f} mm",
        "mass": f"{1000.0 * robot.mass_kg:.1f} g", "energy in the springs": "133 mJ",
        "winding": f"{train.winding_s:.1f} s", "electrical energy of a jump": f"{train.electrical_j:.2f} J",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("infill", "words"), [(0.35, "35 % gyroid infill"), (0.95, "95 % gyroid infill"), (1.0, "solid")]
)
def test_the_print_settings_are_those_of_the_workshop(robot: Robot, infill: float, words: str) -> None:
    changed = {
        "layer_height_mm": 0.15, "first_layer_mm": 0.25, "line_width_mm": 0.47, "perimeters": 4, "top_layers": 6,
        "bottom_layers": 5, "infill": infill, "infill_pattern": "gyroid",
    }  # fmt: skip
    process = robot.workshop.process.model_copy(update=changed)
    printer = robot.workshop.printer.model_copy(update={"nozzle_mm": 0.5})
    own = robot.workshop.model_copy(update={"process": process, "printer": printer})
    assert (
        "Layers of 0.15 mm, the first 0.25 mm; 4 perimeters of 0.47 mm; 6 solid layers above and 5 below; "
        f"{words}; nozzle of 0.5 mm; no supports."
    ) in section("printing", robot=replace(robot, workshop=own), **file_values(()))


def test_what_is_violated_stands_out_and_names_are_escaped(robot: Robot, jump: Jump) -> None:
    workshop = robot.workshop
    assert workshop is not None
    soft = workshop.model_copy(update={"safety": workshop.safety.model_copy(update={"steel_yield_mpa": 20.0})})
    page = write_report(replace(robot, name="a <b> & c", workshop=soft), {}, jump)
    assert parsed(page).findtext("body/h1") == "a <b> & c"
    broken = [row for row in parsed(page).iter("tr") if row.get("class") == "error"]
    assert "leg_axle_strength" in {row[0].text for row in broken}
    assert "error: the leg's axle, springs loaded" in (broken[0][2].text or "")


def test_same_bytes_for_the_same_robot(robot: Robot, jump: Jump) -> None:
    again = build(load_design("kenan-2.0"), name="kenan-2.0")
    assert write_report(robot, {"rest": PNG}, jump, b"glb") == write_report(again, {"rest": PNG}, jump, b"glb")


def test_the_energy_account_of_the_jump_is_told_and_adds_up(robot: Robot, jump: Jump) -> None:
    found = cells(write_report(robot, {}, jump))
    account = jump.energy_account_j
    assert account is not None
    told = sum(float(found[kind][1]) for kind in account)
    assert told == pytest.approx(1000.0 * robot.spring.energy_j, abs=0.5)


def viewer_data(page: str) -> dict[str, Any]:
    (data,) = (script for script in parsed(page).iter("script") if script.get("id") == "viewer-data")
    found: dict[str, Any] = json.loads(data.text or "")
    return found


def test_the_motion_begins_at_rest_winds_the_springs_and_ends_in_flight(robot: Robot, jump: Jump) -> None:
    data = viewer_data(write_report(robot, {}, jump, b"glb"))
    assert data["phase"] == sorted(data["phase"], key=["winding", "drop", "push-off", "flight"].index)
    assert np.all(np.diff(data["show_s"]) >= 0.0)
    for moment, loaded in ((0, 0.0), (data["phase"].index("drop"), 1.0)):
        for body, pose in body_poses(robot, loaded).items():
            seven = data["frames"][body][moment]
            np.testing.assert_allclose(seven[:3], pose[:3, 3], atol=2e-5)
            np.testing.assert_allclose(Rotation.from_quat(seven[3:]).as_matrix(), pose[:3, :3], atol=5e-5)
    path = np.array(data["com_m"])[np.array(data["phase"]) == "flight"]
    times = np.array(data["time_s"])[np.array(data["phase"]) == "flight"]
    assert np.polyfit(times, path[:, 1], 2)[0] == pytest.approx(-9.81 / 2.0, rel=0.02)


def test_the_page_links_to_the_files_beside_it(robot: Robot, jump: Jump) -> None:
    page = write_report(robot, {}, jump, None, ["assembly.html", "bom.csv", "print/plate 1.3mf"])
    root = parsed(page)
    links = [link.get("href") or "" for link in root.iter("a")]
    assert {"assembly.html", "bom.csv", "print/plate%201.3mf"} == {link for link in links if link[0] != "#"}
    assert [(link.get("href"), link.text) for link in root.iter("a")][:2] == [
        ("assembly.html", "Assembly guide"), ("bom.csv", "Bill of materials"),
    ]  # fmt: skip
    assert links.count("assembly.html") == 3  # at the top, where printing is told, and among the files
    anchors = {element.get("id") for element in root.iter()}
    assert {link[1:] for link in links if link[0] == "#"} <= anchors


def test_files_stand_by_their_folders(robot: Robot) -> None:
    """Each folder with its own count; what lies in a folder within another is not counted there."""
    files = ["bom.csv", "print/plate-1-PLA.3mf", "print/README.md", "urdf/a.urdf", "urdf/meshes/a.stl", "urdf/b.json"]
    page = section("files", **file_values(files))
    assert re.findall(r"<summary>(.*?)</summary>", page) == [
        "this folder (1)", "print (2)", "urdf (2)", "urdf/meshes (1)",
    ]  # fmt: skip
    assert re.findall(r'href="([^"]*)"', page) == [
        "bom.csv", "print/plate-1-PLA.3mf", "print/README.md", "urdf/a.urdf", "urdf/b.json", "urdf/meshes/a.stl",
    ]  # fmt: skip
    told = section("printing", robot=robot, **file_values(files))
    assert re.findall(r'href="([^"]*)"', told) == ["print/plate-1-PLA.3mf", "print/README.md"]
    assert "For other slicers than PrusaSlicer: <a" in told
    assert "For other slicers" not in section("printing", robot=robot, **file_values(files[:2]))


@pytest.mark.parametrize("priced", [True, False])
def test_parts_stand_in_two_tables_with_the_price_of_all_pieces(robot: Robot, priced: bool) -> None:
    """Pads are printed too. Without any price there is no column of prices."""
    price = 0.25 if priced else None
    items = (
        BillLine("printed", "toe", 2, "PETG", 0.0015, "model", price),
        BillLine("pad", "sole", 4, "TPU 95A", 0.0005, "solid"),
        BillLine("bought", "nut", 8, "", 0.00025, "catalogue", price),
    )
    page = f"<x>{section('parts', **robot_values(robot) | {'bill': Bill(items)})}</x>"
    rows = [[cell.text or "" for cell in row] for row in ElementTree.fromstring(page).iter("tr")]
    expected = [
        ["part", "material", "quantity", "g each", "€"], ["toe", "PETG", "2", "1.50", "0.50"],
        ["sole", "TPU 95A", "4", "0.50", ""], ["article", "quantity", "g each", "€"], ["nut", "8", "0.25", "2.00"],
    ]  # fmt: skip
    assert rows == (expected if priced else [row[:-1] for row in expected])


def test_bars_stand_in_one_order_and_what_has_no_share_comes_last_with_its_reason() -> None:
    findings = [
        at_most("half", 5.0, 10.0, "mm", "", ""),
        limit("just", 1e-9, "mm", "", ""),
        at_most("twice", 20.0, 10.0, "mm", "too much", "less", violated="warning"),
        limit("asked", 0.0, "", "", ""),
        at_least("nine tenths", 10.0, 9.0, "mm", "", ""),
        at_most("thrice", 30.0, 10.0, "mm", "too much", "less"),
        limit("apart", -2.0, "mm", "too near", "further"),
        at_least("above", 3.0, 0.0, "mm", "", ""),
        at_most("tenth", 1.0, 10.0, "mm", "", ""),
    ]
    page = section("limits", **limit_values(findings))
    rows = re.findall(r'<tr class="(\w+)"><td>([^<]*)</td><td>(.*?)</td>', page)
    assert [name for _, name, _ in rows] == [
        "thrice", "twice", "apart", "nine tenths", "half", "tenth", "just", "asked", "above",
    ]  # fmt: skip
    reasons = {name: cell.partition("<small>")[2].partition("<")[0] for _, name, cell in rows}
    assert [name for name, reason in reasons.items() if reason] == ["apart", "just", "asked", "above"]
    assert reasons["asked"] == "no share: a condition, kept or not"
    assert reasons["above"] == "no share: the limit is 0"
    assert page.count("<details open") == 1  # what is just kept is seen at once


def test_the_top_says_how_many_limits_are_violated_and_which(robot: Robot, jump: Jump) -> None:
    page = write_report(robot, {}, jump)
    rows = page.partition('id="limits"')[2].count('<tr class="info">')
    assert rows > 80
    assert f"All {rows} limits are kept" in page


def test_the_top_says_what_it_costs_or_where_prices_are_entered(robot: Robot, jump: Jump) -> None:
    page = write_report(robot, {}, jump)
    assert "What it costs is not known" in page
    assert "<code>[prices_eur]</code>" in page
    pla = robot.workshop.materials["PLA"].model_copy(update={"price_eur_per_kg": 20.0})
    materials = dict.fromkeys(robot.workshop.materials, pla)
    some = robot.workshop.model_copy(update={"materials": materials})
    printed_kg = sum(item.total_kg for item in bill_of_materials(robot).items if item.kind == "printed")
    assert f"cost {20.0 * printed_kg:.2f} € at least" in write_report(replace(robot, workshop=some), {}, jump)
    every = some.model_copy(update={"prices_eur": dict.fromkeys(map(chr, range(33, 127)), 1.0)})
    pieces = sum(item.quantity for item in bill_of_materials(robot).items if item.kind == "bought")
    pieces += 2  # a second spring of each hand is ordered, to choose from
    assert f"cost {20.0 * printed_kg + pieces:.2f} €." in write_report(replace(robot, workshop=every), {}, jump)


def test_a_robot_that_does_not_jump_says_why_at_the_top(robot: Robot) -> None:
    light = robot.design.model_copy(update={"stiffness_nmm_per_deg": 1.0})
    found = simulate(jumpcad.capsule_robot(light), Settings())
    page = write_report(robot, {}, found)
    verdict = next(one for one in parsed(page).iter("p") if "verdict" in (one.get("class") or ""))
    assert (verdict.text or "").startswith("It does not jump: the springs hold 14.5 mJ;")
    assert "What to change: raise stiffness_nmm_per_deg" in page
