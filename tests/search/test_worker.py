"""What runs in a worker process."""

import os
import signal
import subprocess
import sys
from types import SimpleNamespace

import pytest
from support.hills import SMALL, Hill

from jumpcad.errors import JumpcadError
from jumpcad.search import worker
from jumpcad.search.pool import local_pool


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


def test_a_worker_that_starts_after_its_parent_was_killed_ends():
    """Its parent is then another process: here, this test's child is told that it is its own parent."""
    code = (
        "import os, signal; from jumpcad.search.worker import start_worker; start_worker(os.getpid()); signal.pause()"
    )
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


def test_what_a_worker_prints_goes_nowhere(monkeypatch):
    """Descriptor 1 is standard output, on which the parent may be printing a document; errors stay on 2."""
    made, ended = [], []
    monkeypatch.setattr(worker.signal, "signal", lambda *_: None)
    monkeypatch.setattr(worker.threading, "Thread", lambda **given: SimpleNamespace(start=lambda: ended.append(given)))
    monkeypatch.setattr(worker.os, "open", lambda path, _: path)
    monkeypatch.setattr(worker.os, "dup2", lambda source, target: made.append((source, target)))
    worker.start_worker(7)
    assert made == [(os.devnull, 1)]
    assert [(given["args"], given["daemon"]) for given in ended] == [((7,), True)]
