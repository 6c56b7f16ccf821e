"""Searches for a front: how much of the true one they find, and resumption."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import SMALL, Hill
from support.stages import stage

from jumpcad.search.fronts import SPRING_ENERGY, find_cost, front, hypervolume
from jumpcad.search.propose.pareto import ParetoFitness, energy_caps_j, run_nsga2, run_pareto
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

GRID = np.array(np.meshgrid(*[np.linspace(0, 1, 21)] * 3)).reshape(3, -1).T


def trials_of(model, points):
    """Return the trials of designs at points of the unit cube."""
    designs = [SMALL.to_design(point) for point in points]
    found = [(design, model(design)) for design in designs]
    return [
        Trial("pareto", 0, place, design, one, one.metrics.get("fitness"), "m", 0.0)
        for place, (design, one) in enumerate(found)
    ]


def test_caps_end_at_the_largest_energy():
    # At c = 1 there is no tilt: half of 30 N·mm/deg times the square of 0.8 of 70°; c = 1.2 tilts the body and adds.
    plain = Space.parse(fix=["c_coef=1"])
    largest = 0.5 * 30e-3 * np.degrees(1.0) * np.radians(0.8 * 70.0) ** 2
    assert energy_caps_j(plain)[-1] == pytest.approx(largest, rel=1e-12)
    assert energy_caps_j(Space.default())[-1] > 1.1 * largest


def dominated_share(evaluator):
    """Return the area under the true front that an evaluator's front misses, as a share."""
    return hypervolume(evaluator.trials) / hypervolume(trials_of(Hill(), GRID))


@pytest.mark.thorough
def test_constrained_improvement_finds_the_front(evaluator):
    one = evaluator()
    run_pareto(one, stage(41, 0, initial=9))
    assert len(one.trials) == 41
    assert dominated_share(one) > 0.99


@pytest.mark.thorough
def test_nsga2_finds_most_of_it(evaluator):
    one = evaluator()
    run_nsga2(one, stage(300, 0))
    assert len(one.trials) == 300
    assert dominated_share(one) > 0.95


def test_nsga2_begins_with_the_front_of_a_prior_study(evaluator):
    """Its designs are not evaluated again."""
    teacher, alone = evaluator(), evaluator()
    run_nsga2(teacher, stage(300, 0))
    run_nsga2(alone, stage(60, 1))
    pupil = evaluator(prior=teacher.trials)
    run_nsga2(pupil, stage(60, 1))
    assert len(pupil.trials) == 60
    assert not {trial.key for trial in pupil.trials} & {trial.key for trial in teacher.trials}
    assert hypervolume(pupil.trials) > hypervolume(alone.trials)


def test_whatever_jumps_is_better_than_what_is_rejected(evaluator):
    """An own objective may give any score down to -1e12."""
    fitness = ParetoFitness(evaluator(), "nsga2", 10)
    jumps = Trial("nsga2", 0, 0, SMALL.to_design([0.5] * 3), Evaluation("jump"), -1e12, "m", 0.0)
    rejected = fitness.fitness(replace(jumps, score=None))
    assert all(good > bad for good, bad in zip(fitness.fitness(jumps), rejected, strict=True))


def test_of_two_that_score_alike_the_one_with_less_energy_is_as_good_or_better():
    """PyGAD maximises both objectives."""
    designs = [SMALL.to_design(point) for point in ([0.5, 0.5, 0.2], [0.5, 0.5, 0.8])]
    frugal, strong = sorted(designs, key=lambda design: design.stiffness_nmm_per_deg)
    found = [
        ParetoFitness.objectives(
            SimpleNamespace(cost=SPRING_ENERGY), Trial("nsga2", 0, 0, design, Evaluation("jump"), 3.0, "m", 0.0)
        )
        for design in (frugal, strong)
    ]
    assert frugal.spring_energy_j < strong.spring_energy_j
    assert found[0][0] == found[1][0] == 3.0
    assert found[0][1] > found[1][1]


@pytest.mark.usefixtures("quick_proposals_once")
def test_a_front_resumes(evaluator, tmp_path):
    whole, first = evaluator(), evaluator(tmp_path / "s.db")
    run_pareto(whole, stage(21, 0, initial=9))
    run_pareto(first, stage(13, 0, initial=9))
    first.store.close()
    longer = evaluator(tmp_path / "s.db")
    run_pareto(longer, stage(21, 0, initial=9))
    assert [trial.key for trial in longer.trials] == [trial.key for trial in whole.trials]


class Weighed(Hill):
    """A hill whose robots weigh the more the stiffer their springs are, and rise the higher the less they are wound."""

    def __call__(self, design):
        found = super().__call__(design)
        more = {"mass_kg": 0.05 + 0.002 * design.stiffness_nmm_per_deg, "com_rise_m": 1.0 - design.compression_ratio}
        return Evaluation(found.verdict, {**found.metrics, **more}, found.findings) if found.metrics else found


@pytest.mark.thorough
@pytest.mark.parametrize("against", ["mass", "rise"])
def test_a_cost_that_is_not_known_before_is_learned(evaluator, against):
    """Two planes; much less of the true front's area is missed than by random designs."""
    one, cost = evaluator(model=Weighed()), find_cost(against)
    run_pareto(one, stage(41, 0, initial=9, against=against))
    true, random = (trials_of(Weighed(), points) for points in (GRID, SMALL.spread(41, np.random.default_rng(1))))
    whole, found, drawn = (hypervolume(trials, cost=cost) for trials in (true, one.trials, random))
    assert whole - found < (0.4 if against == "mass" else 0.6) * (whole - drawn)
    costs = [cost.of(trial) for trial in front(one.trials, cost)]
    assert costs == sorted(costs)
