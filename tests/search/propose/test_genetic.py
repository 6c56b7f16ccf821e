"""PyGAD through the evaluator."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import FIXED, SMALL, TOP, Hill
from support.stages import stage

from jumpcad.search.models import robot_model
from jumpcad.search.propose import genetic
from jumpcad.search.propose.genetic import (
    PATIENCE,
    SETTINGS,
    Fitness,
    ScreenedFitness,
    _first_population,
    _gene_space,
    evolve,
    run_genetic,
)
from jumpcad.search.space import Space
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop


def best(trials):
    return max(trial.score or 0.0 for trial in trials)


@pytest.mark.parametrize("evaluations", [1, 7, 20, 53])
def test_the_budget_is_met_exactly(evaluator, evaluations):
    one = evaluator()
    run_genetic(one, stage(evaluations, seed=1))
    assert len(one.trials) == evaluations
    assert len({trial.key for trial in one.trials}) == evaluations


def test_a_rejected_design_is_worse_than_any_score_that_an_objective_may_give(evaluator, monkeypatch):
    """Own objectives give at least -1e12."""
    seen = []
    monkeypatch.setattr(genetic, "evolve", lambda score, *_others: seen.append(score))
    run_genetic(evaluator(), stage(20, seed=1))
    (score,) = seen
    design = SMALL.to_design([0.5, 0.5, 0.5])
    worst, refused = (
        Trial("ga", 0, 0, design, Evaluation("jump"), -1e12, "m", 0.0),
        Trial("ga", 0, 1, design, Evaluation("loop"), None, "m", 0.0),
    )
    assert score.fitness(refused) < score.fitness(worst) == -1e12


def test_it_climbs_where_chance_does_not(evaluator):
    # Of points within 0.05 of the top of a unit cube there are 0.05 %: chance meets one in 200 with p = 0.1.
    for seed in range(3):
        one = evaluator()
        run_genetic(one, stage(200, seed))
        assert best(one.trials) > 10.0 * np.exp(-2.0 * 0.05**2)
        assert all(trial.evaluation.verdict == "loop" for trial in one.trials if trial.score is None)


def test_seed_decides_everything(evaluator):
    runs = []
    for seed in (5, 5, 6):
        one = evaluator()
        run_genetic(one, stage(80, seed))
        runs.append([trial.key for trial in one.trials])
    assert runs[0] == runs[1] != runs[2]


def test_published_preset_replaces_five_genes(evaluator):
    settings = SETTINGS["published"]
    assert settings.population == 10
    assert settings.operators["mutation_num_genes"] == 5
    assert settings.operators["keep_parents"] == 2
    assert settings.operators["num_parents_mating"] == 5
    assert settings.operators["keep_elitism"] == 0
    one = evaluator(space=Space.default())
    run_genetic(one, stage(60, 0, preset="published"))
    assert len(one.trials) == 60


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
    found = Fitness(one, "ga", 9, rejected=-5.0)(SimpleNamespace(generations_completed=0), points, None)
    assert found == [77.0, Hill()(screened.design).metrics["fitness"]]
    assert [trial.key for trial in one.trials] == [screened.key]


def test_a_screen_looks_at_each_candidate_once(monkeypatch):
    """A study that holds all of a generation says what was left out: nothing is guessed or learned again."""
    variants, asked, held = [SMALL.to_variant([share, 0.5, 0.5]) for share in (0.2, 0.4, 0.6)], [], set()
    fitness = object.__new__(ScreenedFitness)
    fitness._seen = set()
    fitness.evaluator = SimpleNamespace(
        holds=lambda one: one.key in held, trials=[], store=SimpleNamespace(recall=lambda _: None)
    )
    fitness._screen = SimpleNamespace(
        learn=lambda *_: False, outcomes=lambda fresh, best: asked.append(([*fresh], best)) or {"some": "outcome"}
    )
    assert fitness.left_out(variants[:2]) == {"some": "outcome"}
    assert fitness.left_out(variants) == {"some": "outcome"}
    assert fitness.left_out(variants) == {}
    assert asked == [(variants[:2], 0.0), (variants[2:], 0.0)]
    again = SMALL.to_variant([0.8, 0.5, 0.5])
    held.add(again.key)
    assert fitness.left_out([again]) == {}


def test_what_a_screen_leaves_out_has_the_score_that_was_guessed():
    fitness = object.__new__(ScreenedFitness)
    fitness.rejected = -1.0
    design = SMALL.to_design([0.5, 0.5, 0.5])
    for metrics, score in (({GUESSED: 2.5}, 2.5), ({}, -1.0)):
        trial = Trial("ga", 0, 0, design, Evaluation(SCREENED, metrics), None, "m", 0.0)
        assert fitness.fitness(trial) == score
    assert fitness.fitness(Trial("ga", 0, 0, design, Evaluation("jump"), 3.5, "m", 0.0)) == 3.5


def test_a_search_with_a_screen_begins_at_its_own_step(monkeypatch):
    monkeypatch.setattr("jumpcad.search.estimate.corrected_estimate.Screen", lambda *given: given)
    evaluator = SimpleNamespace(model=robot_model(), space="space", objective="objective", prior=[])
    fitness = ScreenedFitness(evaluator, "ga", 9, -2.0, 40)
    assert (fitness.phase, fitness.left, fitness.rejected, fitness.run) == ("ga", 9, -2.0, 40)


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


def test_a_population_has_the_scores_of_its_designs_in_their_order(evaluator):
    """What is rejected, or beyond the evaluations, has the same fitness; steps are counted on from the first."""
    one = evaluator()
    fitness = Fitness(one, "ga", 3, rejected=-5.0, run=40)
    points = [[0.5, 0.5, 0.5], [1.0, 0.5, 0.5], [0.2, 0.5, 0.5], [0.3, 0.5, 0.5]]
    found = fitness(SimpleNamespace(generations_completed=2), points, None)
    exact = [Hill()(SMALL.to_design(point)).metrics.get("fitness") for point in points]
    assert found == [exact[0], -5.0, exact[2], -5.0]
    assert exact[1] is None
    assert [trial.position for trial in one.trials] == [("ga", 40, 2, n) for n in range(3)]
    assert fitness.left == 0
    assert fitness.on_generation(None) == "stop"


def test_a_search_stops_after_so_many_generations_without_a_new_design_or_when_its_time_is_over(evaluator):
    fitness = Fitness(evaluator(), "ga", 99, rejected=-5.0)
    points = [[0.5, 0.5, 0.5]]
    for generation in range(PATIENCE):
        fitness(SimpleNamespace(generations_completed=generation), points, None)
        assert fitness.on_generation(None) is None
    fitness(SimpleNamespace(generations_completed=PATIENCE), points, None)
    assert fitness.on_generation(None) == "stop"
    fitness(SimpleNamespace(generations_completed=PATIENCE + 1), [[0.4, 0.5, 0.5]], None)
    assert fitness.on_generation(None) is None
    fitness.evaluator.expired = lambda: True
    assert fitness.on_generation(None) == "stop"


def test_half_of_a_first_population_are_the_best_of_a_prior_study(evaluator):
    """The best first, then evenly spread ones; all within the space, each coordinate free or one of its choices."""
    teacher = evaluator()
    run_genetic(teacher, stage(40, 0))
    ranked = sorted((trial for trial in teacher.trials if trial.score is not None), key=lambda trial: -trial.score)
    found = _first_population(evaluator(prior=teacher.trials), 10, 3)
    assert found[:5] == pytest.approx(np.array([SMALL.to_unit(trial.variant) for trial in ranked[:5]]))
    assert found[5:] == pytest.approx(_first_population(evaluator(), 10, 3)[:5])
    space = Space.parse(fix=FIXED[:-1], choose=["stiffness_nmm_per_deg=10,20,30"])
    genes = dict(zip([one.name for one in space.free], _gene_space(space), strict=True))
    assert genes["stiffness_nmm_per_deg"] == [0.0, 0.5, 1.0]
    assert genes["rest_angle_deg"] == {"low": 0.0, "high": 1.0}
