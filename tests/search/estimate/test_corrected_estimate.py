"""The screen of a genetic algorithm: what it leaves out is worse; a search with it is the same however it is run."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.quick import BEST, FIGURES, LIKE, SPACE, Quick, quick

from jumpcad.search.estimate.corrected_estimate import PAIRS, Screen
from jumpcad.search.estimate.estimate import LEAST, Estimate
from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.models import robot_model
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request, Stage
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Variant

LAYOUT = {name: FIGURES[name] for name in LAID}


@pytest.fixture(scope="module", autouse=True)
def no_builds():
    """The robots of `Quick` are like best-printable also where that could not be built."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
        patch.setattr(Quick, "laid_out", lambda *_: LAYOUT)
        patch.setattr(Quick, "refused_first", lambda *_: None)
        yield


def search(path, evaluations=105, workers=0):
    model = quick()
    request = Request(SPACE, model, "body_lengths", "ga", evaluations, screen=True)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(request, store, pool)
        run_genetic(evaluator, Stage(request, "ga", evaluations))
        return [replace(trial, duration_s=0.0) for trial in evaluator.trials]


@pytest.fixture(scope="module")
def trials(tmp_path_factory):
    return search(tmp_path_factory.mktemp("screen") / "whole.db")


def test_what_is_left_out_is_worse_than_the_best_and_no_estimate_is_a_score(trials):
    objective, model = find_objective("body_lengths"), quick()
    left_out = [one for one in trials if one.evaluation.verdict == SCREENED]
    assert len(left_out) > 20
    assert all(one.evaluation.verdict != SCREENED for one in trials[:LEAST])
    assert all(one.score is None for one in left_out)
    best = [max((one.score or 0.0 for one in trials if one.step <= other.step), default=0.0) for other in left_out]
    exact = [objective.score(model(one.design)) or 0.0 for one in left_out]
    assert np.mean(np.array(exact) < 1.0005 * np.array(best)) > 0.95
    assert best_trial(trials).evaluation.verdict == "jump"


@pytest.mark.thorough
def test_a_search_that_was_interrupted_and_a_worker_give_the_same_rows(trials, tmp_path):
    search(tmp_path / "again.db", evaluations=64)
    assert search(tmp_path / "again.db", workers=1) == trials


def screen_of(estimate):
    """Return a screen of a model without solids, with such estimates by the first coordinate of a variant."""
    screen = Screen(SPACE, quick(), find_objective("body_lengths"))

    class Known(SimpleNamespace):
        def __call__(self, variant):
            return estimate(round(float(SPACE.to_unit(variant)[0]), 6))

    screen._estimator = Known(layout=lambda _: LAYOUT, learn=lambda _: None, rough=lambda _: None)
    return screen


def robots(scores):
    """Return robots at places from the middle of the first axis on."""
    for place, score in enumerate(scores):
        point = np.full(SPACE.dimension, 0.5)
        point[0] += 0.04 * place
        yield Trial("ga", 0, place, SPACE.to_design(point), Evaluation("jump", LAYOUT), score, "m", 0.0)


def test_a_score_is_corrected_by_the_robots_beside_it_and_better_known_there():
    """All score about a third more than estimated, one in two a little less; of seven robots no error is told."""
    known = list(robots([4.0 / 3.0 - 0.01 * (place % 2) for place in range(PAIRS)]))
    screen = screen_of(lambda _: Estimate(1.0, {}))
    far = SPACE.to_variant(np.zeros(SPACE.dimension))
    beside, away = (screen._place(one, LAYOUT) for one in (known[3].variant, far))
    screen.learn(known[:-1])
    assert screen._bounds(Estimate(1.0, {}), beside) == (1.0, 0.0, math.inf)
    screen.learn(known)
    score, least, most = screen._bounds(Estimate(1.0, {}), beside)
    assert score == pytest.approx(known[3].score, rel=0.01)
    assert least < known[3].score < most < 1.02 * least
    _, low, high = screen._bounds(Estimate(1.0, {}), away)
    assert math.log(high / low) > 2.0 * math.log(most / least)


def test_of_a_generation_those_are_built_that_may_be_better_than_the_best_and_than_another_s_least(monkeypatch):
    """Scores known to about a tenth: of 1.5 and 1.4 each may be better, 1.1 not; what tips may stand after all."""
    estimates = {0.1: 1.5, 0.2: 1.4, 0.3: 1.1, 0.4: 0.5, 0.5: None, 0.6: None, 0.7: 3.0}
    margins = {0.5: {"tips": -1.0}}
    screen = screen_of(lambda share: Estimate(estimates[share], margins.get(share, {})))
    crowded = SPACE.to_variant(np.full(SPACE.dimension, 0.7))
    screen._estimator.layout = lambda one: Evaluation("cannot_build", detail="why") if one == crowded else LAYOUT
    screen._ratios = SimpleNamespace(predict=lambda _: (np.zeros(1), np.full(1, 0.05)), scatter=0.0)
    monkeypatch.setattr(Quick, "admits", lambda *_: True)
    variants = {share: SPACE.to_variant(np.full(SPACE.dimension, share)) for share in estimates}
    found = screen.outcomes(variants.values(), 1.0)
    shares = {one.key: share for share, one in variants.items()}
    assert {shares[key]: (one.verdict, dict(one.metrics)) for key, one in found.items()} == {
        0.3: (SCREENED, {GUESSED: 1.1}), 0.4: (SCREENED, {GUESSED: 0.5}), 0.6: (SCREENED, {}),
        0.7: ("cannot_build", {}),
    }  # fmt: skip
    monkeypatch.setattr(Quick, "admits", lambda *_: False)
    assert screen.outcomes(variants.values(), 9.0) == {}  # refused at once, with the reason


def test_what_masses_refuse_has_the_outcome_of_its_evaluation():
    """A robot with weak springs, before anything was built."""
    weak = Variant(BEST.model_copy(update={"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2}))
    plain = robot_model()
    found = Screen(Space.default(), plain, find_objective("body_lengths")).outcomes([weak], 0.0)
    assert found == {weak.key: plain(weak.design).bare}
    assert found[weak.key].verdict == "too_weak"


def test_nothing_is_learned_where_too_few_were_built():
    """Of a hundred trials all but some were refused before anything was built, or all failed."""
    jump, stayed = Evaluation("jump", {"body_lengths": 1.0}), Evaluation("no_takeoff", LAYOUT)
    refused = [Trial("ga", 0, place, BEST, jump, 1.0, "m", 0.0) for place in range(100)]
    failed = [Trial("ga", 0, place, BEST, stayed, None, "m", 0.0) for place in range(100)]
    few = [*refused, *(replace(trial, evaluation=Evaluation("jump", LAYOUT)) for trial in refused[: LEAST - 1])]
    for known in (refused, failed, few):
        screen = Screen(SPACE, quick(), find_objective("body_lengths"))
        screen.learn(known)
        assert screen.outcomes([Variant(BEST)], 9.0) == {}
