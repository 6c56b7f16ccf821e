"""Evaluators of hills."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.hills import SMALL, Hill
from support.proposals import with_less_work

from jumpcad.search.evaluator import Evaluator
from jumpcad.search.objective import find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.store import StudyStore


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


@pytest.fixture
def evaluator():
    """Return a function that makes an evaluator that computes in this process; all are closed at the end."""
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
        return Evaluator(space, find_objective("fitness"), model or Hill(), store, pool or local_pool(0), prior)

    yield make
    for store in stores:
        store.close()
