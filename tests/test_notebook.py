"""How objects are shown: one short line, and in a notebook a picture and the key figures."""

import re
import sys
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from support.hills import SMALL, Hill

import jumpcad
from jumpcad.bundle.manifest import Bundle
from jumpcad.search import Request, Result, Space, StudyStore, Trial, robot_model
from jumpcad.search.pick.robust import Candidate

LONGEST = 200
DESIGN = jumpcad.Design.from_vector([123.456789, 1.0123456789, 0.8123456, 1.2345678, 0.5123456, 61.23456, 12.345, 33.3])


@pytest.fixture(scope="module")
def result():
    return jumpcad.evaluate(jumpcad.load_design("kenan-2.0"))


def table(html):
    """Return the lines of the table in a notebook's HTML, which is well-formed."""
    root = ElementTree.fromstring(re.search("<table>.*</table>", html)[0])
    return {row[0].text: row[1].text for row in root.iter("tr")}


def things(result, folder):
    trial = Trial("bo", 3, 1, DESIGN, Hill()(DESIGN), 1.23456789, "m", 0.1)
    request = Request(SMALL, Hill())
    yield from (DESIGN, result, result.robot, result.jump, result.robot.workshop)
    yield replace(jumpcad.capsule_robot(DESIGN), name="x" * 300)
    yield jumpcad.simulate(jumpcad.capsule_robot(jumpcad.load_design("best-bo").model_copy(update={"c_coef": 1.2})))
    yield jumpcad.Settings(dt_s=0.000123456, drag_per_s=1.0, flight="simulated")
    yield Bundle(folder, {"name": "n" * 200, "files": {}})
    yield from (trial, request, robot_model("capsule"), Space.default(), Space.parse(fix=["c_coef=1"]), Hill()(DESIGN))
    yield Candidate(trial, 1.0, 2.0, {"loop": 3}, 4)
    yield Result(request, [trial], trial, [Candidate(trial, 1.0, 2.0, {}, 4)], [], ["note"] * 50, 5)
    yield Result(request, [], None, [], [], [], 0)
    with StudyStore.write(None, {"model": {"name": "hill"}}) as store:
        yield store


def test_reprs_are_one_short_line(result, tmp_path):
    for thing in things(result, tmp_path / ("f" * 200)):
        said = repr(thing)
        assert said.startswith(f"<{type(thing).__name__}")
        assert said.endswith(">")
        assert "\n" not in said
        assert len(said) <= LONGEST


def test_a_design_is_a_table_with_units():
    shown = table(DESIGN._repr_html_())
    assert list(shown) == list(jumpcad.design.PARAMETERS)
    assert shown["carrying_link_mm"] == "123.46 mm"
    assert shown["stiffness_nmm_per_deg"] == "12.345 N·mm/°"
    assert shown["rest_angle_deg"] == "61.235 °"
    assert shown["c_coef"] == "1.0123"


def test_a_capsule_robot_has_figures_only():
    robot = jumpcad.capsule_robot(DESIGN)
    assert "<img" not in robot._repr_html_()
    assert table(robot._repr_html_())["longest link"] == f"{DESIGN.l_max_mm:.1f} mm"


def test_a_rejected_design_says_why():
    weak = jumpcad.load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.5})
    jump = jumpcad.simulate(jumpcad.capsule_robot(weak))
    shown = table(jump._repr_html_())
    assert shown["verdict"] == "too_weak (pybullet)"
    assert "error: too_weak" in shown
    assert "ballistic range" not in shown


def test_names_are_escaped():
    assert "<b>" not in replace(jumpcad.capsule_robot(DESIGN), name="<b>&")._repr_html_()


@pytest.mark.thorough
def test_outside_of_a_notebook_a_robot_is_shown_in_the_browser(result, monkeypatch, tmp_path):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.delitem(sys.modules, "IPython", raising=False)
    path = result.robot.show()
    assert path.parent == tmp_path
    assert path.suffix == ".html"
    assert opened == [path.as_uri()]
    page = ElementTree.fromstring(path.read_text(encoding="utf-8").removeprefix("<!DOCTYPE html>"))
    assert page.find(".//div[@id='viewer']") is not None


def test_a_capsule_robot_has_no_page():
    assert not hasattr(jumpcad.capsule_robot(DESIGN), "show")
