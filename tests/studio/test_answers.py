"""Figures as the studio shows them: units, differences from the robot before, the tightest limits."""

import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from support.built import built

from jumpcad.findings import Finding, at_most, limit
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.studio import answers
from jumpcad.studio.answers import SHOWN, Printed
from jumpcad.workshop import load_workshop

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


def test_a_difference_is_said_from_a_twentieth_on() -> None:
    """Of the figures alone that both robots have."""
    text = printed(0.2).to_markdown(printed(0.19))
    assert "| range | 200.0 mm (+10.0) |" in text
    assert text.count("(") == 1
    assert "| range | 200.0 mm (-10.0) |" in printed(0.2).to_markdown(printed(0.21))
    assert "| range | 200.0 mm |" in printed(0.2).to_markdown(printed(0.20004))
    assert "(+0.1)" in printed(0.2).to_markdown(printed(0.19994))
    assert "(" not in printed().to_markdown()
    assert "(" not in printed().to_markdown(replace(printed(), robot=None))


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


def test_a_limit_just_kept_without_a_share_is_among_the_tightest() -> None:
    """As `jumpcad check` and the report say of Kenan 2.0's cam, whose next lift is as near as it may be."""
    text = Printed(built(NAME).design, built(NAME), printed().jump).to_markdown()
    assert "| cam_next_lift | at the limit |" in text


def test_limits_are_those_of_its_robot_the_violated_first_then_by_use(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is violated is always told, what is kept only where it has a share."""
    told = [
        at_most("kept", 1.0, 2.0, "N", "", ""), at_most("broken", 3.0, 2.0, "N", "", ""),
        limit("apart", -0.25, "mm", "", ""), limit("far", 0.25, "mm", "", ""),
        at_most("tight", 1.9, 2.0, "N", "", ""), at_most("warned", 5.0, 2.0, "N", "", "", "warning"),
    ]  # fmt: skip
    asked: list[Any] = []
    monkeypatch.setattr(answers, "quick_findings", lambda robot: asked.append(robot) or told)
    found = Printed(built(NAME).design, built(NAME))
    assert [one.name for one in found.findings] == ["warned", "broken", "apart", "tight", "kept"]
    assert asked == [built(NAME)]


def test_what_cannot_be_built_says_why() -> None:
    found = Printed(built(NAME).design, reason="no room")
    assert found.to_markdown().startswith("**cannot be built**: no room (")
    assert found.findings == []


def test_a_printed_robot_is_that_of_the_workshop_and_name_that_are_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the planar engine: the others take too long for a slider."""
    asked: list[Any] = []
    monkeypatch.setattr(answers, "build", lambda *given: asked.append(given) or "robot")
    monkeypatch.setattr(answers, "simulate", lambda robot, engine: (robot, engine))
    design, shop = built(NAME).design, load_workshop("fine")
    found = answers.printed_answer(design, shop, "frog")
    assert asked == [(design, shop, "frog")]
    assert (found.design, found.robot, found.jump, found.reason) == (design, "robot", ("robot", "planar"), "")


@pytest.mark.parametrize(("reach_m", "said"), [(0.1906, "**191 mm**, rise 64 mm"), (None, "**tips**")])
def test_the_capsule_robot_is_told_in_millimetres(
    monkeypatch: pytest.MonkeyPatch, reach_m: float | None, said: str
) -> None:
    jump = SimpleNamespace(ballistic_range_m=reach_m, com_rise_m=0.0641, verdict="tips")
    asked: list[Any] = []
    monkeypatch.setattr(answers, "simulate", lambda robot, **how: asked.append((robot.mass_kg, how)) or jump)
    answers.capsule_answer.cache_clear()
    assert answers.capsule_answer(built(NAME).design) == f"study's masses: {said}"
    assert asked == [(capsule_robot(built(NAME).design).mass_kg, {"engine": "planar"})]  # docs/start.md
    answers.capsule_answer.cache_clear()
