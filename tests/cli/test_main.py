"""The process as a whole: the module as the command, and Ctrl-C."""

import signal
import subprocess
import sys

import pytest
from support.commands import Run

from jumpcad import cli
from jumpcad.errors import JumpcadError


def test_interrupt_is_exit_code_130(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("jumpcad.design.load_design", interrupted)
    assert run("new", "robot.toml") == (130, "", "jumpcad: interrupted\n")


@pytest.mark.parametrize("interrupted", [False, True])
def test_a_program_that_calls_the_command_has_its_own_hooks_afterwards(
    run: Run, monkeypatch: pytest.MonkeyPatch, interrupted: bool
) -> None:
    """Meanwhile an interrupt prints nothing of its own."""
    seen = []

    def load(_: str) -> None:
        seen.append((sys.excepthook, sys.unraisablehook))
        raise KeyboardInterrupt if interrupted else JumpcadError("no design")

    monkeypatch.setattr("jumpcad.design.load_design", load)
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    before = sys.excepthook, sys.unraisablehook
    try:
        assert run("new", "robot.toml")[0] == (130 if interrupted else 2)
    finally:
        signal.signal(signal.SIGINT, handler)
    assert (sys.excepthook, sys.unraisablehook) == before
    assert seen[0][0] is not before[0]
    assert seen[0][1] is not before[1]


def test_what_nobody_handled_is_printed_unless_it_is_an_interrupt(capsys: pytest.CaptureFixture[str]) -> None:
    for error, printed in ((ValueError("seven"), "ValueError: seven\n"), (KeyboardInterrupt(), "")):
        cli._unhandled(type(error), error, None)
        assert capsys.readouterr().err == printed


def test_an_interrupt_that_a_finalizer_ignored_stops_what_ran_then(monkeypatch: pytest.MonkeyPatch) -> None:
    class Interrupted:
        def __del__(self) -> None:
            raise KeyboardInterrupt

    def work() -> None:
        for step in range(3):
            steps.append(step)
            Interrupted()

    steps: list[int] = []
    monkeypatch.setattr(sys, "unraisablehook", cli._unraisable)
    with pytest.raises(KeyboardInterrupt):
        work()
    assert steps == [0]
    assert sys.gettrace() is None


def test_module_runs_as_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "jumpcad", "--help"], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
