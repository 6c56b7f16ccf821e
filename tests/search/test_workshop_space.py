"""Searches in which values of the workshop vary with the design's."""

import pickle

import numpy as np
import pytest
from support.shops import HEIGHTS, PLATE_MM, SHOP, Shop
from support.stages import stage

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.search.explore import feasibility_map, sweep
from jumpcad.search.models import PrintedModel, robot_model
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.report import plots
from jumpcad.search.space import Space
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.workshop import load_workshop

WORKSHOP = load_workshop()

pytestmark = pytest.mark.usefixtures("quick_proposals")


def test_points_and_variants_correspond():
    assert SHOP.categories == (0, 0, 0, 0, 2)
    for unit in SHOP.spread(16, np.random.default_rng(0)):
        variant = SHOP.to_variant(unit)
        assert 1.2 <= variant.workshop["body.plate_mm"] <= 2.4
        assert variant.workshop["bought.battery"] in HEIGHTS
        assert SHOP.contains(variant)
        assert not SHOP.contains(variant.design)
        assert SHOP.to_unit(variant) == pytest.approx(unit, abs=1e-9)  # of values with ten decimals
        assert pickle.loads(pickle.dumps(variant)).key == variant.key
    other = SHOP.to_variant(unit).changed({"bought.battery": "another"})
    assert not SHOP.contains(other)


def test_a_space_with_a_workshop_survives_its_record():
    space = Space.parse(
        fix=["bought.leg_bearing=", "body.stop_deg=4"],
        bound=["process.perimeters=2:4"],
        choose=["bought.roller=623,683", "process.infill=0.4,0.15", "release.play_deg=auto"],
        workshop=WORKSHOP,
    )
    assert Space.from_record(space.describe()) == space
    by_name = {parameter.name: parameter for parameter in space.parameters}
    assert by_name["process.perimeters"].choices == (2.0, 3.0, 4.0)  # it is a whole number
    assert by_name["bought.roller"].names == ("623", "683")  # names, though they are digits
    assert by_name["process.infill"].choices == (0.15, 0.4)
    assert [one.name for one in space.of_workshop if not one.free] == [
        "bought.leg_bearing", "body.stop_deg", "release.play_deg",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"bound": ["bought.battery=1:2"]}, "bought.battery"),
        ({"bound": ["body.plate_mm=0.1:2"]}, "must be at least 1"),
        ({"bound": ["body.plate_mm=2:1"]}, "empty range"),
        ({"choose": ["bought.motors=a,b"]}, "is a list"),
        ({"choose": ["bought.battery=lipo-1s-300,nope"]}, "bought.battery = 'nope': is no battery in the catalogue"),
        ({"choose": ["bought.battery=lipo-1s-300"], "fix": ["bought.battery=lipo-1s-300"]}, "given twice"),
    ],
)
def test_wrong_keys_are_refused_in_one_line(option, message):
    with pytest.raises(JumpcadError, match=message) as refused:
        Space.parse(**option, workshop=WORKSHOP)
    assert "\n" not in str(refused.value)


def test_names_have_no_order_for_the_process():
    """Predictions do not change when the names are numbered otherwise (Hamming's distance knows no order)."""
    generator = np.random.default_rng(5)
    x, names = generator.random((30, 2)), generator.integers(0, 4, 30)
    y = np.sin(4 * x[:, 0]) + np.array([0.0, 2.0, -1.0, 0.5])[names]
    order = np.array([2, 0, 3, 1])
    points, at = generator.random((8, 2)), generator.integers(0, 4, 8)

    def predicted(numbers, asked):
        one = Surrogate(np.column_stack([x, numbers / 3]), y, categories=(0, 0, 4))
        assert len(one.theta) == 1 + 2 + 4 + 1
        return one.predict(np.column_stack([points, asked / 3]))

    for plain, renamed in zip(predicted(names, at), predicted(order[names], order[at]), strict=True):
        np.testing.assert_allclose(plain, renamed, rtol=1e-4, atol=1e-4)
    mean, _ = predicted(names, at)
    assert np.abs(mean - np.sin(4 * points[:, 0]) - np.array([0.0, 2.0, -1.0, 0.5])[at]).max() < 0.2


@pytest.mark.thorough
@pytest.mark.parametrize(("method", "evaluations", "at_least"), [("ga", 400, 9.0), ("ga+bo", 80, 9.5)])
def test_methods_find_the_best_values_of_the_workshop(method, evaluations, at_least):
    with local_pool(0) as pool:
        result = run_study(Request(SHOP, Shop(), method=method, evaluations=evaluations), None, pool)
    assert result.best.score > at_least
    assert result.best.workshop["bought.battery"] == "lipo-1s-300"
    assert abs(result.best.workshop["body.plate_mm"] - PLATE_MM) < 0.25
    assert {trial.workshop["bought.battery"] for trial in result.trials} == set(HEIGHTS)


def test_the_genetic_algorithm_keeps_trying_other_names(evaluator):
    one = evaluator(model=Shop(), space=SHOP)
    run_genetic(one, stage(200, 3))
    late = [trial.workshop["bought.battery"] for trial in one.trials[-60:]]
    assert set(late) == set(HEIGHTS)


def test_sweeps_start_from_the_model_s_workshop(evaluator):
    one = evaluator(model=Shop(), space=SHOP)
    sweeps = {found.parameter: found for found in sweep(one, SHOP.to_design(np.full(5, 0.5)), 5)}
    assert [trial.workshop["bought.battery"] for trial in sweeps["bought.battery"].trials] == list(HEIGHTS)
    assert {t.workshop["body.plate_mm"] for t in sweeps["bought.battery"].trials} == {WORKSHOP.body.plate_mm}
    assert {t.workshop["bought.battery"] for t in sweeps["body.plate_mm"].trials} == {WORKSHOP.bought.battery}
    assert plots.sweeps(list(sweeps.values()), find_objective("fitness"))
    grid = feasibility_map(one, SHOP.to_design(np.full(5, 0.5)), "bought.battery", "body.plate_mm", 3)
    assert len(grid.trials) == 3
    assert plots.feasibility(grid)


def test_values_that_do_not_go_together_are_a_verdict():
    design = load_design("best-printable")
    found = PrintedModel(workshop=WORKSHOP)(design, {"process.layer_height_mm": 0.3, "printer.nozzle_mm": 0.25})
    assert (found.verdict, found.feasible) == ("workshop", False)
    assert "nozzle" in found.detail


@pytest.mark.thorough
def test_the_winner_s_files_make_the_robot_that_was_searched(tmp_path, monkeypatch):
    monkeypatch.setattr("jumpcad.search.propose.initial_designs.SCREENED", 8)
    design = load_design("best-printable")
    space = Space.make(fixed=design.model_dump(), choices={"body.plate_mm": [1.6, 2.0]}, workshop=WORKSHOP)
    with local_pool(0) as pool:
        result = run_study(Request(space, robot_model(), method="ga", evaluations=2), None, pool)
    result.save(tmp_path / "best.toml")
    again = evaluate(load_design(tmp_path / "best.toml"), load_workshop(tmp_path / "best-workshop.toml"))
    assert again.body_lengths == pytest.approx(result.score, rel=1e-12)
    assert load_workshop(tmp_path / "best-workshop.toml") == result.workshop
