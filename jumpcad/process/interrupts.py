"""Interrupts, by Ctrl-C or SIGTERM: deferred while processes start, asked for where a library took one for an error.

The command line counts them and decides what follows; programs that use jumpcad as a library have their own handler.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

seen: list[int] = []
"""Interrupts of the command so far, by the numbers of their signals."""
deferring: list[None] = []
"""One entry for each block under way in which an interrupt waits for the end."""


def raise_if_seen() -> None:
    """Raise KeyboardInterrupt if the command was interrupted: libraries catch it, and the command would go on."""
    if seen:
        raise KeyboardInterrupt


@contextmanager
def deferred_interrupts() -> Iterator[None]:
    """Let interrupts wait for the end of a block; processes that start in it never get any.

    Ctrl-C is sent to the whole process group, and a process inherits which signals are blocked: one that has just
    started would otherwise print a traceback before it can ignore the signal.
    """
    system: Any = signal  # Windows has no masks
    masks = hasattr(system, "pthread_sigmask")
    deferring.append(None)  # another thread may get the signal, and its handler runs in spite of the mask
    before = system.pthread_sigmask(system.SIG_BLOCK, {signal.SIGINT}) if masks else set()
    try:
        yield
    finally:
        deferring.pop()
        if masks:
            system.pthread_sigmask(system.SIG_SETMASK, before)
    raise_if_seen()
