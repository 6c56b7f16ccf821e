"""Sections that are too weak grow until the checks pass, or stay where there is no room, which is reported."""

from typing import Any

import pytest

from jumpcad import checks
from jumpcad.building import assembly, build
from jumpcad.checks import check
from jumpcad.checks.strength import strength_findings
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, at_least, errors
from jumpcad.robot import Robot
from jumpcad.strength.sizing import KEY_MM, Growth
from jumpcad.workshop import Workshop, load_workshop


def workshop(material: str = "PETG", figures: dict[str, float] | None = None, **safety: float) -> Workshop:
    shop = load_workshop()
    weaker = shop.materials[material].model_copy(update=figures or {})
    safer = shop.safety.model_copy(update=safety)
    return shop.model_copy(update={"materials": {**shop.materials, material: weaker}, "safety": safer})


def test_what_was_sized_to_hold_does_not_grow(monkeypatch: pytest.MonkeyPatch) -> None:
    steps: list[Any] = []
    monkeypatch.setattr(Growth, "more", lambda self, weak: steps.append(weak))
    for name in ("kenan-2.0", "best-bo"):
        build(load_design(name))
    assert steps == []


@pytest.mark.parametrize(
    ("shop", "grown"),
    [
        (workshop(figures={"strength_interlayer_mpa": 4.0}), {"lug_thickness_mm", "key_mm"}),
        (workshop(landing_stop_mm=2.0), {"toe_root_mm", "front_mm", "thickness_mm"}),
        (workshop("PLA", {"strength_in_plane_mpa": 35.0}), {"plate"}),
    ],
)
def test_sections_grow_until_the_checks_pass(shop: Workshop, grown: set[str]) -> None:
    design = load_design("best-bo")
    as_sized = assembly.assembled(design, shop, "", Growth())
    assert errors(strength_findings(as_sized))
    robot = build(design, shop)
    assert errors(check(robot)) == []
    assert robot.mass_kg > as_sized.mass_kg
    before, after = (
        {**vars(r.layout.sections), "plate": r.layout.lateral.left_plate} for r in (as_sized, robot) if r.layout
    )
    assert grown <= {name for name in before if before[name] != after[name]}


def test_any_check_can_make_a_section_grow(monkeypatch: pytest.MonkeyPatch) -> None:
    def wide_key(robot: Robot) -> list[Finding]:
        return [at_least("key_width", robot.layout.sections.key_mm, 7.5, "mm", "found", "remedy", grows="key")]

    monkeypatch.setattr(checks, "CHECKS", (*checks.CHECKS, checks.Check(wide_key, cheap=True)))
    assert build(load_design("kenan-2.0")).layout.sections.key_mm == pytest.approx(1.1 * KEY_MM)


def test_what_finds_no_room_to_grow_stays_and_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    layout_of = assembly.layout_of

    def narrow(design: Any, shop: Any, growth: Growth) -> Any:
        if growth.toe > 1.15:
            raise CannotBuildError("no room")
        return layout_of(design, shop, growth)

    monkeypatch.setattr(assembly, "layout_of", narrow)
    robot = build(load_design("best-bo"), workshop(landing_stop_mm=4.0))
    assert "toe_landing" in {finding.name for finding in errors(strength_findings(robot))}
