"""PyGAD through the evaluator."""

from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import FIXED, SMALL, TOP

from jumpcad.errors import JumpcadError
from jumpcad.search.methods import Task
from jumpcad.search.methods.genetic import ScreenedFitness, evolve, find_preset, run_genetic
from jumpcad.search.objective import GUESSED, SCREENED, Evaluation
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial
from jumpcad.workshop import load_workshop


def best(trials):
    return max(trial.score or 0.0 for trial in trials)


@pytest.mark.parametrize("evaluations", [1, 7, 20, 53])
def test_the_budget_is_met_exactly(evaluator, evaluations):
    one = evaluator()
    run_genetic(one, Task(evaluations, seed=1))
    assert len(one.trials) == evaluations
    assert len({trial.key for trial in one.trials}) == evaluations


def test_it_climbs_where_chance_does_not(evaluator):
    # Of points within 0.05 of the top of a unit cube there are 0.05 %: chance meets one in 200 with p = 0.1.
    for seed in range(3):
        one = evaluator()
        run_genetic(one, Task(200, seed))
        assert best(one.trials) > 10.0 * np.exp(-2.0 * 0.05**2)
        assert all(trial.evaluation.verdict == "loop" for trial in one.trials if trial.score is None)


def test_seed_decides_everything(evaluator):
    runs = []
    for seed in (5, 5, 6):
        one = evaluator()
        run_genetic(one, Task(80, seed))
        runs.append([trial.key for trial in one.trials])
    assert runs[0] == runs[1] != runs[2]


def test_published_preset_replaces_five_genes(evaluator):
    settings = find_preset("published")
    assert settings.population == 10
    assert settings.operators["mutation_num_genes"] == 5
    assert settings.operators["keep_parents"] == 2
    assert settings.operators["num_parents_mating"] == 5
    assert settings.operators["keep_elitism"] == 0
    one = evaluator(space=Space.default())
    run_genetic(one, Task(60, 0, preset="published"))
    assert len(one.trials) == 60


def test_a_space_of_choices_runs_dry(evaluator):
    fixed = [f"{parameter.name}={TOP[parameter.name]}" for parameter in SMALL.free[:1]]
    rest = [f"{p.name}={p.lower}" for p in SMALL.parameters if not p.free]
    names = [parameter.name for parameter in SMALL.free[1:]]
    space = Space.parse(fix=[*rest, *fixed], choose=[f"{names[0]}=25,55,70", f"{names[1]}=10,20"])
    one = evaluator(space=space)
    run_genetic(one, Task(100, 0))
    assert space.size == len(one.trials) == 6


def test_one_free_parameter(evaluator):
    space = Space.parse(
        fix=[f"{p.name}={TOP.get(p.name, p.lower)}" for p in SMALL.parameters if p.name != "rest_angle_deg"]
    )
    for preset in ("recommended", "published"):
        one = evaluator(space=space)
        run_genetic(one, Task(60, 0, preset=preset))
        assert best(one.trials) > 9.9


def test_a_prior_study_seeds_the_population(evaluator):
    teacher = evaluator()
    run_genetic(teacher, Task(300, 0))
    pupil = evaluator(prior=teacher.trials)
    run_genetic(pupil, Task(20, 9))
    assert best(pupil.trials) == best(teacher.trials)


def test_unknown_preset():
    with pytest.raises(JumpcadError, match="did you mean published"):
        find_preset("publishd")


def test_what_a_screen_leaves_out_has_the_score_that_was_guessed():
    fitness = object.__new__(ScreenedFitness)
    fitness.rejected = -1.0
    design = SMALL.to_design([0.5, 0.5, 0.5])
    for metrics, score in (({GUESSED: 2.5}, 2.5), ({}, -1.0)):
        trial = Trial("ga", 0, 0, design, Evaluation(SCREENED, metrics), None, "m", 0.0)
        assert fitness.fitness(trial) == score
    assert fitness.fitness(Trial("ga", 0, 0, design, Evaluation("jump"), 3.5, "m", 0.0)) == 3.5


@pytest.mark.parametrize("batteries", ["lipo-2s-180,lipo-1s-300", "lipo-1s-300"])
def test_names_have_no_order_for_the_genetic_algorithm_however_few_they_are(monkeypatch, batteries):
    """Two are as little on a scale as many; numbers, choices of them too, are on one."""
    asked = {}
    monkeypatch.setattr("pygad.GA", lambda **given: asked.update(given) or SimpleNamespace(run=lambda: None))
    space = Space.parse(
        fix=FIXED, bound=["body.plate_mm=1.2:2.4"], choose=[f"bought.battery={batteries}", "process.infill=0.2,0.4"],
        workshop=load_workshop(),
    )  # fmt: skip
    fitness = SimpleNamespace(left=3, evaluator=SimpleNamespace(space=space))
    evolve(fitness, space.spread(4, np.random.default_rng(0)), {}, 5)
    named = [parameter.name == "bought.battery" for parameter in space.free]
    assert asked["gene_categorical"] == named
    assert sum(named) == ("," in batteries)
    assert asked["random_seed"] == 5
    assert np.shape(asked["initial_population"]) == (4, space.dimension) == (4, len(asked["gene_space"]))
