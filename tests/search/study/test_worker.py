"""What runs in a worker process."""

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
    """A hill that fails where it is steep, and takes 20 ms; of a workshop it says the plates."""

    def __call__(self, design, workshop=None):
        time.sleep(0.02)
        if design.rest_angle_deg > 60.0:
            raise ValueError("too steep" if workshop is None else "")
        return super().__call__(design) if workshop is None else Evaluation("jump", dict(workshop))


def test_a_task_has_a_result_and_a_duration_for_each_of_its_designs():
    """In their order; an unexpected error is one line, and does not end the task."""
    flat, steep = (SMALL.to_design([0.5, place, 0.5]) for place in (0.5, 0.9))
    asked = [flat, steep, Variant(flat, {"body.plate_mm": 2.0}), Variant(steep, {"body.plate_mm": 3.0})]
    model = Told()
    sent = cloudpickle.dumps((model, model.versions()))
    found = pickle.loads(worker.evaluate_task(sent, asked, 0.0))
    assert [result for result, _ in found] == [
        Hill()(flat), worker.Failure("ValueError: too steep"), Evaluation("jump", {"body.plate_mm": 2.0}),
        worker.Failure("ValueError"),
    ]  # fmt: skip
    assert all(duration_s >= 0.02 for _, duration_s in found)


def test_what_is_wrong_with_every_design_ends_the_task():
    """As an engine that is not installed: it is no failure of one design."""

    class Wrong(Hill):
        def __call__(self, design):
            raise JumpcadError("no engine")

    sent = cloudpickle.dumps((Wrong(), {"hill": "1"}))
    with pytest.raises(JumpcadError, match="no engine"):
        worker.evaluate_task(sent, [SMALL.to_design([0.5] * 3)], 0.0)
