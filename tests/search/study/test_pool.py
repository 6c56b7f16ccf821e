"""Workers die, hang and run out of memory; the run goes on."""

import contextlib
import os
import select
import socket
import subprocess
import sys
import textwrap
import time
from concurrent.futures import BrokenExecutor, Future
from types import SimpleNamespace

import numpy as np
import pytest
from support import needs
from support.hills import Hill, Trap
from support.places import TESTS

from jumpcad import process
from jumpcad.errors import JumpcadError
from jumpcad.search.space import Space
from jumpcad.search.study import pool as pool_module
from jumpcad.search.study.objective import QUARANTINED
from jumpcad.search.study.pool import InProcess, Pool, dask_pool, local_pool, open_pool

SPACE = Space.parse(fix=["c_coef=1", "d_coef=0.8"])
DESIGNS = [SPACE.to_design(point) for point in SPACE.spread(24, np.random.default_rng(3))]
TRAPPED = {index for index, design in enumerate(DESIGNS) if design.rest_angle_deg > 60.0}
GOOD = [design for index, design in enumerate(DESIGNS) if index not in TRAPPED]


def evaluate(pool, model, designs=DESIGNS):
    """Return the evaluations by place, and what the pool noted."""
    notes = []
    pool.notice = notes.append
    with pool:
        outcomes = {outcome.index: outcome.evaluation for outcome in pool.evaluate(model, designs)}
    return [outcomes[index] for index in range(len(designs))], notes


@pytest.mark.thorough
@pytest.mark.parametrize("workers", [0, 2])
def test_results_do_not_depend_on_who_computes_them(workers):
    found, notes = evaluate(local_pool(workers), Hill())
    assert found == [Hill()(design) for design in DESIGNS]
    assert notes == []


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("way", "limit_s", "reason"),
    [
        ("kill", 60.0, "SIGKILL (killed, perhaps because memory ran out)"),
        ("memory", 60.0, "MemoryError: no room for a mesh"),
        ("bug", 60.0, "ZeroDivisionError: a bug"),
    ],
)
def test_designs_that_fail_twice_are_quarantined_and_named(way, limit_s, reason):
    """By one worker, for which a new one starts; what two lose to each other is in the tests below."""
    bad = [DESIGNS[index] for index in sorted(TRAPPED)[:2]]  # each ends two workers
    designs = [*GOOD[:3], bad[0], *GOOD[3:6], bad[1], *GOOD[6:8]]
    found, notes = evaluate(local_pool(1, limit_s), Trap(way=way), designs)
    for design, evaluation in zip(designs, found, strict=True):
        if design in bad:
            assert evaluation.verdict == QUARANTINED
            assert reason in evaluation.detail
        else:
            assert evaluation == Hill()(design)
    assert sum("quarantined" in note for note in notes) == len(bad) == 2


@pytest.mark.thorough
def test_a_hang_is_ended_at_its_limit():
    designs = GOOD[:8]
    designs.insert(3, DESIGNS[min(TRAPPED)])
    found, _ = evaluate(local_pool(2, limit_s=0.5), Trap(way="hang"), designs)
    assert found[3].verdict == QUARANTINED
    assert "past its limit of 0.5 s" in found[3].detail
    assert all(evaluation.verdict != QUARANTINED for index, evaluation in enumerate(found) if index != 3)


@pytest.mark.thorough
def test_what_fails_once_is_repeated(tmp_path):
    found, notes = evaluate(local_pool(2), Trap(way="kill", once=tmp_path / "died"))
    assert found == [Hill()(design) for design in DESIGNS]
    assert notes
    assert not any("quarantined" in note for note in notes)


def test_an_error_of_the_request_ends_the_run():
    class Missing(Hill):
        def __call__(self, design):
            raise JumpcadError("PyBullet is not installed")

    with pytest.raises(JumpcadError, match="not installed"):
        evaluate(local_pool(1), Missing())


@pytest.mark.thorough
@pytest.mark.skipif(not hasattr(os, "pidfd_open"), reason="processes of others are waited for as Linux has it")
def test_workers_end_with_a_killed_parent(tmp_path):
    code = textwrap.dedent(f"""
        import os, signal, sys
        sys.path[:0] = [{os.path.dirname(__file__)!r}, {str(TESTS)!r}]
        from test_pool import DESIGNS, Hill, local_pool
        pool = local_pool(2)
        list(pool.evaluate(Hill(), DESIGNS))
        print(*[process.pid for process in pool._executor._processes.values()], flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    workers = [int(pid) for pid in done.stdout.split()]
    assert len(workers) == 2
    for pid in workers:
        _wait_for_the_end_of(pid)


def _wait_for_the_end_of(pid):
    """Return when a process has ended, also one that this process did not start; for ever if it never does."""
    with contextlib.suppress(ProcessLookupError):
        process = os.pidfd_open(pid)
        select.select([process], [], [])
        os.close(process)


@pytest.mark.thorough
def test_dask_loses_nothing_when_a_worker_is_killed(tmp_path):
    distributed = needs.package("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path)
    ) as cluster:
        found, _ = evaluate(dask_pool(cluster.scheduler_address), Trap(way="kill", once=tmp_path / "died"))
        assert (tmp_path / "died").exists()
        assert found == [Hill()(design) for design in DESIGNS]


@pytest.mark.thorough
@pytest.mark.parametrize(("dies", "said"), [(0, "answers no more"), (1, "has no workers any more")])
def test_a_search_without_scheduler_or_workers_ends(tmp_path, monkeypatch, capfd, dies, said):
    """At once, as when memory ran out: nobody says goodbye."""
    needs.package("distributed")
    monkeypatch.setattr("jumpcad.search.study.pool.ANSWER_S", 5.0)
    known, dask = tmp_path / "scheduler.json", [sys.executable, "-m", "dask"]
    once = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    commands = ["scheduler --port 0 --no-dashboard", "worker --no-nanny --nthreads 1 --no-dashboard"]
    programs = [subprocess.Popen([*dask, *one.split(), "--scheduler-file", known], **once) for one in commands]
    try:
        address = wait_for_workers(known)
        with dask_pool(address) as pool:
            outcomes = pool.evaluate(Hill(pause_s=0.1), DESIGNS)
            next(outcomes)
            programs[dies].kill()
            with pytest.raises(JumpcadError, match=said):
                list(outcomes)
    finally:
        for one in programs:
            one.kill()
            one.wait()
    assert capfd.readouterr().err == ""


def wait_for_workers(known):
    """Return the address of a scheduler, from its file, when it has a worker."""
    import distributed

    while not known.exists():
        time.sleep(0.1)
    with distributed.Client(scheduler_file=str(known), set_as_default=False) as client:
        client.wait_for_workers(1)
        return client.scheduler.address


def test_dask_that_does_not_answer(monkeypatch):
    monkeypatch.setattr("jumpcad.search.study.pool.ANSWER_S", 0.5)
    needs.package("distributed")
    silent = socket.create_server(("127.0.0.1", 0))  # somebody else, who listens and says nothing
    wrong = "tcp://127.0.0.1:1", "tls://127.0.0.1:1", "ucx://127.0.0.1:1", "inproc://a", "tcp://127.0.0.1:x"
    for address in (*wrong, f"tcp://127.0.0.1:{silent.getsockname()[1]}"):
        with pytest.raises(JumpcadError, match=f"^no Dask scheduler answers at {address}: [^\n]+$"):
            dask_pool(address)
    silent.close()


def test_other_versions_are_named_before_anything_is_sent():
    def host(python, package):
        return {"host": [("python", python)], "packages": {"jumpcad": package}}

    def client(scheduler, worker):
        found = {"client": host("3.11.7.final.0", "0.1.0"), "scheduler": scheduler, "workers": {"tcp://a": worker}}
        return SimpleNamespace(get_versions=lambda packages: found)

    good = host("3.11.2.final.0", "0.1.0")
    pool_module._require_same_versions(client(good, good))
    with pytest.raises(
        JumpcadError, match=r"^tcp://a has Python 3.12 and jumpcad 0.1.0, not Python 3.11 and jumpcad 0.1.0: install"
    ):
        pool_module._require_same_versions(client(good, host("3.12.1.final.0", "0.1.0")))
    with pytest.raises(JumpcadError, match=r"^the Dask scheduler has Python 3.11 and jumpcad \(none\), not "):
        pool_module._require_same_versions(client(host("3.11.7", None), good))


def test_a_cluster_has_its_own_workers_and_the_same_timeout(monkeypatch):
    for wrong in (0.0, 1e6, float("nan")):
        with pytest.raises(JumpcadError, match="the timeout per evaluation"):
            dask_pool("tcp://a", wrong)
    for name in ("dask_pool", "local_pool"):
        monkeypatch.setattr(pool_module, name, lambda *given, made=name: (made, *given))
    assert open_pool(None, "tcp://a", 7.0) == ("dask_pool", "tcp://a", 7.0)
    assert open_pool(3, None, 7.0) == ("local_pool", 3, 7.0)
    with pytest.raises(JumpcadError, match="workers and dask exclude each other"):
        open_pool(3, "tcp://a")


class Interrupted(Hill):
    """A hill whose command is interrupted at the third evaluation; the steep ones fail."""

    def __call__(self, design):
        super().__call__(design)
        if len(self.log.read_text().splitlines()) == 3:
            process.seen.append(2)
        if design.rest_angle_deg > 60.0:
            raise ZeroDivisionError
        return Hill()(design)


def test_a_command_that_was_interrupted_evaluates_no_more(tmp_path, monkeypatch):
    """Neither further tasks, of which one was sent already, nor what is to be repeated."""
    monkeypatch.setattr(process, "seen", [])
    bad = DESIGNS[min(TRAPPED)]
    for number, (designs, most) in enumerate(((GOOD[:8], 4), ([bad, *GOOD[:2]], 3))):
        log = tmp_path / str(number)
        with local_pool(0) as pool, pytest.raises(KeyboardInterrupt):
            list(pool.evaluate(Interrupted(log=log), designs))
        assert 3 <= len(log.read_text().splitlines()) <= most
        process.seen.clear()


def test_workers_and_timeouts_have_ends_that_are_told():
    """A day at most; a tenth of a second, below which nothing ends."""
    for workers, limit_s, message in (
        (-1, 1.0, "workers = -1"), (257, 1.0, "workers = 257 must be at most 256"), (1, 0.0, "limit = 0.0 s"),
        (1, float("nan"), "limit = nan s"), (1, float("inf"), "limit = inf s"), (1, 0.099, "at least 0.1 and at most"),
        (1, 86401.0, "at most 86400"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=message):
            local_pool(workers, limit_s)
    for limit in (0.1, 86400.0):
        assert local_pool(256, limit).workers == 256


def test_how_a_worker_was_lost_is_one_line():
    for error, said in (
        (BrokenExecutor("a worker ended by SIGALRM(14)"), "it ran past its limit of 12.5 s"),
        (BrokenExecutor("exit codes {SIGKILL(-9)}"),
         "its worker was ended by SIGKILL (killed, perhaps because memory ran out)"),
        (BrokenExecutor("exit codes {SIGSEGV(-11)}"), "its worker was ended by SIGSEGV"),
        (OSError("the line broke\nand more"), "OSError: the line broke"), (OSError(), "OSError"),
        (ValueError("SIGALRM"), "ValueError: SIGALRM"),
    ):  # fmt: skip
        future: Future[bytes] = Future()
        future.set_exception(error)
        assert Pool(InProcess, InProcess.shutdown, 1, 12.5)._outcome(0, future) == said
