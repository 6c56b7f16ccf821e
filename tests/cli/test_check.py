"""`jumpcad check`."""

import json
import math
import re
from pathlib import Path

import pytest
from support.commands import Run
from typer.testing import CliRunner

from jumpcad import checks
from jumpcad.checks.engraving import engraving_findings
from jumpcad.cli import check as command
from jumpcad.cli.check import TIGHT, margin_in_words
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import at_most, limit
from jumpcad.workshop import load_workshop


def test_command_finds_nothing_wrong_with_kenan() -> None:
    result = CliRunner().invoke(app, ["check", "kenan-2.0"])
    assert result.exit_code == 0
    assert "0 errors, 0 warnings" in result.output


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
        assert "0 errors" not in result.output


def test_it_shows_what_is_tight_and_with_all_the_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    short, long = (CliRunner().invoke(app, ["check", "kenan-2.0", *more]).output for more in ([], ["--all"]))
    findings = json.loads(CliRunner().invoke(app, ["check", "kenan-2.0", "--json"]).output)["findings"]
    tight = {one["name"] for one in findings if one["use"] is not None and one["use"] >= TIGHT}
    slack = {one["name"] for one in findings if one["use"] is not None and one["use"] < TIGHT}
    assert tight
    assert slack
    for name in tight | slack:
        assert f" {name} " in long
        assert (f" {name} " in short) == (name in tight)
    assert len({line.index(" %") for line in long.splitlines() if re.match(r"\w+ +\w+ +\d+ %", line)}) == 1
    assert f"{len(findings)} limits hold" in short
    assert "--all" in short
    assert "--all" not in long


@pytest.mark.parametrize("columns", ["30", "75", "76", "200"])
def test_whatever_the_terminals_width_all_is_said(monkeypatch: pytest.MonkeyPatch, columns: str) -> None:
    one = checks.Check(lambda _: [at_most("a_long_name_of_a_check", 3.0, 2.0, "mm", "far too long", "cut it")], {})
    monkeypatch.setattr(checks, "CHECKS", (one,))
    monkeypatch.setenv("COLUMNS", columns)
    said = CliRunner().invoke(app, ["check", "kenan-2.0"]).output
    assert max(map(len, said.splitlines())) <= int(columns)
    counted = "1 error, 0 warnings, 0 limits hold"
    for words in ("error", "a_long_name_of_a_check", "150 %", "-1 mm", "far too long → cut it", counted):
        assert words.replace(" ", "") in re.sub(r"\s", "", said)


@pytest.mark.parametrize(
    ("margin", "unit", "words"),
    [
        (1.3e-05, "rad", "at the limit"),
        (-1.3e-05, "rad", "just beyond"),
        (math.pi / 18.0, "rad", "+10 °"),
        (0.0123, "J", "+12.3 mJ"),
        (0.0017, "N·m", "+1.7 mN·m"),
        (-62.14, "MPa", "-62.1 MPa"),
        (0.0, "faults", ""),
        (0.0, "mm³", ""),
        (0.0, "mm", "at the limit"),
        (0.05, "mm³", "+0.05 mm³"),
    ],
)
def test_margins_are_in_units_that_people_read(margin: float, unit: str, words: str) -> None:
    assert margin_in_words(limit("name", margin, unit, "found", "remedy")) == words


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


def test_every_finding_of_an_explained_limit_has_its_own_state_and_remedy(capsys: pytest.CaptureFixture[str]) -> None:
    findings = [
        at_most("leg_strength", 9.0, 10.0, "MPa", "the left", "thicken it"),
        at_most("leg_strength", 13.0, 10.0, "MPa", "the right", "shorten it"),
        limit("leg_strength", 1.5, "mm", "the third", "leave it"),
    ]
    command._print_explained("leg_strength", findings)
    said = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert said[-6:] == [
        "leg_strength holds, 90 % used, +1 MPa: the left", "remedy thicken it",
        "leg_strength error, 130 % used, -3 MPa: the right", "remedy shorten it",
        "leg_strength holds, +1.5 mm: the third", "remedy leave it",
    ]  # fmt: skip


def test_limits_stand_in_the_order_of_their_severity_and_use(capsys: pytest.CaptureFixture[str]) -> None:
    """A limit without a share counts as used up where it has no margin, else as not used at all."""
    findings = [
        at_most("slack", 1.0, 10.0, "N", "found slack", "loosen"), at_most("tight", 9.0, 10.0, "N", "found tight", "a"),
        at_most("edge", 8.0, 10.0, "N", "found edge", "b"), limit("apart", 0.001, "mm", "found apart", "c"),
        limit("far", 2.0, "mm", "found far", "d"), at_most("worst", 30.0, 10.0, "N", "found worst", "mend it"),
        at_most("bad", 12.0, 10.0, "N", "found bad", "turn it"),
        limit("warned", -1.0, "mm", "found warned", "look at it", violated="warning"),
    ]  # fmt: skip
    order = ["worst", "bad", "warned", "apart", "tight", "edge", "slack", "far"]
    assert [one.name for one in sorted(findings, key=command._order)] == order
    assert [one.name for one in findings if command.is_tight(one)][:3] == ["tight", "edge", "apart"]
    command._print_table(sorted(findings, key=command._order), False)
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert told[1:] == [
        "error worst 300 % -20 N found worst → mend it", "error bad 120 % -2 N found bad → turn it",
        "warning warned -1 mm found warned → look at it", "tight apart at the limit found apart",
        "tight tight 90 % +1 N found tight", "tight edge 80 % +2 N found edge",
        "2 errors, 1 warning, 5 limits hold", "2 of them hold with more than 20 % to spare: --all shows them",
    ]  # fmt: skip
    command._print_table(sorted(findings, key=command._order), True)
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert told[-3:-1] == ["holds slack 10 % +9 N found slack", "holds far +2 mm found far"]
    assert "spare" not in told[-1]
    command._print_table([limit("far", 2.0, "mm", "found far", "d")], False)
    assert capsys.readouterr().out.splitlines() == [
        "0 errors, 0 warnings, 1 limit holds", "1 of them hold with more than 20 % to spare: --all shows them"
    ]  # fmt: skip


def test_all_limits_of_a_kind_are_explained_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """As they stand in the reference; the exit code is that of these alone."""
    findings = [
        at_most(name, value, 10.0, "MPa", "found", "change")
        for name, value in (("gear_strength_1", 9.0), ("gear_strength_2", 8.0), ("leg_strength", 12.0))
    ]
    monkeypatch.setattr("jumpcad.building.build", lambda *_: None)
    monkeypatch.setattr("jumpcad.checks.check", lambda _: findings)
    for asked, names, code in (
        ("gear_strength_*", ["gear_strength_1", "gear_strength_2"], 0), ("gear_strength_2", ["gear_strength_2"], 0),
        ("leg_strength", ["leg_strength"], 1),
    ):  # fmt: skip
        result = CliRunner().invoke(app, ["check", "kenan-2.0", "--explain", asked, "--json"])
        told = json.loads(result.output)
        assert ([one["name"] for one in told["findings"]], result.exit_code) == (names, code)
        assert [one["use"] for one in told["findings"]] == [one.use for one in findings if one.name in names]
        assert (told["design"], told["workshop"]) == ("kenan-2.0", "default")


def test_the_robot_that_is_checked_has_the_name_that_build_engraves(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """So that letters which its font lacks are found before they are missing on the plates."""
    monkeypatch.setattr(checks, "CHECKS", (checks.Check(engraving_findings, {}),))
    file = tmp_path / "漢字.toml"
    file.write_text(load_design("kenan-2.0").to_toml(), encoding="utf-8")
    result = CliRunner().invoke(app, ["check", str(file), "--json"])
    found = {one["name"]: one["severity"] for one in json.loads(result.output)["findings"]}
    assert (found["engraving"], result.exit_code) == ("warning", 0)


@pytest.mark.usefixtures("inputs")
def test_a_bare_name_beside_a_bundle_of_that_name_is_noted(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def built(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.workshop.load_workshop", built)
    note = "jumpcad: kenan-2.0 is the template; write ./kenan-2.0 for the bundle of this name\n"
    assert run("check", "kenan-2.0")[2] == f"{note}jumpcad: begun\n"
