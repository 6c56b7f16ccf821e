"""Worker processes of this machine, which no interrupt reaches, and what they run: one evaluation, with a timeout."""

import atexit
import contextlib
import importlib
import logging
import os
import pickle
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from functools import lru_cache
from multiprocessing import resource_tracker
from typing import Any

import cloudpickle
import loky

from jumpcad.errors import JumpcadError
from jumpcad.process import ONE_THREAD, collect_seldom, deferred_interrupts, in_turn, one_thread
from jumpcad.search.models import RobotModel
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.variant import Variant


class LocalWorkers(loky.ProcessPoolExecutor):  # type: ignore[misc]  # loky has no annotations
    """An executor whose processes start while interrupts are held back, and end with this process."""

    def __init__(self, workers: int) -> None:
        resource_tracker.ensure_running()  # of Python 3.11, it unblocks interrupts when it starts
        with deferred_interrupts():
            super().__init__(workers, initializer=start_worker, initargs=(os.getpid(),), env=ONE_THREAD)

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Send a task; the first one starts the processes, and the thread that starts others in place of lost ones."""
        with deferred_interrupts():
            future: Future[Any] = super().submit(fn, *args, **kwargs)
        return future


def require_descriptors(workers: int) -> None:
    """Require that so many workers can be started: 17 descriptors are open for two, and two more for each other one."""
    try:
        resource = importlib.import_module("resource")  # of POSIX alone
    except ImportError:
        return
    needed, (most, _) = 24 + 2 * workers, resource.getrlimit(resource.RLIMIT_NOFILE)
    if 0 <= most < needed:
        raise JumpcadError(
            f"workers = {workers}: take {needed} open files, and {most} are allowed: raise that with "
            f"ulimit -n {needed}, or take fewer workers (0 for none)"
        )


def start_worker(parent: int) -> None:
    """Prepare a worker of the process `parent`, which may have been killed while the worker started."""
    # Ctrl-C is sent to the whole process group; only the parent answers it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.environ.update(ONE_THREAD)
    one_thread()
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


def evaluate_one(sent: bytes, one: Variant, limit_s: float) -> bytes:
    """Evaluate a variant with a pickled model, in a worker; return outcome and duration (s), pickled.

    They are pickled here because the executor's pickler, which also supports functions and classes, takes four times as
    long.
    """
    model: Any = _unpacked(sent)
    start = time.perf_counter()
    with _alarm(limit_s):
        # A model that is made in no workshop gets the design alone.
        outcome: Evaluation = model(one.design, *([one.workshop] if one.workshop else []))
    return pickle.dumps((outcome, time.perf_counter() - start))


def share(sent: bytes, arguments: Sequence[Any]) -> list[Any]:
    """Return what a pickled function returns for each argument, in a worker."""
    return in_turn(cloudpickle.loads(sent), arguments)


@lru_cache(maxsize=1)
def _unpacked(sent: bytes) -> RobotModel:
    """Return a pickled model; the same object for all tasks of a search."""
    model: RobotModel
    model, asked = cloudpickle.loads(sent)
    for name, version in model.versions().items():
        if version != asked[name]:
            raise JumpcadError(
                f"a worker has {name} {version}, not {asked[name]}: install there what is installed here, "
                f"or repeat the command if it changed meanwhile"
            )
    return model


@contextlib.contextmanager
def _alarm(limit_s: float) -> Iterator[None]:
    """End this process by a signal if the block takes longer than the limit, also inside compiled code."""
    system: Any = signal  # Windows has no such timer
    if limit_s <= 0 or not hasattr(system, "setitimer"):
        yield
        return
    system.setitimer(system.ITIMER_REAL, limit_s)
    try:
        yield
    finally:
        system.setitimer(system.ITIMER_REAL, 0.0)
