"""report.html: valid, self-contained, and correct for the robot."""

import base64
import json
import math
import re
import xml.etree.ElementTree as ET
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.workshops import workshop_with

import jumpcad
from jumpcad.building import build
from jumpcad.bundle.page import Beside, Compared, compared_of, write_report
from jumpcad.calibration.measurements import load_measurements
from jumpcad.design import load_design
from jumpcad.dimensions import unit_of_key
from jumpcad.files import template_names
from jumpcad.files.templates import fill
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump, Settings, simulate, uncertain_jump
from jumpcad.simulation.uncertain import FIGURES, Uncertainty, uncertainty_of

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


@pytest.mark.thorough
def test_how_sure_agrees_with_other_jumps(robot: Robot) -> None:
    """Quantiles of 64 jumps scatter by a few millimetres."""
    few, many = uncertainty_of(robot), uncertain_jump(robot, Settings(), "planar", seed=1, samples=128)
    assert few is not None
    for figure, near_m in (("touchdown_distance_m", 0.006), ("com_rise_m", 0.002)):
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
    assert len(page) < 42_000
    (image,) = parsed(page).iter("img")
    assert base64.b64decode(image.attrib["src"].removeprefix("data:image/png;base64,")) == PNG


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
        "touches the floor after": f"{1000.0 * jump.touchdown_distance_m:.0f} mm",
        "range, floor or not": f"{1000.0 * jump.ballistic_range_m:.0f} mm",
        "rise": f"{1000.0 * jump.com_rise_m:.0f} mm",
        "mass": f"{1000.0 * robot.mass_kg:.1f} g", "energy in the springs": "133 mJ",
        "winding": f"{train.winding_s:.1f} s", "electrical energy of a jump": f"{train.electrical_j:.2f} J",
    }  # fmt: skip


def test_what_is_violated_stands_out_and_names_are_escaped(robot: Robot, jump: Jump) -> None:
    soft = workshop_with(robot.workshop, safety={"steel_yield_mpa": 20.0})
    page = write_report(replace(robot, name="a <b> & c", workshop=soft), {}, jump)
    assert parsed(page).findtext("body/h1") == "a <b> & c"
    broken = [row for row in parsed(page).iter("tr") if row.get("class") == "error"]
    assert "leg_axle_strength" in {row[0].text for row in broken}
    assert "error: the leg's axle, springs loaded" in (broken[0][2].text or "")


def test_the_energy_account_of_the_jump_is_told_and_adds_up(robot: Robot, jump: Jump) -> None:
    page = write_report(robot, {}, jump)
    found, account = cells(page), jump.energy_account_j
    assert account is not None
    told = sum(float(found[kind][1]) for kind in account)
    assert told == pytest.approx(1000.0 * robot.spring.energy_j, abs=0.5)
    flight = 50.0 * robot.mass_kg * jump.takeoff_speed_m_s**2 / robot.spring.energy_j
    assert f"{flight:.0f} % are in the flight" in page
    assert "EPFL 7 g jumper has 81 % in its flight (remembered)" in page


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


def test_a_robot_that_does_not_jump_says_why_at_the_top(robot: Robot) -> None:
    light = robot.design.model_copy(update={"stiffness_nmm_per_deg": 1.0})
    found = simulate(jumpcad.capsule_robot(light), Settings())
    page = write_report(robot, {}, found)
    verdict = next(one for one in parsed(page).iter("p") if "verdict" in (one.get("class") or ""))
    assert (verdict.text or "").startswith("It does not jump: the springs hold 14.5 mJ;")
    assert "What to change: raise stiffness_nmm_per_deg" in page


def row(what: str, reading: str, measured: float, predicted: tuple[float, float, float], below: float = 0.4) -> Beside:
    return Beside.model_construct(what=what, reading=reading, measured=measured, predicted=predicted, below_share=below)


def verdict(*rows: Beside) -> str:
    found = Compared.model_construct(design="a", calibrated_on="b", rows=rows)
    return fill("report/compared.html.j2", {"beside": found})


@pytest.mark.parametrize(("measured", "holds"), [(0.19, False), (0.2, True), (0.3, True), (0.4, True), (0.41, False)])
def test_a_measurement_is_predicted_where_eight_in_ten_draws_hold_it(measured: float, holds: bool) -> None:
    said = verdict(row("distance", "first-touchdown", measured, (0.2, 0.3, 0.4)))
    assert ("Every measurement lies within" in said) == holds
    assert ("does not predict the measured distance" in said) == (not holds)


def test_one_reading_that_holds_is_enough_and_each_quantity_is_named_once() -> None:
    far = row("distance", "first-touchdown", 0.5, (0.2, 0.3, 0.4))
    assert "Every measurement" in verdict(far, row("distance", "resting-place", 0.5, (0.4, 0.5, 0.6)))
    said = verdict(far, far, row("battery", "battery", 3.0, (1.0, 1.5, 2.0)))
    assert "the measured distance and battery energy: no interval" in said


SHARES = {
    "mass": {"touchdown_distance_m": 0.25, "com_rise_m": 0.5},
    "floor": {"touchdown_distance_m": 0.624, "com_rise_m": 0.0},
    "lengths": {"touchdown_distance_m": 0.01, "com_rise_m": 0.9},
}
FOUND = Uncertainty(
    {"touchdown_distance_m": [0.1771, 0.196, 0.2134], "com_rise_m": [0.0574, 0.0649, 0.0741]},
    SHARES,
    {},
    128,
    1.0,
    False,
)


def section(found: Uncertainty) -> ET.Element:
    """Return the section's tree; any tag that is not closed is an error."""
    values = {"sure": found, "sure_figures": FIGURES}
    return ET.fromstring(f"<section>{fill('report/uncertainty.html.j2', values)}</section>")


def cells_of(row: ET.Element) -> list[str]:
    """Return the words of a row's cells_of."""
    return ["".join(cell.itertext()).strip() for cell in row]


def test_quantiles_are_told_in_whole_millimetres_below_what_they_are_of() -> None:
    """Of ten robots one stays below the 10 % quantile, half below the median, nine below the 90 % quantile."""
    first, _ = section(FOUND).iter("table")
    heads, *rows = (cells_of(row) for row in first.iter("tr"))
    assert heads == ["of ten robots", "one stays below", "half", "nine"]
    assert rows == [["touchdown", "177 mm", "196 mm", "213 mm"], ["rise", "57 mm", "65 mm", "74 mm"]]
    assert {cell.get("class") for cell in first.iter("td")} == {None, "number"}
    for row in list(first.iter("tr"))[1:]:
        assert [cell.get("class") for cell in row] == [None, "number", "number", "number"]


def test_what_explains_most_of_the_range_comes_first() -> None:
    """Whatever it explains of the rise; shares in whole percent, a column for either."""
    _, second = section(FOUND).iter("table")
    heads, *rows = (cells_of(row) for row in second.iter("tr"))
    assert heads == ["not known exactly", "of touchdown", "of rise"]
    assert rows == [
        ["friction of the floor", "62 %", "0 %"],
        ["mass", "25 %", "50 %"],
        ["lengths of the links, as printed", "1 %", "90 %"],
    ]
