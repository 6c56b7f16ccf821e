"""Work on several cores: no process with threads is copied, and nothing that was begun outlives an error."""

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from support.robots import make_small_robot
from threadpoolctl import threadpool_info, threadpool_limits

from jumpcad.bundle import export as module
from jumpcad.bundle.export import contents
from jumpcad.exporters.registry import Exporter
from jumpcad.process import one_thread
from jumpcad.search.study.pool import local_pool
from jumpcad.simulation import simulate

WATCHED = """
import os, sys, threading

def watch(event, _):
    if event == "os.fork":
        raise RuntimeError("a copy of this process")

sys.addaudithook(watch)
threading.Thread(target=threading.Event().wait, daemon=True).start()
from jumpcad.cli import main
main()
"""
"""The command line with a thread, where a copy of the process is an error."""


def test_what_an_export_began_ends_with_its_error(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[threading.Thread] = []

    def draw(_: object) -> dict[str, bytes]:
        begun.append(threading.current_thread())
        return {}

    def fail(_: object) -> object:
        raise ZeroDivisionError

    monkeypatch.setattr(module, "all_pictures", draw)
    robot = make_small_robot()
    with pytest.raises(ZeroDivisionError):
        contents(robot, [Exporter("broken", fail)], pictures=True, jump=simulate(robot, engine="planar"))
    assert [thread.is_alive() for thread in begun] == [False]


@pytest.mark.thorough
@pytest.mark.parametrize("asked", ["build kenan-2.0 -o bundle", "optimize --workers 2 --evaluations 14 --study s.db"])
def test_no_command_copies_a_process_with_threads(tmp_path: Path, asked: str) -> None:
    """Python 3.12 and later warn of such copies; libraries such as OpenMP hang in them."""
    command = [sys.executable, "-W", "error::DeprecationWarning:multiprocessing", "-c", WATCHED, *asked.split()]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "") or "a copy" not in done.stderr, done.stderr


def test_work_is_shared_in_order_and_what_workers_cannot_do_is_done_here(caplog: pytest.LogCaptureFixture) -> None:
    with local_pool(2) as pool:
        assert pool.shared(time.sleep, [0.01] * 40) == [None] * 40
    with local_pool(2) as pool:
        assert pool.shared(abs, range(-9, 9)) == [abs(one) for one in range(-9, 9)]
        lock = threading.Lock()  # no pickle holds it
        assert pool.shared(lambda one: (one, lock.locked()), range(9)) == [(one, False) for one in range(9)]
        with pytest.raises(ZeroDivisionError):
            pool.shared(lambda one: 1 // one, range(9))
        assert pool.shared(abs, []) == []
    assert not caplog.records, "loky logs a traceback"


FIRST_OF_ALL = """
import numpy
from threadpoolctl import threadpool_info
from jumpcad.process import one_thread
with one_thread():
    import scipy.linalg, sklearn.gaussian_process
    print(*{pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})
"""


def threads() -> set[int]:
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


def test_there_is_one_within_and_as_many_as_before_afterwards() -> None:
    with threadpool_limits(2, user_api="blas"):
        for _ in range(2):
            with one_thread():
                assert threads() == {1}
            assert threads() == {2}


def test_scipys_own_is_among_them_where_nothing_has_loaded_it_yet() -> None:
    command, environment = [sys.executable, "-c", FIRST_OF_ALL], os.environ | {"OPENBLAS_NUM_THREADS": "2"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.strip() == "1"
