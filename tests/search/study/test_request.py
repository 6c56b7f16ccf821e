"""What a study is asked for, and its stages."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from support.hills import SMALL, Hill
from support.studies import trials

from jumpcad.errors import JumpcadError
from jumpcad.search.models import robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request, plan_stages
from jumpcad.search.study.run import run_study
from jumpcad.workshop import load_workshop

PLAIN = Request(SMALL, Hill(), method="bo", evaluations=40)
CHOICE = Space.parse(choose=["bought.spring=,9271K589"], workshop=robot_model().workshop)


def test_a_quarter_of_the_evaluations_examines_neighbours_and_the_first_of_two_methods_has_a_third_of_the_rest():
    """At most 200, and none where it would be fewer than six; of two methods the first has 50 at most."""
    for evaluations, share in ((1, 0), (23, 0), (24, 6), (27, 6), (250, 62), (799, 199), (800, 200), (10_000, 200)):
        assert replace(PLAIN, evaluations=evaluations).pick == share
    for method, evaluations, split in (
        ("ga+bo", 250, [50, 138]), ("ga+bo", 60, [15, 30]), ("ga+bo", 1000, [50, 750]), ("ga", 7, [7]),
        ("ga+bo", 1, [0, 1]),
    ):  # fmt: skip
        stages = plan_stages(replace(PLAIN, method=method, evaluations=evaluations))
        assert [stage.evaluations for stage in stages] == split


def test_the_first_designs_are_three_for_each_free_parameter_and_those_of_a_prior_study_stand_for_them():
    """Who follows another method begins with its designs; a genetic algorithm has a generation of its own."""
    for method, prior, first in (
        ("bo", 0, [9]), ("bo", 4, [5]), ("bo", 20, [0]), ("ga", 0, [0]), ("ga+bo", 0, [0, 0]),
    ):  # fmt: skip
        stages = plan_stages(replace(PLAIN, method=method, evaluations=240), prior)
        assert [stage.initial for stage in stages] == first, (method, prior)


def test_a_fixed_value_of_the_workshop_leaves_one_workshop_to_guess_in():
    model = robot_model()
    spaces = [Space.parse(**asked, workshop=model.workshop) for asked in (
        {}, {"fix": ["body.plate_mm=2.4"]}, {"bound": ["body.plate_mm=1.6:2.4"]},
    )]  # fmt: skip
    assert [Request(space, model, method="bo").estimated for space in spaces] == [True, True, False]


def test_numbers_of_a_request_have_ends_that_are_told():
    """A seed is one of 2^32: numpy's generators take no other."""
    for name, least, most, step in (
        ("seed", 0, 2**32 - 1, 1), ("until_percent", 0.0, 100.0, 0.1), ("hours", 0.0, 1e6, 0.1),
        ("evaluations", 1, 1_000_000, 1),
    ):  # fmt: skip
        for value in (least, most):
            assert getattr(replace(PLAIN, **{name: value}), name) == value
        for value, words in ((least - step, f"at least {least:g}"), (most + step, ".*at most")):
            with pytest.raises(JumpcadError, match=f"{name} = .* must be {words}"):
                replace(PLAIN, **{name: value})


def test_the_published_stages_have_an_evaluation_each():
    """Seven: random designs, three runs of the genetic algorithm, and the three searches near its best."""
    with pytest.raises(JumpcadError, match="leave 6 for paper, whose parts take 7 at least: ask for more"):
        replace(PLAIN, method="paper", evaluations=6)
    with local_pool(0) as pool:
        trials = run_study(Request(Space.default(), Hill(), method="paper", evaluations=7), None, pool).trials
    assert Counter((trial.phase, trial.run) for trial in trials) == {
        ("sample", 0): 1, **{("ga", run): 1 for run in range(3)}, **{("bo", mode): 1 for mode in range(3)},
    }  # fmt: skip


def test_a_screen_is_for_the_genetic_algorithm_on_printed_robots_of_one_workshop():
    usual = {"space": SMALL, "model": robot_model(), "objective": "body_lengths", "method": "ga", "screen": True}
    plate = Space.parse(fix=["body.plate_mm=2.4"], workshop=robot_model().workshop)
    assert Request(**usual).screen
    for asked, said in (
        ({"method": "bo"}, "does not apply to bo, only to ga"), ({"method": "ga+bo"}, "does not apply to ga"),
        ({"model": robot_model("capsule"), "objective": "fitness"}, "applies to the printed robot"),
        ({"space": plate}, "applies to one workshop"),
        ({"model": robot_model().varied({"bought.spring": "9271K589"})}, "applies to one workshop with springs made"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=rf"screen( = True)?: {said}"):
            Request(**usual | asked)


def test_all_that_decides_the_trials_of_a_study_makes_another_one_and_another_name_of_its_file():
    """But their number, unless each of several parts has a share of it."""
    changes = (
        {"space": Space.default()}, {"objective": "range"}, {"method": "ga+bo"}, {"seed": 4}, {"batch": 3},
        {"prior": Path("p.db")}, {"model": Hill(name="other")},
    )  # fmt: skip
    others = [replace(PLAIN, **change) for change in changes]
    assert len({PLAIN.default_name(), *(one.default_name() for one in others)}) == 1 + len(others)
    identities = [one.identity([]) for one in (PLAIN, *others) if one.prior is None]
    assert all(one not in identities[:place] for place, one in enumerate(identities))
    prior = [trial for trial in trials(4) if trial.score is not None]
    assert PLAIN.identity(prior)["prior"] != PLAIN.identity(prior[1:])["prior"] != PLAIN.identity([])["prior"] is None
    assert set(PLAIN.identity([])["versions"]) == {"hill", "scipy", "scikit-learn", "pygad"}
    for method, same in (("bo", True), ("ga", True), ("ga+bo", False), ("paper", False)):
        one = replace(PLAIN, method=method)
        assert (replace(one, evaluations=80).default_name() == one.default_name()) == same
    assert others[2].default_name().startswith("study-ga-bo-")


def test_what_is_not_asked_for_follows_from_method_and_robot():
    """A front's objective is the range; proposals learn from figures of stand-ins, but for those of `ga` alone."""
    printed, capsule = robot_model(), robot_model("capsule")
    made = {
        (model.name, method): Request(SMALL, model, method=method, evaluations=9)
        for model in (printed, capsule)
        for method in ("bo", "ga", "ga+bo", "nsga2", "pareto")
    }
    assert Request(SMALL, capsule).method == "bo"
    assert {one.aim.name for (_, method), one in made.items() if method in ("nsga2", "pareto")} == {"range"}
    assert [made[name, "ga"].aim.name for name in ("printed", "capsule")] == ["body_lengths", "fitness"]
    stand_ins = {key for key, one in made.items() if one.model.describe().get("stand_in")}
    assert stand_ins == {("printed", "bo"), ("printed", "ga+bo"), ("printed", "pareto")}
    assert Request(SMALL, printed, method="ga", screen=True).model.stand_in
    assert Request(SMALL, printed, "rest", "ga").model.scored == ("rest_distance_m",)
    assert not made["printed", "ga"].model.scored  # two seconds a design are for who asks for them
    own = Request(SMALL, capsule, method="ga", objective=lambda figures: 1.0)
    assert replace(own, seed=3).aim is own.aim
    assert own.identity([])["objective_code"] == own.aim.code != ""


def test_what_does_not_go_together_is_refused_before_anything_is_evaluated():
    usual = {"space": CHOICE, "model": robot_model(), "objective": "range", "method": "ga", "evaluations": 40}
    assert Request(**usual).method == "ga"
    for asked, said in (
        ({"method": "pareto", "against": "spring-energy"}, "bought.spring: a front against spring energy takes spr"),
        ({"method": "gaa"}, "'gaa' is not one of the methods ga.bo, ga, bo, pareto, paper, nsga2 .did you mean ga"),
        ({"preset": "fast"}, "'fast' is not one of the presets recommended, published"),
        ({"method": "bo", "preset": "published"}, "preset = 'published': does not apply to bo, only to ga.bo, ga$"),
        ({"method": "ga", "batch": 3}, r"does not apply to ga, only to ga\+bo, bo"),
        ({"method": "ga", "until_percent": 1.0}, r"does not apply to ga, only to ga\+bo, bo"),
        ({"objective": "reach"}, "'reach' is not one of the objectives"), ({"batch": 0}, "batch = 0 must be at least"),
        ({"model": robot_model("published"), "objective": "rise"}, "the objective rise needs com_rise_m"),
        ({"model": robot_model("capsule"), "objective": "jumps-per-joule"}, "needs electrical_energy_j"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=said):
            Request(**usual | asked)


def test_what_a_front_is_against_follows_from_the_robot_and_is_refused_elsewhere():
    """The winding takes electricity where there is a motor: in printed robots."""
    printed, capsule = robot_model(), robot_model("capsule")
    assert Request(Space.default(), printed, method="pareto").cost.name == "electrical-energy"
    assert Request(Space.default(), capsule, method="pareto").cost.name == "spring-energy"
    light = Request(Space.default(), capsule, method="nsga2", against="mass")
    assert light.identity([])["against"] == "mass"
    assert "against" not in Request(Space.default(), capsule, method="nsga2").identity([])
    for method, model, against, said in (
        ("bo", printed, "mass", "against: does not apply to bo, only to pareto, nsga2"),
        ("pareto", capsule, "electrical-energy", "against electrical-energy needs electrical_energy_j, which this mod"),
        ("pareto", capsule, "", "against = '' is none of electrical-energy"),
        ("pareto", capsule, "range", "against = 'range' is the objective itself"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=said):
            Request(Space.default(), model, method=method, against=against)
    spring = Space.make(choices={"bought.spring": ["", "9271K619"]}, workshop=load_workshop())
    assert Request(spring, printed, method="pareto").cost.name == "electrical-energy"
    with pytest.raises(JumpcadError, match=r"bought\.spring: a front against spring energy"):
        Request(spring, printed, method="pareto", against="spring-energy")
