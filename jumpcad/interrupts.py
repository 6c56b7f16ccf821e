"""Interrupts, by Ctrl-C or SIGTERM: held back while processes start, asked for where a library took one for an error.

The command line counts them and decides what follows; programs that use jumpcad as a library have their own handler.
"""

# It imports nothing at first: the command line needs it before an interrupt can be handled.
seen: list[int] = []
"""Interrupts of the command so far, by the numbers of their signals."""
holding: list[object] = []
"""The blocks in which an interrupt waits for their end."""


def raise_if_seen() -> None:
    """Raise KeyboardInterrupt if the command was interrupted: libraries catch it, and the command would go on."""
    if seen:
        raise KeyboardInterrupt


class Held:
    """A context in which interrupts wait for its end; processes that start in it never get any.

    Ctrl-C is sent to the whole process group, and a process inherits which signals are blocked: one that has just
    started would otherwise print a traceback before it can ignore the signal.
    """

    def __enter__(self) -> None:
        import signal

        holding.append(self)  # another thread may get the signal, and its handler runs in spite of the mask
        if hasattr(signal, "pthread_sigmask"):  # not on Windows
            self._before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})

    def __exit__(self, kind: object, *_: object) -> None:
        import signal

        holding.remove(self)
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_SETMASK, self._before)
        if kind is None:
            raise_if_seen()
