"""The command line: ready for an interrupt before anything else is loaded."""

# All of these are loaded when Python has started; `signal` and `threading` would load much more before an interrupt
# could be answered, and a handler that loads a module while another one is being loaded breaks that.
import _signal as signal  # type: ignore[import-not-found]
import _thread
import atexit
import os
import sys
import time

TYPE_CHECKING = False  # as in `jumpcad`
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
    while frame is not None and frame.f_code is not main.__code__:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            _thread.start_new_thread(_send_again, (number,))
            return
        frame = frame.f_back
    raise KeyboardInterrupt


def _send_again(number: int) -> None:
    time.sleep(RETRY_S)
    os.kill(os.getpid(), number)
