"""Figures as files."""

import ast
import re

import pytest
from PIL import Image
from support.places import ROOT

from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import require_free
from jumpcad.search.report.figures import (
    figure_words,
    named,
    panels,
    reason_words,
    report_words,
    save_figure,
    with_unit,
)


def test_an_unwritable_folder_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(JumpcadError, match="cannot be written"):
        save_figure(panels(1)[0], tmp_path / "file", "x")


def test_a_figure_is_there_as_svg_and_png_and_repeats(tmp_path):
    for folder in ("a", "b"):
        path = save_figure(panels(1)[0], tmp_path / folder, "x")
        assert path.name == "x.svg"
        require_free(path)
        require_free(path.with_suffix(".png"))
    for name in ("x.svg", "x.png"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert Image.open(tmp_path / "a" / "x.png").width > 400


def refusals():
    """Return the names of the limits with which the package refuses to build a design."""
    for path in (ROOT / "jumpcad").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if "CannotBuildError(" not in text:
            continue
        for call in ast.walk(ast.parse(text)):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "CannotBuildError" and len(call.args) > 1:
                name = call.args[1]
                if isinstance(name, ast.Attribute | ast.Name):  # of a finding: a check of the reference
                    continue
                yield name.value if isinstance(name, ast.Constant) else name.values[0].value + "x"


def test_every_check_and_every_refusal_has_words():
    """All checks of the reference, and every refusal of a layout: words are in `templates/report/reasons.toml`."""
    reference = (ROOT / "docs/reference/checks.md").read_text(encoding="utf-8")
    checks = re.findall(r"^### `(\w+?)(?:_\*)?`$", reference, re.MULTILINE)
    assert {"tips", "gear_strength"} <= set(checks)
    names = {*checks, *refusals()}
    assert [name for name in sorted(names) if not reason_words(name)] == []


def test_when_something_would_break_is_told_as_its_check_computes_it():
    """At landing, at release, under a blocked motor: the words' moment stands in the reference too."""
    reference = (ROOT / "docs/reference/checks.md").read_text(encoding="utf-8")
    told = []
    for check in reference.split("\n### ")[1:]:
        name, _, text = check.partition("\n")
        for moment in ("land", "release", "blocked"):
            if moment in report_words("reasons").get(name.strip("`"), ""):
                assert moment in text, name
                told.append(moment)
    assert len(told) > 12
    assert len({*told}) == 3


def test_the_longest_name_counts_and_an_unknown_reason_has_no_words():
    assert reason_words("room_battery") == report_words("reasons")["room"]
    assert reason_words("gear_strength_2") == report_words("reasons")["gear_strength"]
    assert reason_words("sensor_track") == report_words("reasons")["sensor_track"] != reason_words("sensor_open")
    assert reason_words("roomy") == ""


def test_figures_and_parameters_have_their_units():
    assert figure_words("ballistic_range_m", 0.2024) == ("range, floor or not", "202.4 mm")
    assert figure_words("takeoff_angle_deg", 58.0) == ("angle of take-off above the ground", "58°")
    assert figure_words("foot_mass_kg", 0.0117) == ("mass of the foot", "11.7 g")
    assert figure_words("foot_inertia_kg_m2", 2.5e-5) == ("foot inertia", "2.5e-05 kg·m²")
    assert named("stiffness_nmm_per_deg") == "stiffness_nmm_per_deg (N·mm/°)"
    assert (with_unit("5 … 30", "body.plate_mm"), with_unit("0.8", "c_coef")) == ("5 … 30 mm", "0.8")
