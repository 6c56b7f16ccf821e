"""The process as a whole: the module as the command, and Ctrl-C."""

import signal
import subprocess
import sys
from collections.abc import Iterator

import pytest
from support.commands import Run

from jumpcad import cli
from jumpcad.errors import JumpcadError


def test_interrupt_is_exit_code_130(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("jumpcad.design.load_design", interrupted)
    assert run("new", "robot.toml") == (130, "", "jumpcad: interrupted\n")


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
    monkeypatch.setattr("jumpcad.design.load_design", lambda _: signal.raise_signal(number))
    try:
        assert run("new", "robot.toml")[0] == 128 + number
    finally:
        for one, handler in before.items():
            signal.signal(one, handler)
    assert told == [("interrupted", signal.SIG_IGN, signal.SIG_DFL)]


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


@pytest.fixture
def interrupts() -> Iterator[list[int]]:
    """The interrupts that were seen, none before and after."""
    cli.seen.clear()
    yield cli.seen
    cli.seen.clear()


def test_an_interrupt_is_counted_and_raised_unless_it_is_held(interrupts: list[int]) -> None:
    cli.holding.append("a block")
    cli._interrupt(signal.SIGINT, sys._getframe())
    assert interrupts == [signal.SIGINT]
    cli.holding.remove("a block")
    with pytest.raises(KeyboardInterrupt):
        cli._interrupt(signal.SIGINT, sys._getframe())
    assert interrupts == [signal.SIGINT] * 2


def test_module_runs_as_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "jumpcad", "--help"], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
