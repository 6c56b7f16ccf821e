"""Where a search starts."""

import math

import numpy as np
from support.hills import SMALL, TOP, Hill

from jumpcad.design import load_design
from jumpcad.search.models import robot_model
from jumpcad.search.propose.initial_designs import APART, first_points, ranked_points
from jumpcad.search.study.objective import find_objective


class Known(Hill):
    """A hill with a quick model that knows it."""

    def quick_score(self, design, objective):
        found = self(design)
        return found.metrics["fitness"] if found.feasible else -math.inf


def test_half_of_the_start_is_spread_and_half_the_best_of_the_quick_model(evaluator):
    plain, half = evaluator(), evaluator(model=Known())
    assert ranked_points(plain, np.random.default_rng(1)) == []
    spread = first_points(SMALL, 24, np.random.default_rng(1))
    assert (spread == SMALL.spread(24, np.random.default_rng(1))).all()
    points = first_points(SMALL, 24, np.random.default_rng(1), ranked_points(half, np.random.default_rng(2)))
    assert (points[:12] == spread[:12]).all()
    scores = [Hill()(SMALL.to_design(point)).metrics.get("fitness", 0.0) for point in points]
    assert min(scores[12:]) > np.median(scores[:12])
    assert max(scores) > 9.8  # the top, to the distance of 512 points
    for number, point in enumerate(points[12:]):
        assert all(np.abs(point - other).max() >= APART for other in points[12 + number + 1 :])


def test_what_is_not_admitted_is_passed_over():
    def admits(variant):
        return SMALL.to_unit(variant)[0] < 0.5

    ranked = [np.array([0.9, 0.9, 0.5]), np.array([0.1, 0.9, 0.5]), np.array([0.15, 0.85, 0.5])]
    points = first_points(SMALL, 8, np.random.default_rng(1), ranked, admits)
    assert len(points) == 8
    assert points[:, 0].max() < 0.5
    assert points[-1].tolist() == [0.1, 0.9, 0.5]  # the first is not admitted, the third too near


def test_the_printed_robot_s_quick_model_is_the_capsule_robot():
    score, capsule = find_objective("range"), robot_model("capsule")
    for name in ("best-ga", "kenan-2.0"):
        design = load_design(name)
        exact = capsule(design).metrics["ballistic_range_m"]
        assert abs(robot_model().quick_score(design, score) - exact) < 0.03 * exact
    assert robot_model("capsule").quick_score(load_design("best-ga"), score) == -math.inf


def test_an_objective_that_capsules_lack_ranks_by_fitness():
    design = load_design("best-ga")
    fitness = robot_model().quick_score(design, find_objective("fitness"))
    assert robot_model().quick_score(design, find_objective("body_lengths")) == fitness > 0
    assert TOP
