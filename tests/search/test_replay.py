"""What a study file knows of the pick is what the run that wrote it found."""

import sqlite3
from dataclasses import asdict, replace
from types import SimpleNamespace

import pytest
from support.bumps import REST, Bump, studied
from support.studies import IDENTITY, trials

from jumpcad.search import replay
from jumpcad.search.fronts import SPRING_ENERGY, front
from jumpcad.search.pick.tolerances import Making
from jumpcad.search.pool import local_pool
from jumpcad.search.replay import _share, known
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore
from jumpcad.search.study import run_study
from jumpcad.search.trial import feasible_trials, trial_numbers


def test_bounds_are_those_of_the_winner_where_it_is_not_the_best(tmp_path, monkeypatch):
    asked, found = [], feasible_trials(trials(24))
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append(trials(24))
    monkeypatch.setattr(replay, "_share", lambda *_: 8)
    monkeypatch.setattr(replay, "rank_candidates", lambda *_: [SimpleNamespace(trial=found[1])])
    monkeypatch.setattr(replay, "active_bounds", lambda _, trial, step: asked.append((trial, step)) or [])
    with StudyStore.read(tmp_path / "s.db") as store:
        assert known(store).winner == found[1] != found[0]
    assert asked == [(found[1], 0)]


@pytest.mark.parametrize(
    ("change", "making"),
    [
        ({}, Making(0.0)), ({"tolerance_mm": 0.3}, Making(0.3)),
        ({"making": asdict(Making(0.4, 0.05, 0.04, 0.15, True)), "method": "nsga2", "seed": 9},
         Making(0.4, 0.05, 0.04, 0.15, True)),
    ],
)  # fmt: skip
def test_a_pick_is_ranked_again_with_all_that_its_run_had(monkeypatch, change, making):
    """Tolerances, of which the first studies had one; the seed; of a front, its designs alone may be candidates.

    Trials have the numbers that they have in the study, those around the best too.
    """
    asked, held = [], [*trials(24), *trials(2, "robust", 8 * (201 * 24 + 57))]
    monkeypatch.setattr(replay, "rank_candidates", lambda *given: asked.append(given[1:]) or [])
    with StudyStore.write(None, IDENTITY | change) as store:
        store.append(held)
        found = known(store)
    among = front(held[:24], SPRING_ENERGY) if "method" in change else None
    assert asked == [(held[:24], change.get("seed", 1), making, 57, among)]
    assert found.trials == held[:24]
    assert found.numbers == trial_numbers(held)


def test_a_step_has_the_trials_that_the_study_holds_of_it():
    """Also where they are fewer than were asked for: the run was stopped there."""
    held = [*trials(2, "margin", 5), *trials(4, "margin", 6)[2:], *trials(6, "robust", 5)[4:]]
    with StudyStore.write(None, IDENTITY) as store:
        store.append(held)
        replayed = replay.Replay(store)
    assert replayed.finished("margin", 5, 3) == held[:2]
    assert replayed.finished("margin", 6, 2) == held[2:4]
    assert replayed.finished("margin", 7, 3) == []


@pytest.mark.parametrize("top", [0.45, 0.72], ids=["bound below the bump", "constraint beside it"])
def test_candidates_and_bounds_are_those_of_the_run(tmp_path, top):
    space = Space.parse(fix=REST, bound=[f"compression_ratio=0.1:{top}"])
    request = Request(space, Bump(), method="ga", evaluations=120, seed=3)
    with local_pool(0) as pool:
        result = run_study(request, tmp_path / "s.db", pool)
    with StudyStore.read(tmp_path / "s.db") as store:
        found = known(store)
    assert [one.to_dict() for one in found.candidates] == [one.to_dict() for one in result.candidates]
    assert result.candidates
    assert found.bounds == result.bounds
    assert found.winner is not None
    assert found.winner.key == result.winner.key
    assert [trial.key for trial in found.trials] == [trial.key for trial in result.trials]


def test_what_a_bound_costs_is_the_fall_of_the_bump(tmp_path):
    space = Space.parse(fix=REST, bound=["compression_ratio=0.1:0.4"])
    with studied(tmp_path / "s.db", space, "bo", 40) as store:
        found = known(store)
    (bound,) = found.bounds
    assert (bound.name, bound.side, bound.value) == ("compression_ratio", "upper", 0.4)
    assert bound.beyond == pytest.approx(0.4 + 0.05 * 0.3)
    at = found.winner.design.compression_ratio
    assert bound.worth == pytest.approx(20.0 * ((0.5 - at) ** 2 - (0.5 - bound.beyond) ** 2), abs=1e-9)


def test_a_study_that_was_stopped_in_its_pick_says_what_it_has(tmp_path):
    space = Space.parse(fix=REST, bound=["compression_ratio=0.1:0.4"])
    with studied(tmp_path / "s.db", space, "bo", 40) as store:
        whole = sum(one.neighbours for one in known(store).candidates)
    connection = sqlite3.connect(tmp_path / "s.db")
    connection.execute("DELETE FROM evaluations WHERE phase = 'bounds' OR (phase = 'robust' AND place % 2 = 1)")
    connection.commit()
    connection.close()
    with StudyStore.read(tmp_path / "s.db") as store:
        found = known(store)
    assert 0 < sum(one.neighbours for one in found.candidates) < whole
    assert [bound.worth for bound in found.bounds] == [None]


def test_the_share_of_a_pick_follows_from_the_step_that_it_wrote_last():
    """Steps of a pick are eight for each number of designs and of evaluations; without a pick there is no share."""
    (trial,) = trials(1)
    assert _share([], 10) == 0
    assert _share([trial], 10) == 0
    for proposed, share in ((10, 1), (10, 57), (120, 200)):
        step = 8 * (201 * proposed + share)
        picked = replace(trial, phase="robust", step=step)
        assert _share([trial, picked], proposed) == share
        assert _share([trial, picked], proposed + 1) == 0  # it belongs to a search that has gone on
