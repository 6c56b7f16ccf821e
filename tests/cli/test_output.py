"""Any kind of standard output, any file name, Ctrl-C at any time: one line and one exit code."""

import errno
import os
import subprocess
import sys
from importlib.util import find_spec
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from support.commands import Run

from jumpcad.cli.output import _log
from jumpcad.design import load_design
from jumpcad.errors import without_controls

JUMPCAD = [sys.executable, "-m", "jumpcad"]
LIGHT = ["simulate", "kenan-2.0", "--capsule"]

SURROUNDINGS = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), "PYTHONUNBUFFERED": ""}
"""Buffered, as for most people: errors come when the buffer is written."""

needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")


def test_what_is_being_done_is_logged_once(capsys: pytest.CaptureFixture[str]) -> None:
    texts, minutes = ["a"], iter((False, False, True))
    _log(texts, SimpleNamespace(wait=lambda _: next(minutes)))  # type: ignore[arg-type]
    assert capsys.readouterr().err == "jumpcad: a\n"


def called(*arguments: str, shell: str = "", folder: Path, **environment: str) -> tuple[int, str, str]:
    """Run the command in a separate process, redirected in a shell's syntax."""
    line = f'exec "$@" {shell}'
    env = {**SURROUNDINGS, **environment}
    done = subprocess.run(["sh", "-c", line, "sh", *JUMPCAD, *arguments], capture_output=True, cwd=folder, env=env)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8")


@needs_full
@pytest.mark.parametrize("arguments", [["list"], ["list", "--json"], ["--help"]], ids=" ".join)
def test_a_full_disk_behind_standard_output_is_one_line(tmp_path: Path, arguments: list[str]) -> None:
    code, _, err = called(*arguments, shell=">/dev/full", folder=tmp_path)
    assert (code, err) == (2, "jumpcad: standard output cannot be written: No space left on device\n")


@needs_full
def test_an_error_that_nobody_can_read_keeps_its_exit_code(tmp_path: Path) -> None:
    assert called("fly", shell="2>/dev/full", folder=tmp_path) == (2, "", "")


@pytest.mark.parametrize("arguments", [["list"], ["list", "--json"]], ids=" ".join)
def test_a_reader_that_has_gone_is_no_error(tmp_path: Path, arguments: list[str]) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    command = [*JUMPCAD, *arguments]
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, cwd=tmp_path, env=SURROUNDINGS)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("shell", "arguments"), [(">&-", ["list"]), ("2>&-", ["list"]), ("<&- >&- 2>&-", LIGHT)], ids=["1", "2", "all"]
)
def test_closed_streams_are_no_error(tmp_path: Path, shell: str, arguments: list[str]) -> None:
    code, _, err = called(*arguments, shell=shell, folder=tmp_path)
    assert (code, err) == (0, "")


@pytest.mark.thorough
def test_what_an_encoding_lacks_is_shown_escaped(tmp_path: Path) -> None:
    (tmp_path / "机.toml").write_text(load_design("kenan-2.0").to_toml())
    code, out, err = called("simulate", "机.toml", "--capsule", folder=tmp_path, PYTHONIOENCODING="ascii")
    assert (code, err) == (0, "")
    assert out.startswith(r"\u673a.toml, capsule robot")
    assert r"\xb0" in out  # a degree sign


def test_a_deleted_folder_is_one_line(tmp_path: Path) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    done = subprocess.run(
        ["sh", "-c", 'rmdir ../gone; exec "$@"', "sh", *JUMPCAD, *LIGHT], capture_output=True, text=True, cwd=gone,
        env=SURROUNDINGS,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "jumpcad: the current folder was deleted, or may not be entered: change into another one\n"


def test_a_folder_that_may_not_be_entered_is_one_line(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the system answers anybody but root, of a folder of somebody else."""
    true = os.stat

    def stat(path: Any, *given: Any, **options: Any) -> os.stat_result:
        if str(path).startswith("theirs/"):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return true(path, *given, **options)

    monkeypatch.setattr(os, "stat", stat)
    studio = ("studio",) if find_spec("viser") else ()
    for command, name in product(("study", "report", *studio, "check", "simulate"), ("theirs/e.db", "theirs/e.toml")):
        if command != "study" or name.endswith(".db"):
            found = run(command, name)
            assert found == (2, "", f"jumpcad: {name}: may not be read (permission denied)\n"), command


def test_an_error_is_one_line_whatever_the_file_is_called(run: Run) -> None:
    assert run("simulate", "a\nb[/red]\x1b[2J\u202e\udcff.toml") == (
        2, "", "jumpcad: a\\nb[/red]\\x1b[2J\\u202e\\udcff.toml: no such file\n",
    )  # fmt: skip
    assert without_controls("Käfer 机器人 🐸 µ−°…") == "Käfer 机器人 🐸 µ−°…"


@pytest.mark.parametrize("name", ["[/x].toml", "a\x1b[2Jb.toml", "[red]x.toml"])
def test_names_are_no_markup_and_move_no_cursor(run: Run, tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    file.parent.mkdir(exist_ok=True)
    file.write_text(load_design("kenan-2.0").to_toml())
    code, out, err = run("simulate", name, "--capsule")
    assert (code, err) == (0, "")
    assert out.startswith(f"{without_controls(name)}, capsule robot")
    assert "\x1b" not in out
    code, _, err = run("build", name, "--no-pictures")
    assert (code, err.count("\n")) == (2, 1)
    assert "use letters, digits" in err


@pytest.mark.thorough
def test_surroundings_that_no_command_can_use(tmp_path: Path) -> None:
    """A terminal that is a hundred million columns wide, no backend for windows, hardly any file that may be opened."""
    for width in ("COLUMNS", "TERMINAL_WIDTH"):
        code, out, err = called("check", "--help", folder=tmp_path, **{width: "99999999"})
        assert (code, err) == (0, "")
        assert max(map(len, out.splitlines())) < 1000
    search = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--study", "s.db")
    code, _, err = called(*search, "--workers", "0", "--plots", "p", folder=tmp_path, MPLBACKEND="nonsense")
    assert (code, err) == (0, "")
    done = subprocess.run(
        ["sh", "-c", 'ulimit -n 20; exec "$@"', "sh", *JUMPCAD, *search, "--workers", "2"],
        capture_output=True, cwd=tmp_path, env=SURROUNDINGS, text=True, timeout=60.0,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert "workers = 2: take 28 open files, and 20 are allowed" in done.stderr
