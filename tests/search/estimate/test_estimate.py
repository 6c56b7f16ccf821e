"""Estimates of printed robots from those that were built."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.quick import BEST, FIGURES, LIKE, SPACE, quick

from jumpcad.findings import bare
from jumpcad.search.estimate import estimate
from jumpcad.search.estimate.estimate import BUILT_FIGURE, FEW, Estimator, FittedFigures, features
from jumpcad.search.estimate.estimated_robot import EXTENTS, LAID, estimated_robot
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Variant
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import load_workshop, varied

LAYOUT = {name: FIGURES[name] for name in LAID}
ONE = np.eye(45 + len(LAID))[0]
"""A coefficient that is constant."""


@pytest.fixture(autouse=True)
def no_builds(monkeypatch):
    """The robots of `Quick` are like best-printable also where that could not be built."""
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
    monkeypatch.setattr("jumpcad.search.models.PrintedModel.laid_out", lambda *_: LAYOUT)


def trials_of(points, model, objective):
    for place, point in enumerate(points):
        design = SPACE.to_design(point)
        evaluation = model(design)
        yield Trial("bo", 0, place, design, evaluation, objective.score(evaluation), "m", 0.0)


def estimator_of(figures, objective="body_lengths"):
    """Return an estimator by which every robot has figures with these coefficients."""
    found = Estimator(SPACE, quick(), find_objective(objective))
    positive = {name: value for name, value in figures.items() if name == "body_mass_kg"}
    others = {name: value for name, value in figures.items() if name not in positive}
    found._figures = FittedFigures(positive, others, np.zeros((len(LAID), 45)))
    found._like = LIKE
    return found


def test_a_dozen_robots_tell_of_the_others():
    model, objective, points = quick(), find_objective("body_lengths"), SPACE.spread(32, np.random.default_rng(3))
    estimator = Estimator(SPACE, model, objective)
    built = list(trials_of(points[:14], model, objective))
    assert estimator(built[0].variant) is None  # nothing is known yet
    assert not estimator.ready
    estimator.learn(built)
    others = list(trials_of(points[14:], model, objective))
    pairs = [(estimator(one.variant), one.score) for one in others]
    scores = np.array([(estimate.score, score) for estimate, score in pairs if estimate.score and score])
    assert len(scores) > 8
    assert np.median(np.abs(scores[:, 0] / scores[:, 1] - 1.0)) < 0.1
    assert np.corrcoef(scores.T)[0, 1] > 0.9
    assert all(estimate.score is None for estimate, score in pairs if score is None)


def test_an_estimate_is_the_jump_of_the_robot_with_the_fitted_figures():
    """All figures constant, but a body whose mass is e^(x - 3), with x from -1 to 1 along the first axis."""
    mass = np.eye(len(ONE))[1] - 3.0 * ONE
    constant = {name: value * ONE for name, value in FIGURES.items()}
    fitted = {"size_m": 0.1 * ONE, "ballistic_range_m": 9.0 * ONE}  # a range is a figure of robots too: not of this one
    estimator = estimator_of(constant | fitted | {"body_mass_kg": mass}, "range")
    for share in (0.3, 0.8):
        point = SPACE.to_unit(BEST)
        point[0] = share
        variant = SPACE.to_variant(point)
        robot = estimated_robot(variant.design, FIGURES | {"body_mass_kg": math.exp(2.0 * share - 4.0)}, LIKE)
        found, jump = estimator(variant), simulate(robot, quick().estimate_settings, "planar")
        assert found.score == pytest.approx(jump.ballistic_range_m, rel=1e-6)
        statics = {one.name: one.margin for one in jump.findings if one.name in ("tips", "too_weak")}
        assert len(statics) == 2
        assert found.margins == pytest.approx(statics, rel=1e-6)


def test_what_the_gate_refuses_does_not_jump():
    apart = BEST.model_copy(update={"c_coef": 0.1, "d_coef": 0.1, "e_coef": 3.0})  # its loop does not close
    assert estimator_of({"mass_kg": ONE})(Variant(apart)).score is None


def test_what_an_objective_cannot_take_is_not_estimated():
    """A figure of a built robot keeps an identity; a fitted one need not. The size is that of the largest extent."""

    def careful(figures):
        return 1.0 / figures["size_m"] if figures["size_m"] > 1.0 else math.log(-1.0)

    figures = {name: value * ONE for name, value in (FIGURES | dict.fromkeys(EXTENTS, 0.1)).items()}
    figures["body_mass_kg"] = math.log(FIGURES["body_mass_kg"]) * ONE
    assert estimator_of(figures, careful)(Variant(BEST)) is None
    large = figures | {EXTENTS[1]: 2.0 * ONE}
    assert estimator_of(large, careful)(Variant(BEST)).score == pytest.approx(0.5)
    assert estimator_of(large | {"body_mass_kg": 1e4 * ONE}, careful)(Variant(BEST)) is None


def test_what_has_no_room_is_refused_once_it_was_laid_out(monkeypatch):
    laid, estimator = [], estimator_of({"mass_kg": ONE})
    monkeypatch.setattr(
        "jumpcad.search.models.PrintedModel.laid_out", lambda _, one: laid.append(one) or Evaluation("cannot_build")
    )
    assert not estimator.refuses(Variant(BEST))
    assert estimator(Variant(BEST)) is None
    assert estimator.layout(Variant(BEST)).verdict == "cannot_build"
    assert estimator.refuses(Variant(BEST))
    assert laid == [Variant(BEST)]


def test_what_is_not_fitted_is_that_of_a_robot_of_the_search_s_own_workshop(monkeypatch):
    """It is built in the search's workshop with the trial's values; where the workshop varies, nothing is fitted."""
    asked = []
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *order: asked.append(order) or LIKE)
    shop, objective = load_workshop("light"), find_objective("body_lengths")
    model = replace(quick(), workshop=shop, settings=Settings(restitution=0.3))
    trials = [
        replace(one, workshop={"body.plate_mm": 2.0})
        for one in trials_of(SPACE.spread(9, np.random.default_rng(3)), quick(), objective)
    ]
    estimator = Estimator(SPACE, model, objective)
    estimator.learn(trials[:7])
    assert not estimator.ready
    estimator.learn(trials)
    assert asked == [(trials[0].design, varied(shop, {"body.plate_mm": 2.0}))]
    other = Estimator(Space.parse(bound=["body.plate_mm=1.6:2.4"], workshop=shop), model, objective)
    other.learn(trials)
    assert not other.ready


def test_an_estimated_robot_has_the_springs_of_its_robot():
    for chosen in ("", "9271K589"):
        shop = varied(load_workshop(), {"bought.spring": chosen})
        design = BEST.model_copy(update={"stiffness_nmm_per_deg": 20.0})
        spring = estimated_robot(design, FIGURES, replace(LIKE, workshop=shop)).spring
        rate = 20.0 if not chosen else 2.0 * shop.stock_spring.rate_nmm_per_deg
        assert spring.stiffness_nm_per_rad == pytest.approx(rate / 1000.0 * 180.0 / math.pi), chosen
        assert (spring.wind_rad, spring.one_sided) == (design.compression_rad, True)
        assert spring.preload_rad == LIKE.spring.preload_rad


def test_an_estimated_robot_releases_no_more_than_was_loaded():
    """Where the roller leaves the cam: short of the whole travel by the turn that was estimated."""
    for share, ratio in ((0.95, 0.95), (1.02, 1.0)):
        found = estimated_robot(LIKE.design, FIGURES | {"release_ratio": share, "release_turn_rad": 0.04}, LIKE)
        assert found.roller_off.energy_ratio == ratio
        assert found.roller_off.leg_rad == pytest.approx(0.04 - LIKE.design.compression_rad)


CENTRE = np.full(SPACE.dimension, 0.5)
NONE = dict.fromkeys(LAID, 0.0)


def trials_at(points, figures):
    """Return robots at points (n, d) with figures that depend on the coordinates, from -1 to 1."""
    for place, point in enumerate(points):
        metrics = NONE | figures(2.0 * SPACE.to_unit(SPACE.to_variant(point)) - 1.0)
        yield Trial("bo", 0, place, SPACE.to_design(point), Evaluation("jump", metrics), 1.0, "m", 0.0)


def test_features_of_two_coordinates_are_one_both_and_their_three_products():
    """From 0…1 to -1…1."""
    assert features(np.array([[0.0, 0.75], [0.5, 1.0]])).tolist() == [
        [1.0, -1.0, 0.5, 1.0, -0.5, 0.25], [1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
    ]  # fmt: skip


def test_margins_of_limits_that_reject_are_fitted_too():
    """A limit that is missed beyond 0.4 of the first coordinate, and one that nothing misses."""
    trials = []
    for trial in trials_at(SPACE.spread(64, np.random.default_rng(1)), lambda x: {"first": x[0]}):
        margin = 0.4 - trial.evaluation.metrics["first"]
        findings = (bare("weak", "error" if margin < 0.0 else "info", margin, "N"), bare("strong", "info", 1.0, "N"))
        trials.append(replace(trial, evaluation=replace(trial.evaluation, findings=findings)))
    fit = FittedFigures.of(SPACE, trials, CENTRE)
    for first in (-0.5, 0.0, 0.9):
        point = np.append((first + 1.0) / 2.0, CENTRE[1:])
        margins, kept = fit.margins(fit.predict(point, NONE))
        assert margins == {"weak": pytest.approx(0.4 - first, abs=0.1)}
        assert kept == (first < 0.4)
    near, far = (np.append((first + 1.0) / 2.0, CENTRE[1:]) for first in (0.35, -0.9))
    rejected = [trial for trial in trials if trial.evaluation.missed]
    warned = FittedFigures.of(SPACE, [*trials, *rejected[:4]], CENTRE)  # four in a row
    assert [one.margins(one.predict(near, NONE))[1] for one in (fit, warned)] == [True, False]
    assert warned.margins(warned.predict(far, NONE))[1]


def test_a_mass_is_fitted_by_its_logarithm_and_stays_positive():
    """What only some robots have is not fitted, nor what the layout says."""

    def figures(x):
        mass = math.exp(0.3 * x[0] - 0.2 * x[1] * x[2] - 3.0)
        return {"mass_kg": mass, "com_x_m": x[0] - 0.5} | ({"some": 1.0} if x[0] > 0.0 else {})

    points = SPACE.spread(128, np.random.default_rng(1))
    fit = FittedFigures.of(SPACE, list(trials_at(points[:100], figures)), points[0])
    for point in points[100:]:
        exact, found = figures(2.0 * SPACE.to_unit(SPACE.to_variant(point)) - 1.0), fit.predict(point, NONE)
        assert set(found) == {"mass_kg", "com_x_m"}
        assert found["mass_kg"] == pytest.approx(exact["mass_kg"], rel=0.01)
        assert found["com_x_m"] == pytest.approx(exact["com_x_m"], abs=0.01)
    far = fit.predict(np.full(SPACE.dimension, -9.0), NONE)
    assert far["mass_kg"] > 0.0 > far["com_x_m"]


def test_what_masses_leap_with_is_told_by_the_layout():
    """Masses of which half follow a figure of the layout, that no polynomial of the parameters does."""

    def figures(x):
        laid = {BUILT_FIGURE: 20.0 * float(math.sin(40.0 * x[0]) > 0.0)}
        return laid | {"body_mass_kg": math.exp(0.1 * x[1] + 0.02 * laid[BUILT_FIGURE])}

    points = SPACE.spread(64, np.random.default_rng(2))
    trials = list(trials_at(points, figures))
    fit = FittedFigures.of(SPACE, trials[:40], points[0])
    for point, trial in zip(points[40:], trials[40:], strict=True):
        exact = trial.evaluation.metrics["body_mass_kg"]
        assert fit.predict(point, trial.evaluation.metrics)["body_mass_kg"] == pytest.approx(exact, rel=0.05)


def test_without_a_layout_it_is_about_that_of_the_robots_beside_it():
    def figures(x):
        laid = {BUILT_FIGURE: 30.0 + 5.0 * x[0]}
        return laid | {"body_mass_kg": math.exp(0.1 * x[1] + 0.02 * laid[BUILT_FIGURE])}

    points = SPACE.spread(120, np.random.default_rng(2))
    trials = list(trials_at(points, figures))
    fit = FittedFigures.of(SPACE, trials[:90], points[0])
    for point, trial in zip(points[90:], trials[90:], strict=True):
        exact = trial.evaluation.metrics["body_mass_kg"]
        assert fit.predict(point, None)["body_mass_kg"] == pytest.approx(exact, rel=0.02)


def test_a_robot_a_quarter_of_the_ranges_from_the_best_counts_half_and_few_do_not_say_the_second_order(monkeypatch):
    """The normal equations of weighted ridge regression, set up anew; the farthest of very many are left out."""
    points = SPACE.spread(FEW, np.random.default_rng(7))

    def figures(x):
        return {"com_x_m": float(np.sin(3.0 * x[0]) * x[1] - x[2] ** 3)}

    d, trials = SPACE.dimension, list(trials_at(points, figures))
    units = np.array([SPACE.to_unit(trial.variant) for trial in trials])
    values = np.array([trial.evaluation.metrics["com_x_m"] for trial in trials])
    away = np.abs(units - CENTRE).max(axis=1)
    for most, count, second in ((300, FEW, 1e-3), (FEW - 1, FEW - 1, 1e-2)):
        monkeypatch.setattr(estimate, "FITTED", most)
        near = np.argsort(away, kind="stable")[:count]
        weights = 1.0 / (1.0 + (away[near] / 0.25) ** 2)
        rows = features(units[near])
        ridge = np.array([1e-9, *[1e-3] * d, *[second] * (d * (d + 1) // 2)]) * weights.sum()
        left = np.vstack([rows * np.sqrt(weights)[:, None], np.diag(np.sqrt(ridge))])
        right = np.append(values[near] * np.sqrt(weights), np.zeros(len(ridge)))
        exact = features(CENTRE[None])[0] @ np.linalg.lstsq(left, right)[0]
        assert FittedFigures.of(SPACE, trials, CENTRE).predict(CENTRE, NONE)["com_x_m"] == pytest.approx(
            exact, abs=1e-6
        )
