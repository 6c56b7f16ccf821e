"""The command line: ready for an interrupt before anything else is loaded."""

import atexit
import os
import signal
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
RETRY_S = 0.02
"""Delay after which an interrupt is tried again while a module loads."""


def main() -> None:
    """Run the command line; see `jumpcad.cli.commands.run` for the exit codes, besides 130 for an interrupt."""
    listening = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # nohup and & have it ignored
    if listening:
        signal.signal(signal.SIGINT, _interrupt)
    try:
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        from jumpcad.cli.output import complain

        code = complain("interrupted", INTERRUPTED)
    finally:
        if listening:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    atexit.register(signal.signal, signal.SIGINT, signal.SIG_IGN)  # all is done; an interrupt would only be a traceback
    sys.exit(code)


def _interrupt(number: int, frame: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; while a module loads, a moment later.

    Compiled modules abort the process then, or take it for a failure of their own.
    """
    import threading  # late, as is everything that takes a millisecond

    while frame is not None and frame.f_code is not main.__code__:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            again = threading.Timer(RETRY_S, os.kill, (os.getpid(), number))
            again.daemon = True
            again.start()
            return
        frame = frame.f_back
    raise KeyboardInterrupt
