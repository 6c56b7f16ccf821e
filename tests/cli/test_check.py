"""`jumpcad check`."""

import json
import re
from pathlib import Path

import pytest
from support.built import built
from typer.testing import CliRunner

from jumpcad import checks
from jumpcad.bundle.limits import limit_values, limits_of
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.workshop import load_workshop


def test_command_finds_nothing_wrong_with_kenan() -> None:
    result = CliRunner().invoke(app, ["check", "kenan-2.0"])
    assert result.exit_code == 0
    assert re.match(r"jumps 202 mm far and 69 mm high with 115\.9 g; all \d+ limits are kept\n", result.output)


def test_rows_and_the_limits_left_out_are_all_that_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plug that bears 100 V is no limit of a robot of 4.2 V, and is not counted."""
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    output = CliRunner().invoke(app, ["check", "kenan-2.0"], env={"COLUMNS": "999"}).output
    rows = len(re.findall("^ *tight ", output, re.MULTILINE))
    left, held = (int(re.search(rf"(\d+) {words}", output)[1]) for words in ("more are kept", "limits are kept"))  # type: ignore[index]
    assert rows + left == held
    every = json.loads(CliRunner().invoke(app, ["check", "kenan-2.0", "--json"]).output)
    uses = {one["name"]: one["use"] for one in every["findings"]}
    assert held == every["limits"] == sum(use is None or use >= 0.1 for use in uses.values())
    assert limit_values(limits_of(built("kenan-2.0")))["count"] == held  # as report.html says
    assert uses["supply_voltage_plug"] == pytest.approx(4.2 / 100.0)


def test_a_robot_that_stays_on_the_ground_is_no_success_and_has_a_remedy_that_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All its limits but the jump are kept; with the stiffness that its remedy names it jumps."""
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    weak = load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 3.0})
    (tmp_path / "weak.toml").write_text(weak.to_toml(), encoding="utf-8")
    said = CliRunner().invoke(app, ["check", str(tmp_path / "weak.toml")], env={"COLUMNS": "999"})
    assert said.exit_code == 1
    assert said.output.startswith("does not jump (no_takeoff); ")
    found = json.loads(CliRunner().invoke(app, ["check", str(tmp_path / "weak.toml"), "--json"]).output)
    assert found["verdict"] == "no_takeoff"
    remedy = next(one["remedy"] for one in found["findings"] if one["name"] == "no_takeoff")
    stiffness = float(re.search(r"raise stiffness_nmm_per_deg to ([\d.]+)", remedy)[1])  # type: ignore[index]
    assert 3.0 < stiffness < 9.2
    assert evaluate(weak.model_copy(update={"stiffness_nmm_per_deg": stiffness})).verdict == "jump"


def test_a_design_that_cannot_be_built_is_refused_with_a_value_that_can(tmp_path: Path) -> None:
    far = load_design("kenan-2.0").model_copy(update={"compression_ratio": 0.9})
    (tmp_path / "far.toml").write_text(far.to_toml(), encoding="utf-8")
    refused = CliRunner().invoke(app, ["check", str(tmp_path / "far.toml")])
    assert isinstance(refused.exception, CannotBuildError)
    ratio = float(re.search(r"compression_ratio to (0\.\d+)", str(refused.exception))[1])  # type: ignore[index]
    assert evaluate(far.model_copy(update={"compression_ratio": ratio})).verdict == "jump"


def test_what_became_of_a_robot_by_itself_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A bought spring of 26.36 N·mm/° has 5.7 times the stiffness of the design's, for which its stop's bar grows."""
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    (tmp_path / "stock.toml").write_text('[bought]\nspring = "9271K589"\n', encoding="utf-8")
    arguments = ["check", "kenan-2.0", "--workshop", str(tmp_path / "stock.toml")]
    lines = CliRunner().invoke(app, arguments).output.splitlines()
    assert re.match(r"note: sections grew to carry \d\.\d times the load .*stop by \d+ % \(stop_strength\)", lines[1])
    assert "have 52.72 N·mm/°" in lines[2]
    grown = json.loads(CliRunner().invoke(app, [*arguments, "--json"]).output)["grown"]
    assert all(one["factor"] > 1.0 and one["use"] > 1.0 for one in grown)


@pytest.mark.parametrize("as_json", [False, True])
def test_command_fails_where_an_axle_is_too_weak(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, as_json: bool
) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))  # without solids
    soft = tmp_path / "soft.toml"
    soft.write_text("[safety]\nsteel_yield_mpa = 20.0\n", encoding="utf-8")
    arguments = ["check", "kenan-2.0", "--workshop", str(soft), *(["--json"] if as_json else [])]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 1
    if as_json:
        first = json.loads(result.output)["findings"][0]
        assert (first["name"], first["severity"], first["unit"]) == ("leg_axle_strength", "error", "MPa")
    else:
        assert re.search(r"error +leg_axle_strength.*tight ", result.output, re.DOTALL)
        assert "limits are violated: do not build it as it is" in result.output


def test_a_printer_is_named_on_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    arguments = ["check", "kenan-2.0", "--printer", "a1-mini", "--material", "PLA", "--all"]
    output = CliRunner().invoke(app, arguments, env={"COLUMNS": "200"}).output
    assert "180 x 180 x 180 mm" in output


def test_a_material_is_named_on_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """The legs' allowed stress is then that of PLA; they are of PETG."""
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))

    def allowed_mpa(*more: str) -> float:
        arguments = ["check", "kenan-2.0", "--explain", "leg_strength", "--json", *more]
        (finding,) = json.loads(CliRunner().invoke(app, arguments).output)["findings"]
        return float(finding["limit"])

    materials = load_workshop().materials
    share = materials["PLA"].strength_in_plane_mpa / materials["PETG"].strength_in_plane_mpa
    assert share > 1.1
    assert allowed_mpa("--material", "PLA") / allowed_mpa() == pytest.approx(share, rel=0.01)


def test_command_says_which_part_does_not_fit_the_bed(tmp_path: Path) -> None:
    small = tmp_path / "small.toml"
    small.write_text('[printer]\nname = "tiny"\nbed_mm = [100.0, 100.0, 100.0]\nnozzle_mm = 0.4\n', encoding="utf-8")
    result = CliRunner().invoke(app, ["check", "kenan-2.0", "--workshop", str(small)])
    assert isinstance(result.exception, CannotBuildError)
    assert "part foot of" in str(result.exception)


def test_one_limit_is_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))

    def explained(name: str, *more: str) -> str:
        return CliRunner().invoke(app, ["check", "kenan-2.0", "--explain", name, *more], env={"COLUMNS": "999"}).output

    basis, output = checks.basis_of("gear_strength_1"), explained("gear_strength_1")
    assert basis is not None
    for words in (basis.formula, basis.source, "bending of teeth, pair 1: ", "wider gears"):
        assert words in output
    assert [one["name"] for one in json.loads(explained("gear_strength_1", "--json"))["findings"]] == [
        "gear_strength_1"
    ]
    assert "not a limit of this robot" in explained("toe_joint_strength")


def test_a_limit_that_no_check_has_is_refused_with_the_nearest() -> None:
    result = CliRunner().invoke(app, ["check", "kenan-2.0", "--explain", "leg_strenght"])
    assert isinstance(result.exception, JumpcadError)
    assert "did you mean leg_strength?" in str(result.exception)
