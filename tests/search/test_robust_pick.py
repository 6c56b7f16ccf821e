"""The robust pick: the scores of the neighbours decide."""

from dataclasses import replace

import numpy as np
import pytest
from support.hills import FIXED, SMALL, Hill, Shaped

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search.models import robot_model
from jumpcad.search.robust_pick import (
    NOT_EXAMINED,
    _Examined,
    _ranked,
    active_bounds,
    best_apart,
    named_bounds,
    plan_rounds,
    rank_candidates,
)
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Tolerances, Variant, perturbed
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop


def spiked(design):
    """Return a plateau of height 5 with a needle of height 9 that is 0.2 % of its parameter wide."""
    needle = abs(design.rest_angle_deg - 60.0) < 0.06
    return 9.0 if needle else 5.0 - 0.01 * abs(design.rest_angle_deg - 40.0)


def needled(design):
    """Return a plateau of height 5 at small rest angles; elsewhere 9, but for exact values of the stiffness only."""
    if design.rest_angle_deg < 35.0:
        return 5.0
    exact = design.rest_angle_deg == 45.0 and design.carrying_link_mm == 100.0
    return 9.0 if exact and design.stiffness_nmm_per_deg % 1.0 == 0 else None


def test_a_plateau_beats_a_needle(evaluator):
    one = evaluator(model=Shaped(height=spiked))
    centre = SMALL.to_design([0.5, 0.5, 0.5])
    one.evaluate([centre.model_copy(update={"rest_angle_deg": angle}) for angle in (60.0, 40.0, 30.0)], "bo", 0)
    ranked = rank_candidates(one, one.trials, seed=0, evaluations=200)
    assert [candidate.trial.score for candidate in ranked] == [5.0, 4.9, 9.0]
    assert ranked[-1].parameters_score < 5.0
    assert ranked[0].robust_score == min(ranked[0].parameters_score, ranked[0].print_score)


def test_neighbours_follow_from_the_seed(evaluator):
    runs = []
    for seed in (0, 0, 1):
        one = evaluator()
        one.evaluate([SMALL.to_design([0.5, 0.5, 0.5])], "bo", 0)
        rank_candidates(one, one.trials, seed=seed, evaluations=20)
        runs.append([trial.key for trial in one.trials if trial.phase == "robust"])
    assert len(runs[0]) >= 16
    assert runs[0] == runs[1]
    assert not set(runs[1]) & set(runs[2])


def test_the_search_for_a_robust_one_goes_beyond_ten_needles(evaluator):
    one = evaluator(model=Shaped(height=needled))
    centre = SMALL.to_design([0.5, 0.5, 0.5])
    needles = [centre.model_copy(update={"stiffness_nmm_per_deg": 6.0 + number}) for number in range(12)]
    plateau = centre.model_copy(update={"rest_angle_deg": 30.0})
    one.evaluate([*needles, plateau], "bo", 0)
    ranked = rank_candidates(one, one.trials, seed=0, evaluations=200)
    assert sum(candidate.trial.phase == "bo" for candidate in ranked) == 13
    assert ranked[0].trial.design == plateau


def test_refused_neighbours_count_nothing_and_are_named(evaluator):
    one = evaluator()
    edge = SMALL.to_design([0.5, 0.5, 0.5]).model_copy(update={"compression_ratio": 0.6999})
    one.evaluate([edge], "bo", 0)
    candidate = rank_candidates(one, one.trials, seed=0, evaluations=200)[-1]
    assert candidate.trial.design == edge
    assert candidate.parameters_score == 0.0
    assert candidate.print_score > 0.0
    # Half of the parameters go up, a quarter of all neighbours.
    assert candidate.rejections["loop"] == pytest.approx(candidate.neighbours / 4, abs=1)


@pytest.mark.parametrize("evaluations", [5, 8, 19, 52, 152, 192])
def test_the_pick_keeps_to_its_evaluations_and_spends_most_on_the_winner(evaluator, evaluations):
    one = evaluator(model=Shaped(height=spiked))
    centre = SMALL.to_design([0.5, 0.5, 0.5])
    one.evaluate([centre.model_copy(update={"rest_angle_deg": 30.0 + number}) for number in range(20)], "bo", 0)
    ranked = rank_candidates(one, one.trials, seed=0, evaluations=evaluations)
    assert 0.5 * evaluations < len(one.trials) - 20 <= evaluations
    assert ranked[0].neighbours == max(candidate.neighbours for candidate in ranked)
    rounds = plan_rounds(evaluations)
    assert [count for count, _ in rounds] == [2**power for power in reversed(range(len(rounds)))]
    assert sum(new for _, new in rounds) <= 32


@pytest.mark.parametrize("below", [0.0, 7.0, 100.0])
def test_who_got_far_and_fails_there_stands_behind_who_does_not(evaluator, below):
    """The better one keeps its first neighbours and loses most of the others; the plateau's all jump.

    Also where some or all scores are negative.
    """
    fine, edge = (SMALL.to_design([0.5, 0.5, 0.5]).model_copy(update={"rest_angle_deg": a}) for a in (30.0, 60.0))
    edge = edge.model_copy(update={"stiffness_nmm_per_deg": 20.0})
    examined = _Examined(0, Trial("bo", 0, 0, edge, Evaluation("jump"), 9.0, "m", 0.0))
    first = [variant.design for _, variant in examined.neighbours(2, 0, Tolerances(0.2))]
    kept = max(abs(design.stiffness_nmm_per_deg / 20.0 - 1.0) for design in first) + 1e-9

    def late(design):
        if design.rest_angle_deg < 45.0:
            return 5.0
        return None if abs(design.stiffness_nmm_per_deg / 20.0 - 1.0) > kept else 9.0

    one = evaluator(model=Shaped(height=late))
    aim = replace(one.objective, figure=lambda metrics: metrics["fitness"] - below)
    one.request = replace(one.request, objective=aim)
    one.evaluate([edge, fine], "bo", 0)
    ranked = rank_candidates(one, one.trials, seed=0, evaluations=15)
    assert [candidate.trial.design for candidate in ranked] == [fine, edge]
    assert ranked[1].neighbours > ranked[0].neighbours == 2


def known(index, score, **neighbours):
    """Return a candidate of which the scores of some neighbours of each kind are known."""
    one = _Examined(index, Trial("bo", 0, index, load_design("best-ga"), Evaluation("jump"), score, "m", 0.0))
    one.scores |= neighbours
    return one


def test_candidates_are_compared_on_as_many_neighbours_as_all_of_them_have():
    """The more neighbours, the lower the lowest: who has joined with one of each kind is no better for having few."""
    joined = known(0, 0.22, parameters=[0.210], print=[0.211])
    older = known(1, 0.23, parameters=[0.215, 0.205], print=[0.220, 0.219])
    assert older.robust_score() < joined.robust_score()
    assert _ranked([joined, older], []) == [older, joined]


def test_neighbours_that_score_nothing_are_a_failure_and_a_winner_is_told_so():
    """Whether they are rejected or an objective gives them nothing."""
    fragile = known(0, 0.2237, parameters=[0.0], print=[0.0])
    sound = known(1, 0.2197, parameters=[0.2144], print=[0.2176])
    assert _ranked([fragile], [sound]) == [sound, fragile]
    assert [one.candidate().fails for one in (fragile, sound, known(2, 0.0))] == [True, False, False]
    assert _ranked([fragile], [])[0].candidate().to_dict()["fails"]


def test_where_scores_are_negative_a_rejected_neighbour_is_the_worst(evaluator):
    one = evaluator()
    edge = SMALL.to_design([0.5, 0.5, 0.5]).model_copy(update={"compression_ratio": 0.6999})
    inside = edge.model_copy(update={"compression_ratio": 0.4})
    aim = replace(one.objective, figure=lambda metrics: metrics["fitness"] - 100.0)
    one.request = replace(one.request, objective=aim)
    one.evaluate([edge, inside], "bo", 0)
    ranked = rank_candidates(one, one.trials, seed=0, evaluations=15)
    assert [candidate.trial.design for candidate in ranked] == [inside, edge]


def test_variation_keeps_to_what_a_design_can_be():
    flat = load_design("kenan-2.0").model_copy(update={"rest_angle_deg": 90.0})
    assert (
        max(one.design.rest_angle_deg for one in Tolerances(0.2).varied(Variant(flat), np.random.default_rng(0)))
        == 90.0
    )


def slope(design):
    """Return what grows by 2 over a range of the stiffness and falls by 3 over one of the rest angle."""
    if design.compression_ratio > 0.8:
        return None
    return 20.0 + 2.0 * (design.stiffness_nmm_per_deg - 5.0) / 25.0 - 3.0 * (design.rest_angle_deg - 20.0) / 50.0


def test_active_bounds_and_their_worth(evaluator):
    one = evaluator(model=Shaped(height=slope))
    names = [parameter.name for parameter in SMALL.free]
    assert names == ["compression_ratio", "rest_angle_deg", "stiffness_nmm_per_deg"]
    (trial,) = one.evaluate([SMALL.to_design([1.0, 0.0, 1.0])], "bo", 0)
    found = {bound.name: bound for bound in active_bounds(one, trial, run=1)}
    assert set(found) == set(names)
    assert found["stiffness_nmm_per_deg"].worth == pytest.approx(0.05 * 2.0)
    assert found["stiffness_nmm_per_deg"].beyond == pytest.approx(31.25)
    assert found["rest_angle_deg"].worth == pytest.approx(0.05 * 3.0)
    assert found["rest_angle_deg"].side == "lower"
    assert found["compression_ratio"].worth is None
    assert found["compression_ratio"].reason == "loop"
    few = active_bounds(one, trial, run=2, evaluations=0)
    assert {bound.reason for bound in few} == {NOT_EXAMINED} or few == list(found.values())


def test_a_bound_is_active_within_a_thousandth_of_the_range_and_no_design_lies_beyond_its_limits():
    """A rest angle is 5° at least and 90° at most; beyond a bound is a twentieth of its range, or such a limit."""
    for name, low, high, value, found in (
        ("c_coef", 0.8, 1.2, 0.8003, ("lower", 0.78)), ("c_coef", 0.8, 1.2, 1.1997, ("upper", 1.22)),
        ("c_coef", 0.8, 1.2, 0.8005, None), ("c_coef", 0.8, 1.2, 1.0, None),
        ("rest_angle_deg", 5.0, 90.0, 5.0, None), ("rest_angle_deg", 5.0, 90.0, 90.0, None),
        ("rest_angle_deg", 6.0, 70.0, 6.0, ("lower", 5.0)), ("rest_angle_deg", 20.0, 88.0, 88.0, ("upper", 90.0)),
    ):  # fmt: skip
        space = Space.make(bounds={name: (low, high)})
        design = space.to_design(np.full(8, 0.5)).model_copy(update={name: value})
        (*bounds,) = named_bounds(space, Trial("bo", 0, 0, design, Evaluation("jump"), 1.0, "m", 0.0))
        assert [(one.name, one.side, one.beyond) for one in bounds] == (
            [(name, found[0], pytest.approx(found[1]))] if found else []
        ), (name, value)


def test_springs_as_made_change_the_jump_and_not_the_robot():
    """Range of the robot that is built for the design's springs, with others."""
    design, model = load_design("kenan-2.0"), robot_model()
    robot = build(design, name="")
    found = model(design, {"made.spring_factor": 1.05})
    jump = simulate(with_spring_factor(robot, 1.05), model.settings, model.engine)
    assert found.metrics["mass_kg"] == pytest.approx(robot.mass_kg)
    assert found.metrics["ballistic_range_m"] == pytest.approx(jump.ballistic_range_m, rel=1e-6)
    assert found.metrics["ballistic_range_m"] > 1.03 * model(design).metrics["ballistic_range_m"]


def test_lengths_as_made_are_those_of_the_built_robot():
    """A design a hair from a limit of its layout has neighbours: what is printed is not laid out anew."""
    design, generator = load_design("kenan-2.0"), np.random.default_rng(0)
    making, robot = robot_model().making, build(design, name="")
    assert making.length_mm == 2.0 * robot.workshop.fits.sliding_mm
    lengths = np.array([design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm])
    for one in making.neighbours(Variant(design), generator)[:4]:
        made, settings = perturbed(robot, Settings(), one.workshop)
        bodies = made.bodies.values()
        assert [body.mass_kg for body in bodies] == [body.mass_kg for body in robot.bodies.values()]
        links = made.design
        errors = np.array([links.l2_mm, links.l3_mm, links.l4_mm, links.l5_mm]) - lengths
        assert 0.0 < np.abs(errors).max() <= making.length_mm + 1e-9
        assert np.linalg.norm(made.joint("ankle").origin_m) == pytest.approx(links.l2_mm / 1000.0)
        assert made.loop.point_a_m[0] == pytest.approx(links.l3_mm / 1000.0)
        friction = coefficients(made, settings).ground / coefficients(robot, Settings()).ground
        assert friction == pytest.approx(one.workshop["made.friction_factor"])
    stiffer = design.stiffness_nmm_per_deg * 1.01
    made, _ = perturbed(robot, Settings(), {"made.stiffness_nmm_per_deg": stiffer})
    assert made.spring.energy_j == pytest.approx(1.01 * robot.spring.energy_j)


def test_the_last_of_a_design_s_choices_is_a_bound_and_that_of_a_workshop_s_is_none(evaluator):
    """Stiffnesses of 10, 12 and 20: beyond them springs may be made to order, a twentieth of 10 farther."""
    choices = ["stiffness_nmm_per_deg=10,12,20", "process.perimeters=2,3"]
    space = Space.parse(fix=FIXED, choose=choices, workshop=load_workshop())
    one = evaluator(model=InAnyWorkshop(), space=space)
    (trial,) = one.evaluate([space.to_variant([0.5, 0.5, 1.0, 1.0])], "bo", 0)
    assert [(bound.name, bound.beyond) for bound in active_bounds(one, trial, run=1)] == [
        ("stiffness_nmm_per_deg", 20.5)
    ]


class InAnyWorkshop(Hill):
    """A hill that is the same in every workshop."""

    def __call__(self, design, workshop=None):
        return super().__call__(design)


def test_the_best_are_apart_by_a_fiftieth_of_some_range_the_best_first():
    designs = [SMALL.to_design([0.5, 0.5, place]) for place in (0.5, 0.519, 0.521, 0.3)]
    trials = [
        Trial("bo", 0, n, one, Evaluation("jump"), score, "m", 0.0)
        for n, (one, score) in enumerate(zip(designs, (4.0, 3.0, 2.0, 5.0), strict=True))
    ]
    assert [trial.place for trial in best_apart(SMALL, trials, 9)] == [3, 0, 2]
    assert [trial.place for trial in best_apart(SMALL, trials, 2)] == [3, 0]
