"""The commands together: exit codes, one line of error, one JSON document, help without delay."""

import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from support import needs
from support.commands import Run
from support.each import each
from support.places import ROOT

from jumpcad.bundle.export import export, export_coupon
from jumpcad.cli import commands
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.face import __version__

HEAVY = ("numpy", "scipy", "pybullet", "mujoco", "trimesh", "manifold3d", "sklearn", "matplotlib", "pygad")


@each(
    "arguments",
    [
        ["fly"], ["new"], ["new", "robot.toml", "--form", "kenan-2.0"], ["new", "robot.txt"],
        ["new", "no/folder/robot.toml"], ["new", "x" * 300 + ".toml"], ["new", "robot.toml", "--from", "kenan-3.0"],
        ["new", "robot.toml", "--from", "missing.toml", "--json"],
        ["simulate", "kenan-2.0", "--published", "--engine", "mujoco"],
    ],
)  # fmt: skip
def test_wrong_request_is_one_line_and_exit_code_2(run: Run, tmp_path: Path, arguments: list[str]) -> None:
    code, out, err = run(*arguments)
    assert code == 2
    assert out == ""
    assert err.startswith("jumpcad: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_user_without_a_home_has_one_in_which_nothing_can_be_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a container's whose number the system does not know: ezdxf cannot be imported without a home."""
    monkeypatch.setenv("HOME", "~")
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)
    assert commands.run(["--version"]) == 0
    assert os.environ["HOME"] == os.devnull


def test_design_that_cannot_be_assembled_is_exit_code_1(run: Run, tmp_path: Path) -> None:
    crossed = load_design("kenan-2.0").model_copy(update={"c_coef": 2.5})
    (tmp_path / "crossed.toml").write_text(crossed.to_toml())
    for command in (["simulate", "--published"], ["simulate"], ["check"], ["build"], ["report"]):
        code, out, err = run(*command, "crossed.toml")
        assert (code, out) == (1, "")
        assert err.startswith("jumpcad: ")
        assert err.count("\n") == 1
        code, out, same = run(*command, "crossed.toml", "--json")
        refused = json.loads(out)
        assert (code, same, refused["verdict"]) == (1, err, "cannot_build")
        assert err == f"jumpcad: {refused['message']}\n"


def test_a_bug_is_exit_code_3_with_its_traceback(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: str) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("jumpcad.load_design", broken)
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
    if arguments[0] != "new":
        needs.package("pybullet")
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


def test_nothing_is_replaced_unless_force_is_asked_for() -> None:
    """Neither by a command nor by the functions behind them."""
    commands = [command.callback for command in app.registered_commands if command.callback]
    forces = [
        signature.parameters["force"].default
        for function in (*commands, export, export_coupon)
        if "force" in (signature := inspect.signature(function)).parameters
    ]
    assert len(forces) > 8
    assert not any(forces)


def test_the_docs_name_every_command_and_no_other() -> None:
    table = re.findall(r"^\| `jumpcad (\w+)", (ROOT / "docs" / "commands.md").read_text(), re.MULTILINE)
    assert sorted(set(table)) == sorted(
        command.name or command.callback.__name__ for command in app.registered_commands if command.callback
    )


@pytest.mark.parametrize(
    ("arguments", "heavy"), [(["--help"], (*HEAVY, "pydantic")), (["simulate", "--help"], HEAVY)], ids=["all", "one"]
)
def test_help_imports_nothing_heavy(arguments: list[str], heavy: tuple[str, ...]) -> None:
    """For the options of one command typer itself imports pydantic."""
    program = (
        "import sys; from jumpcad.cli import main\n"
        f"sys.argv = ['jumpcad', *{arguments!r}]\n"
        "try: main()\n"
        f"except SystemExit: print([name for name in {heavy!r} if name in sys.modules], file=sys.stderr)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
    assert done.stderr == "[]\n"


def test_version_and_short_help(run: Run) -> None:
    assert run("--version") == (0, f"jumpcad {__version__}\n", "")
    assert run("-h") == run("--help")
    assert run("check", "-h")[1] == run("check", "--help")[1]


@needs.without("bash")
def test_completion_is_installed_without_an_error(tmp_path: Path) -> None:
    surroundings = {**os.environ, "HOME": str(tmp_path), "PYTHONPATH": str(ROOT)}
    command = ["bash", "-c", '"$0" -m jumpcad --install-completion; exit $?', sys.executable]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=surroundings)
    assert (done.returncode, done.stderr) == (0, "")
    assert f"bash completion installed in {tmp_path}" in done.stdout


def test_an_option_without_a_value_is_named(run: Run) -> None:
    """Else an empty folder would be the current one, and an empty workshop the default."""
    for *words, option in (("build", "kenan-2.0", "-o"), ("check", "kenan-2.0", "--workshop"), ("optimize", "--study")):
        said = f"jumpcad: {option} '': its value is empty: give one, or leave {option} out\n"
        assert run(*words, option, "") == (2, "", said)
