"""The commands together: exit codes, one line of error, one JSON document, help without delay."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from support.commands import Run
from support.places import ROOT

from jumpcad.cli.commands import app
from jumpcad.design import load_design

HEAVY = ("numpy", "scipy", "pybullet", "mujoco", "trimesh", "manifold3d", "sklearn", "matplotlib", "pygad")


@pytest.mark.parametrize(
    "arguments",
    [
        ["fly"],
        ["new"],
        ["new", "robot.toml", "--form", "kenan-2.0"],
        ["new", "robot.txt"],
        ["new", "no/folder/robot.toml"],
        ["new", "x" * 300 + ".toml"],
        ["new", "robot.toml", "--from", "kenan-3.0"],
        ["new", "robot.toml", "--from", "missing.toml", "--json"],
        ["simulate", "kenan-2.0", "--published", "--engine", "mujoco"],
    ],
    ids=" ".join,
)
def test_wrong_request_is_one_line_and_exit_code_2(run: Run, tmp_path: Path, arguments: list[str]) -> None:
    code, out, err = run(*arguments)
    assert code == 2
    assert out == ""
    assert err.startswith("jumpcad: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_design_that_cannot_be_assembled_is_exit_code_1(run: Run, tmp_path: Path) -> None:
    crossed = load_design("kenan-2.0").model_copy(update={"c_coef": 2.5})
    (tmp_path / "crossed.toml").write_text(crossed.to_toml())
    code, out, err = run("simulate", "crossed.toml", "--published", "--json")
    assert (code, out) == (1, "")
    assert err.startswith("jumpcad: no assembled pose")
    assert err.count("\n") == 1


def test_a_bug_is_exit_code_3_with_its_traceback(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: str) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("jumpcad.design.load_design", broken)
    for more in ((), ("--json",)):
        code, out, err = run("new", "robot.toml", *more)
        assert (code, out) == (3, "")
        assert err.startswith("Traceback")
        assert err.endswith("\nZeroDivisionError\n")


@pytest.mark.parametrize(
    "arguments",
    [["new", "frog.toml"], ["simulate", "kenan-2.0", "--published"], ["reproduce"]],
    ids=lambda arguments: arguments[0],
)
def test_json_is_one_document(run: Run, arguments: list[str]) -> None:
    code, out, err = run(*arguments, "--json")
    assert (code, err) == (0, "")
    assert isinstance(json.loads(out), dict)


def test_every_command_has_json_and_help(run: Run) -> None:
    names = [command.callback.__name__ for command in app.registered_commands if command.callback]
    assert {"new", "simulate", "reproduce"} <= set(names)
    for command in app.registered_commands:
        code, out, err = run(command.name or command.callback.__name__, "--help")
        assert (code, err) == (0, "")
        assert ("--json" in out) == (
            "studio" not in out.split("Usage:")[1].split("\n")[0]
        )  # it serves until it is stopped


def test_readme_names_every_command_and_no_other() -> None:
    table = re.findall(r"^\| `jumpcad (\w+)", (ROOT / "README.md").read_text(), re.MULTILINE)
    assert sorted(set(table)) == sorted(
        command.name or command.callback.__name__ for command in app.registered_commands if command.callback
    )


@pytest.mark.parametrize("arguments", [["--help"], ["simulate", "--help"]], ids=" ".join)
def test_help_imports_nothing_heavy(arguments: list[str]) -> None:
    program = (
        "import sys; from jumpcad.cli import main\n"
        f"sys.argv = ['jumpcad', *{arguments!r}]\n"
        "try: main()\n"
        f"except SystemExit: print([name for name in {HEAVY!r} if name in sys.modules], file=sys.stderr)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
    assert done.stderr == "[]\n"
