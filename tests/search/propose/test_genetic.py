"""PyGAD through the evaluator."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import FIXED, SMALL, TOP, Hill
from support.stages import stage

from jumpcad.findings import bare
from jumpcad.search.propose.genetic import PATIENCE, Fitness, evolve, run_genetic
from jumpcad.search.space import Space
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation
from jumpcad.workshop import load_workshop


def best(trials):
    return max(trial.score or 0.0 for trial in trials)


@pytest.mark.parametrize("evaluations", [1, 7, 20, 53])
def test_the_budget_is_met_exactly(evaluator, evaluations):
    one = evaluator()
    run_genetic(one, stage(evaluations, seed=1))
    assert len(one.trials) == evaluations
    assert len({trial.key for trial in one.trials}) == evaluations


def test_it_climbs_where_chance_does_not(evaluator):
    # Of points within 0.05 of the top of a unit cube there are 0.05 %: chance meets one in 200 with p = 0.1.
    for seed in range(3):
        one = evaluator()
        run_genetic(one, stage(200, seed))
        assert best(one.trials) > 10.0 * np.exp(-2.0 * 0.05**2)
        assert all(trial.evaluation.verdict == "loop" for trial in one.trials if trial.score is None)


def test_what_only_misses_requirements_is_between_the_rejected_and_all_others_and_the_nearer_the_better(evaluator):
    """By shares of typical margins: 10° of 20° is less than 0.09 m of 0.1 m."""
    one = evaluator()
    run_genetic(one, stage(1, 0))
    fitness = Fitness(one, "ga", 1, rejected=-2e12)
    fitness._sizes = {"turn_deg<=30": 20.0, "com_rise_m>=0.2": 0.1}

    def of(score, *missed):
        findings = tuple(bare(name, "error", margin, "") for name, margin in missed)
        evaluation = Evaluation("jump" if missed or score else "loop", {}, findings)
        return fitness.fitness(replace(one.trials[0], evaluation=evaluation, score=score))

    turned, low, limit = ("turn_deg<=30", -10.0), ("com_rise_m>=0.2", -0.09), ("leg_flex", -0.1)
    values = [of(None), of(None, turned, low), of(None, low), of(None, turned), of(-1e12), of(0.0), of(1.0)]
    assert values == sorted(values)
    assert len(set(values)) == 7
    assert of(None, limit, turned) == of(None)


@pytest.mark.thorough
def test_a_space_of_choices_runs_dry(evaluator):
    fixed = [f"{parameter.name}={TOP[parameter.name]}" for parameter in SMALL.free[:1]]
    rest = [f"{p.name}={p.lower}" for p in SMALL.parameters if not p.free]
    names = [parameter.name for parameter in SMALL.free[1:]]
    space = Space.parse(fix=[*rest, *fixed], choose=[f"{names[0]}=25,55,70", f"{names[1]}=10,20"])
    one = evaluator(space=space)
    run_genetic(one, stage(100, 0))
    assert space.size == len(one.trials) == 6


def test_one_free_parameter(evaluator):
    space = Space.parse(
        fix=[f"{p.name}={TOP.get(p.name, p.lower)}" for p in SMALL.parameters if p.name != "rest_angle_deg"]
    )
    for preset in ("recommended", "published"):
        one = evaluator(space=space)
        run_genetic(one, stage(60, 0, preset=preset))
        assert best(one.trials) > 9.9


def test_a_prior_study_seeds_the_population_and_its_designs_cost_nothing(evaluator):
    """docs/searching.md: they are not proposed again. So the new ones are as many as were asked for."""
    teacher, alone = evaluator(), evaluator()
    run_genetic(teacher, stage(300, 0))
    run_genetic(alone, stage(60, 9))
    pupil = evaluator(prior=teacher.trials)
    run_genetic(pupil, stage(60, 9))
    assert len(pupil.trials) == 60
    assert not {trial.key for trial in pupil.trials} & {trial.key for trial in teacher.trials}
    assert best(pupil.trials) > best(alone.trials)


def test_what_a_prior_study_screened_is_no_measurement(evaluator):
    """Such a design is evaluated here; one that was measured there is not."""
    points = ([0.5, 0.5, 0.5], [0.4, 0.5, 0.5])
    measured, screened = evaluator().evaluate([SMALL.to_design(point) for point in points], "ga", 0)
    screened = replace(screened, evaluation=Evaluation(SCREENED, {GUESSED: 99.0}), score=None)
    one = evaluator(prior=[replace(measured, score=77.0), screened])
    fitness = Fitness(one, "ga", 9, rejected=-5.0)
    found = fitness.of_population(SimpleNamespace(generations_completed=0), points, None)
    assert found == [77.0, Hill()(screened.design).metrics["fitness"]]
    assert [trial.key for trial in one.trials] == [screened.key]


@pytest.mark.parametrize("batteries", ["lipo-2s-180,lipo-1s-300", "lipo-1s-300"])
def test_names_have_no_order_for_the_genetic_algorithm_however_few_they_are(monkeypatch, batteries):
    """Two are as little on a scale as many; numbers, choices of them too, are on one."""
    asked = {}
    monkeypatch.setattr("pygad.GA", lambda **given: asked.update(given) or SimpleNamespace(run=lambda: None))
    space = Space.parse(
        fix=FIXED, bound=["body.plate_mm=1.2:2.4"], choose=[f"bought.battery={batteries}", "process.infill=0.2,0.4"],
        workshop=load_workshop(),
    )  # fmt: skip
    fitness = Fitness(SimpleNamespace(space=space, prior=()), "ga", 3, rejected=-5.0)
    evolve(fitness, space.spread(4, np.random.default_rng(0)), {}, 5)
    named = [parameter.name == "bought.battery" for parameter in space.free]
    assert asked["gene_categorical"] == named
    assert sum(named) == ("," in batteries)
    assert asked["random_seed"] == 5
    assert np.shape(asked["initial_population"]) == (4, space.dimension) == (4, len(asked["gene_space"]))


def test_a_search_stops_after_so_many_generations_without_a_new_design_or_when_its_time_is_over(evaluator):
    fitness = Fitness(evaluator(), "ga", 99, rejected=-5.0)
    points = [[0.5, 0.5, 0.5]]
    for generation in range(PATIENCE):
        fitness.of_population(SimpleNamespace(generations_completed=generation), points, None)
        assert fitness.on_generation(None) is None
    fitness.of_population(SimpleNamespace(generations_completed=PATIENCE), points, None)
    assert fitness.on_generation(None) == "stop"
    fitness.of_population(SimpleNamespace(generations_completed=PATIENCE + 1), [[0.4, 0.5, 0.5]], None)
    assert fitness.on_generation(None) is None
    fitness.evaluator.expired = lambda: True
    assert fitness.on_generation(None) == "stop"
