"""What a process does by itself: cores and threads that it uses, garbage collection, interrupts.

Linear algebra in one thread sums in a fixed order: the same bits however many cores there are. Interrupts, by Ctrl-C or
SIGTERM, are deferred while processes start, and asked for where a library took one for an error. The command line
counts them and decides what follows; programs that use jumpcad as a library have their own handler.
"""

import gc
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

A = TypeVar("A")
T = TypeVar("T")
MapOnCores = Callable[[Callable[[Any], Any], Sequence[Any]], list[Any]]
"""Gives what a function returns for each argument: `in_turn`, or on several cores."""
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of commands and of workers: small matrices gain nothing by threads, which wait for work at full speed."""
THRESHOLDS = 50_000, 20, 20
"""Of Python's three generations of objects, in place of 700, 10 and 10. Commands make many objects, hardly any in
cycles: 6 % of a search's time and 9 % of a build's went into looking (measured)."""
USUAL = gc.get_threshold()

seen: list[int] = []
"""Interrupts of the command so far, by the numbers of their signals."""
deferring: list[None] = []
"""One entry for each block under way in which an interrupt waits for the end."""


def cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def in_turn(function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
    return [function(one) for one in arguments]


def one_thread() -> AbstractContextManager[Any]:
    """Return a context in which numpy's and scipy's linear algebra has one thread."""
    context: AbstractContextManager[Any] = _libraries().limit(limits=1)
    return context


@cache
def _libraries() -> "ThreadpoolController":
    """Return the linear algebra underneath, which it takes some milliseconds to look for."""
    import scipy.linalg  # noqa: F401  # has libraries of its own
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def collect_seldom(seldom: bool = True) -> None:
    """Make this process look seldom: for commands and workers, which end with what they were started for.

    Else as often as before: for one that stays, whose bundles would take twice the memory.
    """
    gc.set_threshold(*(THRESHOLDS if seldom else USUAL))


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
