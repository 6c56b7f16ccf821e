"""The screen: what it guesses, and that a search with it is the same however it is run."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.methods import Task
from jumpcad.search.methods.genetic import run_genetic
from jumpcad.search.models import RobotModel, robot_model
from jumpcad.search.objective import SCREENED, Evaluation, find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.screen import LEAST, Guess, Screen, features
from jumpcad.search.space import Space
from jumpcad.search.stand_in import figures_of, stand_in
from jumpcad.search.store import StudyStore
from jumpcad.search.trial import best_trial
from jumpcad.simulation import simulate

BEST = load_design("best-printable")
SPACE = Space.make(around=BEST, within_percent=15.0)
LIKE = build(BEST)
FIGURES = figures_of(LIKE) | {f"{name}_mass_kg": body.mass_kg for name, body in LIKE.bodies.items()}


class Quick(RobotModel):
    """Robots of which all is known: masses grow with the main leg and the springs, the rest is best-printable's."""

    quick_score = None  # its first designs are spread

    def __call__(self, design, workshop=None):
        larger = design.carrying_link_mm / BEST.carrying_link_mm
        heavier = larger * (1.0 + 0.002 * design.stiffness_nmm_per_deg * larger)
        figures = {name: value * (heavier if "mass" in name else 1.0) for name, value in FIGURES.items()}
        jump = simulate(stand_in(design, figures, LIKE), self.settings, "pybullet")
        found = {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
        size = max(0.1, design.l_max_mm / 1000.0)
        metrics = figures | found | {"size_m": size, "body_lengths": (jump.ballistic_range_m or 0.0) / size}
        return Evaluation(jump.verdict, metrics, jump.findings)


@pytest.fixture(scope="module")
def model():
    plain = robot_model(settings="default")
    return Quick("printed", plain.workshop, plain.settings, "pybullet", screened=True)


def search(model, path, evaluations=115, workers=0):
    request = Request(SPACE, model, "body_lengths", "ga", evaluations, screen=True)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(SPACE, request.aim, model, store, pool)
        run_genetic(evaluator, Task(evaluations, 0, screen=True))
        return evaluator.trials


@pytest.fixture(scope="module", autouse=True)
def no_builds():
    """The robots of `Quick` are like best-printable also where that could not be built."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jumpcad.search.screen.build", lambda *_: LIKE)
        yield


@pytest.fixture(scope="module")
def trials(model, tmp_path_factory):
    return search(model, tmp_path_factory.mktemp("screen") / "whole.db")


def test_a_robot_stands_in_for_itself():
    other = stand_in(BEST, FIGURES, LIKE)
    exact, found = simulate(LIKE), simulate(other)
    assert found.ballistic_range_m == pytest.approx(exact.ballistic_range_m, rel=2e-3)  # left and right alike
    assert [one.margin for one in found.findings[:4]] == pytest.approx([one.margin for one in exact.findings[:4]])


def test_features_are_all_products():
    row = features(np.array([[1.0, 0.75]]))[0]
    assert row.tolist() == [1.0, 1.0, 0.5, 1.0, 0.5, 0.25]


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


def test_nothing_is_left_out_before_enough_is_known_and_no_guess_is_a_score(trials):
    left_out = [one for one in trials if one.evaluation.verdict == SCREENED]
    assert len(left_out) > 20
    assert all(one.evaluation.verdict != SCREENED for one in trials[:LEAST])
    assert all(one.score is None for one in left_out)
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
