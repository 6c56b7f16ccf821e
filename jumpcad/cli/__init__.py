"""Entry points of the command line; they handle interrupts before any other module is imported."""

# Python has these modules at its start. `signal` would import many more before an interrupt could be handled, and a
# handler that imports a module during another import breaks that import.
import _signal as signal  # type: ignore[import-not-found]
import sys

from jumpcad.interrupts import holding, seen

TYPE_CHECKING = False  # as in `jumpcad`
if TYPE_CHECKING:
    from types import FrameType, TracebackType
    from typing import NoReturn

INTERRUPTED = 130
IMPORTING = "<frozen importlib._bootstrap>"
"""File name of the code of Python's import system."""


def program() -> "NoReturn":
    """Run the command line as a process, which ends as soon as all is written and its threads are done.

    To take hundreds of modules apart costs a fifth of the time of a short command, and libraries that count leaks then
    print what a lost worker left behind. A process that is profiled ends as others do.
    """
    try:
        main()
    except SystemExit as end:
        code = int(end.code or 0)
    if sys.getprofile() or sys.gettrace():
        sys.exit(code)
    import atexit
    import os
    import threading

    threading._shutdown()  # type: ignore[attr-defined]  # in Python's own order
    atexit._run_exitfuncs()
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):
        sys.exit(code)  # Python says what became of the stream
    os._exit(code)


def main() -> "NoReturn":
    """Run the command line; exit codes are those of `jumpcad.cli.commands.run`, and 130 for an interrupt."""
    seen.clear()
    listening = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # nohup and & have it ignored
    hooks = sys.excepthook, sys.unraisablehook
    if listening:
        signal.signal(signal.SIGINT, _interrupt)
        sys.excepthook, sys.unraisablehook = _unhandled, _unraisable
    try:
        from jumpcad.collecting import collect_seldom

        collect_seldom()
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
        _ignore_interrupts(listening)  # the command is done: an interrupt would only print a traceback
    except KeyboardInterrupt:
        _ignore_interrupts(listening)
        code = INTERRUPTED
    if seen or code == INTERRUPTED:  # a library may have caught the KeyboardInterrupt
        from jumpcad.cli.output import complain

        code = complain("interrupted", INTERRUPTED)
    seen.clear()
    sys.excepthook, sys.unraisablehook = hooks
    sys.exit(code)


def _ignore_interrupts(listening: bool) -> None:
    if listening:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _interrupt(number: int, frame: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; during an import, after it, in the code that imports; while it is held, not yet.

    Raised while a compiled module is imported it would abort the process, or look like a failure of the module.
    """
    seen.append(number)
    if holding:
        return
    asking = _asking(frame)
    if asking is None:
        raise KeyboardInterrupt
    _raise_in(asking)


def _unraisable(ignored: "sys.UnraisableHookArgs") -> None:
    """Raise an interrupt that compiled code or a finalizer ignored in the code that called it; show other errors."""
    if ignored.exc_type is not KeyboardInterrupt:
        sys.__unraisablehook__(ignored)
        return
    calling = sys._getframe().f_back
    if calling is not None:
        _raise_in(_asking(calling) or calling)


def _unhandled(kind: "type[BaseException]", error: BaseException, trace: "TracebackType | None") -> None:
    """Print nothing of an interrupt: Cython prints what it ignores here too."""
    if kind is not KeyboardInterrupt:
        sys.__excepthook__(kind, error, trace)


def _asking(frame: "FrameType | None") -> "FrameType | None":
    """Return the frame of the command that asks for the outermost import under way; None if none is."""
    outermost = None
    while frame is not None and frame.f_code is not main.__code__:
        if frame.f_code.co_filename == IMPORTING:
            outermost = frame
        frame = frame.f_back
    return outermost and outermost.f_back


def _raise_in(frame: "FrameType") -> None:
    """Raise KeyboardInterrupt in a frame before its next step."""
    frame.f_trace, frame.f_trace_opcodes = _raise, True
    sys.settrace(lambda *_: None)


def _raise(*_: object) -> None:
    sys.settrace(None)
    raise KeyboardInterrupt
