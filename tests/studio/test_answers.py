"""Figures as the studio shows them: units, differences from the robot before, the tightest limits."""

import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from support.built import built

from jumpcad.findings import Finding, at_most, limit
from jumpcad.studio.answers import SHOWN, Printed

NAME = "kenan-2.0"


def printed(reach_m: float | None = 0.2, findings: list[Finding] | None = None) -> Printed:
    jump: Any = SimpleNamespace(verdict="jump", ballistic_range_m=reach_m, com_rise_m=0.08)
    found = Printed(built(NAME).design, built(NAME), jump)
    vars(found)["findings"] = findings or []
    return found


def test_figures_are_in_millimetres_grams_and_millijoules() -> None:
    """Kenan 2.0's springs hold 133 mJ, as the study says."""
    found = printed().figures()
    assert found["range"] == (pytest.approx(200.0), "mm")
    assert found["rise"] == (pytest.approx(80.0), "mm")
    assert found["mass"] == (pytest.approx(1000.0 * built(NAME).mass_kg), "g")
    assert found["spring energy"] == (pytest.approx(133.0, abs=1.0), "mJ")
    assert found["winding"] == (built(NAME).layout.drive.train.winding_s, "s")
    assert printed(None).figures()["range"] == (0.0, "mm")
    assert replace(printed(), robot=None).figures() == {}


def test_the_tightest_five_limits_are_shown_and_every_error() -> None:
    """The violated ones bold; a limit without a share by its margin."""
    kept = [at_most(f"kept_{number}", 9.0 - number, 10.0, "mm", "", "") for number in range(7)]
    wrong = [at_most(f"wrong_{number}", 20.0, 10.0, "mm", "", "") for number in range(6)]
    names = re.findall(r"\| \*?\*?(\w+_\d)", printed(findings=kept).to_markdown())
    assert names == [one.name for one in kept[:SHOWN]] == [f"kept_{number}" for number in range(5)]
    assert "| kept_1 | 80 % |" in printed(findings=kept).to_markdown()
    text = printed(findings=[*wrong, *kept]).to_markdown()
    assert re.findall(r"\| \*\*(\w+)\*\* \| 200 % \|", text) == [one.name for one in wrong]
    assert "kept" not in text
    assert "| **apart** | -0.25 mm |" in printed(findings=[limit("apart", -0.25, "mm", "", "")]).to_markdown()


def test_all_that_is_violated_is_shown_in_units_that_people_read() -> None:
    """A warning with a share stands before an error without one, and must not take its place; angles are in degrees."""
    warned = [at_most(f"warned_{number}", 20.0, 10.0, "mm", "", "", "warning") for number in range(3)]
    wrong = [limit(f"wrong_{number}", -0.1, "rad", "", "") for number in range(6)]
    text = printed(findings=[*warned, *wrong]).to_markdown()
    assert re.findall(r"\| \*\*(\w+)\*\* \|", text) == [one.name for one in [*warned, *wrong]]
    assert "| **wrong_5** | -5.73 ° |" in text


def test_what_cannot_be_built_says_why() -> None:
    found = Printed(built(NAME).design, reason="no room")
    assert found.to_markdown().startswith("**cannot be built**: no room (")
    assert found.findings == []
