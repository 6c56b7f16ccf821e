"""Evaluations on many processes or machines, repeated if a worker is lost.

Any `concurrent.futures.Executor` can be used: local processes (loky), a Dask cluster, or the calling process. The
designs of a lost worker are evaluated again, one at a time; one that fails again is quarantined, with the reason.
"""

import importlib
import logging
import pickle
import re
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager
from dataclasses import dataclass
from threading import Thread
from typing import Any

import cloudpickle

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.process import A, T, cores, in_turn, raise_if_seen
from jumpcad.search.models import RobotModel
from jumpcad.search.study.objective import QUARANTINED, Evaluation
from jumpcad.search.study.variant import Variant
from jumpcad.search.study.worker import LocalWorkers, evaluate_one, require_descriptors, share

ANSWER_S = 10.0
"""Timeout for a Dask scheduler's answer, and for a result until somebody asks whether there may be one."""
GO_ON = "and repeat the command: with --study it goes on"

MOST_WORKERS = 256
SHARE = 4
"""Arguments that a worker gets at a time of work that is shared."""
SHORTEST_S, LONGEST_S = 0.1, 86400.0
"""Least timeout per evaluation, below which no evaluation could end, and largest."""


@dataclass(frozen=True)
class Outcome:
    """One finished evaluation: index of the design in its batch, result, duration."""

    index: int
    evaluation: Evaluation
    duration_s: float


class Pool(AbstractContextManager["Pool"]):
    """Runs so many evaluations at a time on an executor, and repeats those of lost workers.

    After a timeout (s) per evaluation its worker is ended; 0 for none. `notice` is called with one line about every
    failure, `lost` where nothing ends for `ANSWER_S`: it says why nothing will any more, or nothing.
    """

    @check_arguments
    def __init__(
        self, open_executor: Callable[[], Executor], end_executor: Callable[[Any], None], workers: int,
        limit_s: float = 0.0, notice: Callable[[str], None] = lambda text: None, lost: Callable[[], str] = str,
    ) -> None:  # fmt: skip
        self.workers, self.notice = workers, notice
        self._open, self._end = open_executor, end_executor
        self._limit_s, self._lost = limit_s, lost
        self._executor: Executor | None = None

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        if self._executor is not None:
            self._end(self._executor)
            self._executor = None

    def evaluate(self, model: RobotModel, designs: Sequence[Design | Variant]) -> Iterator[Outcome]:
        """Evaluate designs; outcomes come in the order in which they finish."""
        sent = cloudpickle.dumps((model, model.versions()))  # once per batch; executors would do it once per task
        waiting = [(index, Variant.of(design)) for index, design in enumerate(designs)][::-1]
        running: dict[Future[bytes], tuple[int, Variant]] = {}
        suspects: list[tuple[int, Variant, str]] = []
        while waiting or running:
            raise_if_seen()
            while waiting and len(running) <= self.workers:  # one more keeps workers busy while results travel
                task = waiting.pop()
                running[self._submit(evaluate_one, sent, task[1], self._limit_s)] = task
            for future in self._ended(running):
                index, variant = running.pop(future)
                outcome = self._outcome(index, future)
                if isinstance(outcome, str):
                    suspects.append((index, variant, outcome))
                else:
                    yield outcome
        for index, variant, reason in suspects:
            raise_if_seen()
            self.notice(f"an evaluation failed and is repeated alone: {reason}")
            (future,) = self._ended([self._submit(evaluate_one, sent, variant, self._limit_s)])
            again = self._outcome(index, future)
            if isinstance(again, str):
                values = ", ".join(value if isinstance(value, str) else f"{value:.6g}" for value in variant.key)
                self.notice(f"a design is quarantined: {again}; before: {reason}; design: {values}")
                again = Outcome(index, Evaluation(QUARANTINED, detail=again), 0.0)
            yield again

    def shared(self, function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
        """Return what a function returns for each argument: the last ones here, the first by workers that are free.

        Nothing waits for them: what they have not done, or cannot do, is done here.
        """
        parts = [arguments[start : start + SHARE] for start in range(0, len(arguments), SHARE)]
        try:
            sent = cloudpickle.dumps(function) if self.workers > 1 and len(parts) > 1 else b""
        except Exception:  # an objective of the user's that holds what cannot be sent
            sent = b""
        if not sent:
            return in_turn(function, arguments)
        others: list[Future[list[T]]] = []
        found: list[T] = []
        while len(others) < len(parts):
            # Few wait: loky ends with a traceback where one that waits was cancelled.
            if sum(not other.done() for other in others) < 2 * self.workers:
                others.append(self._submit(share, sent, parts[len(others)]))
            else:
                found = [*in_turn(function, parts.pop()), *found]
        for part, other in zip(parts[::-1], others[::-1], strict=True):
            done = other.done() and not other.cancelled() and other.exception() is None
            found = [*(other.result() if done else in_turn(function, part)), *found]
        return found

    def _ended(self, running: Iterable[Future[bytes]]) -> Iterable[Future[bytes]]:
        """Return the futures that have ended, one or more."""
        while not (ended := wait(running, ANSWER_S, FIRST_COMPLETED).done):
            self._require_somebody()
        return ended

    def _require_somebody(self) -> None:
        if reason := self._lost():
            raise JumpcadError(reason)

    def _submit(self, function: Callable[..., T], *arguments: Any) -> Future[T]:
        if self._executor is None:
            self._executor = self._open()
        try:
            return self._executor.submit(function, *arguments)
        except BrokenExecutor:
            self.close()
            self._executor = self._open()
            return self._executor.submit(function, *arguments)
        except Exception:  # a Dask client is closed when its scheduler does not come back
            self._require_somebody()
            raise

    def _outcome(self, index: int, future: Future[bytes]) -> Outcome | str:
        """Return what a future holds: an outcome, or in one line how the evaluation failed."""
        try:
            return Outcome(index, *pickle.loads(future.result()))
        except JumpcadError:
            raise
        except Exception as error:  # a bug with a rare design, or whatever an executor raises for a lost worker
            ended_by = re.search(r"SIG[A-Z]+", str(error)) if isinstance(error, BrokenExecutor) else None
            if ended_by and ended_by[0] == "SIGALRM":
                return f"it ran past its limit of {self._limit_s:g} s"
            if ended_by:
                killed = " (killed, perhaps because memory ran out)" if ended_by[0] == "SIGKILL" else ""
                return f"its worker was ended by {ended_by[0]}{killed}"
            return f"{type(error).__name__}: {str(error).split(chr(10))[0]}".removesuffix(": ")


@check_arguments
def local_pool(workers: int | None = None, limit_s: float = 60.0) -> Pool:
    """Return a pool of processes on this machine, by default one for each core that this process may use.

    With 0 workers, designs are evaluated in the calling process, without a timeout.
    """
    workers = cores() if workers is None else workers
    if workers < 0:
        raise JumpcadError(f"workers = {shown(workers)} must be at least 1 (0 evaluates without worker processes)")
    if workers > MOST_WORKERS:
        raise JumpcadError(
            f"workers = {shown(workers)} must be at most {MOST_WORKERS}; more machines take part by Dask"
        )
    _require_limit(limit_s)
    if workers == 0:
        return Pool(InProcess, InProcess.shutdown, 1)

    require_descriptors(workers)
    return Pool(lambda: LocalWorkers(workers), lambda one: one.shutdown(kill_workers=True), workers, limit_s)


@check_arguments
def open_pool(workers: int | None = None, dask: str | None = None, limit_s: float = 60.0) -> Pool:
    """Return a pool of local processes, or on a Dask scheduler; see `local_pool` and `dask_pool`."""
    if dask is not None and workers is not None:
        raise JumpcadError("workers and dask exclude each other: a Dask cluster has its own workers")
    return local_pool(workers, limit_s) if dask is None else dask_pool(dask, limit_s)


def _require_limit(limit_s: float) -> None:
    if not SHORTEST_S <= limit_s <= LONGEST_S:  # also false for NaN
        raise JumpcadError(
            f"limit = {shown(limit_s)} s must be at least {SHORTEST_S:g} and at most {LONGEST_S:g}: "
            "the timeout per evaluation"
        )


@check_arguments
def dask_pool(address: str, limit_s: float = 60.0) -> Pool:
    """Return a pool on the workers of a Dask scheduler (they need one thread each, and this version of jumpcad)."""
    _require_limit(limit_s)
    try:
        distributed: Any = importlib.import_module("distributed")  # its annotations are incomplete
    except ImportError:
        raise JumpcadError("Dask is not installed: pip install 'jumpcad[dask]', or use --workers") from None
    for name in logging.root.manager.loggerDict:
        if name.split(".")[0] in ("distributed", "tornado"):  # what they say of a lost connection is told in one line
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    try:
        if address.startswith("inproc:"):
            raise ValueError("that is within one process")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of other versions: they are looked at below
            # First, because a client with a wrong address prints an error again when it is garbage-collected.
            distributed.comm.resolve_address(address)
            opened: Future[Any] = Future()

            def open_client() -> None:
                try:
                    opened.set_result(distributed.Client(address, timeout=ANSWER_S, set_as_default=False))
                except Exception as error:
                    opened.set_exception(error)

            # Its timeout does not hold where somebody else listens, who says nothing.
            Thread(target=open_client, daemon=True).start()
            client = opened.result(3.0 * ANSWER_S)
    except Exception as error:  # each protocol has its own
        reason = str(error).split("\n")[0] or type(error).__name__
        raise JumpcadError(f"no Dask scheduler answers at {address}: {reason}") from None
    try:
        workers = sum(worker["nthreads"] for worker in client.scheduler_info(n_workers=-1)["workers"].values())
        if workers == 0:
            raise JumpcadError(
                f"the Dask scheduler at {address} has no workers: start some with `dask worker {address}`"
            )
        _require_same_versions(client)
    except BaseException:
        client.close()
        raise

    def lost() -> str:
        try:
            known = client.sync(client.scheduler.identity, n_workers=-1, callback_timeout=ANSWER_S)
        except Exception:  # whatever the connection raises
            return f"the Dask scheduler at {address} answers no more: start it and its workers again, {GO_ON}"
        ended = f"the Dask scheduler at {address} has no workers any more: start some, {GO_ON}"
        return "" if known["workers"] else ended

    def end_executor(executor: Any) -> None:
        if client.status == "running":
            executor.shutdown(wait=False)
        client.close()

    return Pool(lambda: client.get_executor(pure=False), end_executor, workers, limit_s, lost=lost)


def _require_same_versions(client: Any) -> None:
    """Require Python and jumpcad of scheduler and workers, which read what is sent to them, to be those of here."""

    def versions(one: Any) -> str:
        python = dict(one["host"])["python"].split(".")[:2]
        return f"Python {'.'.join(python)} and jumpcad {dict(one['packages'])['jumpcad'] or '(none)'}"

    found = client.get_versions(packages=["jumpcad"])
    own = versions(found["client"])
    for place, other in {"the Dask scheduler": found["scheduler"], **found["workers"]}.items():
        if versions(other) != own:
            raise JumpcadError(f"{place} has {versions(other)}, not {own}: install there what is installed here")


class InProcess(Executor):
    """An executor that does its work in the calling process when it is submitted."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future
