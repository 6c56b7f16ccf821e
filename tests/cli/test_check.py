"""`jumpcad check`."""

import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from jumpcad import checks
from jumpcad.building import build
from jumpcad.bundle.limits import limit_values, limits_of
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.workshop import load_workshop


@pytest.fixture
def cheap(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the checks that need solids."""
    monkeypatch.setattr(checks, "CHECKS", tuple(one for one in checks.CHECKS if one.cheap))


def check(*arguments: object, columns: int = 999) -> Result:
    """Run `jumpcad check ARGUMENTS` in a wide terminal."""
    return CliRunner().invoke(app, ["check", *map(str, arguments)], env={"COLUMNS": str(columns)})


def test_command_finds_nothing_wrong_with_kenan() -> None:
    result = check("kenan-2.0")
    assert result.exit_code == 0
    assert re.match(r"jumps 181 mm far and 68 mm high with 116\.3 g; all \d+ limits are kept\n", result.output)


def test_rows_and_the_limits_left_out_are_all_that_count(cheap: None) -> None:
    """A plug that bears 100 V is no limit of a robot of 4.2 V, and is not counted."""
    output = check("kenan-2.0").output
    rows = len(re.findall("^ *tight ", output, re.MULTILINE))
    left, held = (int(re.search(rf"(\d+) {words}", output)[1]) for words in ("more are kept", "limits are kept"))  # type: ignore[index]
    assert rows + left == held
    every = json.loads(check("kenan-2.0", "--json").output)
    uses = {one["name"]: one["use"] for one in every["findings"] if one["name"] != "free_release"}  # a note
    assert held == every["limits"] == sum(use is None or use >= 0.1 for use in uses.values())
    robot = build(load_design("kenan-2.0"), load_workshop(), "kenan-2.0")
    assert limit_values(limits_of(robot))["count"] == held  # as report.html says
    assert uses["supply_voltage_plug"] == pytest.approx(4.2 / 100.0)


def test_a_robot_that_stays_on_the_ground_is_no_success_and_has_a_remedy_that_works(
    cheap: None, tmp_path: Path
) -> None:
    """All its limits but the jump are kept; with the stiffness that its remedy names it jumps."""
    weak = load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 3.0})
    (tmp_path / "weak.toml").write_text(weak.to_toml(), encoding="utf-8")
    said = check(tmp_path / "weak.toml")
    assert said.exit_code == 1
    assert said.output.startswith("does not jump (no_takeoff); ")
    found = json.loads(check(tmp_path / "weak.toml", "--json").output)
    assert found["verdict"] == "no_takeoff"
    remedy = next(one["remedy"] for one in found["findings"] if one["name"] == "no_takeoff")
    stiffness = float(re.search(r"raise stiffness_nmm_per_deg to ([\d.]+)", remedy)[1])  # type: ignore[index]
    assert 3.0 < stiffness < 9.2
    assert evaluate(weak.model_copy(update={"stiffness_nmm_per_deg": stiffness})).verdict == "jump"


def test_a_design_that_cannot_be_built_is_refused_with_a_value_that_can(tmp_path: Path) -> None:
    far = load_design("kenan-2.0").model_copy(update={"compression_ratio": 0.9})
    (tmp_path / "far.toml").write_text(far.to_toml(), encoding="utf-8")
    refused = check(tmp_path / "far.toml")
    assert isinstance(refused.exception, CannotBuildError)
    ratio = float(re.search(r"compression_ratio to (0\.\d+)", str(refused.exception))[1])  # type: ignore[index]
    assert evaluate(far.model_copy(update={"compression_ratio": ratio})).verdict == "jump"


def test_what_became_of_a_robot_by_itself_is_said(cheap: None, tmp_path: Path) -> None:
    """A bought spring of 26.36 N·mm/° has 5.7 times the stiffness of the design's, for which its stop's bar grows."""
    (tmp_path / "stock.toml").write_text('[bought]\nspring = "9271K589"\n', encoding="utf-8")
    arguments = ("kenan-2.0", "--workshop", tmp_path / "stock.toml")
    lines = check(*arguments).output.splitlines()
    assert re.match(r"note: sections grew to carry \d\.\d times the load .*stop by \d+ % \(stop_strength\)", lines[1])
    assert any("have 52.72 N·mm/°" in line for line in lines)
    grown = json.loads(check(*arguments, "--json").output)["grown"]
    assert all(one["factor"] > 1.0 and one["use"] > 1.0 for one in grown)


@pytest.mark.parametrize("as_json", [False, True])
def test_command_fails_where_an_axle_is_too_weak(cheap: None, tmp_path: Path, as_json: bool) -> None:
    soft = tmp_path / "soft.toml"
    soft.write_text("[safety]\nsteel_yield_mpa = 20.0\n", encoding="utf-8")
    result = check("kenan-2.0", "--workshop", soft, *(["--json"] if as_json else []))
    assert result.exit_code == 1
    if as_json:
        first = json.loads(result.output)["findings"][0]
        assert (first["name"], first["severity"], first["unit"]) == ("leg_axle_strength", "error", "MPa")
    else:
        assert re.search(r"error +leg_axle_strength.*tight ", result.output, re.DOTALL)
        assert "limits are violated: do not build it as it is" in result.output


def test_a_printer_is_named_on_the_command_line(cheap: None) -> None:
    assert "180 x 180 x 180 mm" in check("kenan-2.0", "--printer", "a1-mini", "--material", "PLA", "--all").output


def test_a_material_is_named_on_the_command_line(cheap: None) -> None:
    """The legs' allowed stress is then that of PLA; they are of PETG."""

    def allowed_mpa(*more: str) -> float:
        (finding,) = json.loads(check("kenan-2.0", "--explain", "leg_strength", "--json", *more).output)["findings"]
        return float(finding["limit"])

    materials = load_workshop().materials
    share = materials["PLA"].strength_in_plane_mpa / materials["PETG"].strength_in_plane_mpa
    assert share > 1.1
    assert allowed_mpa("--material", "PLA") / allowed_mpa() == pytest.approx(share, rel=0.01)


def test_command_says_which_part_does_not_fit_the_bed(tmp_path: Path) -> None:
    small = tmp_path / "small.toml"
    small.write_text('[printer]\nname = "tiny"\nbed_mm = [100.0, 100.0, 100.0]\nnozzle_mm = 0.4\n', encoding="utf-8")
    result = check("kenan-2.0", "--workshop", small)
    assert isinstance(result.exception, CannotBuildError)
    assert "part foot of" in str(result.exception)


def test_one_limit_is_explained(cheap: None) -> None:

    asked = ("kenan-2.0", "--explain")
    basis, output = checks.basis_of("gear_strength_1"), check(*asked, "gear_strength_1").output
    assert basis is not None
    for words in (basis.formula, basis.source, "bending of teeth, pair 1: ", "wider gears"):
        assert words in output
    found = json.loads(check(*asked, "gear_strength_1", "--json").output)["findings"]
    assert [one["name"] for one in found] == ["gear_strength_1"]
    assert "not a limit of this robot" in check(*asked, "toe_joint_strength").output


def test_a_limit_that_no_check_has_is_refused_with_the_nearest() -> None:
    result = check("kenan-2.0", "--explain", "leg_strenght")
    assert isinstance(result.exception, JumpcadError)
    assert "did you mean leg_strength?" in str(result.exception)
