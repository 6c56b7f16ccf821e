"""The command line: ready for an interrupt before anything else is loaded."""

import atexit
import signal
import sys

INTERRUPTED = 130


def main() -> None:
    """Run the command line; see `jumpcad.cli.commands.run` for the exit codes, besides 130 for an interrupt."""
    try:
        from jumpcad.cli.commands import run  # takes 0.2 s, in which people press Ctrl-C too

        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        from jumpcad.cli.output import complain

        code = complain("interrupted", INTERRUPTED)
    atexit.register(signal.signal, signal.SIGINT, signal.SIG_IGN)  # all is done; an interrupt would only be a traceback
    sys.exit(code)
