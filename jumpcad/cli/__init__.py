"""The command line: ready for an interrupt before anything else is loaded."""

# All of these are loaded when Python has started; `signal` would load much more before an interrupt could be answered,
# and a handler that loads a module while another one is being loaded breaks that.
import _signal as signal  # type: ignore[import-not-found]
import sys

TYPE_CHECKING = False  # as in `jumpcad`
if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
IMPORTING = "<frozen importlib._bootstrap>"
"""Where Python's own code loads modules."""
_seen: list[int] = []
"""Interrupts that came while a command ran."""


def main() -> None:
    """Run the command line; see `jumpcad.cli.commands.run` for the exit codes, besides 130 for an interrupt."""
    _seen.clear()
    listening = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # nohup and & have it ignored
    if listening:
        signal.signal(signal.SIGINT, _interrupt)
    try:
        from jumpcad.cli.commands import run

        code = run(sys.argv[1:])
        _ignore_interrupts(listening)  # all is done: they would only be tracebacks
    except KeyboardInterrupt:
        _ignore_interrupts(listening)
        code = INTERRUPTED
    if _seen or code == INTERRUPTED:  # something may have taken the KeyboardInterrupt for an error of its own
        from jumpcad.cli.output import complain

        code = complain("interrupted", INTERRUPTED)
    sys.exit(code)


def _ignore_interrupts(listening: bool) -> None:
    if listening:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _interrupt(number: int, frame: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; while a module loads, as soon as it is loaded, in the code that asked for it.

    Compiled modules abort the process, or take it for a failure of their own, when it is raised while they load.
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
