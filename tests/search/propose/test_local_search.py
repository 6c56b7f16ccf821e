"""When a search stands still, and what lies beside its best design."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL

from jumpcad.search.propose.local_search import DRAWN, STEP, Progress, gains, neighbours
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop

HALF = {"theta": {}, "log_improvement": math.log(0.4), "log_feasible": math.log(0.5)}
"""An expected gain of 0.2 of the score's root: a fifth of a score of 4."""
LITTLE = HALF | {"log_improvement": math.log(4e-4)}


def scored(*scores, phase="bo", step=1, **note):
    """Return a step's trials of these scores, along a line, with what the step promised."""
    designs = [SMALL.to_design(np.full(3, 0.1 + 0.2 * place)) for place in range(len(scores))]
    return [
        Trial(phase, step, place, designs[place], Evaluation("jump" if score else "tips"), score, "m", 0.0, note)
        for place, score in enumerate(scores)
    ]


def promised(trials, best=0.0):
    return [promise for promise, _ in gains(trials, best)]


def test_a_promise_is_twice_the_expected_gain_of_the_score_s_root():
    """Over the root of the best before it; times the chance of a jump; of a batch the largest; failures raise none."""
    first = scored(None, None, phase="bo", step=0)
    steps = [*first, *scored(4.0, step=1), *scored(None, step=2, **HALF), *scored(0.5, step=3, **HALF)]
    assert promised(steps) == pytest.approx([0.2, 0.2])
    assert promised(steps, best=16.0) == pytest.approx([0.1, 0.1])
    better = [*steps, *scored(25.0, step=4, **HALF), *scored(1.0, step=5, **HALF)]
    assert promised(better) == pytest.approx([0.2, 0.2, 0.2, 0.08])
    few = [*first, *scored(0.25, step=1), *scored(0.25, step=2, **HALF)]
    assert promised(few) == pytest.approx([0.8])
    assert promised(scored(1.0, phase="ga", **HALF)) == []
    batch = [scored(None, **LITTLE)[0], *scored(None, None, **HALF)[1:]]
    assert promised([*scored(4.0, step=0), *batch]) == pytest.approx([0.2])


def test_a_gain_is_that_of_a_step_s_best_over_the_best_before():
    steps = [*scored(4.0), *scored(2.0, 5.0, step=2, **HALF), *scored(None, step=3, **HALF)]
    assert [found for _, found in gains(steps)] == pytest.approx([0.25, -1.0])
    assert [found for _, found in gains(steps[1:])] == [math.inf, -1.0]  # nothing jumped before


@pytest.mark.parametrize(
    ("steps", "idle", "low"),
    [
        ([(3.9, HALF)], 1, 0),
        ([(3.9, LITTLE), (None, LITTLE)], 2, 2),
        ([(3.9, LITTLE), (3.9, HALF), (3.9, LITTLE)], 3, 1),
        ([(3.9, LITTLE), (4.1, LITTLE)], 0, 0),
        ([(4.03, LITTLE), (4.03, LITTLE)], 2, 2),  # gains of less than 1 %
        ([(4.1, LITTLE), (4.0, LITTLE)], 1, 1),
    ],
)  # fmt: skip
def test_a_search_stands_still_as_long_as_nothing_is_gained(steps, idle, low):
    """After a score of 4, and with 1 % as the least gain: what was promised says only how sure that is."""
    trials = scored(4.0, step=0)
    for number, (score, note) in enumerate(steps, start=1):
        trials += scored(score, step=number, **note)
    assert Progress.of(trials, 0.0, 0.01) == (idle, low)


def test_before_the_first_jump_no_search_stands_still():
    trials = [*scored(None, step=0), *scored(None, step=1, **HALF), *scored(None, step=2, **HALF)]
    assert Progress.of(trials, 0.0, 0.01) == (0, 0)


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
    assert points[:2, 0] == pytest.approx([0.4 + STEP, 0.4 - STEP])
    assert (points[:, 1:] == place[1:]).all()
    assert len(points) == 2 + DRAWN
    names = ["", "any", "683"]
    space = Space.make(fixed=fixed, choices={"bought.leg_bearing": names}, workshop=load_workshop())
    middle = space.to_variant(np.where(np.array(space.categories) > 0, 0.5, 0.4))  # not on a bound, and yet no number
    best = replace(best, design=middle.design, workshop=middle.workshop)
    points = np.array(neighbours(space, best, np.random.default_rng(0)))
    assert (points[:, np.array(space.categories) > 0] == 0.5).all()
    assert len(points) == 4 + DRAWN
    whole = replace(best, design=SMALL.to_design(np.array([0.4, 0.5, 0.6])), workshop={})
    points = np.array(neighbours(SMALL, whole, np.random.default_rng(0)))
    assert len(points) == 6 + DRAWN
    assert (np.abs(points[6:] - [0.4, 0.5, 0.6]) > 0.0).all()
    edge = replace(best, design=SMALL.to_design(np.array([0.004, 0.5, 0.996])), workshop={})  # nearer than half a step
    near = np.array(neighbours(SMALL, edge, np.random.default_rng(0)))
    assert near[:, [0, 2]] == pytest.approx(np.tile([0.004, 0.996], (2 + DRAWN, 1)), abs=1e-3)
    wider = np.array(neighbours(SMALL, whole, np.random.default_rng(0), 2.5)) - [0.4, 0.5, 0.6]
    assert wider == pytest.approx(2.5 * (points - [0.4, 0.5, 0.6]), abs=3e-4)  # of the same draws, to four digits
