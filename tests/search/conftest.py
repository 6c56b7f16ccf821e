"""Evaluators of hills."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from support.hills import SMALL, Hill
from support.proposals import with_less_work

from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore


@pytest.fixture(scope="module")
def quick_proposals() -> Iterator[None]:
    """Let proposals be made with less work in a module's tests."""
    with pytest.MonkeyPatch.context() as patch:
        with_less_work(patch)
        yield


@pytest.fixture
def quick_proposals_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let proposals be made with less work in one test."""
    with_less_work(monkeypatch)


@contextmanager
def _evaluators() -> Iterator[Callable[..., Evaluator]]:
    stores = []

    def make(path: Path | None = None, model=None, space=SMALL, prior=(), pool=None) -> Evaluator:
        study = {
            "model": {"name": "hill"},
            "objective": "fitness",
            "method": "ga",
            "seed": 0,
            "space": space.describe(),
        }
        store = StudyStore.write(path, study)
        stores.append(store)
        return Evaluator(Request(space, model or Hill()), store, pool or local_pool(0), prior)

    yield make
    for store in stores:
        store.close()


@pytest.fixture
def evaluator() -> Iterator[Callable[..., Evaluator]]:
    """Return a function that makes an evaluator that computes in this process; all are closed at the end."""
    with _evaluators() as make:
        yield make


@pytest.fixture(scope="module")
def kept_evaluator() -> Iterator[Callable[..., Evaluator]]:
    """Return such a function for searches that several tests of a module look at."""
    with _evaluators() as make:
        yield make
