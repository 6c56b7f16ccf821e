"""When a search stands still, and what lies beside its best design."""

from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL
from support.stages import scored

from jumpcad.search.propose.local_search import DRAWN, STEP, idle_steps, neighbours
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop

NOTE = {"theta": {}}


def test_a_search_stands_still_as_long_as_nothing_is_gained():
    """After a score of 4, and with 1 % as the least gain; of a batch the best counts, other methods do not."""
    for steps, idle in (
        ([(3.9,)], 1), ([(3.9,), (None,)], 2), ([(3.9,), (4.1,)], 0), ([(4.03,), (4.03,)], 2), ([(4.1,), (4.0,)], 1),
        ([(3.9, 4.1)], 0), ([(4.1, 3.9), (4.0, 4.1)], 1),
    ):  # fmt: skip
        trials = scored(4.0, step=0)
        for number, scores in enumerate(steps, start=1):
            trials += scored(*scores, step=number, **NOTE)
        assert idle_steps(trials, 0.0, 0.01) == idle, steps
        assert idle_steps([replace(one, phase="ga") for one in trials], 0.0, 0.01) == 0
        assert idle_steps(trials, 9.0, 0.01) == len(steps)  # what was known before is better


def test_before_the_first_jump_no_search_stands_still():
    trials = [*scored(None, step=0), *scored(None, step=1, **NOTE), *scored(None, step=2, **NOTE)]
    assert idle_steps(trials, 0.0, 0.01) == 0


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
    whole = replace(best, design=SMALL.to_design(np.array([0.4, 0.5, 0.6])), workshop={})
    points = np.array(neighbours(SMALL, whole, np.random.default_rng(0)))
    assert len(points) == 6 + DRAWN
    assert (np.abs(points[6:] - [0.4, 0.5, 0.6]) > 0.0).all()
    edge = replace(best, design=SMALL.to_design(np.array([0.004, 0.5, 0.996])), workshop={})  # nearer than half a step
    near = np.array(neighbours(SMALL, edge, np.random.default_rng(0)))
    assert near[:, [0, 2]] == pytest.approx(np.tile([0.004, 0.996], (2 + DRAWN, 1)), abs=1e-3)
    wider = np.array(neighbours(SMALL, whole, np.random.default_rng(0), 2.5)) - [0.4, 0.5, 0.6]
    assert wider == pytest.approx(2.5 * (points - [0.4, 0.5, 0.6]), abs=3e-4)  # of the same draws, to four digits
