"""What is fitted to robots that were built: which figures, and from which robots."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.quick import SPACE

from jumpcad.findings import bare
from jumpcad.search.estimate import fitted_figures
from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.estimate.fitted_figures import FEW, MARK, FittedFigures, features
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

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
        laid = {MARK: 20.0 * float(math.sin(40.0 * x[0]) > 0.0)}
        return laid | {"body_mass_kg": math.exp(0.1 * x[1] + 0.02 * laid[MARK])}

    points = SPACE.spread(64, np.random.default_rng(2))
    trials = list(trials_at(points, figures))
    fit = FittedFigures.of(SPACE, trials[:40], points[0])
    for point, trial in zip(points[40:], trials[40:], strict=True):
        exact = trial.evaluation.metrics["body_mass_kg"]
        assert fit.predict(point, trial.evaluation.metrics)["body_mass_kg"] == pytest.approx(exact, rel=0.05)


def test_without_a_layout_it_is_about_that_of_the_robots_beside_it():
    def figures(x):
        laid = {MARK: 30.0 + 5.0 * x[0]}
        return laid | {"body_mass_kg": math.exp(0.1 * x[1] + 0.02 * laid[MARK])}

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
        monkeypatch.setattr(fitted_figures, "FITTED", most)
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
