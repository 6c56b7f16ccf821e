"""The objective p10: what nine of ten neighbours reach."""

from dataclasses import replace

import pytest

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.models import RobotModel, robot_model
from jumpcad.search.neighbours import NEIGHBOURS
from jumpcad.search.objective import Evaluation, find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.study import run_study

DESIGN = load_design("best-ga")


class Slope(RobotModel):
    """Fitness is the compression ratio; rejected above a limit."""

    limit = 0.9

    def _alone(self, design):
        if design.compression_ratio > self.limit:
            return Evaluation("tips", findings=(Finding("tips", "error", -1.0, "", "", ""),))
        return Evaluation("jump", {"fitness": design.compression_ratio})


def test_it_is_the_worst_of_ten_neighbours_within_one_percent():
    found = Slope("capsule", neighbours_of="fitness")(DESIGN)
    assert found.feasible
    assert 0.99 * DESIGN.compression_ratio <= found.metrics["p10"] < DESIGN.compression_ratio
    assert found.metrics["evaluations"] == 1 + NEIGHBOURS
    assert found.metrics["fitness"] == DESIGN.compression_ratio


@pytest.mark.parametrize("scores", [range(1, NEIGHBOURS + 1), range(NEIGHBOURS, 0, -1)])
def test_each_neighbour_counts_with_its_own_score(scores):
    """The worst of ten, whether it is the first or the last of them; the design itself, with 99, is none of them."""

    class Counting(RobotModel):
        given = iter([99, *scores])

        def _alone(self, design):
            return Evaluation("jump", {"fitness": float(next(self.given))})

    assert NEIGHBOURS == 10
    assert Counting("capsule", neighbours_of="fitness")(DESIGN).metrics["p10"] == 1.0


def test_it_is_a_quantile_of_the_score_that_is_asked_for():
    """Here of the rise, which falls where the range over the longest link grows."""

    class Rising(Slope):
        def _alone(self, design):
            return Evaluation(
                "jump", {"fitness": design.compression_ratio, "com_rise_m": 2.0 - design.compression_ratio}
            )

    found = Rising("capsule", neighbours_of="rise")(DESIGN)
    assert 2.0 - 1.01 * DESIGN.compression_ratio <= found.metrics["p10"] < 2.0 - DESIGN.compression_ratio


def test_a_design_is_rejected_with_its_first_neighbour():
    class Near(Slope):
        limit = DESIGN.compression_ratio * 1.002

    found = Near("capsule", neighbours_of="fitness")(DESIGN)
    assert (found.reasons, found.detail) == (("neighbours",), "tips")
    assert 2 <= found.metrics["evaluations"] < 1 + NEIGHBOURS


def test_designs_that_do_not_jump_cost_one():
    class Low(Slope):
        limit = 0.1

    found = Low("capsule", neighbours_of="fitness")(DESIGN)
    assert found.reasons == ("tips",)
    assert "evaluations" not in found.metrics


@pytest.mark.parametrize(("method", "batch"), [("ga", 1), ("bo", 1), ("bo", 5), ("pareto", 1)])
def test_all_evaluations_count_and_no_more_than_asked_for(method, batch):
    with local_pool(0) as pool:
        others = {"evaluations": 60, "batch": batch, "until_percent": 0.0}
        request = Request.make(Space.default(), Slope("capsule"), method, "p10-fitness", **others)
        assert (request.objective, request.pick) == ("p10-fitness", 0)
        result = run_study(request, None, pool)
    assert result.evaluations == sum(int(t.evaluation.metrics.get("evaluations", 1)) for t in result.trials)
    assert 60 - NEIGHBOURS <= result.evaluations <= 60
    assert len(result.trials) < result.evaluations


@pytest.mark.parametrize("evaluations", [11, 12, 21, 22, 23, 34, 47])
@pytest.mark.parametrize("method", ["ga", "bo", "ga+bo"])
def test_a_search_takes_no_more_than_asked_for_however_few(method, evaluations):
    with local_pool(0) as pool:
        request = Request.make(Space.default(), Slope("capsule"), method, "p10-fitness", evaluations=evaluations)
        result = run_study(request, None, pool)
    assert evaluations - NEIGHBOURS <= result.evaluations <= evaluations
    assert result.trials


def test_fewer_evaluations_than_one_design_takes_are_refused():
    words = "evaluations = 10 must be at least 11 for p10-fitness: a design takes as many with its 10 neighbours"
    with pytest.raises(JumpcadError, match=f"^{words}$"):
        Request.make(Space.default(), Slope("capsule"), "ga", "p10-fitness", evaluations=10)


def test_names():
    assert find_objective("p10-range").neighbours_of == "range"
    with pytest.raises(JumpcadError, match="is not one of the objectives"):
        find_objective("p10-nonsense")


def test_the_margin_of_neighbours_is_how_many_of_ten_jump_before_one_does_not(monkeypatch):
    """Less one, so that it is 0 where all do but the last; each costs its evaluation, as the design itself does."""
    design, looked = load_design("best-ga"), []
    look = Slope._alone
    monkeypatch.setattr(Slope, "_alone", lambda self, one: looked.append(one) or look(self, one))
    found = Slope("capsule", neighbours_of="fitness")(design)
    assert found.margins["neighbours"] == pytest.approx(1.0 / NEIGHBOURS)
    assert found.metrics["evaluations"] == len(looked) == 1 + NEIGHBOURS
    around = looked[1:]
    higher = [place for place, one in enumerate(around) if one.compression_ratio > design.compression_ratio]
    monkeypatch.setattr(Slope, "limit", design.compression_ratio)
    rejected = Slope("capsule", neighbours_of="fitness")(design)
    assert rejected.margins["neighbours"] == pytest.approx(higher[0] / NEIGHBOURS - 1.0)
    assert rejected.metrics["evaluations"] == 2.0 + higher[0]


def test_neighbours_are_the_robot_as_it_may_be_made_half_within_a_percent_half_within_tolerances(monkeypatch):
    """The design is the same in all: what is printed is not laid out anew. The least of ten scores counts."""
    looked = []
    monkeypatch.setattr(
        RobotModel, "_alone",
        lambda self, one: looked.append((one, dict(self.made))) or Evaluation("jump", {"fitness": 10.0 + len(looked)}),
    )  # fmt: skip
    design = load_design("kenan-2.0")
    found = replace(robot_model(), neighbours_of="fitness")(design)
    assert {one for one, _ in looked} == {design}
    plain, *around = (made for _, made in looked)
    percent = [made for made in around if "made.spring_factor" not in made]
    tolerances = [made for made in around if "made.spring_factor" in made]
    assert plain == {}
    assert len(percent) == len(tolerances) == NEIGHBOURS / 2
    for made in percent:
        shares = [abs(value / getattr(design, key.removeprefix("made.")) - 1.0) for key, value in made.items()]
        assert 0.001 < max(shares) <= 0.01 + 1e-9
    for made in tolerances:
        assert made["made.friction_factor"] != 1.0 != made["made.spring_factor"]
    assert found.metrics["p10"] == 12.0  # of 12 to 21
