"""How objects are shown: one short line, and in a notebook a picture and the key figures."""

import re
import sys
from dataclasses import replace
from xml.etree import ElementTree

import pytest

import jumpcad
from jumpcad.simulation.engines import default_engine

DESIGN = jumpcad.Design.from_vector([123.456789, 1.0123456789, 0.8123456, 1.2345678, 0.5123456, 61.23456, 12.345, 33.3])


@pytest.fixture(scope="module")
def result():
    return jumpcad.evaluate(jumpcad.load_design("kenan-2.0"))


def table(html):
    """Return the lines of the table in a notebook's HTML, which is well-formed."""
    root = ElementTree.fromstring(re.search("<table>.*</table>", html)[0])
    return {row[0].text: row[1].text for row in root.iter("tr")}


def test_a_rejected_design_says_why():
    weak = jumpcad.load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.5})
    jump = jumpcad.simulate(jumpcad.capsule_robot(weak))
    shown = table(jump._repr_html_())
    assert shown["verdict"] == f"too_weak ({default_engine()})"
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
