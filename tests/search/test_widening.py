"""Active bounds are moved, and the search goes on."""

import math
from dataclasses import replace

import pytest
from support.hills import FIXED, TOP, Hill
from support.shops import SHOP, Shop

from jumpcad.errors import JumpcadError
from jumpcad.search.objective import Evaluation
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request, plan_stages
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore
from jumpcad.search.study import run_study
from jumpcad.search.widening import SHARE, TOGETHER, Widened, _allowed, _judged, _moved, _wider, widen

BELOW = Space.parse(fix=FIXED, bound=["rest_angle_deg=30:50", "stiffness_nmm_per_deg=5:18"])
"""The hill's top (55° and 20 N·mm/°) lies outside."""

pytestmark = pytest.mark.usefixtures("quick_proposals")


def searched(path=None, evaluations=80, **others):
    with local_pool(0) as pool:
        return run_study(Request(BELOW, Hill(), method="bo", evaluations=evaluations, widen=True, **others), path, pool)


def test_a_top_beyond_the_bounds_is_found():
    result = searched()
    assert result.best.score > 9.95
    assert result.best.design.rest_angle_deg == pytest.approx(TOP["rest_angle_deg"], abs=2.0)
    first = {one.name: one for one in result.widened[:3]}
    assert (first["rest_angle_deg"].side, first["rest_angle_deg"].beyond) == ("upper", 50.0 + SHARE * 20.0)
    assert first[TOGETHER].worth > max(first["rest_angle_deg"].worth, 0.0)
    assert result.evaluations <= 80


def test_the_worth_of_a_bound_is_the_difference_of_the_hill(evaluator):
    one = evaluator(space=BELOW)
    design = BELOW.to_design([0.5, 1.0, 0.2])  # of compression, rest angle and stiffness
    (trial,) = one.evaluate([design], "bo", 0)
    (moved,) = widen(one, 0)
    beyond = Hill()(design.model_copy(update={"rest_angle_deg": 55.0})).metrics["fitness"]
    assert moved.worth == pytest.approx(beyond - trial.score)
    assert next(p.upper for p in one.space.free if p.name == "rest_angle_deg") == 55.0


@pytest.mark.parametrize(("share", "active"), [(0.9995, True), (0.998, False)])
@pytest.mark.parametrize(("name", "at"), [("carrying_link_mm", 0), ("c_coef", 1)])
def test_a_bound_is_active_within_a_thousandth_of_its_range(evaluator, name, at, share, active):
    """Of 100 mm as of 0.4: nearer to the bound than a thousandth of the range, whatever its unit."""
    space = Space.parse(fix=[one for one in FIXED if not one.startswith(name)])
    one = evaluator(space=space)
    unit = [share if parameter.name == name else 0.5 for parameter in space.free]
    one.evaluate([space.to_design(unit)], "bo", 0)
    assert [moved.name for moved in widen(one, 0)] == ([name] if active else [])


def test_a_bound_of_what_a_design_can_be_does_not_move(evaluator):
    space = Space.parse(fix=FIXED[:-1], bound=["rest_angle_deg=70:90"])
    one = evaluator(space=space)
    unit = [1.0 if parameter.name == "rest_angle_deg" else 0.5 for parameter in space.free]
    one.evaluate([space.to_design(unit)], "bo", 0)
    assert widen(one, 0) == []


def test_bounds_of_the_workshop_move_as_far_as_it_can_be(evaluator):
    class Limited(Shop):
        def varied(self, values):
            if values["body.plate_mm"] > 2.4:
                raise JumpcadError("too thick")
            return self

    one = evaluator(model=Limited(), space=SHOP)
    one.evaluate([SHOP.to_variant([0.5, 0.5, 0.5, end, 1.0]) for end in (1.0,)], "bo", 0)
    assert widen(one, 0) == []
    one.evaluate([SHOP.to_variant([0.5, 0.5, 0.5, 0.0, 1.0])], "bo", 1)
    (moved,) = widen(one, 1)
    assert (moved.name, moved.side, moved.beyond) == ("body.plate_mm", "lower", pytest.approx(1.2 - SHARE * 1.2))
    wide, narrow = one.trials[-1].score, one.trials[-2].score
    assert moved.worth == pytest.approx(wide - narrow)
    assert wide == pytest.approx(narrow * math.exp(0.16 - 0.49))  # plates of 0.9 and 1.2 mm, the best are of 1.6


def test_it_ends_with_the_rows_of_an_uninterrupted_search(tmp_path):
    class Stop(Exception):
        pass

    def rows(path):
        with StudyStore.read(path) as store:
            return [(trial.position, trial.key, trial.score) for trial in store.trials()]

    searched(tmp_path / "whole.db", 45)
    seen = []

    def stop(trial, computed):
        seen.append(trial)
        if len(seen) == 26:
            raise Stop

    with local_pool(0) as pool, pytest.raises(Stop):
        run_study(Request(BELOW, Hill(), method="bo", evaluations=45, widen=True), tmp_path / "cut.db", pool, stop)
    searched(tmp_path / "cut.db", 45)
    assert rows(tmp_path / "cut.db") == rows(tmp_path / "whole.db")


def test_a_search_that_ended_early_goes_on_alike(tmp_path):
    """Only its last stage ends early: one before would lead the others elsewhere if it went on."""
    request = Request(BELOW, Hill(), method="bo", evaluations=70, widen=True, until_percent=50.0)
    with local_pool(0) as pool:
        early = run_study(request, tmp_path / "s.db", pool)
        longer = run_study(replace(request, until_percent=0.0), tmp_path / "s.db", pool)
    assert early.converged
    assert not longer.converged
    assert len(early.trials) < len(longer.trials)
    assert longer.trials[: len(early.trials)] == early.trials


def test_its_share_is_planned_within_the_evaluations():
    request = Request(BELOW, Hill(), method="ga+bo", evaluations=100, widen=True)
    stages = plan_stages(request)
    assert sum(stage.evaluations for stage in stages) == request.searched
    assert [stage.widen for stage in stages] == [False, False, True, True, True]


def test_where_its_evaluations_do_not_reach_bounds_are_only_moved(evaluator):
    one = evaluator(space=BELOW)
    one.evaluate([BELOW.to_design([0.5, 1.0, 1.0])], "bo", 0)  # of compression, rest angle and stiffness
    first, second, together = widen(one, 0, 1)
    assert len(one.trials) == 2
    assert (first.name, first.unknown, first.worth is None) == ("rest_angle_deg", False, False)
    assert [(moved.unknown, moved.worth) for moved in (second, together)] == [(True, None)] * 2
    assert next(p.upper for p in one.space.free if p.name == second.name) == second.beyond


def test_a_search_of_few_keeps_to_them():
    assert searched(evaluations=8).evaluations == 8


def test_a_front_has_no_best_design_to_widen_for():
    with pytest.raises(JumpcadError, match="widen: does not apply to pareto"):
        Request(BELOW, Hill(), method="pareto", widen=True)


def test_what_is_tried_beyond_bounds_counts_among_the_evaluations():
    """Every stage has its share, of which the designs beyond the bounds are taken: none is searched in addition."""
    request = Request(BELOW, Hill(), method="bo", evaluations=80, widen=True, until_percent=0.0, batch=7)
    with local_pool(0) as pool:
        trials = run_study(request, None, pool).trials
    planned = [stage.evaluations for stage in plan_stages(request)]
    begun = [
        number for number, trial in enumerate(trials) if trial.phase == "widen" and trials[number - 1].phase != "widen"
    ]
    assert begun
    assert set(begun) <= {sum(planned[:count]) for count in range(1, len(planned))}
    assert len(trials) == sum(planned)


def test_a_wider_value_is_tried_with_the_others_of_the_best_workshop(evaluator):
    """What is not of the workshop is always allowed, and all where the model has none."""
    asked = []

    class Picky(Shop):
        def varied(self, values):
            asked.append(dict(values))
            if values["body.plate_mm"] > 2.5:
                raise JumpcadError("too thick")
            return self

    one = evaluator(model=Shop(), space=SHOP)
    (best,) = one.evaluate([SHOP.to_variant([0.5, 0.5, 0.5, 0.0, 1.0])], "bo", 0)
    one.model = Picky()
    allowed = _allowed(one, best)
    assert [allowed("c_coef", 9.0), allowed("body.plate_mm", 2.45), allowed("body.plate_mm", 2.55)] == [
        True,
        True,
        False,
    ]
    assert asked == [{**best.workshop, "body.plate_mm": value} for value in (2.45, 2.55)]
    assert set(best.workshop) == {"body.plate_mm", "bought.battery"}
    assert _allowed(evaluator(space=SHOP), best)("body.plate_mm", 99.0)


def test_bounds_are_moved_by_a_quarter_of_the_range_to_the_side_on_which_the_best_lies(evaluator):
    """Together they make one wider space; the others keep theirs."""
    one = evaluator(space=BELOW)
    (best,) = one.evaluate([BELOW.to_design([0.5, 0.0, 1.0])], "bo", 0)  # of compression, rest angle and stiffness
    moved = _moved(BELOW, best, lambda name, value: name != "stiffness_nmm_per_deg" or value > 0)
    assert moved == [
        Widened("rest_angle_deg", "lower", 30.0, 25.0), Widened("stiffness_nmm_per_deg", "upper", 18.0, 21.25)
    ]  # fmt: skip
    assert _moved(BELOW, best, lambda name, value: name == "rest_angle_deg") == moved[:1]
    wide = {one.name: (one.lower, one.upper) for one in _wider(BELOW, moved).free}
    assert wide == {
        "compression_ratio": (0.1, 0.8), "rest_angle_deg": (25.0, 50.0), "stiffness_nmm_per_deg": (5.0, 21.25)
    }  # fmt: skip
    tips = replace(best, score=None, evaluation=Evaluation("tips"))
    assert _judged(moved[0], best, replace(best, score=best.score + 0.5)) == replace(moved[0], worth=0.5)
    assert _judged(moved[0], best, tips) == replace(moved[0], reason="tips")
    assert [_judged(moved[0], best, trial).unknown for trial in (None, tips)] == [True, False]
    assert moved[0].to_dict() == {
        "name": "rest_angle_deg", "side": "lower", "value": 30.0, "beyond": 25.0, "worth": None, "reason": ""
    }  # fmt: skip
