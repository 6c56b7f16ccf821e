"""Worker processes on this machine, which no interrupt reaches: the process that started them answers it."""

import os
from collections.abc import Callable
from concurrent.futures import Future
from multiprocessing import resource_tracker
from typing import Any

import loky

from jumpcad.interrupts import deferred_interrupts
from jumpcad.search.study.worker import start_worker

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of a worker: as many workers as cores, one thread each."""


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

    def end(self) -> None:
        """End the processes without waiting for their tasks."""
        self.shutdown(kill_workers=True)
