"""The code of a worker process: tasks of evaluations, each with a timeout."""

import atexit
import contextlib
import logging
import os
import pickle
import signal
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cloudpickle

from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.gc_tuning import collect_seldom
from jumpcad.search.study.objective import Evaluation, Model
from jumpcad.search.study.variant import Variant


@dataclass(frozen=True)
class Failure:
    """An evaluation that ended with an unexpected exception."""

    text: str


def start_worker(parent: int) -> None:
    """Prepare a worker of the process `parent`, which may have been killed while the worker started."""
    # Ctrl-C is sent to the whole process group; only the parent answers it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Engines print a banner; the parent may be printing one JSON document.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    threading.Thread(target=_end_with_parent, args=(parent,), daemon=True).start()
    collect_seldom()
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # as in `jumpcad.cli.commands.run`
    atexit.register(os._exit, 0)  # else libraries that count leaks when Python ends print them into the parent's lines


def _end_with_parent(parent: int) -> None:
    """End this process when its parent was killed; otherwise it would wait forever."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


@lru_cache(maxsize=1)
def _unpacked(sent: bytes) -> Model:
    """Return a pickled model; the same object for all tasks of a search.

    Raises
    ------
    JumpcadError
        If this machine has other versions than the one that asks.
    """
    model: Model
    model, asked = cloudpickle.loads(sent)
    for name, version in model.versions().items():
        if version != asked[name]:
            raise JumpcadError(
                f"a worker has {name} {version}, not {asked[name]}: install there what is installed here, "
                f"or repeat the command if it changed meanwhile"
            )
    return model


def evaluate_task(sent: bytes, designs: Sequence[Design | Variant], limit_s: float) -> bytes:
    """Evaluate designs one after the other with a pickled model, in a worker; return results and durations, pickled.

    They are pickled here because the executor's pickler, which also supports functions and classes, takes four times as
    long.

    Raises
    ------
    JumpcadError
        If the model cannot work at all, or this machine has other versions of packages.
    """
    model: Any = _unpacked(sent)
    results: list[tuple[Any, float]] = []
    for design in designs:
        start = time.perf_counter()
        with _alarm(limit_s):
            try:
                one = Variant.of(design)  # a model that is made in no workshop gets the design alone
                result: Evaluation | Failure = model(one.design, *([one.workshop] if one.workshop else []))
            except JumpcadError:
                raise
            except Exception as error:  # a bug with a rare design must not end the run
                result = Failure(f"{type(error).__name__}: {error}".removesuffix(": "))
        results.append((result, time.perf_counter() - start))
    return pickle.dumps(results)


@contextlib.contextmanager
def _alarm(limit_s: float) -> Iterator[None]:
    """End this process by a signal if the block takes longer than the limit, also inside compiled code."""
    if limit_s <= 0 or not hasattr(signal, "setitimer"):
        yield
        return
    signal.setitimer(signal.ITIMER_REAL, limit_s)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
