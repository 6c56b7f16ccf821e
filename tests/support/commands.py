"""Commands as tests call them."""

import signal
import sys
from collections.abc import Callable

import pytest

from jumpcad import cli

Run = Callable[..., tuple[int, str, str]]
"""`run("new", "frog.toml")` returns exit code, standard output and standard error."""


def interruptible() -> None:
    """Let Ctrl-C end this process: called before a command starts, for tests run with & or nohup, which ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def exit_code_of(*arguments: str) -> int:
    """Run `jumpcad ARGUMENTS` in this process and return its exit code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["jumpcad", *arguments])
        handler = signal.getsignal(signal.SIGINT)
        try:
            with pytest.raises(SystemExit) as caught:
                cli.main()
        finally:
            signal.signal(signal.SIGINT, handler)
    return int(caught.value.code or 0)
