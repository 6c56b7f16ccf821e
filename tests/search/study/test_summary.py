"""What a study file knows of the pick is what the run that wrote it found."""

import contextlib
import shutil
import sqlite3
from dataclasses import replace

import pytest
from support.bumps import REST, Bump, studied

from jumpcad.errors import JumpcadError
from jumpcad.search.space import Space
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import summary
from jumpcad.search.study.trial import best_trial


@pytest.mark.parametrize("top", [0.45, 0.72], ids=["bound below the bump", "constraint beside it"])
def test_candidates_and_bounds_are_those_of_the_run(tmp_path, top):
    space = Space.parse(fix=REST, bound=[f"compression_ratio=0.1:{top}"])
    request = Request(space, Bump(), method="ga", evaluations=120, seed=3)
    with local_pool(0) as pool:
        result = run_study(request, tmp_path / "s.db", pool)
    with StudyStore.read(tmp_path / "s.db") as store:
        found = summary(store)
    assert [one.to_dict() for one in found.candidates] == [one.to_dict() for one in result.candidates]
    assert result.candidates
    assert found.bounds == result.bounds
    assert found.winner is not None
    assert found.winner.key == result.winner.key
    assert [trial.key for trial in found.trials] == [trial.key for trial in result.trials]


def test_a_search_that_goes_on_has_another_pick_and_the_first_one_stays(tmp_path):
    space = Space.parse(fix=REST, bound=["compression_ratio=0.1:0.72"])
    held = []
    with local_pool(0) as pool:
        for evaluations in (40, 60):
            request = Request(space, Bump(), method="ga", evaluations=evaluations, seed=3)
            result = run_study(request, tmp_path / "s.db", pool)
            with StudyStore.read(tmp_path / "s.db") as store:
                found, picked = summary(store), [one for one in store.trials() if one.phase == "robust"]
            assert [one.to_dict() for one in found.candidates] == [one.to_dict() for one in result.candidates]
            held.append(picked)
    assert {one.run for one in held[0]} == {0}
    assert {one.run for one in held[1]} == {0, 1}
    assert held[1][: len(held[0])] == held[0]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Return the study of a search whose winner lies on a bound."""
    path = tmp_path_factory.mktemp("study") / "s.db"
    studied(path, Space.parse(fix=REST, bound=["compression_ratio=0.1:0.4"]), "bo", 40).close()
    return path


def changed(finished, tmp_path, *statements):
    """Return a copy of a study that another program has changed."""
    copy = shutil.copy(finished, tmp_path / "copy.db")
    with contextlib.closing(sqlite3.connect(copy)) as connection, connection:
        for statement in statements:
            assert connection.execute(statement).rowcount > 0
    return copy


def test_what_a_bound_costs_is_the_fall_of_the_bump(finished):
    with StudyStore.read(finished) as store:
        found = summary(store)
    (bound,) = found.bounds
    assert (bound.name, bound.side, bound.value) == ("compression_ratio", "upper", 0.4)
    assert bound.beyond == pytest.approx(0.4 + 0.05 * 0.3)
    at = found.winner.design.compression_ratio
    assert bound.worth == pytest.approx(20.0 * ((0.5 - at) ** 2 - (0.5 - bound.beyond) ** 2), abs=1e-9)


def test_a_pick_that_has_not_ended_or_belongs_to_a_shorter_search_is_none(finished, tmp_path):
    """The winner is the best then, and its bounds are named alone."""
    for change in (
        "UPDATE study SET value = '[{\"designs\": 30, \"evaluations\": 10}]' WHERE key = 'picks'",
        "UPDATE study SET value = replace(value, '\"designs\": 30', '\"designs\": 29') WHERE key = 'picks'",
        "DELETE FROM study WHERE key = 'picks'",
    ):
        with StudyStore.read(changed(finished, tmp_path, change)) as store:
            found = summary(store)
        assert (found.candidates, found.winner) == ([], best_trial(found.trials))
        assert [(bound.name, bound.unknown) for bound in found.bounds] == [("compression_ratio", True)]


def test_scores_that_are_all_alike_have_no_winner(tmp_path):
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "ga", 20) as store:
        found = summary(store)
        assert found.winner is not None
        for value in (0.0, 2.0):
            monotone = [replace(one, score=None if one.score is None else value) for one in store.trials()]
            store.trials = lambda trials=monotone: trials
            assert (summary(store).winner, summary(store).scored) == (None, True)


def test_a_candidate_that_is_none_of_the_trials_is_damage(finished, tmp_path):
    moved = "UPDATE study SET value = replace(value, ': 30', ': 0') WHERE key = 'picks'"
    path = changed(finished, tmp_path, "DELETE FROM trials WHERE phase = 'bo'", moved)
    with StudyStore.read(path) as store, pytest.raises(JumpcadError, match="damaged: a trial at bo 0"):
        summary(store)
