"""Searches for a front: how much of the true one they find, and resumption."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import SMALL, Hill
from support.stages import stage

from jumpcad.search.fronts import SPRING_ENERGY, find_cost, front, hypervolume
from jumpcad.search.propose import pareto
from jumpcad.search.propose.pareto import ParetoFitness, energy_caps_j, run_nsga2, run_pareto
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop


def test_caps_end_at_the_largest_energy():
    # At c = 1 there is no tilt: half of 30 N·mm/deg times the square of 0.8 of 70°; c = 1.2 tilts the body and adds.
    plain = Space.parse(fix=["c_coef=1"])
    largest = 0.5 * 30e-3 * np.degrees(1.0) * np.radians(0.8 * 70.0) ** 2
    assert energy_caps_j(plain)[-1] == pytest.approx(largest, rel=1e-12)
    assert energy_caps_j(Space.default())[-1] > 1.1 * largest


def test_values_of_the_workshop_add_no_corners(monkeypatch):
    """Of eleven free parameters, 2⁸ corners, and the same caps."""
    bounds = {"body.plate_mm": (1.6, 2.4), "body.stop_deg": (4.0, 6.0), "process.infill": (0.1, 0.5)}
    wide = Space.make(bounds=bounds, workshop=load_workshop())
    assert wide.dimension == 11
    rows = []
    energies = pareto.energies_j
    monkeypatch.setattr(pareto, "energies_j", lambda values: rows.append(len(values)) or energies(values))
    assert energy_caps_j(wide) == pytest.approx(energy_caps_j(Space.default()))
    assert rows == [256, 256]


def dominated_share(evaluator):
    """Return the area under the true front that an evaluator's front misses, as a share."""
    grid = np.array(np.meshgrid(*[np.linspace(0, 1, 21)] * 3)).reshape(3, -1).T
    true = []
    for place, point in enumerate(grid):
        design = SMALL.to_design(point)
        score = Hill()(design).metrics.get("fitness")
        true.append(Trial("pareto", 0, place, design, Evaluation("jump"), score, "m", 0.0))
    return hypervolume(evaluator.trials) / hypervolume(true)


@pytest.mark.thorough
def test_constrained_improvement_finds_the_front(evaluator):
    one = evaluator()
    run_pareto(one, stage(41, 0, initial=9))
    assert len(one.trials) == 41
    assert dominated_share(one) > 0.99


def test_every_cap_asks_for_more_than_the_best_below_it(evaluator, monkeypatch):
    """Where energy is all that counts; more than the cap is penalised by 1 at a hundredth above it, and less is not."""

    class Strong(Hill):
        def __call__(self, design):
            return Evaluation("jump", {"fitness": design.spring_energy_j})

    asked, look = [], pareto.propose
    monkeypatch.setattr(pareto, "propose", lambda *given, **more: asked.append(more) or look(*given, **more))
    one = evaluator(model=Strong())
    run_pareto(one, stage(17, 0, initial=9))
    caps = energy_caps_j(SMALL)
    bests = [
        max((trial.score or 0.0 for trial in one.trials[:9] if trial.design.spring_energy_j <= cap), default=0.0)
        for cap in caps
    ]
    assert [given["best"] for given in asked] == bests
    assert len(set(bests)) > 1
    for cap, given in zip(caps, asked, strict=True):
        points = np.array([SMALL.to_unit(trial.variant) for trial in one.trials])
        over = np.array([trial.design.spring_energy_j for trial in one.trials]) / cap - 1.0
        expected = np.where(over > 0.0, (100.0 * over) ** 2, 0.0)
        np.testing.assert_allclose(given["penalty"](points), expected, rtol=1e-6, atol=1e-12)
        assert all(SMALL.to_design(point).spring_energy_j <= cap for point in given["elite"])


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
    grid = np.array(np.meshgrid(*[np.linspace(0, 1, 21)] * 3)).reshape(3, -1).T
    true = [trial_of(Weighed(), SMALL.to_design(point), place) for place, point in enumerate(grid)]
    random = [trial_of(Weighed(), SMALL.to_design(point), 0) for point in SMALL.spread(41, np.random.default_rng(1))]
    whole, found, drawn = (hypervolume(trials, cost=cost) for trials in (true, one.trials, random))
    assert whole - found < (0.4 if against == "mass" else 0.6) * (whole - drawn)
    costs = [cost.of(trial) for trial in front(one.trials, cost)]
    assert costs == sorted(costs)


def trial_of(model, design, place):
    """Return the trial of a design."""
    found = model(design)
    return Trial("pareto", 0, place, design, found, found.metrics.get("fitness"), "m", 0.0)


def test_a_cap_is_kept_as_probably_as_the_process_of_the_cost_says(evaluator):
    """Far below the cap there is no penalty; at a cost of the cap it is ln 2; and the last cap is none."""
    trials = [trial_of(Weighed(), SMALL.to_design(p), 0) for p in SMALL.spread(40, np.random.default_rng(0))]
    cost = find_cost("mass")
    caps = pareto._caps(SMALL, cost, trials)
    jumped = [cost.of(trial) for trial in trials if trial.score is not None]
    assert [cap for cap, _ in caps] == pytest.approx([*np.linspace(min(jumped), max(jumped), 8)[:-1], np.inf])
    assert caps[-1][1] is None
    cap, penalty = caps[3]
    stiffness = (cap - 0.05) / 0.002
    at = SMALL.to_unit(SMALL.to_design([0.4, 0.4, 0.4]))[None].repeat(3, axis=0)
    stiff = next(i for i, one in enumerate(SMALL.free) if one.name == "stiffness_nmm_per_deg")
    at[:, stiff] = [0.0, (stiffness - 5.0) / 25.0, 1.0]
    light, middle, heavy = penalty(at)
    assert light == pytest.approx(0.0, abs=1e-6)
    assert middle == pytest.approx(np.log(2.0), rel=0.2)
    assert heavy > 10.0
    assert pareto._caps(SMALL, cost, []) == [(np.inf, None)] * 8


def test_nsga2_begins_with_the_prior_s_front_against_its_own_cost_and_spread_designs_of_its_seed(
    evaluator, monkeypatch
):
    """Of designs that jump, fewer are on a front against the mass, which is the stiffness, than against the energy."""
    begun = []
    monkeypatch.setattr(pareto, "evolve", lambda fitness, first, operators, seed: begun.append((first.tolist(), seed)))
    points = SMALL.spread(32, np.random.default_rng(5))
    prior = [trial_of(Weighed(), SMALL.to_design(point), n) for n, point in enumerate(points)]
    for seed, against in ((3, "mass"), (3, "mass"), (4, "mass"), (3, "spring-energy")):
        one = evaluator(model=Weighed(), prior=prior)
        run_nsga2(one, stage(60, seed, against=against))
    (mass, seed), again, (other, another), (energy, _) = begun
    assert (seed, another) == (3, 4)
    assert again == (mass, seed)
    fronts = [front(prior, find_cost(name)) for name in ("mass", "spring-energy")]
    assert 1 < len(fronts[0]) < len(fronts[1]) < 20
    for found, best in ((mass, fronts[0]), (other, fronts[0]), (energy, fronts[1])):
        assert len(found) == 40
        assert found[: len(best)] == [SMALL.to_unit(trial.variant).tolist() for trial in best]
    count = len(fronts[0])
    assert not any(point in mass[count:] for point in other[count:])


@pytest.mark.usefixtures("quick_proposals_once")
def test_a_front_of_a_learned_cost_resumes(evaluator, tmp_path):
    whole, first = evaluator(model=Weighed()), evaluator(tmp_path / "s.db", model=Weighed())
    run_pareto(whole, stage(21, 0, initial=9, against="mass"))
    run_pareto(first, stage(13, 0, initial=9, against="mass"))
    first.store.close()
    longer = evaluator(tmp_path / "s.db", model=Weighed())
    run_pareto(longer, stage(21, 0, initial=9, against="mass"))
    assert [trial.key for trial in longer.trials] == [trial.key for trial in whole.trials]
