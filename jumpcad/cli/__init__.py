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

SIGNALLED = 128
"""Exit code of a command that a signal ended, with the signal's number: 130 for Ctrl-C, 143 for SIGTERM."""
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
    """Run the command line; exit codes are those of `jumpcad.cli.commands.run`, and `SIGNALLED` ones.

    SIGTERM, by which queues of shared machines end a program, is taken as Ctrl-C is.
    """
    seen.clear()
    usual = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
    listening = [one for one in usual if signal.getsignal(one) == usual[one]]  # nohup and & have SIGINT ignored
    hooks = sys.excepthook, sys.unraisablehook
    for one in listening:
        signal.signal(one, _interrupt)
    if listening:
        sys.excepthook, sys.unraisablehook = _unhandled, _unraisable
    try:
        from jumpcad.gc_tuning import collect_seldom

        collect_seldom()
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
        _listen_no_more(listening)  # the command is done: an interrupt would only print a traceback
        interrupted = bool(seen)  # a library may have caught the KeyboardInterrupt
    except KeyboardInterrupt:
        _listen_no_more(listening)
        interrupted = True
    if interrupted:
        from jumpcad.cli.output import complain

        code = complain("interrupted", SIGNALLED + (seen[0] if seen else signal.SIGINT))
    seen.clear()
    sys.excepthook, sys.unraisablehook = hooks
    sys.exit(code)


def _listen_no_more(listening: "list[int]") -> None:
    """Ignore Ctrl-C from now on; another SIGTERM ends the process."""
    for one in listening:
        signal.signal(one, signal.SIG_IGN if one == signal.SIGINT else signal.SIG_DFL)


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
