"""Bayesian optimisation: few evaluations, batches, resumption."""

from dataclasses import replace

import numpy as np
import pytest
from support.hills import FIXED, SMALL, TOP, Hill
from support.stages import scored, stage

from jumpcad.search.propose.acquisition import Proposal
from jumpcad.search.propose.bayesian import (
    IDLE_ALONE,
    idle_steps,
    incumbent,
    learned_trials,
    run_bayesian,
    run_steps,
    unproposed,
)
from jumpcad.search.space import Space
from jumpcad.search.study.request import default_initial


def best(trials):
    return max(trial.score or 0.0 for trial in trials)


@pytest.fixture(scope="module")
def taught(kept_evaluator):
    """Return the trials of a search to learn from."""
    one = kept_evaluator()
    run_bayesian(one, stage(24, 0, initial=9))
    return one.trials


@pytest.mark.thorough
def test_the_top_is_found_in_few_evaluations(taught, evaluator):
    others = [evaluator() for _ in range(2)]
    for seed, one in enumerate(others, start=1):
        run_bayesian(one, stage(24, seed, initial=9))
    for trials in (taught, *(one.trials for one in others)):
        assert len(trials) == 24
        assert best(trials) > 9.99


@pytest.mark.thorough
def test_batches_find_it_too_and_do_not_repeat_themselves(evaluator):
    one = evaluator()
    run_bayesian(one, stage(41, 0, initial=9, batch=4))
    assert len({trial.key for trial in one.trials}) == 41
    assert best(one.trials) > 9.99
    assert [sum(trial.step == step for trial in one.trials) for step in range(9)] == [9, *[4] * 8]


@pytest.mark.thorough
@pytest.mark.usefixtures("quick_proposals_once")
def test_a_resumed_search_goes_on_with_the_same_proposals(evaluator, tmp_path):
    whole = evaluator()
    run_bayesian(whole, stage(18, 3, initial=6, batch=2))
    for cut in (3, 6, 11, 17):
        path = tmp_path / f"{cut}.db"
        begun = evaluator(path)
        begun.store.append(whole.trials[:cut])
        begun.store.close()
        log = tmp_path / f"{cut}.log"
        resumed = evaluator(path, Hill(log=log))
        run_bayesian(resumed, stage(18, 3, initial=6, batch=2))
        assert [(trial.key, trial.score, trial.proposal) for trial in resumed.trials] == [
            (trial.key, trial.score, trial.proposal) for trial in whole.trials
        ]
        assert len(log.read_text().splitlines()) == 18 - cut


def test_a_prior_study_saves_the_first_points(evaluator, taught):
    pupil = evaluator(prior=taught[:20])
    run_bayesian(pupil, stage(4, 1, initial=default_initial(SMALL, 4, prior=20)))
    assert not {trial.key for trial in pupil.trials} & {trial.key for trial in taught[:20]}
    assert best(pupil.trials) > 9.9


def test_a_search_knows_what_a_prior_study_gained(evaluator, taught):
    """Its first step gains nothing over that study's best: 25 such steps are enough."""
    assert best(taught[:20]) > 9.9
    pupil = evaluator(prior=taught[:20])
    assert run_bayesian(pupil, stage(40, 1, least_gain=0.02)) is True
    assert len(pupil.trials) == IDLE_ALONE


def test_an_exhausted_space_ends_the_search(evaluator):
    space = Space.parse(fix=[*FIXED, f"rest_angle_deg={TOP['rest_angle_deg']}", "compression_ratio=0.6"],
                        choose=["stiffness_nmm_per_deg=8,19,30"])  # fmt: skip
    one = evaluator(space=space)
    run_bayesian(one, stage(20, 0, initial=2))
    assert len(one.trials) == 3
    assert one.store.notes() == []  # as many as the space has


def test_a_search_that_finds_nothing_more_to_try_says_so(evaluator):
    class Picky(Hill):
        def admits(self, design):
            return design.stiffness_nmm_per_deg < 15.0

    space = Space.parse(fix=[*FIXED, "rest_angle_deg=50", "compression_ratio=0.6"],
                        choose=["stiffness_nmm_per_deg=8,10,19,20,21,22,23,30"])  # fmt: skip
    one = evaluator(model=Picky(), space=space)
    run_bayesian(one, stage(20, 0, initial=2))
    assert len(one.trials) < 8
    assert one.store.notes() == [f"ended after {len(one.trials)} designs: no other was found that is new and has room"]


def test_the_processes_learn_from_the_best_and_the_nearest(evaluator):
    one = evaluator()
    points = SMALL.spread(1000, np.random.default_rng(0))
    trials = [trial for trial in one.evaluate([SMALL.to_design(point) for point in points], "ga", 0) if trial]
    learned = learned_trials(SMALL, trials)
    assert len(learned) == 400
    assert learned == [trial for trial in trials if trial in learned]
    ranked = sorted((trial for trial in trials if trial.score is not None), key=lambda trial: -trial.score)
    keys = {trial.key for trial in learned}
    assert all(trial.key in keys for trial in ranked[:100])
    far = {trial.key: np.abs(SMALL.to_unit(trial.design) - SMALL.to_unit(ranked[0].design)).max() for trial in trials}
    nearest = sorted(far, key=far.get)
    assert set(nearest[:300]) <= keys
    assert learned_trials(SMALL, trials[:400]) == trials[:400]


def test_the_incumbent_is_the_best_and_the_elite_are_the_best_four():
    trials = scored(1.0, None, 5.0, 3.0, 2.0)
    best, elite = incumbent(SMALL, trials)
    assert best == 5.0
    assert elite == pytest.approx(np.array([[0.5] * 3, [0.7] * 3, [0.9] * 3, [0.1] * 3]))
    assert incumbent(SMALL, scored(None))[1].shape == (0, 3)


def test_what_is_proposed_is_new_fits_and_is_not_in_the_batch_already(evaluator):
    """Not evaluated before, by this search or its prior; admitted by the model; with room for its parts."""
    one = evaluator(prior=evaluator().evaluate([SMALL.to_design([0.1, 0.1, 0.1])], "bo", 0))
    one.evaluate([SMALL.to_design([0.2, 0.2, 0.2])], "bo", 0)
    prior, done, taken, tight, free = (SMALL.to_variant([at] * 3) for at in (0.1, 0.2, 0.3, 0.4, 0.5))
    batch = [Proposal(taken, np.full(3, 0.3), 0.0, 0.0)]
    admits = unproposed(one, batch, lambda variant: variant.key != tight.key)
    assert [admits(variant) for variant in (prior, done, taken, tight, free)] == [False] * 4 + [True]
    assert unproposed(one, [])(tight)
    assert unproposed(one, [])(taken)


def test_a_first_step_is_spread_and_later_ones_are_proposed_as_many_at_a_time_as_asked(evaluator):
    """No more than are left: of eleven four first, then three, three and one; steps are counted from the first."""
    asked = []

    def proposer(loop, trials, count, generator):
        asked.append((len(trials), count, generator.random()))
        loop.tried.append(np.full(3, 0.25))
        loop.thetas = {"score": [0.1 * len(asked)] * 5}
        points = [np.array([0.01 * len(asked) + 0.001 * n, 0.5, 0.5]) for n in range(count)]
        return [Proposal(SMALL.to_variant(point), point, -1.0, -2.0 - n) for n, point in enumerate(points)]

    one = evaluator()
    assert run_steps(one, "bo", stage(11, 6, initial=4, batch=3, run=5), proposer) is False
    assert [(trials, count) for trials, count, _ in asked] == [(4, 3), (7, 3), (10, 1)]
    assert [drawn for *_, drawn in asked] == [
        np.random.default_rng([6, 2, step]).random() for step in (5_000_001, 5_000_002, 5_000_003)
    ]
    places = [(trial.run, trial.step, trial.place) for trial in one.trials]
    assert places == [(5, step, n) for step, count in enumerate((4, 3, 3, 1)) for n in range(count)]
    notes = [dict(trial.proposal) for trial in one.trials]
    assert notes[:4] == [{}] * 4
    theta = {"theta": {"score": [0.1] * 5}}
    assert notes[4] == {"log_improvement": -1.0, "log_feasible": -2.0, "tried": [[0.25] * 3]} | theta
    assert notes[5] == {"log_improvement": -1.0, "log_feasible": -3.0} | theta
    assert notes[10]["theta"] == {"score": pytest.approx([0.3] * 5)}


def test_steps_end_when_it_is_said_or_time_is_over_or_nothing_is_proposed(evaluator):
    def proposer(loop, trials, count, generator):
        point = np.array([0.01 * len(trials), 0.5, 0.5])
        return [Proposal(SMALL.to_variant(point), point, -1.0, -2.0)]

    one = evaluator()
    assert run_steps(one, "bo", stage(20, 0, initial=3), proposer, lambda: len(one.trials) >= 6) is True
    assert len(one.trials) == 6
    late = evaluator()
    late.expired = lambda: len(late.trials) >= 5
    assert run_steps(late, "bo", stage(20, 0, initial=3), proposer) is False
    assert len(late.trials) == 5
    dry = evaluator()
    assert run_steps(dry, "bo", stage(20, 0, initial=3), lambda *_: []) is False
    assert dry.store.notes() == ["ended after 3 designs: no other was found that is new and has room"]


def test_a_search_stands_still_as_long_as_nothing_is_gained():
    """After a score of 4, and with 1 % as the least gain; of a batch the best counts, other methods do not."""
    for steps, idle in (
        ([(3.9,)], 1), ([(3.9,), (None,)], 2), ([(3.9,), (4.1,)], 0), ([(4.03,), (4.03,)], 2), ([(4.1,), (4.0,)], 1),
        ([(3.9, 4.1)], 0), ([(4.1, 3.9), (4.0, 4.1)], 1),
    ):  # fmt: skip
        trials = scored(4.0, step=0)
        for number, scores in enumerate(steps, start=1):
            trials += scored(*scores, step=number, theta={})
        assert idle_steps(trials, 0.0, 0.01) == idle, steps
        assert idle_steps([replace(one, phase="ga") for one in trials], 0.0, 0.01) == 0
        assert idle_steps(trials, 9.0, 0.01) == len(steps)  # what was known before is better


def test_before_the_first_jump_no_search_stands_still():
    trials = [*scored(None, step=0), *scored(None, step=1, theta={}), *scored(None, step=2, theta={})]
    assert idle_steps(trials, 0.0, 0.01) == 0
