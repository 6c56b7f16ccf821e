"""How objects are shown: one short line, and in a notebook a picture and the key figures."""

import base64
import io
import re
import sys
from dataclasses import replace
from html import unescape
from types import ModuleType, SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image
from support.hills import SMALL, Hill

import jumpcad
from jumpcad.bundle.manifest import Bundle
from jumpcad.bundle.renders import renders, rest_picture
from jumpcad.findings import at_most
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


def test_reprs_say_the_figures_that_matter(result):
    assert "mm=123.46," in repr(DESIGN)
    assert f"range {result.jump.ballistic_range_m:.3f} m" in repr(result)
    assert f"{1000 * result.robot.mass_kg:.1f} g" in repr(result.robot)


def test_reprs_name_the_robot(result):
    assert repr(replace(result.robot, name="mine")).startswith("<Robot 'mine': ")
    assert repr(result.robot).startswith("<Robot without a name: ")


def test_a_design_is_a_table_with_units():
    shown = table(DESIGN._repr_html_())
    assert list(shown) == list(jumpcad.design.PARAMETERS)
    assert shown["carrying_link_mm"] == "123.46 mm"
    assert shown["stiffness_nmm_per_deg"] == "12.345 N·mm/°"
    assert shown["rest_angle_deg"] == "61.235 °"
    assert shown["c_coef"] == "1.0123"


def test_a_robot_has_picture_and_figures(result):
    html = result.robot._repr_html_()
    (data,) = re.findall(r'src="data:image/png;base64,([\w+/=]+)"', html)
    shown = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("L"))
    assert shown.shape == (315, 420)
    assert 0.02 < (shown < 200).mean() < 0.9
    assert table(html)["mass"] == f"{1000 * result.robot.mass_kg:.1f} g"
    assert table(html)["spring energy"] == f"{result.robot.spring.energy_j:.3f} J"
    assert table(html)["longest link"] == f"{result.robot.design.l_max_mm:.1f} mm"
    assert int(table(html)["printed parts"]) == sum(len(part.placements) for part in result.robot.parts)
    first, *others = result.robot.parts
    twice = replace(first, drawing=replace(first.drawing, placements=first.placements * 2))
    more = table(replace(result.robot, parts=(twice, *others))._repr_html_())
    assert int(more["printed parts"]) == int(table(html)["printed parts"]) + 1
    assert int(table(html)["bought parts"]) == len(result.robot.hardware)
    assert table(html)["printer"] == "Original Prusa MK4"
    assert len(html) < 100_000


def test_the_picture_is_the_bundles(result):
    assert rest_picture(result.robot, (200, 150)) == renders(result.robot, (200, 150))["rest"]


def test_a_capsule_robot_has_figures_only():
    robot = jumpcad.capsule_robot(DESIGN)
    assert "<img" not in robot._repr_html_()
    assert table(robot._repr_html_())["longest link"] == f"{DESIGN.l_max_mm:.1f} mm"


def test_jumps_and_evaluations_have_tables(result):
    for thing in (result.jump, result):
        shown = table(thing._repr_html_())
        assert shown["verdict"] == "jump (pybullet)"
        assert shown["ballistic range"] == f"{result.jump.ballistic_range_m:.3f} m"
        assert shown["rise of the centre of mass"] == f"{result.jump.com_rise_m:.3f} m"
        assert shown["mass"] == f"{result.robot.mass_kg:.4f} kg"
        assert shown["spring energy"] == f"{result.robot.spring.energy_j:.3f} J"
        assert shown["energy at take-off / spring energy"] == f"{result.jump.takeoff_energy_ratio:.3f}"
        longest = result.robot.design.l_max_mm / 1000.0
        assert shown["fitness (range / longest link)"] == f"{result.jump.ballistic_range_m / longest:.2f}"
    shown, train = table(result._repr_html_()), result.robot.layout.drive.train
    assert shown["winding time"] == f"{train.winding_s:.1f} s"
    assert shown["winding energy (electrical)"] == f"{train.electrical_j:.2f} J"


def test_a_rejected_design_says_why():
    weak = jumpcad.load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.5})
    jump = jumpcad.simulate(jumpcad.capsule_robot(weak))
    shown = table(jump._repr_html_())
    assert shown["verdict"] == "too_weak (pybullet)"
    assert "error: too_weak" in shown
    assert "ballistic range" not in shown


def test_an_evaluation_says_what_rejects_its_robot(result):
    """What the checks of the robot found, not of its jump alone."""
    weak = at_most("leg_strength", 50.0, 40.0, "MPa", "the leg has 50 MPa", "make it thicker")
    kept = at_most("toe_strength", 30.0, 40.0, "MPa", "the toes have 30 MPa", "make them thicker")
    shown = table(replace(result, findings=(*result.findings, weak, kept))._repr_html_())
    assert {name: said for name, said in shown.items() if name.startswith("error")} == {
        "error: leg_strength": "the leg has 50 MPa; make it thicker"
    }


def test_names_are_escaped():
    assert "<b>" not in replace(jumpcad.capsule_robot(DESIGN), name="<b>&")._repr_html_()


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


@pytest.mark.parametrize("kernel", [None, object()], ids=["terminal", "notebook"])
def test_in_a_notebook_the_page_stands_below_the_cell(result, monkeypatch, tmp_path, kernel):
    shown, opened = [], []
    ipython, display = ModuleType("IPython"), ModuleType("IPython.display")
    ipython.get_ipython = lambda: SimpleNamespace(kernel=kernel)
    display.display = shown.append
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    path = result.robot.show()
    if kernel is None:
        assert not shown
        assert opened == [path.as_uri()]
        return
    assert path is None
    assert not opened
    assert not list(tmp_path.iterdir())
    frame = ElementTree.fromstring(shown[0]._repr_html_())
    inside = ElementTree.fromstring(frame.get("srcdoc").removeprefix("<!DOCTYPE html>"))
    assert inside.findtext("body/h1") == result.robot.name
    assert unescape(shown[0]._repr_html_()).count("</iframe>") == 1


def test_a_capsule_robot_has_no_page():
    assert not hasattr(jumpcad.capsule_robot(DESIGN), "show")


def test_the_result_of_a_search_is_a_table():
    found = jumpcad.optimize("ga", 40, model="capsule", workers=0)
    shown = table(found._repr_html_())
    assert shown["fitness"] == f"{found.score:.4g} body lengths"
    assert float(shown["carrying_link_mm"]) == pytest.approx(found.design.carrying_link_mm, rel=1e-4)
    assert {name: int(shown[f"rejected: {name}"]) for name in found.rejected} == found.rejected
    best = jumpcad.optimize("nsga2", 40, model="capsule", workers=0)
    shown = table(best._repr_html_())
    assert [name for name in shown if name.startswith("energy in the springs ")] == [
        f"energy in the springs {trial.design.spring_energy_j:.4g} J" for trial in best.front
    ]


def test_a_search_without_a_design_that_jumps_has_a_table_too():
    shown = table(Result(Request(SMALL, Hill()), [], None, [], [], [], 0)._repr_html_())
    assert shown["designs evaluated"].startswith("0,")
