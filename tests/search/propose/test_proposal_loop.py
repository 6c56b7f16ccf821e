"""What a step learns, with dry runs that are known."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import SMALL, Hill

from jumpcad.search.propose.acquisition import Proposal
from jumpcad.search.propose.proposal_loop import (
    AWAY,
    DRAWN,
    HELD,
    ROUNDS,
    STEP,
    WITHIN,
    ProposalLoop,
    neighbours,
)  # fmt: skip
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop


def trial_of(unit):
    variant = SMALL.to_variant(unit)
    evaluation = Hill()(variant.design)
    score = evaluation.metrics.get("fitness") if evaluation.feasible else None
    return Trial("bo", 0, 0, variant.design, evaluation, score, "m", 0.0)


TRIALS = [trial_of(point) for point in SMALL.spread(16, np.random.default_rng(0))]


class DryRun:
    """Only what is left of a half holds; of what was tried, nothing else is known."""

    def __init__(self, half=0.5, ready=False):
        self.half, self.estimator = half, SimpleNamespace(ready=ready, refuses=lambda _: False)

    def failure(self, variant):
        no_room = Trial("", 0, 0, variant.design, Evaluation("no_room"), None, "", 0.0)
        return None if SMALL.to_unit(variant)[0] < self.half else no_room

    def tried(self, trials, tried):
        return [SMALL.to_variant(point) for point in tried]

    def look_at(self, variants):
        """What is done ahead changes nothing."""

    def score(self, variant, required=True):
        """The sum of its coordinates."""
        return float(SMALL.to_unit(variant).sum())

    def rough(self, points):
        return np.array([sum(point) for point in points])

    def failures(self, trials, tried):
        return [one for one in map(self.failure, map(SMALL.to_variant, tried)) if one is not None]

    def estimates(self, trials, tried):
        return {}


class Asked:
    """Proposes given points one after the other, then the last that was tried; promises what none can keep."""

    def __init__(self, *points, promised=50.0):
        self.points, self.posteriors, self.held, self.promised = list(points), [], [], promised

    def __call__(self, posterior, held):
        self.posteriors.append(posterior)
        self.held.append(list(held))
        unit = np.array(self.points.pop(0)) if self.points else held[-1]
        return Proposal(SMALL.to_variant(unit), unit, self.promised, 0.0)


def test_what_keeps_its_promise_in_its_dry_run_is_taken_at_once():
    """A fifth less, in logarithms, is kept; more is not, and another is asked for."""
    unit = np.array([[0.2, 0.5, 0.5]])
    for less, asked in ((0.19, 1), (0.21, 2)):
        loop = ProposalLoop(SMALL, TRIALS, DryRun(), {}, refit=True)
        posterior = loop._learned()
        value = float((posterior.log_improvement(unit, 1.0) + posterior.log_feasible(unit))[0])
        ask = Asked(unit[0].tolist(), promised=value + less)
        found = loop.propose(ask, 1.0)
        assert found.unit.tolist() == unit[0].tolist()
        assert len(ask.posteriors) == asked
        if asked == 1:
            assert found.log_value == pytest.approx(value, abs=1e-3)  # hyperparameters are rounded after a fit


def test_without_dry_runs_the_first_proposal_is_taken():
    ask = Asked([0.9, 0.1, 0.1])
    loop = ProposalLoop(SMALL, TRIALS, None, {}, refit=True)
    assert loop.propose(ask, 1.0).unit.tolist() == [0.9, 0.1, 0.1]
    assert (len(ask.posteriors), loop.tried) == (1, [])
    assert "score" in loop.thetas


def test_what_does_not_hold_is_learned_and_the_next_is_asked_for():
    ask = Asked([0.9, 0.1, 0.1], [0.2, 0.2, 0.2])
    loop = ProposalLoop(SMALL, TRIALS, DryRun(), {}, refit=True)
    assert loop.propose(ask, 1.0).unit.tolist() == [0.2, 0.2, 0.2]
    assert [point.tolist() for point in loop.tried] == [[0.9, 0.1, 0.1], [0.2, 0.2, 0.2]]
    assert [len(held) for held in ask.held] == [0, 0, 1]
    before, after = ask.posteriors[:2]
    unit = np.array([[0.9, 0.1, 0.1]])
    assert after.log_feasible(unit) < before.log_feasible(unit)


def test_a_proposal_is_tried_until_enough_hold_or_it_is_hopeless():
    many = [[0.01 * number, 0.5, 0.5] for number in range(40)]
    loop = ProposalLoop(SMALL, TRIALS, DryRun(), {}, refit=False)
    loop.propose(Asked(*many), 1.0)
    assert len(loop.tried) == HELD
    hopeless = ProposalLoop(SMALL, TRIALS, DryRun(half=-1.0), {}, refit=False)
    assert hopeless.propose(Asked(*many), 1.0).unit.tolist() == many[ROUNDS]
    assert len(hopeless.tried) == ROUNDS


def test_what_was_proposed_is_believed_in_the_rest_of_the_step():
    ask = Asked([0.3, 0.3, 0.3], [0.6, 0.6, 0.6])
    loop = ProposalLoop(SMALL, TRIALS, None, {}, refit=True)
    loop.propose(ask, 1.0)
    loop.propose(ask, 1.0)
    unit = np.array([[0.3, 0.3, 0.3]])
    (_, before), (_, after) = (posterior.score.predict(unit) for posterior in ask.posteriors)
    assert after < 0.5 * before


def found_in(*steps):
    """Return trials at the same place, one or more in each step, with scores."""
    unit = np.array([0.5, 0.9, 1.0])
    return [replace(trial_of(unit), step=step, score=score) for step, scores in enumerate(steps) for score in scores]


@pytest.mark.parametrize(
    ("trials", "looks"),
    [
        (found_in([1.0], [1.03]), True),
        (found_in([1.0], [0.5, 1.03]), True),
        (found_in([1.0], [1.03, 0.5]), True),  # of a batch, the best need not be the last
        (found_in([1.0], [1.01]), False),
        (found_in([1.0], [1.015], [1.03]), True),  # small gains add up
        (found_in([1.0], [1.03], [0.9]), False),  # once
        (found_in([1.0], [1.03], [1.04]), False),
        (found_in([None], [None]), False),
        ([*(replace(one, phase="ga") for one in found_in([1.0], [1.03])), *found_in([0.5], [0.9])[1:]], False),
    ],
)  # fmt: skip
def test_beside_a_leap_all_axes_are_tried(trials, looks):
    """A fifth to either side, less at a bound, nothing beyond it: 1.0 has one side, 0.9 the other one halfway."""
    dry_run = DryRun()
    dry_run.estimator.ready = True
    loop = ProposalLoop(SMALL, trials, dry_run, {}, refit=False)
    loop.propose(Asked([0.2, 0.2, 0.2]), 1.0)
    beside = [[0.3, 0.9, 1.0], [0.5, 0.7, 1.0], [0.5, 0.9, 0.8], [0.7, 0.9, 1.0]]
    expected = [*(beside if looks else []), [0.2, 0.2, 0.2]]
    assert np.array(loop.tried) == pytest.approx(np.array(expected))


def test_what_failed_is_not_asked_for_again_and_what_held_is_taken_where_nothing_else_is_left():
    few = [SMALL.to_variant(np.array(unit)) for unit in ([0.9, 0.1, 0.1], [0.2, 0.2, 0.2], [0.8, 0.3, 0.3])]
    loop = ProposalLoop(SMALL, TRIALS, DryRun(), {}, refit=True)

    def ask(posterior, held):
        known = [unit.tolist() for unit in held]
        for variant in few:
            unit = SMALL.to_unit(variant)
            if loop.may_hold(variant) and unit.tolist() not in known:
                return Proposal(variant, unit, 0.0, 0.0)
        return None

    assert loop.propose(ask, 1.0).variant == few[1]
    assert len(loop.tried) == 3
    assert [loop.may_hold(variant) for variant in few] == [False, True, False]
    nothing = ProposalLoop(SMALL, TRIALS, DryRun(half=-1.0), {}, refit=True)
    loop = nothing  # of which `ask` asks
    assert nothing.propose(ask, 1.0) is None


def test_the_neighbour_with_the_best_guess_is_proposed_if_it_is_about_as_good_as_the_best():
    """Guesses grow with all coordinates, so that a step forwards along some axis is better, whatever is drawn."""
    best = replace(trial_of(np.array([0.5, 0.5, 0.5])), score=2.0)
    dry_run = DryRun()
    loop = ProposalLoop(SMALL, TRIALS, dry_run, {}, refit=False)
    assert (
        loop.beside([best], lambda _: True, np.random.default_rng(0), far=False) is None
    )  # nothing can be guessed yet
    dry_run.estimator.ready = True
    found = loop.beside([best], lambda _: True, np.random.default_rng(0), far=False)
    assert len(loop.tried) == 6 + DRAWN
    assert found.unit.sum() == pytest.approx(max(point.sum() for point in loop.tried))
    assert found.unit.sum() >= 1.5 + STEP
    new = {SMALL.to_variant(point).key for point in loop.tried} - {found.variant.key}
    other = loop.beside([best], lambda one: one.key in new, np.random.default_rng(0), far=False)
    assert 1.5 * (1.0 - WITHIN[0]) < other.unit.sum() < found.unit.sum()
    assert len(loop.tried) == 6 + DRAWN  # the same points, which are learned from once
    lesser = {key for key in new if dry_run.score(variant_of(loop, key)) < 1.5 * (1.0 - WITHIN[0])}
    assert lesser
    assert loop.beside([best], lambda one: one.key in lesser, np.random.default_rng(0), far=False) is None
    assert loop.beside([replace(best, score=None)], lambda _: True, np.random.default_rng(0), far=False) is None


def test_other_hills_are_away_from_all_robots_and_not_much_worse_than_the_best():
    """Guesses grow with all coordinates; the same parents breed the same children."""
    dry_run, points = DryRun(half=2.0, ready=True), [SMALL.to_unit(one.variant) for one in TRIALS]
    dry_run.estimates = lambda _trials, _tried: {number: (point, point.sum()) for number, point in enumerate(points)}
    best = replace(max(TRIALS, key=lambda one: SMALL.to_unit(one.variant).sum()), score=2.0)

    def other(robots):
        loop = ProposalLoop(SMALL, robots, dry_run, {}, refit=True)
        return loop.beside([best], lambda _: True, np.random.default_rng(0), far=True)

    found = [other(TRIALS)]
    found.append(other([*TRIALS, trial_of(found[0].unit)]))
    assert np.abs(found[1].unit - found[0].unit).max() > AWAY
    assert all(one.unit.sum() > (1.0 - WITHIN[1]) * SMALL.to_unit(best.variant).sum() for one in found)
    dry_run.estimates = lambda _trials, _tried: {}
    assert other(TRIALS) is None  # nothing to breed of


def variant_of(loop, key):
    return next(one for one in map(SMALL.to_variant, loop.tried) if one.key == key)


def test_neighbours_lie_along_the_axes_that_are_on_no_bound():
    """A step to both sides of each, then some aslant; at a bound, and along names, they are where the best is."""
    few = SMALL.free[1].name, SMALL.free[2].name
    fixed = {name: value for name, value in SMALL.to_design(np.full(3, 0.5)) if name not in few}
    space = Space.make(fixed=fixed, choices={"bought.retention": ["clips", "nuts"]}, workshop=load_workshop())
    name = int(np.flatnonzero(space.categories)[0])
    place = np.where(np.arange(3) == name, 0.0, [0.4, 1.0, 1.0])
    variant = space.to_variant(place)
    best = Trial("bo", 1, 0, variant.design, Evaluation("jump"), 1.0, "m", 0.0, workshop=variant.workshop)
    points = np.array(neighbours(space, best, np.random.default_rng(0)))
    step = STEP * space.scale[0]
    assert points[:2, 0] == pytest.approx([0.4 + step, 0.4 - step], abs=1e-4)
    assert (points[:, 1:] == place[1:]).all()
    assert len(points) == 2 + DRAWN
    whole = replace(best, design=SMALL.to_design(np.array([0.4, 0.5, 0.6])), workshop={})
    points = np.array(neighbours(SMALL, whole, np.random.default_rng(0)))
    assert len(points) == 6 + DRAWN
    assert (np.abs(points[6:] - [0.4, 0.5, 0.6]) > 0.0).all()
    edge = replace(best, design=SMALL.to_design(np.array([0.004, 0.5, 0.996])), workshop={})  # nearer than half a step
    near = np.array(neighbours(SMALL, edge, np.random.default_rng(0)))
    assert near[:, [0, 2]] == pytest.approx(np.tile([0.004, 0.996], (2 + DRAWN, 1)), abs=1e-3)
