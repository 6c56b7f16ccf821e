"""Finished evaluations are never computed twice, and what is finished is kept."""

import numpy as np
import pytest
from support.hills import SMALL, Hill, Trap

from jumpcad.errors import JumpcadError
from jumpcad.search.study.objective import QUARANTINED, Evaluation
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.variant import Variant


def designs(count, seed=0):
    return [SMALL.to_design(point) for point in SMALL.spread(count, np.random.default_rng(seed))]


def test_finished_designs_are_read_from_the_study_file(evaluator, tmp_path):
    log = tmp_path / "log"
    first = evaluator(tmp_path / "s.db", Hill(log=log))
    batch = designs(10)
    trials = first.evaluate([*batch, batch[0], batch[3]], "ga", 0)
    assert len(log.read_text().splitlines()) == 10
    assert trials[10] is trials[0]
    first.store.close()
    again = evaluator(tmp_path / "s.db", Hill(log=log))
    assert [trial.evaluation for trial in again.evaluate(batch, "ga", 0)] == [trial.evaluation for trial in trials[:10]]
    assert len(log.read_text().splitlines()) == 10
    assert [trial.place for trial in again.trials] == list(range(10))


def test_a_budget_is_kept(evaluator):
    one = evaluator()
    trials = one.evaluate(designs(10), "ga", 0, limit=4)
    assert [trial is None for trial in trials] == [False] * 4 + [True] * 6
    assert len(one.trials) == 4


def test_a_design_of_an_earlier_study_is_not_new(evaluator):
    first, second, third = designs(3)
    earlier = evaluator()
    earlier.evaluate([first], "ga", 0)
    later = evaluator(prior=earlier.trials)
    later.evaluate([second], "ga", 0)
    assert [later.admits(design) for design in (first, second, third)] == [False, False, True]


def test_an_interrupt_keeps_what_is_finished(evaluator, tmp_path):
    class Interrupting(Hill):
        def __call__(self, design):
            if self.log.exists() and len(self.log.read_text().splitlines()) == 6:
                raise KeyboardInterrupt
            return super().__call__(design)

    stopped = evaluator(tmp_path / "s.db", Interrupting(log=tmp_path / "log"))
    with pytest.raises(KeyboardInterrupt):
        stopped.evaluate(designs(16), "ga", 0)
    stopped.store.close()
    kept = StudyStore.read(tmp_path / "s.db").trials()
    # The task in hand is lost with the interrupt; tasks before it are kept, in the places that they were proposed in.
    assert 0 < len(kept) <= 6
    resumed = evaluator(tmp_path / "s.db")
    resumed.evaluate(designs(16), "ga", 0)
    whole = evaluator()
    whole.evaluate(designs(16), "ga", 0)
    assert [(trial.place, trial.design, trial.score) for trial in resumed.store.trials()] == [
        (trial.place, trial.design, trial.score) for trial in whole.store.trials()
    ]


def test_a_search_that_proposes_otherwise_is_refused(evaluator, tmp_path):
    first = evaluator(tmp_path / "s.db")
    first.evaluate(designs(4), "ga", 0)
    first.store.close()
    again = evaluator(tmp_path / "s.db")
    with pytest.raises(JumpcadError, match="proposes other designs"):
        again.evaluate(designs(4, seed=1), "ga", 0)
    with pytest.raises(JumpcadError, match="proposes other designs"):  # one of them
        again.evaluate([*designs(3), *designs(1, seed=1)], "ga", 0)
    assert len(again.evaluate([*designs(4), *designs(1, seed=1)], "ga", 0)) == 5


def test_a_model_that_always_fails_ends_the_run(evaluator):
    one = evaluator(model=Trap(way="bug"))
    steep = [design for design in designs(32) if design.rest_angle_deg > 60.0]
    with pytest.raises(JumpcadError, match=r"every evaluation failed.*ZeroDivisionError"):
        one.evaluate(steep, "ga", 0)
    assert one.store.trials() == []


def test_failures_beside_or_after_something_that_worked_are_rows(evaluator):
    """The model works here, so designs are the cause, also where they are all of a batch."""
    one = evaluator(model=Trap(way="bug"))
    steep = [design for design in designs(32) if design.rest_angle_deg > 60.0]
    for step, batch in enumerate((designs(16), steep)):
        found = [trial for trial in one.evaluate(batch, "ga", step) if trial.design.rest_angle_deg > 60.0]
        assert len(found) > 1
        assert {trial.evaluation.verdict for trial in found} == {QUARANTINED}
    assert any("quarantined: ZeroDivisionError" in note for note in one.store.notes())


def test_what_is_left_out_is_a_row_with_its_outcome_and_is_not_evaluated(evaluator, tmp_path):
    """It counts among the designs, in the place in which it was proposed, and has no score."""
    log = tmp_path / "log"
    one, (first, second, third) = evaluator(model=Hill(log=log)), designs(3)
    out = {Variant.of(second).key: Evaluation("screened", {"guessed": 0.5})}
    notes = [{"log_feasible": float(number)} for number in range(3)]
    seen = []
    one._watch = lambda trial, computed: seen.append((trial.place, computed))
    trials = one.evaluate([first, second, third], "ga", 4, proposals=notes, left_out=out)
    assert len(log.read_text().splitlines()) == 2
    assert [(trial.phase, trial.step, trial.place) for trial in trials] == [("ga", 4, place) for place in range(3)]
    assert [trial.design for trial in trials] == [first, second, third]
    assert (trials[1].evaluation, trials[1].score) == (Evaluation("screened", {"guessed": 0.5}), None)
    assert [dict(trial.proposal) for trial in trials] == [notes[0], {}, notes[2]]
    assert {trial.model for trial in trials} == {one.model.digest}
    assert seen == [(0, True), (1, True), (2, True)]  # decided now, not read from the file
    assert [one.holds(Variant.of(design)) for design in designs(4)] == [True, True, True, False]


def test_a_step_is_read_whole_or_not_at_all(evaluator, tmp_path):
    first = evaluator(tmp_path / "s.db")
    first.evaluate(designs(3), "ga", 2)
    first.store.close()
    again = evaluator(tmp_path / "s.db")
    assert (
        again.finished("ga", 2, 2)
        is again.finished("ga", 2, 4)
        is again.finished("ga", 1, 3)
        is again.finished("bo", 2, 3)
        is None
    )
    assert again.trials == []
    found = again.finished("ga", 2, 3)
    assert [trial.place for trial in found] == [0, 1, 2]
    assert again.trials == found
