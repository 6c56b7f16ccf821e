"""A search method is its own module and one line: choices, help, plan and study file follow."""

from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL, Hill
from support.stages import stage

from jumpcad.search.methods import LEARNING_PHASES, METHODS, NAMES, Method
from jumpcad.search.space import Space
from jumpcad.search.study import request
from jumpcad.search.study.request import Request, plan_stages
from jumpcad.search.study.run import run_stage


@pytest.mark.parametrize("name", [name for name in METHODS if name != "paper"])  # it runs others
def test_every_method_spends_its_evaluations_in_a_phase_of_its_name(evaluator, name):
    one = evaluator()
    assert run_stage(one, replace(stage(12, seed=0, initial=4, batch=2), method=name)) is False  # it did not end early
    assert len(one.trials) == 12
    assert {trial.phase for trial in one.trials} == {name}
    learned = [trial for trial in one.trials if "theta" in trial.proposal]
    assert bool(learned) == METHODS[name].learns == (name in LEARNING_PHASES)


@pytest.mark.parametrize("name", [name for name in METHODS if name != "paper"])
def test_the_first_designs_follow_from_the_seed(evaluator, name):
    runs = []
    for seed in (0, 0, 1):
        one = evaluator()
        run_stage(one, replace(stage(4, seed=seed, initial=4), method=name))
        runs.append([trial.key for trial in one.trials])
    assert runs[0] == runs[1]
    assert not set(runs[1]) & set(runs[2])


@pytest.mark.parametrize("name", ["ga", "nsga2"])
def test_generations_follow_from_the_seed(evaluator, monkeypatch, name):
    """Of the same first population."""
    spread = Space.spread
    monkeypatch.setattr(Space, "spread", lambda self, count, _: spread(self, count, np.random.default_rng(0)))
    runs = []
    for seed in (0, 0, 1):
        one = evaluator()
        run_stage(one, replace(stage(60, seed=seed), method=name))
        steps = [[trial.key for trial in one.trials if (trial.step == 0) == first] for first in (True, False)]
        runs.append(steps)
    assert runs[0] == runs[1]
    assert runs[0][0] == runs[2][0]
    assert runs[0][1] != runs[2][1]


@pytest.mark.thorough
@pytest.mark.parametrize("name", [name for name, method in METHODS.items() if method.learns])
def test_proposals_follow_from_the_seed(evaluator, name):
    """From the same first designs, which another search has evaluated; seeds of `bo` find the same best proposals."""
    points = SMALL.spread(8, np.random.default_rng(0))
    runs = []
    for seed in (0, 0, 1):
        one = evaluator()
        one.evaluate([SMALL.to_variant(point) for point in points], "sample", 0)
        run_stage(one, replace(stage(3, seed=seed), method=name))
        runs.append([trial.key for trial in one.trials[8:]])
    assert len(runs[0]) == 3
    assert runs[0] == runs[1]
    assert name == "bo" or runs[0] != runs[2]


def test_a_new_method_needs_one_line(evaluator, monkeypatch):
    """Random search, as one would add it."""

    def run_random(one, stage):
        points = np.random.default_rng(stage.request.seed).random((stage.evaluations, one.space.dimension))
        one.evaluate([one.space.to_design(point) for point in points], "sample", 0)

    monkeypatch.setattr("jumpcad.search.propose.genetic.run_random", run_random, raising=False)
    monkeypatch.setitem(METHODS, "random", Method("random", "genetic.run_random", "uniformly random designs"))
    monkeypatch.setattr(request, "NAMES", (*NAMES, "random"))
    (planned,) = plan_stages(Request(SMALL, Hill(), method="random", evaluations=9, seed=1))
    assert (planned.method, planned.evaluations, planned.initial) == ("random", 9, 0)
    one = evaluator()
    run_stage(one, planned)
    assert len(one.trials) == 9
