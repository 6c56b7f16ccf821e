"""report.html: valid, self-contained, and correct for the robot."""

import base64
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from jumpcad.building import build
from jumpcad.bundle.page import write_report
from jumpcad.checks import constraint_findings
from jumpcad.design import load_design
from jumpcad.robot import Robot

PNG = b"\x89PNG\r\n\x1a\n and so on"


@pytest.fixture(scope="module")
def robot() -> Robot:
    return build(load_design("kenan-2.0"), name="kenan-2.0")


def parsed(page: str) -> ElementTree.Element:
    """Return the page's tree; any tag that is not closed, and any stray character, is an error."""
    return ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))


def cells(page: str) -> dict[str, list[str]]:
    rows = ([cell.text or "" for cell in row.iter("td")] for row in parsed(page).iter("tr"))
    return {row[0]: row for row in rows if row}


def test_is_closed_html_that_asks_for_nothing_else(robot: Robot) -> None:
    page = write_report(robot, {"rest": PNG})
    opened: list[str] = []

    class Reader(HTMLParser):
        def handle_starttag(self, tag: str, attrs: object) -> None:
            opened.append(tag)

        def handle_endtag(self, tag: str) -> None:
            assert opened.pop() == tag

    Reader(convert_charrefs=True).feed(page)
    assert opened == []
    assert re.findall(r"https?:|src=\"(?!data:)|href=|<script", page) == []
    assert len(page) < 30_000
    (image,) = parsed(page).iter("img")
    assert base64.b64decode(image.attrib["src"].removeprefix("data:image/png;base64,")) == PNG


def test_says_what_the_robot_is(robot: Robot) -> None:
    found = cells(write_report(robot, {}))
    assert float(found["mass"][1]) == pytest.approx(1000.0 * robot.mass_kg, abs=0.05)
    assert float(found["spring energy"][1]) == pytest.approx(0.133, abs=0.001)  # the study's figure for Kenan 2.0
    assert {finding.name for finding in constraint_findings(robot)} <= set(found)
    assert {part.name for part in robot.parts} <= set(found)
    assert {thing.article for thing in robot.hardware} <= set(found)
    assert found["electronics_tray_upper"][2] == "1"


def test_what_is_violated_stands_out_and_names_are_escaped(robot: Robot) -> None:
    workshop = robot.workshop
    assert workshop is not None
    soft = workshop.model_copy(update={"safety": workshop.safety.model_copy(update={"steel_yield_mpa": 20.0})})
    page = write_report(replace(robot, name="a <b> & c", workshop=soft), {})
    assert parsed(page).findtext("body/h1") == "a <b> & c"
    broken = [row for row in parsed(page).iter("tr") if row.get("class") == "error"]
    assert "leg_axle_strength" in {row[0].text for row in broken}
    assert "error: the leg's axle, springs loaded" in (broken[0][3].text or "")


def test_same_bytes_for_the_same_robot(robot: Robot) -> None:
    again = build(load_design("kenan-2.0"), name="kenan-2.0")
    assert write_report(robot, {"rest": PNG}) == write_report(again, {"rest": PNG})
