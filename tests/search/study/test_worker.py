"""What runs in a worker process."""

import os
import pickle
import signal
import subprocess
import sys
import time

import cloudpickle
import pytest
from support.hills import SMALL, Hill

from jumpcad.errors import JumpcadError
from jumpcad.search.study import worker
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.variant import Variant


class Elsewhere(Hill):
    """A hill whose version depends on who asks."""

    asked = 0

    def versions(self):
        type(self).asked += 1
        return {"hill": str(type(self).asked)}


def test_a_worker_with_another_program_computes_nothing():
    design = SMALL.to_design([0.5, 0.5, 0.5])
    with local_pool(0) as pool, pytest.raises(JumpcadError, match="a worker has hill 2, not 1"):
        list(pool.evaluate(Elsewhere(), [design]))


@pytest.mark.thorough
def test_a_worker_that_starts_after_its_parent_was_killed_ends():
    """Its parent is then another process: here, this test's child is told that it is its own parent."""
    start = "from jumpcad.search.study.worker import start_worker; start_worker(os.getpid())"
    code = f"import os, signal; {start}; signal.pause()"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 1


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="alarms are POSIX")
def test_the_alarm_is_off_after_a_design_that_was_in_time():
    with worker._alarm(60.0):
        left, again = signal.getitimer(signal.ITIMER_REAL)
        assert 50.0 < left <= 60.0
        assert again == 0.0
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
    with worker._alarm(0.0):  # no limit
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


class Told(Hill):
    """A hill that takes 20 ms; of a workshop it says the plates."""

    def __call__(self, design, workshop=None):
        time.sleep(0.02)
        return super().__call__(design) if workshop is None else Evaluation("jump", dict(workshop))


def test_a_task_has_the_outcome_of_its_variant_and_how_long_it_took():
    design = SMALL.to_design([0.5] * 3)
    sent = cloudpickle.dumps((Told(), {"hill": "1"}))
    plates = {"body.plate_mm": 2.0}
    for variant, expected in ((Variant(design), Hill()(design)), (Variant(design, plates), Evaluation("jump", plates))):
        found, duration_s = pickle.loads(worker.evaluate_one(sent, variant, 0.0))
        assert found == expected
        assert duration_s >= 0.02


@pytest.mark.thorough
def test_a_worker_computes_in_one_thread():
    """Of OpenMP and of both libraries of linear algebra: sums in several threads differ in their last digits."""
    workers = worker.LocalWorkers(1)
    variables = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    assert [workers.submit(os.getenv, name).result() for name in variables] == ["1", "1", "1"]
    workers.shutdown(kill_workers=True)
