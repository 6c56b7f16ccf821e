"""Rehearsals: what they refuse, what they teach, and that a search with them is the same however it is run."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.kept import once
from support.proposals import with_less_work
from support.quick import LIKE, SPACE, Quick, quick

from jumpcad.design import load_design
from jumpcad.findings import Finding
from jumpcad.search.estimate.estimate import Guess, Guesser
from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.estimate.fitting import MARK, Table
from jumpcad.search.models import robot_model
from jumpcad.search.propose.bayesian import IDLE, run_bayesian
from jumpcad.search.propose.dry_run import FAILED, GUESSED, TRIED, Rehearsal, _stayed
from jumpcad.search.propose.local_search import STALLED, Progress
from jumpcad.search.propose.proposal_loop import Learner
from jumpcad.search.propose.task import Task
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Variant
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop

TASK = Task(15, 0, initial=10)
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
        patch.setattr("jumpcad.search.propose.initial_designs.SCREENED", 64)
        yield


def search(path, task=TASK, workers=0):
    model = quick()
    request = Request(SPACE, model, "body_lengths", "bo", task.evaluations)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(SPACE, request.aim, model, store, pool)
        run_bayesian(evaluator, task)
        return [replace(trial, duration_s=0.0) for trial in evaluator.trials]


@pytest.fixture(scope="module")
def trials(tmp_path_factory):
    return search(tmp_path_factory.mktemp("rehearsal") / "whole.db")


@pytest.mark.thorough
def test_a_search_that_ended_early_and_a_worker_give_the_same_rows(trials, tmp_path):
    path = tmp_path / "again.db"
    search(path, replace(TASK, evaluations=12))
    assert search(path, workers=1) == trials


def test_what_was_tried_is_kept_and_the_proposals_have_short_numbers(trials):
    tried = [point for trial in trials for point in trial.proposal.get(TRIED, ())]
    assert tried
    assert all(number == round(number, 4) for point in tried for number in point)
    for trial in trials[TASK.initial :]:
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


def rehearsal_of(model=None, space=SPACE, phase="bo", task=TASK):
    model = model or quick()
    request = Request(space, model, "body_lengths", "bo", 20)
    return Rehearsal.of(Evaluator(space, request.aim, model, StudyStore.write(None, {}), local_pool(0)), phase, task)


def test_only_printed_robots_are_rehearsed():
    model = robot_model("capsule")
    request = Request(SPACE, model, "fitness", "bo", 20)
    with StudyStore.write(None, {}) as store, local_pool(0) as pool:
        assert Rehearsal.of(Evaluator(SPACE, request.aim, model, store, pool), "bo", TASK) is None


@pytest.fixture(scope="module")
def learned(trials):
    """Return a rehearsal of the same search that has learned from its trials."""
    rehearsal = rehearsal_of()
    assert rehearsal.guesses(trials, []) == {}  # nothing was fitted yet
    rehearsal.learn(trials)
    return rehearsal


def test_what_fails_is_learned_as_a_trial_and_guesses_follow_the_robots_that_were_built(trials, learned):
    rehearsal = learned
    tried = [np.array(point) for trial in trials for point in trial.proposal.get(TRIED, ())]
    known = rehearsal.guesses(trials, [])
    jumped = [trial for trial in trials if trial.score is not None]
    errors = [known[trial.key][1] / trial.score - 1.0 for trial in jumped if trial.key in known]
    assert len(errors) > len(jumped) / 2
    assert np.median(np.abs(errors)) < 0.1
    failures = list(rehearsal.failures(trials, []))
    held = [rehearsal.holds(SPACE.to_variant(point)) for point in tried]
    assert len(failures) == min(held.count(False), FAILED)
    assert all(trial.score is None and not trial.evaluation.feasible for trial in failures)


def test_figures_are_fitted_around_the_best_robot(trials, monkeypatch):
    seen = []

    class Noted(Table):
        def __init__(self, space, known, centre, laid=False):
            seen.append((known, centre.tolist()))
            super().__init__(space, known, centre, laid)

    monkeypatch.setattr("jumpcad.search.propose.dry_run.Table", Noted)
    rehearsal_of().learn(trials)
    ((known, centre),) = seen
    best = max((trial for trial in known if trial.score is not None), key=lambda trial: trial.score)
    assert centre == SPACE.to_unit(best.variant).tolist()
    assert best is not known[0]


def test_what_other_searches_tried_is_not_looked_at(trials, learned):
    for other in (rehearsal_of(phase="pareto"), rehearsal_of(task=replace(TASK, run=1))):
        other.learn(trials)
        assert len(other.guesses(trials, [])) < len(learned.guesses(trials, []))


def test_what_a_prior_study_tried_is_not_tried_again(trials):
    model = quick()
    request = Request(SPACE, model, "body_lengths", "bo", 20)
    later = Rehearsal.of(
        Evaluator(SPACE, request.aim, model, StudyStore.write(None, {}), local_pool(0), trials), "bo", TASK
    )
    assert rehearsal_of().failures(trials, [])
    assert later.failures(trials, []) == []


def test_figures_follow_all_robots_also_where_the_processes_learn_from_few(monkeypatch, tmp_path):
    counts = {"figures": [], "processes": []}
    learn, init = Rehearsal.learn, Learner.__init__

    def counted(kind, count, function):
        def call(self, *arguments):
            counts[kind].append(count(arguments))
            return function(self, *arguments)

        return call

    monkeypatch.setattr(Rehearsal, "learn", counted("figures", lambda given: len(given[0]), learn))
    monkeypatch.setattr(Learner, "__init__", counted("processes", lambda given: len(given[1]), init))
    monkeypatch.setattr("jumpcad.search.propose.bayesian.learned_trials", lambda _space, trials: trials[:11])
    search(tmp_path / "few.db", replace(TASK, evaluations=13))
    steps = [*range(counts["figures"][0], 13)]
    assert 3 <= len(steps) <= 4  # after the start
    assert counts == {"figures": steps, "processes": [min(known, 11) for known in steps]}


def test_a_start_that_has_no_room_is_passed_over_and_learned():
    model = robot_model()
    rehearsal = rehearsal_of(model, WHOLE)
    variants = [WHOLE.to_variant(point) for point in HARD]
    refused = [one for one in variants if model.admits(one.design) and not rehearsal.starts_with(one)]
    assert [trial.key for trial in rehearsal.failures([], [])] == [one.key for one in refused]
    assert len(refused) >= 4


def test_what_had_room_but_would_not_jump_is_a_failure_too(monkeypatch):
    """Of three points that were tried, one is refused, one is guessed to stay on the ground, and one holds."""
    rehearsal = Rehearsal.__new__(Rehearsal)
    vars(rehearsal).update(_space=SPACE, _phase="bo", _task=TASK, _prior=set(), _passed_over={}, _laid={}, _variants={})
    points = [np.full(SPACE.dimension, share) for share in (0.1, 0.5, 0.9)]
    refused, grounded, _ = (SPACE.to_variant(point).key for point in points)
    outcome = {refused: Evaluation("no_room")}
    monkeypatch.setattr(Rehearsal, "_guess", lambda _, one: Guess(None if one.key == grounded else 1.0, {}))
    vars(rehearsal)["_model"] = SimpleNamespace(laid_out=lambda one: outcome.get(one.key, {}))
    found = rehearsal.failures([], points)
    assert [(one.key, one.evaluation.verdict, one.score) for one in found] == [
        (refused, "no_room", None), (grounded, "no_takeoff", None),
    ]  # fmt: skip


def test_what_stands_too_badly_is_learned_with_its_margins(monkeypatch):
    rehearsal = Rehearsal.__new__(Rehearsal)
    vars(rehearsal).update(_space=SPACE, _phase="bo", _task=TASK, _prior=set(), _passed_over={}, _laid={}, _variants={})
    monkeypatch.setattr(Rehearsal, "_guess", lambda *_: Guess(None, {"tips": -3.0, "too_weak": 0.2, "stop_room": 1.0}))
    vars(rehearsal)["_model"] = SimpleNamespace(laid_out=lambda one: {})
    (found,) = rehearsal.failures([], [np.full(SPACE.dimension, 0.5)])
    assert found.evaluation.reasons == ("tips",)
    assert found.evaluation.margins == {"tips": -3.0, "too_weak": 0.2}


def test_guesses_take_the_planar_engine_with_long_steps_where_it_has_what_the_settings_ask_for():
    model = robot_model()
    assert (model.guess_engine, model.guess_settings.dt_s) == ("planar", 0.002)
    slow = replace(model, settings=model.settings.model_copy(update={"dt_s": 0.004, "restitution": 0.1}))
    assert (slow.guess_engine, slow.guess_settings.dt_s) == (slow.engine, 0.004)
    jump = simulate(LIKE)
    quick_jump = simulate(LIKE, model.guess_settings, model.guess_engine)
    assert quick_jump.ballistic_range_m == pytest.approx(jump.ballistic_range_m, rel=0.02)


def test_the_first_guesses_follow_from_the_seed_of_the_search(monkeypatch):
    monkeypatch.setattr(
        "jumpcad.search.propose.dry_run.ranked_points", lambda _, generator: generator.random(3).tolist()
    )
    with local_pool(0) as pool, StudyStore.write(None, {"space": SPACE.describe()}) as store:
        evaluator = Evaluator(SPACE, find_objective("body_lengths"), quick(), store, pool)
        one, again, other = (Rehearsal(evaluator, "bo", Task(9, seed)).ranked for seed in (0, 0, 1))
    assert one == again != other


def test_guesses_are_of_the_objective_of_the_search(monkeypatch):
    asked = []
    monkeypatch.setattr(Guesser, "quick", lambda *given: asked.append(given))
    monkeypatch.setattr("jumpcad.search.propose.dry_run.ranked_points", lambda *_: [])
    monkeypatch.setattr("jumpcad.search.propose.dry_run.Table", lambda *_, **__: SimpleNamespace(coefficients=dict))
    aim, model = find_objective("rise"), quick()
    design = SPACE.to_design(np.full(SPACE.dimension, 0.5))
    trials = [Trial("bo", 0, place, design, Evaluation("jump", {MARK: 1.0}), 1.0, "m", 0.0) for place in range(8)]
    with local_pool(0) as pool, StudyStore.write(None, {"space": SPACE.describe()}) as store:
        Rehearsal(Evaluator(SPACE, aim, model, store, pool), "bo", Task(9, 0)).learn(trials)
    assert asked == [(SPACE, model, aim, trials[0])]


def test_what_was_refused_for_any_trial_is_not_proposed_again_also_after_a_restart(trials):
    """Whatever of the trials the processes learn from."""
    model = robot_model()
    points = [WHOLE.to_variant(point) for point in HARD]
    hard = next(one for one in points if model.admits(one.design))
    note = {TRIED: [WHOLE.to_unit(hard).tolist()]}
    restarted = rehearsal_of(model, WHOLE)
    assert not restarted.is_refused(hard)
    restarted.learn([replace(trials[-1], step=1, proposal=note)])
    assert restarted.is_refused(hard)


@pytest.mark.thorough
def test_a_search_with_guesses_ends_after_so_many_steps_in_a_row_without_a_gain(tmp_path, monkeypatch):
    """After four of them it looks beside the best."""
    idle, beside, task = [], Learner.beside, replace(TASK, evaluations=60, least_gain=0.2)

    def counted(learner, trials, *others):
        idle.append(Progress.of(trials, 0.0, 0.2).idle)
        return beside(learner, trials, *others)

    monkeypatch.setattr(Learner, "beside", counted)
    trials = search(tmp_path / "end.db", task)
    assert len(trials) < 60
    assert Progress.of(trials, 0.0, 0.2).idle == IDLE
    assert idle[-(IDLE - STALLED) :] == list(range(STALLED, IDLE))
    assert min(idle) == STALLED
    assert search(tmp_path / "end.db", task) == trials


def test_what_is_learned_of_a_rehearsal_is_of_its_own_variant():
    """Of design and workshop: it takes its place among the points of the search."""
    variant = Variant(load_design("best-printable"), {"process.infill": 0.3, "bought.battery": "lipo-1s-300"})
    findings = (Finding("stop", "error", -0.2, "mm", "too near", "move it"),)
    trial = _stayed(variant, Evaluation("cannot_build", findings=findings, detail="no room"))
    assert (trial.variant, trial.key, trial.score) == (variant, variant.key, None)
    assert trial.evaluation.margins == {"stop": -0.2}
    assert not trial.evaluation.feasible


def test_of_what_did_not_hold_the_last_are_learned():
    """Those that were passed over at the start stand before those that were tried."""
    rehearsal = object.__new__(Rehearsal)
    rehearsal._passed_over = {(float(number),): number for number in range(FAILED)}
    rehearsal._tried = lambda trials, tried: iter(tried)
    rehearsal._failure = lambda number: None if number % 2 else number
    found = rehearsal.failures([], [1000, 1001, 1002])
    assert found == [*range(2, FAILED), 1000, 1002]
    assert rehearsal.failures([], []) == list(range(FAILED))


def test_of_what_held_the_last_are_guessed_and_every_trial_that_jumped(monkeypatch):
    """The first designs of a search come before what was tried."""
    rehearsal = object.__new__(Rehearsal)
    named = [SimpleNamespace(key=number) for number in range(GUESSED + 4)]
    monkeypatch.setattr(rehearsal, "_tried", lambda trials, tried: iter(tried), raising=False)
    monkeypatch.setattr(rehearsal, "_guess", lambda one: Guess(10.0 * one.key, {}), raising=False)
    rehearsal._fit, rehearsal._first = object(), named[:2]
    rehearsal._failure = lambda one: object() if one.key == 5 else None
    rehearsal._space = SimpleNamespace(to_unit=lambda one: -one.key)
    trials = [SimpleNamespace(variant=SimpleNamespace(key=key), score=score) for key, score in ((-1, 0.5), (-2, None))]
    found = rehearsal.guesses(trials, named[2:])
    assert list(found) == [number for number in range(3, GUESSED + 4) if number != 5] + [-1]
    assert found[-1] == (1, -10.0)


def figures_that_know_their_rows(monkeypatch):
    """Let guesses be the number of robots from which figures were fitted."""
    coefficients = SimpleNamespace(coefficients=dict)
    monkeypatch.setattr("jumpcad.search.propose.dry_run.Table", lambda *_, **__: coefficients)
    monkeypatch.setattr("jumpcad.search.propose.dry_run.ranked_points", lambda *_: [])
    monkeypatch.setattr(Guesser, "quick", lambda *_: lambda variant, fit, laid: Guess(float(fit.rows), {}))


def test_what_was_guessed_is_guessed_anew_with_new_figures(monkeypatch):
    """From eight robots on, then of ten (10.4), and not of nine."""
    figures_that_know_their_rows(monkeypatch)
    design = SPACE.to_design(np.full(SPACE.dimension, 0.5))
    trials = [Trial("bo", 0, place, design, Evaluation("jump", {MARK: 1.0}), 1.0, "m", 0.0) for place in range(11)]
    rehearsal, asked = rehearsal_of(), []
    vars(rehearsal)["_model"] = SimpleNamespace(laid_out=lambda one: {})
    for count in (7, 8, 9, 11):
        rehearsal.learn(trials[:count])
        asked.append(rehearsal.guess(Variant(design)))
    assert asked == [None, 8.0, 8.0, 10.0]


def test_where_the_workshop_varies_nothing_is_guessed(monkeypatch):
    """docs/searching.md: there is only the layout."""
    figures_that_know_their_rows(monkeypatch)
    shop = load_workshop()
    for bound, guessing in (([], True), (["body.plate_mm=1.6:2.4"], False)):
        space = Space.parse(bound=bound, workshop=shop)
        variant = space.to_variant(np.full(space.dimension, 0.5))
        one = Trial(
            "bo", 0, 0, variant.design, Evaluation("jump", {MARK: 1.0}), 1.0, "m", 0.0, workshop=variant.workshop
        )
        rehearsal = rehearsal_of(robot_model(), space)
        rehearsal.learn([replace(one, place=place) for place in range(8)])
        assert rehearsal.guessing == guessing


def test_a_point_of_another_space_is_not_looked_at(monkeypatch):
    """As of a search that had other free parameters."""
    rehearsal = rehearsal_of()
    monkeypatch.setattr(rehearsal, "_refusal", lambda one: pytest.fail("laid out"))
    assert rehearsal.failures([], [np.full(SPACE.dimension + 1, 0.5), np.full(SPACE.dimension - 1, 0.5)]) == []
    assert rehearsal.known([], [np.full(SPACE.dimension + 1, 0.5)]) == set()
