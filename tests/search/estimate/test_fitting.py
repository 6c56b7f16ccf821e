"""What is fitted to robots that were built: which figures and which margins, and from which robots."""

import math

import numpy as np
import pytest
from support.quick import SPACE

from jumpcad.findings import Finding
from jumpcad.search.estimate import fitting
from jumpcad.search.estimate.estimated_robot import LAID
from jumpcad.search.estimate.fitting import (
    FEW,
    KNOWN,
    LIMITS,
    MARK,
    Table,
    features,
    figures_of,
    learned_rows,
    of_layout,
)
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

CENTRE = np.full(SPACE.dimension, 0.5)
POINTS = SPACE.spread(FEW, np.random.default_rng(7))


def table(*evaluations: Evaluation, **options: object) -> Table:
    """Return the table of robots at spread points."""
    trials = [
        Trial("ga", 0, place, SPACE.to_design(point), one, None, "m", 0.0)
        for place, (point, one) in enumerate(zip(POINTS, evaluations, strict=False))
    ]
    return Table(SPACE, trials, CENTRE, **options)  # type: ignore[arg-type]


def missed(*names: str, **margins: float) -> Evaluation:
    """Return what fails these limits by 1 mm, and has some margins of others."""
    failed = tuple(Finding(name, "error", -1.0, "mm", "", "") for name in names)
    kept = tuple(Finding(name, "info", margin, "mm", "", "") for name, margin in margins.items())
    return Evaluation("jump", {MARK: 1.0}, (*failed, *kept))


def test_features_of_two_coordinates_are_one_both_and_their_three_products() -> None:
    """From 0…1 to -1…1."""
    assert features(np.array([[0.0, 0.75], [0.5, 1.0]])).tolist() == [
        [1.0, -1.0, 0.5, 1.0, -0.5, 0.25], [1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
    ]  # fmt: skip


def test_figures_come_back_from_their_logarithms_and_margins_as_they_are() -> None:
    assert figures_of({"log mass_kg": math.log(0.125), "com_x_m": -2.0, "margin bed": -0.5}) == {
        "mass_kg": pytest.approx(0.125), "com_x_m": -2.0, "margin bed": -0.5,
    }  # fmt: skip


def test_a_layout_is_seen_in_its_own_units() -> None:
    """Ten grams, ten millimetres, in the order of the figures."""
    laid = {name: 5.0 * number for number, name in enumerate(LAID)}
    assert of_layout(laid).tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]


@pytest.mark.parametrize(
    ("known", "rows"), [(15, 0), (16, 16), (19, 16), (20, 20), (24, 20), (25, 25), (31, 25), (32, 31)]
)
def test_a_screen_learns_from_sixteen_on_and_a_quarter_more_each_time(known: int, rows: int) -> None:
    """16, 20, 25, 31.25 rounded, …"""
    assert learned_rows(known, 16, 1.25) == rows


def test_what_is_positive_in_all_robots_is_fitted_by_its_logarithm() -> None:
    """What only some have is not fitted, nor what the layout says; of what was not built nothing is known."""
    built = [
        Evaluation("jump", {MARK: 5.0, "mass_kg": 0.1, "com_x_m": x, "zero": 0.0, **({"some": 1.0} if x > 0 else {})})
        for x in (-1.0, 1.0)
    ]
    columns = table(*built, Evaluation("tips", {"mass_kg": 9.0}))._columns
    assert set(columns) == {"log mass_kg", "com_x_m", "zero"}
    assert columns["log mass_kg"][:2] == pytest.approx([math.log(0.1)] * 2)
    assert columns["com_x_m"][:2].tolist() == [-1.0, 1.0]
    assert np.isnan([values[2] for values in columns.values()]).all()


def test_the_limits_that_reject_most_are_fitted_where_some_robot_meets_them() -> None:
    """Six of them; of equals the first by name. Of fewer than twenty robots nothing is fitted."""
    names = [f"limit_{letter}" for letter in "gfedcba"]
    kept = dict.fromkeys(names, 0.5)
    failing = [missed(*names), missed(*names[:-1]), missed("tips", "never", **kept)]
    meeting = [missed(**kept)] * (KNOWN - 2)
    columns = table(*failing, *meeting)._columns
    found = [name.removeprefix("margin ") for name in columns if name.startswith("margin ")]
    assert len(found) == LIMITS == 6
    assert found == sorted(names)[1:]  # the last of seven is missed once
    assert columns["margin limit_b"][:3].tolist() == [-1.0, -1.0, 0.5]
    for count, fitted in ((KNOWN, True), (KNOWN - 1, False)):
        few = table(*failing, *meeting[: count - len(failing)])._columns
        assert any(name.startswith("margin ") for name in few) == fitted
    always = table(*[missed("limit_a")] * KNOWN)._columns
    assert "margin limit_a" not in always
    simulated = table(missed("tips", "too_weak"), *[missed(tips=0.5, too_weak=0.5)] * KNOWN)._columns
    assert not any(name.startswith("margin ") for name in simulated)  # the stand-in itself tells them


def test_of_very_many_robots_the_nearest_to_the_best_are_fitted(monkeypatch: pytest.MonkeyPatch) -> None:
    """In their order."""
    monkeypatch.setattr(fitting, "FITTED", 5)
    distance = np.abs(POINTS - CENTRE).max(axis=1)
    found = table(*[Evaluation("jump", {MARK: 1.0})] * FEW)
    nearest = sorted(sorted(range(FEW), key=lambda place: distance[place])[:5])
    assert [one.place for one in found.trials] == nearest
    assert found.distance == pytest.approx(distance[nearest], abs=1e-6)


@pytest.mark.parametrize(
    ("laid", "limits", "fitted"),
    [(False, None, True), (True, None, False), (True, True, True), (False, False, False)],
)
def test_margins_are_fitted_of_what_was_not_laid_out_unless_they_are_asked_for(
    laid: bool, limits: bool | None, fitted: bool
) -> None:
    robots = [Evaluation("jump", dict.fromkeys(LAID, 1.0), missed(*names, bed=1.0).findings)
              for names in (("bed",), *[()] * KNOWN)]  # fmt: skip
    columns = table(*robots, laid=laid, limits=limits)._columns
    assert ("margin bed" in columns) == fitted


@pytest.mark.parametrize(("count", "times"), [(FEW - 1, 10.0), (FEW, 1.0)])
def test_of_few_robots_the_second_order_is_believed_ten_times_less(count: int, times: float) -> None:
    """The normal equations of weighted ridge regression, set up anew."""
    robots = [
        Evaluation("jump", {MARK: 1.0, "com_x_m": float(np.sin(9.0 * point[0]) - point[1] ** 3)}) for point in POINTS
    ]
    found = table(*robots[:count], ridge=0.01)
    rows, d = features(POINTS[:count]), SPACE.dimension
    weights = 1.0 / (1.0 + (np.abs(POINTS[:count] - CENTRE).max(axis=1) / 0.25) ** 2)
    ridge = [1e-9, *[0.01] * d, *[0.01 * times] * (d * (d + 1) // 2)]
    left = (rows * weights[:, None]).T @ rows + weights.sum() * np.diag(ridge)
    right = (rows * weights[:, None]).T @ [one.metrics["com_x_m"] for one in robots[:count]]
    assert found.coefficients()["com_x_m"] == pytest.approx(np.linalg.solve(left, right), rel=1e-6, abs=1e-9)
