"""The process as a whole: the module as the command, Ctrl-C, and an end at once, with all that it has written."""

import signal
import subprocess
import sys

import pytest
from support.commands import Run


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_is_exit_code_128_and_its_number(
    run: Run, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    """As shells have it: 130 for Ctrl-C, 143 for SIGTERM; afterwards Ctrl-C is ignored, and SIGTERM ends a process."""
    usual = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
    before = {one: signal.signal(one, handler) for one, handler in usual.items()}
    told: list[tuple[object, ...]] = []

    def complain(message: str, exit_code: int) -> int:
        told.append((message, *map(signal.getsignal, usual)))
        return exit_code

    monkeypatch.setattr("jumpcad.cli.output.complain", complain)
    monkeypatch.setattr("jumpcad.load_design", lambda _: signal.raise_signal(number))
    try:
        assert run("new", "robot.toml")[0] == 128 + number
    finally:
        for one, handler in before.items():
            signal.signal(one, handler)
    assert told == [("interrupted", signal.SIG_IGN, signal.SIG_DFL)]


def test_module_runs_as_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "jumpcad", "--help"], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout


LEAK = (
    "import atexit, ctypes, sys; from manifold3d import CrossSection; "
    "ctypes.pythonapi.Py_IncRef(ctypes.py_object(CrossSection.square((1, 1))))"
)
CALL = "from jumpcad.cli import {entry}; sys.argv = ['jumpcad', *{arguments!r}]; {entry}()"


def called(entry: str, *arguments: str, before: str = "") -> subprocess.CompletedProcess[str]:
    code = f"{before or 'import sys'}; {CALL.format(entry=entry, arguments=arguments)}"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("code", "arguments"),
    [(0, ("--version",)), (0, ("simulate", "--help")), (2, ("simulate", "no-such-design")), (2, ("fly",))],
)
def test_a_program_writes_and_returns_what_main_does(code: int, arguments: tuple[str, ...]) -> None:
    program, main = called("program", *arguments), called("main", *arguments)
    assert (program.returncode, program.stdout, program.stderr) == (main.returncode, main.stdout, main.stderr)
    assert program.returncode == code
    assert program.stdout or program.stderr


def test_libraries_count_no_leaks_at_the_end() -> None:
    assert "nanobind: leaked" in called("main", "--version", before=LEAK).stderr
    assert called("program", "--version", before=LEAK).stderr == ""


SWALLOWED = """
from jumpcad.cli import commands, main
from jumpcad.process import seen
commands.run = lambda arguments: seen.append(2) or 0
try:
    main()
except SystemExit as end:
    print(end.code, seen)
"""


def test_an_interrupt_counts_for_its_own_command_only() -> None:
    """Also one that a library took for its own; what the process does next is not interrupted by it."""
    done = subprocess.run([sys.executable, "-c", SWALLOWED], capture_output=True, text=True, check=True)
    assert done.stdout == "130 []\n"
    assert "interrupted" in done.stderr
