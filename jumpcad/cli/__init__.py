"""Entry point of the command line; it handles interrupts before any other module is imported."""

# Python has these modules at its start. `signal` would import many more before an interrupt could be handled, and a
# handler that imports a module during another import breaks that import.
import _signal as signal  # type: ignore[import-not-found]
import sys

TYPE_CHECKING = False  # as in `jumpcad`
if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
IMPORTING = "<frozen importlib._bootstrap>"
"""File name of the code of Python's import system."""
_seen: list[int] = []
"""Interrupts during the command."""


def main() -> None:
    """Run the command line; exit codes are those of `jumpcad.cli.commands.run`, and 130 for an interrupt."""
    _seen.clear()
    listening = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # nohup and & have it ignored
    if listening:
        signal.signal(signal.SIGINT, _interrupt)
    try:
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
        _ignore_interrupts(listening)  # the command is done: an interrupt would only print a traceback
    except KeyboardInterrupt:
        _ignore_interrupts(listening)
        code = INTERRUPTED
    if _seen or code == INTERRUPTED:  # a library may have caught the KeyboardInterrupt
        from jumpcad.cli.output import complain

        code = complain("interrupted", INTERRUPTED)
    sys.exit(code)


def _ignore_interrupts(listening: bool) -> None:
    if listening:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _interrupt(number: int, frame: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; during an import, after it, in the code that imports.

    Raised while a compiled module is imported it would abort the process, or look like a failure of the module.
    """
    _seen.append(number)
    outermost = None
    while frame is not None and frame.f_code is not main.__code__:
        if frame.f_code.co_filename == IMPORTING:
            outermost = frame
        frame = frame.f_back
    asking = outermost and outermost.f_back
    if not asking:
        raise KeyboardInterrupt
    asking.f_trace, asking.f_trace_opcodes = _raise, True  # before its next step
    sys.settrace(lambda *_: None)


def _raise(*_: object) -> None:
    sys.settrace(None)
    raise KeyboardInterrupt
