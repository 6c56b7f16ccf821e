"""Fronts against brute force and against PyGAD's own hypervolume."""

from dataclasses import replace

import numpy as np
import pytest
from pygad.utils.quality_indicators import hypervolume as reference_hypervolume

from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.search.fronts import (
    COSTS,
    REFERENCE_ENERGY_J,
    SPRING_ENERGY,
    described_cost,
    energies_j,
    energy_j,
    find_cost,
    front,
    hypervolume,
)
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial


@pytest.fixture
def trials():
    generator = np.random.default_rng(0)
    found = []
    for place, point in enumerate(Space.default().spread(200, generator)):
        design = Space.default().to_design(point)
        score = float(generator.random()) if place % 5 else None
        if np.isfinite(energy_j(design)):
            found.append(Trial("pareto", 0, place, design, Evaluation("jump"), score, "m", 0.0))
    return found


def test_front_is_what_nothing_dominates(trials):
    points = [(trial.score, energy_j(trial.design)) for trial in trials if trial.score is not None]
    brute = {
        (score, energy)
        for score, energy in points
        if not any((s >= score and e <= energy) and (s, e) != (score, energy) for s, e in points)
    }
    assert {(trial.score, energy_j(trial.design)) for trial in front(trials)} == brute


def test_where_no_score_is_above_0_the_front_is_still_what_nothing_dominates(trials):
    """Scores of an own objective may all be negative; they dominate nothing above 0."""
    below = [replace(trial, score=trial.score and trial.score - 2.0) for trial in trials]
    assert [trial.place for trial in front(below)] == [trial.place for trial in front(trials)]
    assert hypervolume(below) == 0.0


def test_a_jump_backwards_is_on_no_front_that_has_jumps_forwards(trials):
    cheapest = min((trial for trial in trials if trial.score is not None), key=lambda trial: energy_j(trial.design))
    backwards = [replace(trial, score=-0.5) if trial is cheapest else trial for trial in trials]
    assert all(trial.score > 0.0 for trial in front(backwards))
    assert front(backwards)


def test_hypervolume_is_pygads(trials):
    points = np.array([[trial.score, -energy_j(trial.design)] for trial in trials if trial.score is not None])
    energies = [energy_j(trial.design) for trial in front(trials)]
    for energy_j_at_most in (REFERENCE_ENERGY_J, float(np.median(energies)) + 1e-3, 3.0):
        theirs = reference_hypervolume(points[points[:, 1] > -energy_j_at_most], [0.0, -energy_j_at_most])
        assert hypervolume(trials, energy_j_at_most) == pytest.approx(theirs, rel=1e-12)
    assert hypervolume(trials) == hypervolume(trials, REFERENCE_ENERGY_J)
    assert hypervolume([]) == 0.0


def test_a_design_without_a_pose_has_no_energy():
    design = Design.from_vector([100, 3.0, 0.1, 1, 0.5, 80, 10, 40])
    assert energy_j(design) == np.inf


def test_the_energies_of_many_designs_are_those_of_each():
    # Among them designs without a pose, with legs of one length, and with values that are chosen.
    space = Space.make(bounds={"c_coef": (0.3, 3.0), "d_coef": (0.1, 1.5)}, choices={"rest_angle_deg": (20, 88.2, 90)})
    points = np.vstack([space.spread(512, np.random.default_rng(3)), np.eye(8), 1.0 - np.eye(8)])
    designs = [space.to_design(point) for point in points]
    assert [design.to_vector() for design in designs] == space.values(points).tolist()
    each = [energy_j(design) for design in designs]
    assert 50 < np.isinf(each).sum() < 500
    np.testing.assert_allclose(energies_j(space.values(points)), each, rtol=1e-14)
    equal_legs = np.array([[100.0, 1.0, 0.6, 1.0, 0.5, 60.0, 9.0, 40.0]])
    assert energies_j(equal_legs)[0] == pytest.approx(0.5 * 9e-3 * np.degrees(1.0) * np.radians(30.0) ** 2)


@pytest.mark.parametrize(
    ("against", "figure", "sign", "reference"), [("mass", "mass_kg", 1.0, 0.3), ("rise", "com_rise_m", -1.0, 0.0)]
)
def test_a_front_of_two_figures_is_what_nothing_dominates(trials, against, figure, sign, reference):
    """Of a cost less is better, of another objective more; a trial without the figure is on no front."""
    generator, cost = np.random.default_rng(1), find_cost(against)
    weighed = [replace(one, evaluation=Evaluation("jump", {figure: float(generator.random())})) for one in trials]
    points = [(one.score, sign * one.evaluation.metrics[figure]) for one in weighed if one.score is not None]
    brute = {
        (score, spent)
        for score, spent in points
        if not any((s >= score and e <= spent) and (s, e) != (score, spent) for s, e in points)
    }
    assert {(one.score, cost.of(one)) for one in front(weighed, cost)} == brute
    assert all(cost.shown(cost.of(one)) == one.evaluation.metrics[figure] for one in weighed)
    theirs = reference_hypervolume(np.array([[s, -e] for s, e in points]), [0.0, -1.0])
    assert hypervolume(weighed, 1.0, cost) == pytest.approx(theirs, rel=1e-12)
    below = np.array([[s, -e] for s, e in points if e < reference])  # 300 g at most; any rise
    theirs = reference_hypervolume(below, [0.0, -reference])
    assert hypervolume(weighed, cost=cost) == pytest.approx(theirs, rel=1e-12)
    assert cost.of(trials[0]) == np.inf
    assert str(cost.shown(0.0)) == "0.0"  # not -0


@pytest.mark.parametrize("against", ["jumps-per-joule", "range-per-spring-joule", "electrical-energy"])
def test_what_has_no_such_figure_or_divides_by_nothing_is_on_no_front(trials, against):
    """As a winding that takes no electricity."""
    without = {"ballistic_range_m": 1.0}
    nothing = without | {"electrical_energy_j": 0.0, "spring_energy_j": 0.0}
    cost = find_cost(against)
    assert cost.of(replace(trials[0], evaluation=Evaluation("jump", without))) == np.inf
    divided = cost.of(replace(trials[0], evaluation=Evaluation("jump", nothing)))
    assert divided == (0.0 if against == "electrical-energy" else np.inf)


def test_costs_are_found_by_name_and_by_what_a_study_remembers():
    """A study that remembers none has energy in the springs."""
    assert described_cost({}) is SPRING_ENERGY is find_cost("spring-energy")
    assert SPRING_ENERGY.describe() == {}
    for name in (*COSTS, "rise", "range"):
        assert described_cost(find_cost(name).describe()).name == name
    with pytest.raises(JumpcadError, match=r"^against = 'mas' is none of electrical-energy, .*did you mean mass"):
        find_cost("mas")
