"""Work beside this process, on another core: in a copy of it, where the system can make one at once."""

import multiprocessing
import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from functools import cache, partial
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from jumpcad.interrupts import deferred_interrupts

LEAST = 6
A = TypeVar("A")
T = TypeVar("T")
Shared = Callable[[Callable[[Any], Any], Sequence[Any]], list[Any]]
"""Gives what a function returns for each argument: `one_by_one`, or on several cores."""


def cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def may_copy() -> bool:
    """Whether copies of this process are safe: on Linux, from its first thread, if it may have children at all."""
    first = threading.current_thread() is threading.main_thread()
    return sys.platform == "linux" and first and not multiprocessing.current_process().daemon


def beside(function: Callable[..., T], *arguments: object) -> Callable[[], T]:
    """Start a function in a copy of this process; return a function that waits for its result, which is pickled.

    It is called here, when its result is asked for, where there is no other core, where copies are not safe, and where
    the copy fails, so that an error is raised as if there were none.
    """
    here = cache(partial(function, *arguments))
    if cores() < 2 or not may_copy():
        return here
    ours, theirs = multiprocessing.Pipe(duplex=False)
    context: Any = multiprocessing.get_context("fork")
    copy = context.Process(target=_answer, args=(theirs, here), daemon=True)
    try:
        with deferred_interrupts():
            copy.start()
    except OSError:  # no memory, or too many processes
        return here
    theirs.close()

    def result() -> T:
        try:
            with ours:
                found: T = pickle.loads(ours.recv_bytes())
        except (EOFError, OSError):
            return here()
        copy.join()
        return found

    return cache(result)


def shared(function: Callable[[A], T], arguments: Sequence[A], most: int) -> list[T]:
    """Return what a function returns for each argument, on all cores, at most some: here and in copies of this process.

    What a copy learns besides is lost. Each does `LEAST` of them or more: to make a copy takes 10 ms.
    """
    count = max(1, min(cores(), most, len(arguments) // LEAST))
    others = [beside(one_by_one, function, arguments[start::count]) for start in range(1, count)]
    found = [one_by_one(function, arguments[::count]), *(other() for other in others)]
    return [found[index % count][index // count] for index in range(len(arguments))]


def one_by_one(function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
    """Return what a function returns for each argument."""
    return [function(one) for one in arguments]


def _answer(answer: Connection, function: Callable[[], object]) -> None:
    """Send a function's result; nothing if it fails: it will fail again where it is seen."""
    for number in (signal.SIGINT, signal.SIGTERM):  # the first goes to the whole group, and only its parent answers it
        signal.signal(number, signal.SIG_IGN if number == signal.SIGINT else signal.SIG_DFL)
    sys.stdout = sys.stderr = None  # a thread that shows progress may have locked them, and is not in this copy
    try:
        answer.send_bytes(pickle.dumps(function()))
    except Exception:
        answer.close()
