"""Views of the space show the known facts of the hill."""

import numpy as np
import pytest
from support.hills import FIXED, SMALL, TOP

from jumpcad.errors import JumpcadError
from jumpcad.search.explore import components, elite, feasibility_map, importance, sample, sweep
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

CENTRE = SMALL.to_design([0.5, 0.5, 0.5])


def test_sweeps_peak_at_the_top(evaluator):
    for one in sweep(evaluator(), CENTRE, 26):
        scores = [trial.score or 0.0 for trial in one.trials]
        step = one.values[1] - one.values[0]
        assert abs(one.values[int(np.argmax(scores))] - TOP[one.parameter]) <= step / 2 + 1e-9


def test_sampled_components_are_equal_and_the_elite_s_are_not(evaluator):
    one = evaluator(space=Space.default())
    trials = sample(one, 512, 0)
    every, best = components(one, trials), components(one, elite(trials))
    assert every.shares == pytest.approx(np.full(8, 1 / 8), abs=0.01)
    assert every.shares.sum() == pytest.approx(1.0)
    # The hill confines three of eight parameters, so that standardised or not, chance alone spreads the rest.
    assert best.shares[0] > every.shares[0]
    assert best.directions @ best.directions.T == pytest.approx(np.eye(8), abs=1e-9)


def test_samples_and_what_is_permuted_follow_from_the_seed(evaluator):
    drawn = [sample(evaluator(), 32, seed) for seed in (0, 0, 1)]
    keys = [[trial.key for trial in trials] for trials in drawn]
    assert keys[0] == keys[1]
    assert not set(keys[0]) & set(keys[2])
    falls = [importance(evaluator(), drawn[0], seed).mean.tolist() for seed in (0, 0, 1)]
    assert falls[0] == falls[1] != falls[2]


@pytest.mark.thorough
def test_importance_knows_which_parameters_decide(evaluator):
    one = evaluator(space=Space.default())
    found = importance(one, sample(one, 300, 0), 0)
    assert found.r_squared > 0.9
    assert found.designs < 300
    ranked = {found.names[index] for index in np.argsort(-found.mean)[:3]}
    assert ranked == set(TOP)
    assert np.abs(found.mean[[name not in TOP for name in found.names]]).max() < 0.02


def scored(scores):
    """Return trials that are drawn at random, with these scores."""
    points = np.random.default_rng(1).random((len(scores), 3))
    return [
        Trial("sample", 0, number, SMALL.to_design(point), Evaluation("jump"), float(score), "m", 0.0)
        for number, (point, score) in enumerate(zip(points, scores, strict=True))
    ]


def test_equal_scores_do_not_say_what_is_important(evaluator):
    with pytest.raises(JumpcadError, match="20 of 20 designs jump, and score alike: nothing says what is important"):
        importance(evaluator(), scored(np.ones(20)), 0)


def test_feasibility_map_shows_the_border(evaluator):
    found = feasibility_map(evaluator(), CENTRE, "rest_angle_deg", "compression_ratio", 15)
    for y, line in zip(found.y, found.trials, strict=True):
        assert {trial.evaluation.verdict for trial in line} == ({"loop"} if y > 0.7 else {"jump"})


def test_a_sweep_has_so_many_values_from_bound_to_bound(evaluator):
    """Evenly; all other parameters are those of the design around which it goes."""
    for one, parameter in zip(sweep(evaluator(), CENTRE, 5), SMALL.free, strict=True):
        assert one.values == pytest.approx(np.linspace(parameter.lower, parameter.upper, 5))
        assert len(one.trials) == 5
        for value, trial in zip(one.values, one.trials, strict=True):
            assert trial.design == CENTRE.model_copy(update={one.parameter: value})


def test_too_little_to_look_at(evaluator):
    with pytest.raises(JumpcadError, match="samples = 5"):
        sample(evaluator(), 5, 0)
    with pytest.raises(JumpcadError, match="points = 1"):
        sweep(evaluator(), CENTRE, 1)
    with pytest.raises(JumpcadError, match="too few"):
        components(evaluator(), [])
    few = evaluator(space=Space.default())
    trials = sample(few, 20, 0)
    assert components(few, trials[:3]).designs == 3
    with pytest.raises(JumpcadError, match="2 designs: too few"):
        components(few, trials[:2])
    with pytest.raises(JumpcadError, match="not a free parameter"):
        feasibility_map(evaluator(), CENTRE, "c_coef", "rest_angle_deg", 3)
    with pytest.raises(JumpcadError, match="twice"):
        feasibility_map(evaluator(), CENTRE, "rest_angle_deg", "rest_angle_deg", 3)
    blind = evaluator(space=Space.parse(fix=["compression_ratio=0.75"]))
    with pytest.raises(JumpcadError, match="0 of 32 designs jump"):
        importance(blind, sample(blind, 32, 0), 0)


def test_shares_are_those_of_the_correlations(evaluator):
    """Of standardised parameters: the eigenvalues of their correlation matrix over its trace, however wide each is."""
    one = evaluator(space=Space.default())
    trials = elite(sample(one, 200, 0))
    found = components(one, trials)
    values = np.array([trial.design.to_vector() for trial in trials])
    eigenvalues, vectors = np.linalg.eigh(np.corrcoef(values.T))
    assert values.std(axis=0).max() > 100.0 * values.std(axis=0).min()
    assert found.shares == pytest.approx(eigenvalues[::-1] / 8.0, abs=1e-9)
    assert np.abs(found.directions @ vectors[:, ::-1]) == pytest.approx(np.eye(8), abs=1e-6)


def test_what_is_fixed_has_its_value_in_every_view(evaluator):
    """Also where the design that is looked at has another."""
    fixed = Space.parse(fix=[*FIXED, "stiffness_nmm_per_deg=20"])
    one = evaluator(space=fixed)
    assert CENTRE.stiffness_nmm_per_deg != 20.0
    over = feasibility_map(one, CENTRE, "rest_angle_deg", "compression_ratio", 2)
    seen = [
        *(trial for view in sweep(one, CENTRE, 3) for trial in view.trials),
        *(t for line in over.trials for t in line),
    ]
    assert {trial.design.stiffness_nmm_per_deg for trial in seen} == {20.0}
    assert all(fixed.contains(trial.design) for trial in seen)


def test_the_elite_are_a_tenth_or_twenty(evaluator):
    one = evaluator(space=Space.default())
    trials = sample(one, 300, 0)
    scores = sorted((trial.score for trial in trials if trial.score is not None), reverse=True)
    assert [trial.score for trial in elite(trials)] == scores[: round(0.1 * len(scores))]
    some = [trial for trial in trials if trial.score is not None][:150]
    assert len(elite(some)) == 20
    assert len(elite(some[:7])) == 7
