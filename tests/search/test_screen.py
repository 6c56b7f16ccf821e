"""The screen: what it guesses, and that a search with it is the same however it is run."""

import math
from dataclasses import replace
from operator import attrgetter
from types import SimpleNamespace

import numpy as np
import pytest
from support.quick import BEST, FIGURES, LIKE, SPACE, quick
from threadpoolctl import threadpool_info, threadpool_limits

from jumpcad.errors import JumpcadError
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.guess import Fit, Guess
from jumpcad.search.methods import Task
from jumpcad.search.methods.genetic import run_genetic
from jumpcad.search.models import robot_model
from jumpcad.search.objective import SCREENED, Evaluation, find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.screen import LEAST, Screen
from jumpcad.search.stand_in import stand_in
from jumpcad.search.store import StudyStore
from jumpcad.search.trial import Trial, best_trial
from jumpcad.simulation import simulate


@pytest.fixture(scope="module")
def model():
    return quick()


def search(model, path, evaluations=125, workers=0):
    request = Request(SPACE, model, "body_lengths", "ga", evaluations, screen=True)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(SPACE, request.aim, model, store, pool)
        run_genetic(evaluator, Task(evaluations, 0, screen=True))
        return evaluator.trials


@pytest.fixture(scope="module", autouse=True)
def no_builds():
    """The robots of `Quick` are like best-printable also where that could not be built."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jumpcad.search.guess.build", lambda *_: LIKE)
        yield


@pytest.fixture(scope="module")
def trials(model, tmp_path_factory):
    return search(model, tmp_path_factory.mktemp("screen") / "whole.db")


def test_a_robot_stands_in_for_itself():
    other = stand_in(BEST, FIGURES, LIKE)
    exact, found = simulate(LIKE), simulate(other)
    assert found.ballistic_range_m == pytest.approx(exact.ballistic_range_m, rel=2e-3)  # left and right alike
    assert [one.margin for one in found.findings[:4]] == pytest.approx([one.margin for one in exact.findings[:4]])
    for name, body in other.bodies.items():
        like = LIKE.bodies[name]
        assert body.mass_kg == pytest.approx(like.mass_kg, rel=1e-5)
        assert body.com_m[[0, 2]] == pytest.approx(like.com_m[[0, 2]], rel=1e-5)
        assert body.inertia_kg_m2[1, 1] == pytest.approx(like.inertia_kg_m2[1, 1], rel=1e-5)
        assert [one.radius_m for one in body.contacts] == pytest.approx([one.radius_m for one in like.contacts])
    same = "stop.angle_rad", "stop.stiffness_nm_per_rad", "roller_off.leg_rad", "roller_off.leg_rad_s", "foot_depth_m"
    assert attrgetter(*same)(other) == pytest.approx(attrgetter(*same)(LIKE), rel=1e-4)


def test_a_guess_is_as_good_as_its_error_says_and_what_is_left_out_is_worse_than_the_best(model, trials):
    objective = find_objective("body_lengths")
    screen = Screen(SPACE, model, objective)
    assert screen.learn(trials[:80])
    assert not screen.learn(trials[:85])  # renewed after some more that were built
    error = screen.fit.errors["score"]
    assert math.isfinite(error)
    fresh = trials[80:]
    best = max(one.score or 0.0 for one in trials[:80])
    exact = np.array([objective.score(model(one.design)) or 0.0 for one in fresh])
    guesses = [screen.guess(one.variant) for one in fresh]
    guessed = np.array([guess.score or 0.0 for guess in guesses])
    left_out = np.array([screen.leaves_out(guess, best) for guess in guesses])
    assert np.mean(exact - guessed <= 2.0 * error) > 0.9  # the search moves on between two fits
    assert left_out.sum() > 10
    assert np.mean(exact[left_out] < best) > 0.95


def test_it_is_fitted_in_one_thread(model, trials, monkeypatch):
    seen = []

    def fitted(self, known, best):
        seen.extend(pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas")
        return Fit(0, {}, {})

    monkeypatch.setattr(Screen, "_fitted", fitted)
    with threadpool_limits(2):
        Screen(SPACE, model, find_objective("body_lengths")).learn(trials[:80])
    assert seen
    assert set(seen) == {1}


def test_nothing_is_left_out_before_enough_is_known_and_no_guess_is_a_score(trials):
    left_out = [one for one in trials if one.evaluation.verdict == SCREENED]
    assert len(left_out) > 20
    assert all(one.evaluation.verdict != SCREENED for one in trials[:LEAST])
    assert all(one.score is None for one in left_out)
    assert all(one.duration_s == 0.0 for one in left_out)
    assert best_trial(trials).evaluation.verdict == "jump"


def test_a_search_that_ended_early_and_a_worker_give_the_same_rows(model, trials, tmp_path):
    path = tmp_path / "again.db"
    search(model, path, evaluations=84)
    again = search(model, path, workers=1)
    assert [replace(one, duration_s=0.0) for one in again] == [replace(one, duration_s=0.0) for one in trials]


@pytest.mark.parametrize(
    ("name", "method", "objective"), [("printed", "bo", None), ("capsule", "ga", None), ("printed", "ga", "p10")]
)
def test_where_it_does_not_apply_it_is_refused(name, method, objective):
    with pytest.raises(JumpcadError, match="screen: "):
        Request.make(SPACE, robot_model(name), method, objective, screen=True)


@pytest.mark.parametrize(
    ("score", "margin", "left_out"),
    [
        (1.0, 0.0, False),
        (0.89, 0.0, True),
        (0.91, 0.0, False),
        (None, 0.0, True),
        (2.0, -0.21, True),
        (2.0, -0.19, False),
    ],
)
def test_a_guess_is_left_out_if_it_is_worse_by_more_than_its_error(
    score: float | None, margin: float, left_out: bool
) -> None:
    """Score within 0.1 of the best, 1.0; a margin known to 0.2, and one of unknown error, which decides nothing."""
    screen = Screen.__new__(Screen)
    screen.fit = SimpleNamespace(errors={"score": 0.1, "reach": 0.2})  # type: ignore[assignment]
    assert screen.leaves_out(Guess(score, {"reach": margin, "unknown": -9.0}), 1.0) is left_out


def test_nothing_is_learned_where_too_few_were_built(model):
    """Of a hundred trials all but some were refused before anything was built, or all failed."""
    screen = Screen(SPACE, model, find_objective("body_lengths"))
    few = [
        Trial(
            "ga", 0, place, BEST, Evaluation("jump", {"body_lengths": 1.0}), 1.0 if place < jumped else None, "m", 0.0
        )
        for jumped in (0, 20)
        for place in range(100)
    ]
    for trials in (few[:79], few[:100], few[100:]):
        assert screen.learn(trials) is False
        assert screen.fit is None
        assert screen.guess(few[0].variant) is None
