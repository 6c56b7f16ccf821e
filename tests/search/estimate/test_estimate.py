"""Guesses of printed robots from those that were built."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from support.quick import BEST, FIGURES, LIKE, SPACE, quick

from jumpcad.search.estimate.estimate import Fit, Guesser
from jumpcad.search.estimate.estimated_robot import EXTENTS, LAID, laid_out, stand_in
from jumpcad.search.estimate.fitting import MARK, Table, features, learned_rows
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Variant
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import load_workshop, varied


def trials_of(points, model):
    objective = find_objective("body_lengths")
    for place, point in enumerate(points):
        design = SPACE.to_design(point)
        evaluation = model(design)
        yield Trial("bo", 0, place, design, evaluation, objective.score(evaluation), "m", 0.0)


def test_features_are_all_products():
    row = features(np.array([[1.0, 0.75]]))[0]
    assert row.tolist() == [1.0, 1.0, 0.5, 1.0, 0.5, 0.25]


def test_a_mass_is_fitted_by_its_logarithm_and_stays_positive():
    def robot(design):
        x = 2.0 * SPACE.to_unit(design) - 1.0
        mass = np.exp(0.3 * x[0] - 0.2 * x[1] * x[2] - 3.0)
        return Evaluation(
            "jump", {MARK: 1.0, "mass_kg": float(mass), "com_x_m": float(x[0] - 0.5), "body_lengths": 1.0}
        )

    points = SPACE.spread(128, np.random.default_rng(1))
    fit = Fit(0, Table(SPACE, list(trials_of(points[:100], robot)), points[0]).coefficients(), {})
    for point in points[100:]:
        exact, found = robot(SPACE.to_design(point)).metrics, fit.predict(point)
        assert found["mass_kg"] == pytest.approx(exact["mass_kg"], rel=0.01)
        assert found["com_x_m"] == pytest.approx(exact["com_x_m"], abs=0.01)
    far = fit.predict(np.full(SPACE.dimension, -9.0))
    assert far["mass_kg"] > 0.0 > far["com_x_m"]


def test_a_dozen_robots_guess_the_others(monkeypatch):
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
    model, points = quick(), SPACE.spread(32, np.random.default_rng(3))
    built = list(trials_of(points[:14], model))
    first = next(trial for trial in built if MARK in trial.evaluation.metrics)
    guesser = Guesser(SPACE, model, find_objective("body_lengths"), "pybullet", first)
    fit = Fit(0, Table(SPACE, built, SPACE.to_unit(BEST)).coefficients(), {})
    others = list(trials_of(points[14:], model))
    pairs = [(guesser(one.variant, fit), one.score) for one in others]
    scores = np.array([(guess.score, score) for guess, score in pairs if guess.score and score])
    assert len(scores) > 8
    assert np.median(np.abs(scores[:, 0] / scores[:, 1] - 1.0)) < 0.1
    assert np.corrcoef(scores.T)[0, 1] > 0.9
    assert all(guess.score is None for guess, score in pairs if score is None)


def test_a_guess_is_the_jump_of_the_robot_with_the_fitted_figures(monkeypatch):
    """All figures constant, but a body whose mass is e^(x - 3), with x from -1 to 1 along the first axis."""
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
    guesser = Guesser(SPACE, quick(), find_objective("range"), "pybullet", first_trial())
    one = np.eye(45)[0]
    constant = {name: value * one for name, value in FIGURES.items() if name != "body_mass_kg"}
    fitted = {"size_m": 0.1 * one, "ballistic_range_m": 9.0 * one}  # a range is a figure of robots too: not of this one
    fitted |= {"margin bed": 2.5 * one, "margin tips": 99.0 * one}
    fit = Fit(0, constant | fitted | {"log body_mass_kg": np.eye(45)[1] - 3.0 * one}, {})
    for share in (0.3, 0.8):
        point = SPACE.to_unit(BEST)
        point[0] = share
        variant = SPACE.to_variant(point)
        robot = stand_in(variant.design, FIGURES | {"body_mass_kg": np.exp(2.0 * share - 4.0)}, LIKE)
        found, jump = guesser(variant, fit), simulate(robot)
        assert found.score == pytest.approx(jump.ballistic_range_m, rel=1e-6)
        statics = {one.name: one.margin for one in jump.findings if one.name in ("tips", "too_weak")}
        assert len(statics) == 2  # what the jump itself tells is not fitted
        assert found.margins == pytest.approx({"bed": 2.5} | statics, rel=1e-6)


def test_what_the_gate_refuses_does_not_jump(monkeypatch):
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
    guesser = Guesser(SPACE, quick(), find_objective("body_lengths"), "pybullet", first_trial())
    apart = BEST.model_copy(update={"c_coef": 0.1, "d_coef": 0.1, "e_coef": 3.0})  # its loop does not close
    assert guesser(Variant(apart), Fit(0, {"mass_kg": np.zeros(45)}, {})).score is None


def test_what_an_objective_cannot_take_is_not_guessed(monkeypatch):
    """A figure of a built robot keeps an identity; a fitted one need not. The size is that of the largest extent."""
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)

    def careful(figures):
        return 1.0 / figures["size_m"] if figures["size_m"] > 1.0 else math.log(-1.0)

    guesser = Guesser(SPACE, quick(), find_objective(careful), "pybullet", first_trial())
    fit = Fit(0, {name: value * np.eye(45)[0] for name, value in (FIGURES | dict.fromkeys(EXTENTS, 0.1)).items()}, {})
    assert guesser(Variant(BEST), fit) is None
    known = {**fit.coefficients, EXTENTS[1]: 2.0 * np.eye(45)[0]}
    assert guesser(Variant(BEST), Fit(0, known, {})).score == pytest.approx(0.5)
    far = {**fit.coefficients, "log body_mass_kg": 1e4 * np.eye(45)[0]}
    assert guesser(Variant(BEST), Fit(0, far, {})) is None


@pytest.mark.parametrize("chosen", ["", "9271K589"])
def test_a_stand_in_has_the_springs_of_its_robot(chosen):
    shop = varied(load_workshop(), {"bought.spring": chosen})
    design = BEST.model_copy(update={"stiffness_nmm_per_deg": 20.0})
    like = replace(LIKE, workshop=shop)
    spring = stand_in(design, FIGURES, like).spring
    rate = 20.0 if not chosen else 2.0 * shop.stock_spring.rate_nmm_per_deg
    assert spring.stiffness_nm_per_rad == pytest.approx(rate / 1000.0 * 180.0 / math.pi)
    assert (spring.wind_rad, spring.one_sided) == (design.compression_rad, True)
    assert spring.preload_rad == LIKE.spring.preload_rad


def first_trial():
    return Trial("bo", 0, 0, BEST, Evaluation("jump"), 1.0, "m", 0.0)


def test_what_a_guess_takes_from_a_robot_is_that_of_its_own_workshop(monkeypatch):
    """It is built in the search's workshop with the trial's values; what the planar engine lacks, the search's has."""
    asked = []
    monkeypatch.setattr("jumpcad.search.estimate.estimate.build", lambda *order: asked.append(order) or LIKE)
    for shop, restitution, engine in ((load_workshop("light"), 0.3, "pybullet"), (load_workshop(), 0.0, "planar")):
        model = replace(quick(), workshop=shop, settings=Settings(restitution=restitution))
        first = replace(first_trial(), workshop={"body.plate_mm": 2.0})
        guesser = Guesser.quick(SPACE, model, find_objective("range"), first)
        assert asked.pop() == (BEST, varied(shop, {"body.plate_mm": 2.0}))
        assert (guesser.engine, guesser.model.settings) == (engine, model.guess_settings)


@pytest.mark.parametrize(("known", "rows"), [(7, 0), (8, 8), (9, 8), (10, 8), (11, 10), (15, 14), (100, 85)])
def test_rows_are_learned_in_steps(known, rows):
    """8 times 1.3, 1.3², 1.3³, …: 10.4, 13.5, …, 84.8, rounded."""
    assert learned_rows(known, 8, 1.3) == rows


def test_a_fit_that_a_study_keeps_comes_back_whole():
    fit = Fit(
        24, {"log mass_kg": np.array([-2.0, 0.25]), "margin bed": np.array([1.0, 3.0])}, {"score": 0.5, "bed": 2.0}
    )
    back = Fit.from_record(json.loads(json.dumps(fit.to_record())))
    assert (back.rows, back.errors) == (fit.rows, fit.errors)
    assert {name: values.tolist() for name, values in back.coefficients.items()} == {
        "log mass_kg": [-2.0, 0.25], "margin bed": [1.0, 3.0],
    }  # fmt: skip


def test_a_robot_a_quarter_of_the_ranges_from_the_best_counts_half():
    """By the largest coordinate; half of the ranges away a fifth; beyond 300 the farthest are left out."""
    centre = np.full(SPACE.dimension, 0.5)
    far = [centre.copy() for _ in range(3)]
    far[1][0], far[2][1] = 0.75, 0.0
    trials = [
        Trial("bo", 0, 0, SPACE.to_design(point), Evaluation("jump", {MARK: 1.0}), 1.0, "m", 0.0) for point in far
    ]
    table = Table(SPACE, trials, centre)
    assert table._weights == pytest.approx([1.0, 0.5, 0.2])
    near = SPACE.spread(310, np.random.default_rng(5))
    many = [Trial("bo", 0, place, SPACE.to_design(point), Evaluation("jump", {MARK: 1.0}), 1.0, "m", 0.0)
            for place, point in enumerate(near)]  # fmt: skip
    kept = Table(SPACE, many, centre)
    away = np.abs(np.array([SPACE.to_unit(one.variant) for one in many]) - centre).max(axis=1)
    assert [one.place for one in kept.trials] == sorted(np.argsort(away, kind="stable")[:300].tolist())


def test_what_masses_leap_with_is_told_by_the_layout():
    """Masses of which half follow a figure of the layout, that no polynomial of the parameters does."""
    wire = dict.fromkeys(LAID, 0.0)

    def robot(design):
        x = 2.0 * SPACE.to_unit(design) - 1.0
        laid = wire | {"laid_coil_mm": 20.0 * float(math.sin(40.0 * x[0]) > 0.0)}
        return Evaluation("jump", laid | {"body_mass_kg": math.exp(0.1 * x[1] + 0.02 * laid["laid_coil_mm"])})

    points = SPACE.spread(64, np.random.default_rng(2))
    trials = [Trial("bo", 0, 0, SPACE.to_design(one), robot(SPACE.to_design(one)), 1.0, "m", 0.0) for one in points]
    fits = [Fit(0, Table(SPACE, trials[:40], points[0], laid).coefficients(), {}) for laid in (True, False)]
    errors = []
    for point, trial in zip(points[40:], trials[40:], strict=True):
        metrics = trial.evaluation.metrics
        guesses = fits[0].predict(point, metrics)["body_mass_kg"], fits[1].predict(point)["body_mass_kg"]
        errors.append([abs(one / metrics["body_mass_kg"] - 1.0) for one in guesses])
    assert np.max(errors, axis=0)[0] < 0.05
    assert np.max(errors, axis=0)[1] > 0.2


def test_a_robot_is_held_out_as_if_it_had_not_been_built():
    """Weighted least squares with a ridge, solved anew without each robot."""

    def robot(design):
        x = 2.0 * SPACE.to_unit(design) - 1.0
        return Evaluation("jump", {MARK: 1.0, "com_x_m": float(np.sin(3.0 * x[0]) * x[1] - x[2] ** 3)})

    points = SPACE.spread(32, np.random.default_rng(4))
    trials = [Trial("ga", 0, 0, SPACE.to_design(one), robot(SPACE.to_design(one)), 1.0, "m", 0.0) for one in points]
    values = np.array([trial.evaluation.metrics["com_x_m"] for trial in trials])
    rows, away = features(points), np.abs(points - points[0]).max(axis=1)
    weights = 1.0 / (1.0 + (away / 0.1) ** 2)
    d = SPACE.dimension
    ridge = np.array([1e-9, *[1e-4] * d, *[1e-3] * (d * (d + 1) // 2)]) * weights.sum()  # of few robots
    held_out = Table(SPACE, trials, points[0], reach=0.1, ridge=1e-4).held_out()
    for place in (0, 7, 31):
        kept = np.arange(len(trials)) != place
        left = np.vstack([rows[kept] * np.sqrt(weights[kept])[:, None], np.diag(np.sqrt(ridge))])
        right = np.append(values[kept] * np.sqrt(weights[kept]), np.zeros(len(ridge)))
        coefficients = np.linalg.lstsq(left, right)[0]
        assert held_out[place]["com_x_m"] == pytest.approx(rows[place] @ coefficients, abs=1e-6)
        assert held_out[place]["com_x_m"] != pytest.approx(values[place], abs=1e-3)


def test_figures_of_a_layout_are_those_of_the_built_robot():
    spring, found = LIKE.layout.drive.spring, laid_out(LIKE.layout)
    assert found == {name: FIGURES[name] for name in LAID}
    assert found["laid_spring_g"] == pytest.approx(spring.mass_g, rel=1e-5)
    steel_g = 0.00785 * math.pi / 4.0 * spring.wire_mm**2 * math.pi * found["laid_coil_mm"] * spring.turns
    assert 0.5 < steel_g / spring.mass_g < 1.0  # the coil without its arms
    motor = next(item for item in LIKE.hardware if item.name == "motor")
    assert [found["laid_motor_x_mm"], found["laid_motor_z_mm"]] == pytest.approx(motor.T_body_part[[0, 2], 3], abs=1e-3)


@pytest.mark.parametrize(("guessed", "ratio"), [(0.95, 0.95), (1.02, 1.0)])
def test_a_stand_in_releases_no_more_than_was_loaded(guessed, ratio):
    """Where the roller leaves the cam: short of the whole travel by the turn that was guessed."""
    found = stand_in(LIKE.design, FIGURES | {"release_ratio": guessed, "release_turn_rad": 0.04}, LIKE)
    assert found.roller_off.energy_ratio == ratio
    assert found.roller_off.leg_rad == pytest.approx(0.04 - LIKE.design.compression_rad)
    assert found.roller_off.leg_rad_s == FIGURES["release_rad_s"]
