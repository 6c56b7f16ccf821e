"""All checks together, the cheap ones among them, the drive's, and the command."""

import json
from dataclasses import fields
from pathlib import Path

import pytest
from typer.testing import CliRunner

import jumpcad
from jumpcad import checks
from jumpcad.checks import constraint_findings
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import at_most, limit
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.robot import Robot
from jumpcad.strength.sizing import Growth


def test_nothing_is_wrong_with_kenan(kenan: Robot) -> None:
    findings = jumpcad.check(kenan)
    assert {finding.severity for finding in findings} == {"info"}
    assert all(finding.margin >= 0 and finding.message and finding.remedy for finding in findings)
    assert len({finding.name for finding in findings}) == len(findings)


def test_constraints_are_among_all_checks_and_leave_the_gates_to_the_jump(kenan: Robot) -> None:
    constraints, everything = constraint_findings(kenan), jumpcad.check(kenan)
    assert all(finding in everything for finding in constraints)
    assert {"loop", "below_ground", "tips", "too_weak"}.isdisjoint(finding.name for finding in constraints)
    assert {"loop", "below_ground", "tips", "too_weak"} < {finding.name for finding in everything}


def test_a_check_of_the_registry_is_run_by_all_that_is_cheap(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    weight = at_most("weight", 1000.0 * kenan.mass_kg, 200.0, "g", "found", "remedy")
    monkeypatch.setattr(checks, "CHECKS", (checks.Check(lambda robot: [weight], cheap=True),))
    assert checks.check(kenan) == checks.quick_findings(kenan) == constraint_findings(kenan) == [weight]
    monkeypatch.setattr(checks, "CHECKS", (checks.Check(lambda robot: [weight]),))
    assert (checks.check(kenan), checks.quick_findings(kenan), constraint_findings(kenan)) == ([weight], [], [])
    assert checks.check(capsule_robot(kenan.design)) == []


def test_margins_are_the_distance_from_value_to_limit(kenan: Robot, strongest: Robot) -> None:
    findings = [finding for robot in (kenan, strongest) for finding in jumpcad.check(robot)]
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


def test_command_finds_nothing_wrong_with_kenan() -> None:
    result = CliRunner().invoke(app, ["check", "kenan-2.0"])
    assert result.exit_code == 0
    assert "0 errors, 0 warnings" in result.output


@pytest.mark.parametrize("as_json", [False, True])
def test_command_fails_where_an_axle_is_too_weak(tmp_path: Path, as_json: bool) -> None:
    soft = tmp_path / "soft.toml"
    soft.write_text("[safety]\nsteel_yield_mpa = 20.0\n", encoding="utf-8")
    arguments = ["check", "kenan-2.0", "--workshop", str(soft), *(["--json"] if as_json else [])]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 1
    if as_json:
        first = json.loads(result.output)["findings"][0]
        assert (first["name"], first["severity"], first["unit"]) == ("leg_axle_strength", "error", "MPa")
    else:
        assert result.output.index("leg_axle_strength") < result.output.index("bed_fit")
        assert "0 errors" not in result.output


def test_command_says_which_part_does_not_fit_the_bed(tmp_path: Path) -> None:
    small = tmp_path / "small.toml"
    small.write_text('[printer]\nname = "tiny"\nbed_mm = [100.0, 100.0, 100.0]\nnozzle_mm = 0.4\n', encoding="utf-8")
    result = CliRunner().invoke(app, ["check", "kenan-2.0", "--workshop", str(small)])
    assert isinstance(result.exception, CannotBuildError)
    assert "part foot of" in str(result.exception)
