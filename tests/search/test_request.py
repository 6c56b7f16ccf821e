"""What a study is asked for, and its stages."""

import inspect
from dataclasses import replace

import pytest
from support.hills import SMALL, Hill

import jumpcad
from jumpcad.cli import optimize
from jumpcad.errors import JumpcadError
from jumpcad.search.methods import FRONTS
from jumpcad.search.models import robot_model
from jumpcad.search.request import Request, plan_stages
from jumpcad.search.space import Space


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


def test_only_what_was_asked_for_is_in_a_studys_identity():
    plain = Request(SMALL, Hill(), method="ga", evaluations=40)
    known = plain.identity([])
    assert "widen" not in known
    assert "screen" not in known
    assert known["prior"] is None
    wider = replace(plain, widen=True)
    assert wider.identity([])["widen"] is True
    names = {plain.default_name(), wider.default_name(), replace(plain, seed=plain.seed + 1).default_name()}
    assert len(names) == 3
    assert replace(plain, evaluations=50).default_name() == plain.default_name()
    printed = robot_model()
    screened = Request(SMALL, printed, "body_lengths", "ga", 40, screen=True)
    assert screened.identity([])["screen"] == printed.guess_engine  # another engine guesses otherwise


def test_a_fixed_value_of_the_workshop_leaves_one_workshop_to_guess_in():
    model = robot_model()
    spaces = [Space.parse(**asked, workshop=model.workshop) for asked in (
        {}, {"fix": ["body.plate_mm=2.4"]}, {"bound": ["body.plate_mm=1.6:2.4"]},
    )]  # fmt: skip
    assert [Request.make(space, model, "bo").guessed for space in spaces] == [True, True, False]


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
    """A widened search ends by it, whatever it began with."""
    assert Request(SMALL, Hill(), method="ga", widen=True, **given).widen
    with pytest.raises(JumpcadError, match=r"does not apply to ga, only to ga\+bo, bo"):
        Request(SMALL, Hill(), method="ga", **given)


def test_what_is_not_said_is_the_same_in_python_and_on_the_command_line():
    """Random seed 0, one proposal at a time, no limit of time, bounds as they are, no guesses."""
    plain = vars(Request(SMALL, Hill()))
    usual = {"seed": 0, "preset": "recommended", "batch": 1, "hours": 0.0, "widen": False, "screen": False}
    usual |= {"method": "bo", "evaluations": plain["evaluations"], "until_percent": plain["until_percent"]}
    assert {name: plain[name] for name in usual} == usual
    called = {name: one.default for name, one in inspect.signature(jumpcad.optimize).parameters.items()}
    assert {name: called[name] for name in usual} == usual
    typed = {name: one.default for name, one in inspect.signature(optimize.optimize).parameters.items()}
    assert typed.pop("until") == usual["until_percent"]
    common = usual.keys() - {"method", "until_percent"}  # which a command's help names
    assert {name: typed[name] for name in common} == {name: usual[name] for name in common}
    assert typed["limit"] == called["limit_s"] == 60.0
    assert typed["model"] == called["model"] == "printed"


def test_half_of_a_search_that_widens_goes_on_in_three_steps_from_moved_bounds():
    """Of 240 evaluations 180 are the search's: 90, then three times 30 by `bo`, whatever came before."""
    for method in ("bo", "ga"):
        stages = plan_stages(Request(SMALL, Hill(), method=method, evaluations=240, widen=True))
        assert [stage.method for stage in stages] == [method, "bo", "bo", "bo"]
        assert [stage.evaluations for stage in stages] == [90, 30, 30, 30]
        assert [stage.widen for stage in stages] == [False, True, True, True]


@pytest.mark.parametrize("method", FRONTS)
def test_a_front_has_no_bounds_to_widen(method: str) -> None:
    with pytest.raises(JumpcadError, match=f"widen: does not apply to {method}, which has no best design"):
        Request(SMALL, Hill(), method=method, widen=True)
