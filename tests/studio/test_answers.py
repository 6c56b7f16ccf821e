"""Figures as the studio shows them: units, differences from the robot before, the tightest limits."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from support.built import built

from jumpcad.findings import Finding
from jumpcad.studio.answers import Printed

NAME = "kenan-2.0"


def printed(reach_m: float | None = 0.2, findings: list[Finding] | None = None) -> Printed:
    jump: Any = SimpleNamespace(verdict="jump", touchdown_distance_m=reach_m, com_rise_m=0.08)
    found = Printed(built(NAME).design, built(NAME), jump)
    vars(found)["findings"] = findings or []
    return found


def test_figures_are_in_millimetres_grams_and_millijoules() -> None:
    """Kenan 2.0's springs hold 133 mJ, as the study says."""
    found = printed().figures()
    assert found["touchdown"] == (pytest.approx(200.0), "mm")
    assert found["rise"] == (pytest.approx(80.0), "mm")
    assert found["mass"] == (pytest.approx(1000.0 * built(NAME).mass_kg), "g")
    assert found["spring energy"] == (pytest.approx(133.0, abs=1.0), "mJ")
    assert found["winding"] == (built(NAME).layout.drive.train.winding_s, "s")
    assert printed(None).figures()["touchdown"] == (0.0, "mm")
    assert replace(printed(), robot=None).figures() == {}


def test_what_cannot_be_built_says_why() -> None:
    found = Printed(built(NAME).design, reason="no room")
    assert found.to_markdown().startswith("**cannot be built**: no room (")
    assert found.findings == []
