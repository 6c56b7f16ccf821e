"""All checks together, the cheap ones among them, and those of the drive."""

from dataclasses import fields

import pytest
from support.built import checked

import jumpcad
from jumpcad import checks
from jumpcad.checks import constraint_findings
from jumpcad.design import load_design
from jumpcad.findings import at_most, limit
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.strength.growth import Growth


def test_nothing_is_wrong_with_kenan() -> None:
    findings = checked("kenan-2.0")
    assert {finding.severity for finding in findings} == {"info"}
    assert all((finding.margin >= 0 or finding.is_note) and finding.message and finding.remedy for finding in findings)
    assert len({finding.name for finding in findings}) == len(findings)


def test_constraints_are_among_all_checks_and_leave_the_gates_to_the_jump(kenan: Robot) -> None:
    constraints, everything = constraint_findings(kenan), checked("kenan-2.0")
    assert all(finding in everything for finding in constraints)
    assert {"loop", "below_ground", "tips", "too_weak"}.isdisjoint(finding.name for finding in constraints)
    assert {"loop", "below_ground", "tips", "too_weak"} < {finding.name for finding in everything}
    # all that can fail where a design's blows are hard or its parts heavy
    heavy = {"leg_strength", "stop_leg", "release_kick", "gearbox_torque", "electronics_hold", "ground_clearance"}
    assert heavy | {"axle_retention", "sideways_tipping", "bed_fit"} < {finding.name for finding in constraints}


def test_a_check_of_the_registry_is_run_by_all_that_is_cheap(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    weight = at_most("weight", 1000.0 * kenan.mass_kg, 200.0, "g", "found", "remedy")
    monkeypatch.setattr(checks, "CHECKS", (checks.Check(lambda robot: [weight], {}, cheap=True),))
    assert checks.check(kenan) == checks.quick_findings(kenan) == constraint_findings(kenan) == [weight]
    assert checks.costly_findings(kenan) == []
    monkeypatch.setattr(checks, "CHECKS", (checks.Check(lambda robot: [weight], {}, cheap=False),))
    assert (checks.check(kenan), checks.quick_findings(kenan), constraint_findings(kenan)) == ([weight], [], [])
    assert checks.costly_findings(kenan) == [weight]
    assert checks.check(capsule_robot(kenan.design)) == []


@pytest.mark.thorough
def test_margins_are_the_distance_from_value_to_limit() -> None:
    findings = [finding for name in ("kenan-2.0", "best-bo") for finding in checked(name)]
    compared = [finding for finding in findings if finding.value is not None and finding.limit is not None]
    assert len(compared) > 0.7 * len(findings)
    for finding in compared:
        assert abs(finding.margin) == pytest.approx(abs(finding.limit - finding.value), rel=1e-9, abs=1e-12)
        assert finding.use is None or (finding.use <= 1.0) == (finding.margin >= 0.0)


def test_what_a_check_makes_grow_is_a_factor_of_growth(strongest: Robot) -> None:
    named = {finding.name: finding.grows for finding in constraint_findings(strongest) if finding.grows}
    assert set(named.values()) == {field.name for field in fields(Growth)}
    assert named["leg_sideways"] == named["eye_strength"] == "thickness"
    assert named["toe_landing"] == "toe"


def test_a_mechanism_without_parts_has_only_the_gates_findings() -> None:
    robot = capsule_robot(load_design("kenan-2.0"))
    assert {finding.name for finding in jumpcad.check(robot)} == {"loop", "below_ground", "tips", "too_weak"}


def test_a_limit_is_violated_below_zero_alone() -> None:
    assert limit("a", 0.0, "mm", "", "").severity == "info"
    assert limit("a", -0.1, "mm", "", "").severity == "error"
    assert limit("a", -0.1, "mm", "", "", "warning").severity == "warning"
