"""Entry points of the command line."""

import atexit
import os
import signal
import sys
from typing import TYPE_CHECKING, NoReturn

from jumpcad.process import ONE_THREAD, deferring, seen

if TYPE_CHECKING:
    from types import FrameType

SIGNALLED = 128
"""Exit code of a command that a signal ended, with the signal's number: 130 for Ctrl-C, 143 for SIGTERM."""


def program() -> NoReturn:
    """Run the command line as a process, which ends as soon as threads and functions for its end are done.

    To take modules apart costs a fifth of a short command's time, and libraries that count leaks would print them.
    """
    codes: list[int] = []

    def end() -> None:
        try:
            for stream in (sys.stdout, sys.stderr):
                if stream is not None:
                    stream.flush()
        except (OSError, ValueError):
            return  # Python says what became of the stream
        if codes:
            os._exit(codes[0])

    atexit.register(end)  # the first that is registered runs last
    try:
        main()
    except SystemExit as done:
        codes.append(int(done.code or 0))
        raise


def main() -> NoReturn:
    """Run the command line; exit codes are those of `jumpcad.cli.commands.run`, and `SIGNALLED` ones.

    SIGTERM, by which queues of shared machines end a program, is taken as Ctrl-C is.
    """
    seen.clear()
    usual = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
    listening = [one for one in usual if signal.getsignal(one) == usual[one]]  # nohup and & have SIGINT ignored
    for one in listening:
        signal.signal(one, _interrupt)
    interrupted, code = False, 0
    for name, threads in ONE_THREAD.items():  # before numpy loads
        os.environ.setdefault(name, threads)
    try:
        from jumpcad.process import collect_seldom

        collect_seldom()
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
    except BaseException as error:
        if not (seen or isinstance(error, KeyboardInterrupt)):
            raise
        interrupted = True  # modules that load take it for a failure of theirs
    for one in listening:  # the command is done: an interrupt would only print a traceback
        signal.signal(one, signal.SIG_IGN if one == signal.SIGINT else signal.SIG_DFL)
    if interrupted or seen:  # a library may have caught the KeyboardInterrupt
        from jumpcad.cli.output import complain

        code = complain("interrupted", SIGNALLED + (seen[0] if seen else signal.SIGINT))
    seen.clear()
    sys.exit(code)


def _interrupt(number: int, _: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; while interrupts are deferred, not yet."""
    seen.append(number)
    if not deferring:
        raise KeyboardInterrupt
