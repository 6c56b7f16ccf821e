"""The process as a whole: the module as the command, and Ctrl-C."""

import subprocess
import sys

import pytest
from support.commands import Run


def test_interrupt_is_exit_code_130(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("jumpcad.design.load_design", interrupted)
    assert run("new", "robot.toml") == (130, "", "jumpcad: interrupted\n")


def test_module_runs_as_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "jumpcad", "--help"], capture_output=True, text=True, check=True)
    assert "Usage: jumpcad" in done.stdout
