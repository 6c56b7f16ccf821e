"""Dry runs: what they refuse, what they teach, and that a search with them is the same however it is run."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.kept import once
from support.proposals import with_less_work
from support.quick import LIKE, SPACE, Quick, quick
from support.stages import stage
from support.studies import IDENTITY

from jumpcad.search.estimate.estimate import Estimate
from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.models import robot_model
from jumpcad.search.propose.bayesian import IDLE, STALLED, idle_steps, run_bayesian
from jumpcad.search.propose.dry_run import FAILED, TRIED, DryRun
from jumpcad.search.propose.proposal_loop import ProposalLoop
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.variant import Variant

STAGE = stage(15, 0, initial=10)
WHOLE = Space.default()
HARD = [
    [0.0, 0.57, 0.12, 0.58, 0.9, 1.0, 1.0, 0.08],
    [0.0, 0.53, 0.65, 1.0, 1.0, 1.0, 0.94, 0.0],
    [0.0, 0.57, 0.19, 1.0, 1.0, 0.98, 1.0, 0.35],
    [0.0, 0.51, 0.2, 1.0, 1.0, 1.0, 0.96, 0.36],
    [0.0, 0.51, 0.21, 1.0, 1.0, 1.0, 1.0, 0.39],
]
"""Points with no room for the stop, the legs, the springs or their pin."""


@pytest.fixture(scope="module", autouse=True)
def no_builds():
    """The robots of `Quick` are like best-printable also where that could not be built.

    What lies where in one is found once: it is half of the time of a search, and follows from the variant.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
        patch.setattr(Quick, "laid_out", once({}, Quick.laid_out, lambda _, variant: variant.key), raising=False)
        with_less_work(patch)
        patch.setattr("jumpcad.search.propose.proposal_loop.HELD", 2)
        yield


def search(path, asked=STAGE, workers=0):
    model = quick()
    request = Request(SPACE, model, "body_lengths", "bo", asked.evaluations)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(request, store, pool)
        run_bayesian(evaluator, asked)
        return [replace(trial, duration_s=0.0) for trial in evaluator.trials]


@pytest.fixture(scope="module")
def trials(tmp_path_factory):
    return search(tmp_path_factory.mktemp("dry_run") / "whole.db")


def dry_run_of(model=None, space=SPACE, phase="bo", asked=STAGE, prior=()):
    model = model or quick()
    request = Request(space, model, "fitness", "bo", 20)
    store, pool = StudyStore.write(None, IDENTITY), local_pool(0)
    return DryRun(Evaluator(request, store, pool, prior), phase, asked.request.seed, asked.run)


@pytest.mark.thorough
def test_a_search_that_ended_early_and_more_cores_give_the_same_rows(trials, tmp_path, monkeypatch):
    path = tmp_path / "again.db"
    search(path, replace(STAGE, evaluations=12))
    assert search(path, workers=2) == trials  # dry runs are shared too
    longer = replace(STAGE, evaluations=18)  # which looks near the best and far from all robots in turn
    monkeypatch.setattr("jumpcad.search.propose.bayesian.STALLED", 0)
    monkeypatch.setattr("jumpcad.search.propose.proposal_loop.WITHIN", (1.0, 1.0))
    whole = search(tmp_path / "beside.db", longer)
    search(tmp_path / "cut.db", replace(longer, evaluations=14))
    assert search(tmp_path / "cut.db", longer) == whole


@pytest.mark.thorough
def test_a_search_with_estimates_ends_after_so_many_steps_in_a_row_without_a_gain(tmp_path, monkeypatch):
    """After four of them it looks beside the best and on other hills in turn."""
    idle, beside, longer = {False: [], True: []}, ProposalLoop.beside, replace(STAGE, evaluations=60, least_gain=0.2)

    def counted(loop, trials, *others, far):
        idle[far].append(idle_steps(trials, 0.0, 0.2))
        return beside(loop, trials, *others, far=far)

    monkeypatch.setattr(ProposalLoop, "beside", counted)
    trials = search(tmp_path / "end.db", longer)
    assert len(trials) < 60
    assert idle_steps(trials, 0.0, 0.2) == IDLE
    assert sorted(set(idle[False])) == list(range(STALLED, IDLE, 2))
    assert set(idle[True]) >= set(range(STALLED + 1, IDLE, 2))
    assert search(tmp_path / "end.db", longer) == trials


def test_what_was_tried_is_kept_and_the_proposals_have_short_numbers(trials):
    tried = [point for trial in trials for point in trial.proposal.get(TRIED, ())]
    assert tried
    assert all(number == round(number, 4) for point in tried for number in point)
    for trial in trials[STAGE.initial :]:
        unit = SPACE.to_unit(trial.variant)
        assert unit == pytest.approx(np.round(unit, 4), abs=1e-9)


def test_a_design_is_refused_as_its_evaluation_refuses_it():
    model, refused = robot_model(), 0
    for point in HARD:
        variant = WHOLE.to_variant(point)
        outcome = model.laid_out(variant) if model.admits(variant.design) else None
        if isinstance(outcome, Evaluation):
            exact = model(variant.design)
            assert (outcome.verdict, outcome.reasons) == (exact.verdict, exact.reasons)
            assert [one.margin for one in outcome.findings] == [one.margin for one in exact.findings]
            refused += 1
    assert refused >= 4


def test_the_room_is_that_of_the_variants_workshop():
    model, design = robot_model(), LIKE.design
    assert set(model.laid_out(Variant(design, {"bought.axle_mm": 3.0}))) == set(LAID)
    assert model.laid_out(Variant(design, {"body.plate_mm": -1.0})).verdict == "workshop"


def test_what_fails_is_learned_as_a_trial_and_estimates_follow_the_robots_that_were_built(trials):
    dry_run = dry_run_of()
    assert dry_run.estimates(trials, []) == {}  # nothing was fitted yet
    dry_run.learn(trials)
    known = dry_run.estimates(trials, [])
    jumped = [trial for trial in trials if trial.score is not None]
    errors = [known[trial.key][1] / trial.evaluation.metrics["fitness"] - 1.0 for trial in jumped if trial.key in known]
    assert len(errors) > len(jumped) / 2
    assert np.median(np.abs(errors)) < 0.1
    tried = [SPACE.to_variant(point) for trial in trials for point in trial.proposal.get(TRIED, ())]
    failures = dry_run.failures(trials, [])
    assert len(failures) == min(sum(dry_run.failure(one) is not None for one in tried), FAILED)
    assert all(trial.score is None and not trial.evaluation.feasible for trial in failures)
    for other in (dry_run_of(phase="pareto"), dry_run_of(asked=replace(STAGE, run=1)), dry_run_of(prior=trials)):
        other.learn(trials)  # what other searches tried is not looked at
        assert len(other.estimates(trials, [])) < len(known)
        assert other.failures(trials, []) == []


def test_a_start_that_has_no_room_is_passed_over_and_learned():
    model = robot_model()
    dry_run = dry_run_of(model, WHOLE)
    variants = [WHOLE.to_variant(point) for point in HARD]
    refused = [one for one in variants if model.admits(one.design) and not dry_run.starts_with(one)]
    assert [trial.key for trial in dry_run.failures([], [])] == [one.key for one in refused]
    assert len(refused) >= 4


def test_what_was_refused_for_any_trial_is_not_proposed_again_also_after_a_restart(trials):
    model = robot_model()
    points = [WHOLE.to_variant(point) for point in HARD]
    hard = next(one for one in points if model.admits(one.design))
    note = {TRIED: [WHOLE.to_unit(hard).tolist(), [0.5] * (WHOLE.dimension + 1)]}  # the second of another space
    restarted = dry_run_of(model, WHOLE)
    assert not restarted.estimator.refuses(hard)
    restarted.learn([replace(trials[-1], step=1, proposal=note)])
    assert restarted.estimator.refuses(hard)


class Known(SimpleNamespace):
    """An estimator by which what is in `grounded` stays there, and every other scores 1."""

    def __call__(self, variant):
        return Estimate(None, {"tips": -3.0, "too_weak": 0.2}) if variant in self.grounded else Estimate(1.0, {})


def test_what_had_room_but_would_not_jump_is_a_failure_too_with_its_margins():
    """Of three points that were tried, one is refused, one is estimated to stay on the ground, and one holds."""
    points = [np.full(SPACE.dimension, share) for share in (0.1, 0.5, 0.9)]
    refused, grounded, holds = (SPACE.to_variant(point) for point in points)
    dry_run = dry_run_of()
    dry_run.estimator = Known(
        grounded=[grounded],
        layout=lambda one: Evaluation("no_room", detail="why") if one == refused else {},
        ready=True,
    )
    first, second = dry_run.failures([], points)
    assert (first.variant, first.evaluation.verdict, first.score) == (refused, "no_room", None)
    assert (second.variant, second.evaluation.reasons, second.score) == (grounded, ("tips",), None)
    assert second.evaluation.margins == {"tips": -3.0, "too_weak": 0.2}
    dry_run.ranked = []
    assert list(dry_run.estimates([], points)) == [holds.key]
