"""What a worker process is started with."""

import os

import loky
import pytest

from jumpcad.search.study.local_workers import LocalWorkers
from jumpcad.search.study.worker import start_worker


def test_workers_compute_in_one_thread_and_know_who_started_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """As many as asked, each in one thread of OpenMP and of both libraries of linear algebra."""
    started = []
    monkeypatch.setattr(loky.ProcessPoolExecutor, "__init__", lambda _, *given, **named: started.append((given, named)))
    LocalWorkers(3)
    (((workers,), named),) = started
    assert workers == 3
    assert (named["initializer"], named["initargs"]) == (start_worker, (os.getpid(),))
    variables = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    assert named["env"] == dict.fromkeys(variables, "1")
