"""`jumpcad check`."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from jumpcad import checks
from jumpcad.cli.commands import app
from jumpcad.errors import CannotBuildError


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
        assert result.output.index("leg_axle_strength") < result.output.index("bed_fit")
        assert "0 errors" not in result.output


def test_command_says_which_part_does_not_fit_the_bed(tmp_path: Path) -> None:
    small = tmp_path / "small.toml"
    small.write_text('[printer]\nname = "tiny"\nbed_mm = [100.0, 100.0, 100.0]\nnozzle_mm = 0.4\n', encoding="utf-8")
    result = CliRunner().invoke(app, ["check", "kenan-2.0", "--workshop", str(small)])
    assert isinstance(result.exception, CannotBuildError)
    assert "part foot of" in str(result.exception)
