"""Whole studies: the same trials, whoever computes them and whatever interrupts them."""

import os
import random
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.hills import FIXED, SMALL, Hill
from support.places import TESTS

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.propose.bayesian import IDLE_ALONE, idle_steps
from jumpcad.search.space import Space
from jumpcad.search.study import run as study
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import _read_prior, run_study
from jumpcad.search.study.store import StudyStore

REQUEST = Request(SMALL, Hill(), evaluations=40, seed=4, until_percent=0.0)
FEW = Space.parse(choose=["c_coef=0.9,1.0"], around=load_design("best-ga"), only=["c_coef"])
SCRIPT = TESTS / "support" / "study_script.py"

pytestmark = pytest.mark.usefixtures("quick_proposals")


def test_an_hour_counts_from_what_was_read_to_what_is_computed(monkeypatch):
    """What is read again between computed trials starts no new hour; reading alone never takes too long."""
    now = [0.0]
    monkeypatch.setattr(study, "time", SimpleNamespace(monotonic=lambda: now[0]))
    clock, free, reading = study.Clock(1.0), study.Clock(0.0), study.Clock(1.0)
    for at, computed in ((10.0, False), (5000.0, False), (5001.0, True), (5002.0, False)):
        now[0] = at
        assert not clock.is_over()
        clock.see(computed)
        free.see(computed)
        reading.see(False)
    for more, over in ((3599.9, False), (3600.1, True), (1e9, True)):
        now[0] = 5000.0 + more
        assert (clock.is_over(), free.is_over(), reading.is_over()) == (over, False, False)


def test_a_robust_pick_ends_with_the_time_and_the_same_request_goes_on(tmp_path, monkeypatch):
    """The time is over after some of its evaluations: what it has is kept, and the rest follows later."""
    request = replace(REQUEST, method="ga", evaluations=60)
    whole = run(request)
    around = [trial for trial in whole.candidates if trial.neighbours]
    assert around
    picked = []

    class Timed(study.Clock):
        def see(self, computed):
            super().see(computed)
            picked.append(computed)

        def is_over(self, following=0):
            return len(picked) > request.searched + 3

    monkeypatch.setattr(study, "Clock", Timed)
    cut = run(replace(request, hours=1.0), tmp_path / "s.db")
    assert [trial.key for trial in cut.trials] == [trial.key for trial in whole.trials]
    assert 3 < cut.evaluations - len(cut.trials) < whole.evaluations - len(whole.trials)
    assert cut.notes == ["ended after 1 h, during the robust pick: the same command goes on"]
    assert cut.candidates
    assert all(bound.reason.startswith("not examined") for bound in cut.bounds)
    monkeypatch.undo()
    again = run(replace(request, hours=1.0), tmp_path / "s.db")
    assert again.notes == []
    assert again.evaluations == whole.evaluations
    assert [one.to_dict() for one in again.candidates] == [one.to_dict() for one in whole.candidates]
    assert again.bounds == whole.bounds


def contents(path):
    """Return all trials of a study without their durations."""
    with StudyStore.read(path) as store:
        return [replace(trial, duration_s=0.0) for trial in store.trials()]


def run(request, path=None, workers=0):
    with local_pool(workers) as pool:
        return run_study(request, path, pool)


@pytest.fixture(scope="module")
def two_workers():
    """Two processes that compute for several studies: each costs a second to start."""
    with local_pool(2) as pool:
        yield pool


def start(path, method, evaluations, workers, pause):
    command = [sys.executable, str(SCRIPT), str(path), method, str(evaluations), str(workers), str(pause)]
    return subprocess.Popen(command, env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)})


@pytest.mark.parametrize("method", ["ga+bo", pytest.param("pareto", marks=pytest.mark.thorough)])
def test_same_rows_for_any_number_of_workers(tmp_path, two_workers, method):
    request = replace(REQUEST, method=method, batch=3, evaluations=18)
    run(request, tmp_path / "0.db")
    run_study(request, tmp_path / "2.db", two_workers)
    assert contents(tmp_path / "0.db") == contents(tmp_path / "2.db")


@pytest.mark.thorough
def test_killed_at_random_moments_it_ends_with_the_rows_of_an_uninterrupted_run(tmp_path):
    """By both methods: the first half is the genetic algorithm's."""
    method, evaluations, workers = "ga+bo", 28, 1
    moments = random.Random(11)
    killed = 0
    while killed < 2:
        process = start(tmp_path / "killed.db", method, evaluations, workers, 0.03)
        deadline = time.monotonic() + moments.uniform(0.3, 4.0)
        while process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        if process.poll() is not None:
            break
        process.kill()
        if process.wait() == 0:  # it ended just before
            break
        killed += 1
    assert start(tmp_path / "killed.db", method, evaluations, workers, 0.0).wait() == 0
    run(replace(REQUEST, method=method, evaluations=evaluations), tmp_path / "whole.db")
    assert killed > 0
    assert contents(tmp_path / "killed.db") == contents(tmp_path / "whole.db")


def test_a_finished_study_is_not_computed_again(tmp_path):
    log = tmp_path / "log"
    request = replace(REQUEST, model=Hill(log=log), method="ga")
    first = run(request, tmp_path / "s.db")
    count = len(log.read_text().splitlines())
    again = run(request, tmp_path / "s.db")
    assert len(log.read_text().splitlines()) == count
    assert again.best == first.best
    assert again.candidates == first.candidates


@pytest.mark.thorough
@pytest.mark.parametrize("method", ["ga", "bo", "ga+bo", "pareto"])
def test_a_larger_budget_lengthens_a_study(tmp_path, method):
    request = replace(REQUEST, method=method, evaluations=16)
    run(request, tmp_path / "s.db")
    before = contents(tmp_path / "s.db")
    result = run(replace(request, evaluations=22), tmp_path / "s.db")
    assert len(result.trials) == 22
    after = contents(tmp_path / "s.db")
    assert all(trial in after for trial in before)
    with pytest.raises(JumpcadError, match="evaluations = 16 leave 16 for its search, which is planned for 22"):
        run(request, tmp_path / "s.db")


@pytest.mark.thorough
def test_genetic_then_bayesian_ends_on_the_top():
    result = run(replace(REQUEST, method="ga+bo", evaluations=60))
    assert [trial.phase for trial in result.trials] == ["ga"] * 15 + ["bo"] * 30
    assert result.best.score > 9.99
    assert 45 < result.evaluations <= 60
    assert len(result.candidates) > 1
    assert result.winner == result.candidates[0].trial
    assert result.bounds == []


@pytest.mark.thorough
def test_it_ends_where_its_last_steps_gain_too_little_and_goes_on_where_less_is_asked(tmp_path):
    request = replace(REQUEST, method="bo", evaluations=75)
    first = run(replace(request, until_percent=1.0), tmp_path / "s.db")
    assert 9 + IDLE_ALONE <= len(first.trials) < 60
    assert idle_steps(first.trials, 0.0, 0.01) == IDLE_ALONE
    assert first.best.score > 9.9  # of 10: what was promised, it had
    assert first.converged
    assert first.to_dict()["converged"]
    again = run(replace(request, until_percent=1.0), tmp_path / "s.db")
    assert again.trials == first.trials
    longer = run(request, tmp_path / "s.db")
    assert len(longer.trials) > len(first.trials)
    assert not longer.converged
    assert longer.trials[: len(first.trials)] == first.trials


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("changes", "ended"),
    [
        ({"method": "ga", "evaluations": 40}, {"by": "evaluations"}),
        ({"method": "bo", "evaluations": 70, "until_percent": 5.0}, {"by": "until", "until_percent": 5.0}),
        ({"method": "ga", "evaluations": 40, "hours": 1e-12}, {"by": "hours", "hours": 1e-12}),
        ({"method": "bo", "space": FEW}, {"by": "space"}),
    ],
    ids=["evaluations", "until", "hours", "space"],
)
def test_a_study_remembers_what_ended_it_and_forgets_it_while_it_goes_on(tmp_path, changes, ended):
    request = replace(REQUEST, **changes)
    result = run(request, tmp_path / "s.db")

    def held():
        with StudyStore.read(tmp_path / "s.db") as store:
            return store.recall("ended")

    assert held() == ended
    seen, watched = [], []
    with local_pool(0) as pool:
        run_study(request, tmp_path / "s.db", pool, lambda *told: seen.append(held()) or watched.append(told))
    assert [trial for trial, _ in watched[: len(result.trials)]] == result.trials
    assert not any(computed for _, computed in watched[: result.evaluations])  # all of it is read
    assert len(seen) >= len(result.trials)
    assert set(seen) == {None}
    assert held()["by"] == ended["by"]


def test_everything_refused_has_no_best():
    space, told = Space.parse(fix=["compression_ratio=0.75"]), []
    request = Request(space, Hill(), method="ga", evaluations=67)
    with local_pool(0) as pool:
        result = run_study(request, None, pool, tell=told.append)
    first = "none of the first 40 designs jumps (loop 40): there may be no robot within these bounds"
    assert told == [first, "loop, 40 of 40: ratio; lower it"]
    assert result.notes == [f"loop, {len(result.trials)} of {len(result.trials)}: ratio; lower it"]
    assert result.best is None
    assert result.winner is None
    assert result.candidates == []


@pytest.mark.thorough
def test_a_prior_study_of_the_same_model_is_learned_from(tmp_path):
    run(replace(REQUEST, method="ga", evaluations=120), tmp_path / "old.db")
    learned = run(replace(REQUEST, method="bo", evaluations=6, prior=tmp_path / "old.db"))
    assert learned.best.score > 9.9
    assert learned.notes == []
    with pytest.raises(JumpcadError, match=r'was made with another model than this search \(model.name: "hill" there'):
        run(replace(REQUEST, model=Hill(name="other"), prior=tmp_path / "old.db"))


def test_of_a_prior_study_only_designs_of_the_space_are_learned_from(tmp_path):
    """A search that is narrower than the earlier one; scores are those of its own objective."""
    run(replace(REQUEST, method="ga", evaluations=60), tmp_path / "old.db")
    whole, _ = study._read_prior(replace(REQUEST, prior=tmp_path / "old.db"))
    name = SMALL.free[0].name
    values = sorted(trial.variant.value(name) for trial in whole)
    middle = values[len(values) // 2]
    free = {one.name: (one.lower, one.upper) for one in SMALL.free}
    fixed = {one.name: one.lower for one in SMALL.parameters if not one.free}
    narrow = Space.make(fixed, free | {name: (free[name][0], middle)})
    some, _ = study._read_prior(replace(REQUEST, space=narrow, prior=tmp_path / "old.db"))
    assert sorted(trial.variant.value(name) for trial in some) == [value for value in values if value <= middle]
    assert 10 < len(some) < len(whole) - 10


class Marked(Hill):
    """A hill whose rows have figures for stand-ins too, or not."""

    marks = False

    def describe(self):
        return super().describe() | ({"stand_in": True} if self.marks else {})


class Marking(Marked):
    marks = True


def test_a_prior_study_from_which_nothing_can_be_learned_is_said_to_be_one(tmp_path):
    """Its designs have a compression of 0.1 to 0.8, one each, the search's all 0.15."""
    trials = run(replace(REQUEST, method="ga", evaluations=12), tmp_path / "old.db").trials
    assert all(trial.design.compression_ratio != 0.15 for trial in trials)
    apart = Space.parse(fix=[*FIXED, "compression_ratio=0.15"])
    result = run(replace(REQUEST, space=apart, method="ga", evaluations=4, prior=tmp_path / "old.db"))
    said = f"{tmp_path / 'old.db'}: none of its designs lies in this space, so nothing is learned from it"
    assert result.notes == [said]


@pytest.mark.thorough
def test_a_prior_study_may_lack_the_figures_of_stand_ins(tmp_path):
    run(replace(REQUEST, model=Marked(), method="ga", evaluations=20), tmp_path / "old.db")
    learned = run(replace(REQUEST, model=Marking(), method="bo", evaluations=12, prior=tmp_path / "old.db"))
    assert len(learned.trials) == 12


def test_a_prior_study_of_another_program_is_said_to_be_one(tmp_path):
    class Newer(Hill):
        digest = "newer"

    run(replace(REQUEST, method="ga", evaluations=20), tmp_path / "old.db")
    request = replace(REQUEST, method="ga", model=Newer(), evaluations=20, prior=tmp_path / "old.db")
    for _ in range(2):
        (note,) = run(request, tmp_path / "new.db").notes
        assert "old.db was made by another program" in note


@pytest.mark.thorough
def test_a_prior_study_is_scored_by_the_objective_of_the_request(tmp_path):
    """Whatever it was made for: a rejected design has no score by any."""
    run(replace(REQUEST, method="ga", evaluations=12), tmp_path / "prior.db")

    def doubled(figures):
        return 2.0 * figures["fitness"]

    aim = find_objective(doubled)
    trials, remark = _read_prior(replace(REQUEST, objective=aim, prior=tmp_path / "prior.db"))
    assert remark == ""
    assert len(trials) == 12
    assert any(trial.score is None for trial in trials)
    for trial in trials:
        fitness = trial.evaluation.metrics.get("fitness")
        assert trial.score == (None if fitness is None else 2.0 * fitness)
