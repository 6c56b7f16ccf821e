"""The process as a whole: the module as the command, and Ctrl-C."""

import signal
import subprocess
import sys

import pytest
from support.commands import Run


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


def test_module_runs_as_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "jumpcad", "--help"], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
