"""Work in a copy of this process: its result, its errors, and where there is no copy."""

import io
import os
import signal
import sys
import threading
from collections.abc import Callable

import pytest
from support.robots import make_small_robot

from jumpcad import beside as module
from jumpcad.beside import beside, shared
from jumpcad.checks import costly_findings

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="copies are made on Linux alone")


@pytest.fixture(autouse=True)
def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "cores", lambda: 2)


def test_a_function_runs_in_another_process_once_and_here_where_there_is_one_core(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    elsewhere = beside(os.getpid)
    assert elsewhere() == elsewhere() != os.getpid()
    monkeypatch.setattr(module, "cores", lambda: 1)
    assert beside(os.getpid)() == os.getpid()


def test_what_fails_there_fails_here() -> None:
    """An error is raised where the result is asked for; what a copy cannot finish or send is done here."""
    with pytest.raises(ZeroDivisionError):
        beside(lambda: 1 // 0)()
    here = os.getpid()

    def killed() -> int:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return 7

    assert beside(killed)() == 7
    unsent: Callable[[], Callable[[], int]] = lambda: lambda: 8  # noqa: E731  no pickle holds it
    assert beside(unsent)()() == 8


def test_work_is_shared_in_order_among_as_many_processes_as_are_asked_for() -> None:
    for most in (1, 2, 5):
        found = shared(lambda number: (number, os.getpid()), range(13), most)
        assert [number for number, _ in found] == [*range(13)], most
        assert len({process for _, process in found}) == min(most, 2)
    assert shared(abs, [], 2) == []


def test_interrupts_are_this_process_s_affair() -> None:
    """Ctrl-C goes to the whole group of processes: the copy ignores it; SIGTERM ends it without a word."""
    found = beside(lambda: [signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)])()
    assert found == [signal.SIG_IGN, signal.SIG_DFL]


def test_a_copy_waits_for_no_lock_of_a_thread_that_it_has_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """Such as that of a terminal's progress, through which Python prints warnings too."""
    held = threading.Lock()

    class Progress(io.StringIO):
        def write(self, text: str) -> int:
            assert held.acquire(timeout=1.0)
            return len(text)

    monkeypatch.setattr(sys, "stderr", Progress())
    with held:
        assert beside(lambda: print("a warning", file=sys.stderr) or os.getpid())() != os.getpid()


def test_findings_are_the_same_on_one_core_and_on_two(monkeypatch: pytest.MonkeyPatch) -> None:
    two = costly_findings(make_small_robot())
    monkeypatch.setattr(module, "cores", lambda: 1)
    assert two == costly_findings(make_small_robot())
