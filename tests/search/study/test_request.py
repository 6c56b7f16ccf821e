"""What a study is asked for, and its stages."""

import hashlib
import json
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from support.hills import SMALL, Hill
from support.studies import trials

from jumpcad.errors import JumpcadError
from jumpcad.search.models import robot_model
from jumpcad.search.pick.tolerances import Tolerances
from jumpcad.search.space import Space
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request, plan_stages
from jumpcad.search.study.run import run_study
from jumpcad.search.study.versions import versions
from jumpcad.workshop import load_workshop


@pytest.mark.parametrize(
    ("method", "evaluations", "split"),
    [
        ("ga+bo", 250, [50, 138]),
        ("ga+bo", 60, [15, 30]),
        ("ga+bo", 1000, [50, 750]),
        ("ga", 7, [7]),
        ("ga+bo", 1, [0, 1]),
    ],
)
def test_split_of_the_budget(method, evaluations, split):
    stages = plan_stages(Request(SMALL, Hill(), method=method, evaluations=evaluations))
    assert [stage.evaluations for stage in stages] == split
    assert evaluations - sum(split) == (0 if evaluations < 24 else min(evaluations // 4, 200))


def test_a_quarter_of_the_evaluations_examines_neighbours():
    """At most 200, and none where it would be fewer than six."""
    for evaluations, share in ((1, 0), (23, 0), (24, 6), (27, 6), (250, 62), (799, 199), (800, 200), (10_000, 200)):
        assert Request(SMALL, Hill(), evaluations=evaluations).pick == share


def test_a_fixed_value_of_the_workshop_leaves_one_workshop_to_guess_in():
    model = robot_model()
    spaces = [Space.parse(**asked, workshop=model.workshop) for asked in (
        {}, {"fix": ["body.plate_mm=2.4"]}, {"bound": ["body.plate_mm=1.6:2.4"]},
    )]  # fmt: skip
    assert [Request.make(space, model, "bo").estimated for space in spaces] == [True, True, False]


@pytest.mark.parametrize(
    ("name", "least", "most", "step"),
    [
        ("seed", 0, 2**32 - 1, 1),
        ("until_percent", 0.0, 100.0, 0.1),
        ("hours", 0.0, 1e6, 0.1),
        ("evaluations", 1, 1_000_000, 1),
    ],
)
def test_numbers_of_a_request_have_ends_that_are_told(name, least, most, step):
    """A seed is one of 2^32: numpy's generators take no other."""
    plain = Request(SMALL, Hill(), method="bo", evaluations=40)
    for value in (least, most):
        assert getattr(replace(plain, **{name: value}), name) == value
    for value, words in ((least - step, f"at least {least:g}"), (most + step, "at most")):
        with pytest.raises(JumpcadError, match=f"{name} = .* must be {words}"):
            replace(plain, **{name: value})


@pytest.mark.parametrize("given", [{"until_percent": 1.0}, {"batch": 3}])
def test_what_applies_to_bayesian_optimisation_alone_applies_to_every_search_that_goes_on_with_it(given):
    Request(SMALL, Hill(), method="ga+bo", **given)
    with pytest.raises(JumpcadError, match=r"does not apply to ga, only to ga\+bo, bo"):
        Request(SMALL, Hill(), method="ga", **given)


def test_the_studys_stages_have_an_evaluation_each():
    """Seven: random designs, three runs of the genetic algorithm, and the three searches near its best."""
    shared = "leave {} for paper, whose parts take 7 at least: ask for more"
    for evaluations in (1, 6):
        with pytest.raises(JumpcadError, match=shared.format(evaluations)):
            Request(SMALL, Hill(), method="paper", evaluations=evaluations)
    with local_pool(0) as pool:
        trials = run_study(Request(Space.default(), Hill(), method="paper", evaluations=7), None, pool).trials
    assert Counter((trial.phase, trial.run) for trial in trials) == {
        ("sample", 0): 1, **{("ga", run): 1 for run in range(3)}, **{("bo", mode): 1 for mode in range(3)},
    }  # fmt: skip


@pytest.mark.parametrize(("prior", "first"), [(0, 9), (4, 5), (20, 0)])
def test_designs_of_a_prior_study_stand_for_first_ones(prior, first):
    """Of three for each of three free parameters."""
    assert plan_stages(Request(SMALL, Hill(), method="bo", evaluations=240), prior)[0].initial == first


def test_who_follows_another_method_begins_with_its_designs_and_has_no_first_ones():
    """Nor has a genetic algorithm, whose first generation is its own."""
    for method in ("ga", "ga+bo"):
        stages = plan_stages(Request(SMALL, Hill(), method=method, evaluations=240))
        assert [stage.initial for stage in stages] == [0] * len(stages)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"method": "bo"}, "does not apply to bo, only to ga"), ({"method": "ga+bo"}, "does not apply to ga"),
        ({"model": robot_model("capsule"), "objective": "fitness"}, "applies to the printed robot"),
        ({"space": Space.parse(fix=["body.plate_mm=2.4"], workshop=robot_model().workshop)}, "applies to one workshop"),
        ({"model": robot_model().varied({"bought.spring": "9271K589"})}, "applies to one workshop with springs made"),
    ],
)  # fmt: skip
def test_a_screen_is_for_the_genetic_algorithm_on_printed_robots_of_one_workshop(asked, said):
    usual = {"space": SMALL, "model": robot_model(), "objective": "body_lengths", "method": "ga", "screen": True}
    assert Request(**usual).screen
    with pytest.raises(JumpcadError, match=rf"screen( = True)?: {said}"):
        Request(**usual | asked)


def test_a_study_s_identity_is_all_that_decides_its_trials():
    """But their number. Each part of it makes another study, and another name of the file that keeps it."""
    prior = [trial for trial in trials(4) if trial.score is not None]
    plain = Request(SMALL, Hill(), "fitness", "bo", 40, seed=3, batch=2)
    found = plain.identity(prior)
    learned = json.dumps([[trial.key, trial.score] for trial in prior])
    assert found.pop("prior") == hashlib.sha256(learned.encode()).hexdigest()
    assert set(found["versions"]) == {"hill", "scipy", "scikit-learn", "pygad"}
    assert found["versions"].pop("hill") == "1"
    assert found["versions"] == versions("scipy", "scikit-learn", "pygad")
    del found["versions"]
    making = {"length_mm": 0.2, "rate": 0.0, "mass": 0.0, "floor": 0.0, "printed": False}
    assert found == {
        "model": {"name": "hill"}, "objective": "fitness", "method": "bo", "space": SMALL.describe(), "seed": 3,
        "preset": "recommended", "batch": 2, "making": making,
    }  # fmt: skip
    others = [
        replace(plain, **change)
        for change in (
            {"space": Space.default()}, {"objective": "range"}, {"method": "ga+bo"}, {"seed": 4}, {"batch": 3},
            {"making": Tolerances(0.3)}, {"prior": Path("p.db")},
        )
    ]  # fmt: skip
    assert len({plain.default_name(), *(one.default_name() for one in others)}) == 1 + len(others)
    assert plain.default_name().startswith("study-bo-")
    assert others[2].default_name().startswith("study-ga-bo-")
    longer = [replace(one, evaluations=80).default_name() == one.default_name() for one in (plain, others[2])]
    assert longer == [True, False]  # of two methods each has its share
    bred = replace(plain, method="ga", batch=1)
    assert replace(bred, preset="published").identity([])["preset"] == "published"
    assert replace(bred, preset="published").default_name() != bred.default_name()
    assert replace(plain, method="paper", batch=1, evaluations=80).default_name() != replace(
        plain, method="paper", batch=1
    ).default_name()  # fmt: skip


def test_what_is_not_asked_for_follows_from_method_and_robot():
    """A front's objective is the range; proposals learn from figures of stand-ins, but for those of `ga` alone."""
    printed, capsule = robot_model(), robot_model("capsule")
    made = {
        (model.name, method): Request.make(SMALL, model, method, evaluations=9)
        for model in (printed, capsule)
        for method in (None, "ga", "ga+bo", "nsga2", "pareto")
    }
    assert {one.method for (_, method), one in made.items() if method is None} == {"bo"}
    assert {one.objective for (_, method), one in made.items() if method in ("nsga2", "pareto")} == {"range"}
    assert [made[name, "ga"].objective for name in ("printed", "capsule")] == ["body_lengths", "fitness"]
    stand_ins = {key for key, one in made.items() if one.model.describe().get("stand_in")}
    assert stand_ins == {("printed", None), ("printed", "ga+bo"), ("printed", "pareto")}
    assert Request.make(SMALL, printed, "ga", screen=True).model.stand_in
    assert (made["printed", None].making, made["capsule", None].making) == (printed.making, capsule.making)
    own = Request.make(SMALL, capsule, "ga", lambda figures: 1.0)
    assert own.own is own.aim
    assert own.identity([])["objective_code"] == own.aim.code != ""


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"method": "pareto"}, "bought.spring: a front against spring energy takes springs made to order"),
        ({"method": "nsga2"}, "bought.spring: a front against spring energy takes springs made to order"),
        ({"method": "gaa"}, "'gaa' is not one of the methods ga.bo, ga, bo, pareto, paper, nsga2 .did you mean ga"),
        ({"preset": "fast"}, "'fast' is not one of the presets recommended, published"),
        ({"method": "bo", "preset": "published"}, "preset = 'published': does not apply to bo, only to ga.bo, ga$"),
        ({"method": "paper", "preset": "published"}, "preset = 'published': does not apply to paper"),
        ({"objective": "reach"}, "'reach' is not one of the objectives"),
        ({"batch": 0}, "batch = 0 must be at least 1"), ({"evaluations": 0}, "evaluations = 0 must be at least 1"),
        ({"model": robot_model("published"), "objective": "rise"}, "the objective rise needs com_rise_m"),
        ({"model": robot_model("capsule"), "objective": "jumps-per-joule"}, "needs electrical_energy_j"),
    ],
)  # fmt: skip
def test_what_does_not_go_together_is_refused_before_anything_is_evaluated(asked, said):
    space = Space.parse(choose=["bought.spring=,9271K589"], workshop=robot_model().workshop)
    usual = {"space": space, "model": robot_model(), "objective": "range", "method": "ga", "evaluations": 40}
    assert Request(**usual).method == "ga"
    with pytest.raises(JumpcadError, match=said):
        Request(**usual | asked)


def test_what_a_front_is_against_follows_from_the_robot_and_is_refused_elsewhere():
    """The winding takes electricity where there is a motor: in printed robots."""
    printed, capsule = robot_model(), robot_model("capsule")
    assert Request.make(Space.default(), printed, "pareto").against == "electrical-energy"
    assert Request.make(Space.default(), capsule, "pareto").against == "spring-energy"
    light = Request.make(Space.default(), capsule, "nsga2", against="mass")
    assert light.identity([])["against"] == "mass"
    assert "against" not in Request.make(Space.default(), capsule, "nsga2").identity([])
    for method, model, against, said in (
        ("bo", printed, "mass", "against: does not apply to bo, only to pareto, nsga2"),
        (
            "pareto",
            capsule,
            "electrical-energy",
            "against electrical-energy needs electrical_energy_j, which this model does not give",
        ),
        ("pareto", capsule, "", "against = '' is none of electrical-energy"),
        ("pareto", capsule, "range", "against = 'range' is the objective itself"),
        ("pareto", capsule, "weight", "against = 'weight' is none of electrical-energy"),
    ):
        with pytest.raises(JumpcadError, match=said):
            Request.make(Space.default(), model, method, against=against)

    def range(figures):
        return figures["fitness"]

    assert Request.make(Space.default(), capsule, "pareto", range, against="range").objective == "range"
    spring = Space.make(choices={"bought.spring": ["", "9271K619"]}, workshop=load_workshop())
    assert Request.make(spring, printed, "pareto").cost.name == "electrical-energy"
    with pytest.raises(JumpcadError, match=r"bought\.spring: a front against spring energy"):
        Request.make(spring, printed, "pareto", against="spring-energy")
