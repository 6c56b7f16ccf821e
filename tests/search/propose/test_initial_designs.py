"""Where a search starts."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import SMALL, TOP, Hill

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.estimate.estimated_robot import quick_robot, quick_size_m
from jumpcad.search.models import robot_model
from jumpcad.search.propose.initial_designs import APART, first_points, ranked_points, shipped_points
from jumpcad.search.space import Space
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.request import Request
from jumpcad.workshop import load_workshop


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


def test_a_search_begins_with_the_shipped_designs_that_land_farthest_unless_it_is_cold():
    """Of those that need no cage: their touchdowns stand in docs/results.md, 1,008, 910 and 884 mm."""
    names, space = ("best-range", "best-upright", "best-compact"), Space.make(workshop=load_workshop())
    begin, cold = (
        shipped_points(SimpleNamespace(
            space=space, model=robot_model(), objective=find_objective("touchdown"),
            request=SimpleNamespace(cold=cold), shared=lambda score, variants: [*map(score, variants)],
        ))
        for cold in (False, True)
    )  # fmt: skip
    assert np.array(begin) == pytest.approx(np.array([space.to_unit(load_design(name)) for name in names]))
    assert cold == []


def test_a_cold_search_is_one_of_printed_robots_with_ranked_first_designs() -> None:
    assert Request(Space.make(), robot_model(), cold=True).identity([])["cold"]
    for asked, said in (
        ({"model": robot_model("capsule")}, "printed robot"),
        ({"method": "paper"}, "only to ga\\+bo, ga"),
    ):
        with pytest.raises(JumpcadError, match=rf"cold( = True)?: .*{said}"):
            Request(**{"space": Space.make(study=True), "model": robot_model(), "cold": True, **asked})


def test_what_is_not_admitted_is_passed_over():
    def admits(variant):
        return SMALL.to_unit(variant)[0] < 0.5

    ranked = [np.array([0.9, 0.9, 0.5]), np.array([0.1, 0.9, 0.5]), np.array([0.15, 0.85, 0.5])]
    points = first_points(SMALL, 8, np.random.default_rng(1), ranked, admits)
    assert len(points) == 8
    assert points[:, 0].max() < 0.5
    assert points[-1].tolist() == [0.1, 0.9, 0.5]  # the first is not admitted, the third too near


def test_the_quick_robot_is_about_the_printed_one():
    """Masses of shipped robots within a tenth; springs of 80 N·mm/° are too strong for one."""
    for name, mass_kg in (("best-ga", 0.1512), ("kenan-2.0", 0.1163), ("best-printable", 0.1469)):
        robot = quick_robot(design := load_design(name))
        assert sum(body.mass_kg for body in robot.bodies.values()) == pytest.approx(mass_kg, rel=0.1)
        assert quick_size_m(design) >= design.l_max_mm / 1000.0
    strong = load_design("best-printable").model_copy(update={"stiffness_nmm_per_deg": 80.0})
    assert quick_robot(strong) is None
    assert robot_model().quick_score(strong, find_objective("touchdown")) == -math.inf


def test_an_objective_that_the_quick_robot_lacks_ranks_by_its_touchdown():
    design = load_design("best-ga")
    touchdown = robot_model().quick_score(design, find_objective("touchdown"))
    assert robot_model().quick_score(design, find_objective("jumps-per-joule")) == touchdown > 0
    assert robot_model("capsule").quick_score(design, find_objective("touchdown")) == -math.inf
    assert TOP
