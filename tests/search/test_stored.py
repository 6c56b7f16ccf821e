"""What a study file cannot have been written is refused."""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.store import StudyStore
from jumpcad.search.stored import (
    require_remembered,
    stored_count,
    stored_figure,
    stored_proposal,
    stored_text,
    stored_workshop,
)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        ({"made.spring_factor": 1e300, "made.friction_factor": 1.0}, "must be a number of 0.01 to 100"),
        ({"made.spring_factor": -1.0, "made.friction_factor": 1.0}, "made.spring_factor = -1"),
        ({"made.spring_factor": 1.0, "made.friction_factor": "x"}, "made.friction_factor = 'x'"),
        ({"made.spring_factor": 1.0}, "made.friction_factor: missing"),
        ({"made.carrying_link_mm": 1e300}, "made.carrying_link_mm = 1e+300"),
        ({"made.stiffness_nmm_per_deg": "x"}, "made.stiffness_nmm_per_deg = 'x'"),
    ],
)
def test_what_cannot_be_made_is_a_damaged_row(tmp_path: Path, made: dict[str, object], message: str) -> None:
    (trial,) = trials(1, phase="robust")
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([replace(trial, workshop=made)])
        with pytest.raises(JumpcadError, match=f"is damaged: row 'robust' 0 0: .*{re.escape(message)}"):
            store.trials()


def proposal(free: int = 8, **said: Any) -> dict[str, Any]:
    return stored_proposal({"proposal": json.dumps(said).encode()}, free)


def test_hyperparameters_fit_the_space() -> None:
    """A scale for each free parameter, a level and a noise: at least three, at most two more than are free."""
    for count in (3, 9, 10):
        assert proposal(theta={"score": [0.5] * count}) == {"theta": {"score": [0.5] * count}}
    for theta in ({"score": [0.5] * 2}, {"score": [0.5] * 11}, [[0.5] * 9]):
        with pytest.raises(JumpcadError, match=r"proposal\.theta: must be lists of at most 10 hyperparameters"):
            proposal(theta=theta)
    assert proposal(theta={"score": [-100.0, 100.0, 0.0]})
    for beyond in (-100.1, 100.1):
        with pytest.raises(JumpcadError, match=r"proposal\.theta"):
            proposal(theta={"score": [beyond, 0.0, 0.0]})


def test_points_that_were_tried_lie_in_the_cube() -> None:
    for count in (1, 8):
        assert proposal(tried=[[0.0] * count, [1.0] * count])
    for tried, words in (
        ([[]], "at most 8 coordinates"),
        ([[0.5] * 9], "at most 8 coordinates"),
        ({"a": [0.5]}, "at most 8 coordinates"),
        ([[1.01]], r"proposal\.tried"),
        ([[-0.01]], r"proposal\.tried"),
    ):
        with pytest.raises(JumpcadError, match=words):
            proposal(tried=tried)


def test_what_else_was_predicted_is_a_number() -> None:
    assert proposal(log_feasible=-0.5) == {"log_feasible": -0.5}
    assert proposal() == {}
    for said in ({"log_feasible": [[0.5]]}, {"log_feasible": "x"}, {"log_feasible": {"a": [0.5]}}):
        with pytest.raises(JumpcadError, match="proposal"):
            proposal(**said)


@pytest.mark.parametrize("value", ["NaN", "Infinity", "-Infinity"])
def test_what_is_no_number_is_neither_predicted_nor_a_value_of_a_workshop(value: str) -> None:
    with pytest.raises(JumpcadError, match=r"proposal\.log_feasible.*finite number"):
        stored_proposal({"proposal": f'{{"log_feasible": {value}}}'.encode()}, 8)
    with pytest.raises(JumpcadError, match=r"workshop\.body\.plate_mm.*finite number"):
        stored_workshop({"workshop": f'{{"body.plate_mm": {value}}}'.encode()}, ("body.plate_mm",))


def test_a_row_has_the_keys_of_the_study_in_their_order_and_may_have_those_of_making() -> None:
    def workshop(values: dict[str, Any], keys: tuple[str, ...], more: tuple[str, ...] = ()) -> dict[str, Any]:
        return stored_workshop({"workshop": json.dumps(values).encode()}, keys, more)

    both, made = {"body.plate_mm": 2.0, "bought.kit": "light-1s"}, {"made.spring_factor": 1.0}
    assert workshop(both, tuple(both)) == both
    assert workshop(both | made, tuple(both), tuple(made)) == both | made
    assert workshop({}, ()) == {}
    for values, keys in (
        (both, tuple(both)[::-1]), (both, tuple(both)[:1]), ({}, tuple(both)), (both | made, tuple(both)),
        (made, tuple(both)),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match="not the keys of the study's space"):
            workshop(values, keys)


@pytest.mark.parametrize("value", [0, 7])
def test_counts_are_whole_and_not_below_nothing(value: int) -> None:
    assert stored_count({"step": value}, "step") == value
    for wrong in (-1, 1.0, "1", None):
        with pytest.raises(JumpcadError, match=r"step = .* is not a whole number of at least 0"):
            stored_count({"step": wrong}, "step")


@pytest.mark.parametrize("value", [0.0, -1e12, 1e12])
def test_figures_are_numbers_that_a_jump_may_have(value: float) -> None:
    assert stored_figure({"score": value}, "score") == value
    for wrong in (1.001e12, -1.001e12, float("nan"), float("inf"), 1, "1", None):
        with pytest.raises(JumpcadError, match=r"score = .* is not a plausible number"):
            stored_figure({"score": wrong}, "score")


def test_texts_are_utf_8() -> None:
    assert stored_text({"model": "größer".encode()}, "model") == "größer"
    for wrong in (b"\xff", "text", None):
        with pytest.raises(JumpcadError, match=r"model = .* is not text"):
            stored_text({"model": wrong}, "model")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"c_coef": {"lower": 1.0}}, "c_coef must be fixed, have lower and upper, or choices"),
        ({"c_coef": {"lower": 1.0, "upper": 2.0, "fixed": 1.0}}, "c_coef must be fixed"),
        ({"c_coef": {"choices": []}}, "at least 1"),
        ({"c_coef": {"fixed": "one"}}, "c_coef must be numbers"),
        ({"c_coef": {"choices": ["one"]}}, "c_coef must be numbers"),
        ({"body": {"fixed": 1.0}}, "no key of a workshop"),
        ({"a.b.c.d.e": {"fixed": 1.0}}, "no key of a workshop"),
        ({"a." + 81 * "b": {"fixed": 1.0}}, "no key of a workshop"),
    ],
)
def test_a_space_is_one_that_was_searched(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(JumpcadError, match=message):
        require_remembered("identity", IDENTITY | {"space": {**IDENTITY["space"], **changes}})  # type: ignore[dict-item]


def test_a_space_may_have_keys_of_a_workshop_after_the_parameters() -> None:
    space: dict[str, Any] = IDENTITY["space"]  # type: ignore[assignment]
    for more in ({"body.plate_mm": {"lower": 1.0, "upper": 2.0}}, {"a.b.c.d": {"choices": ["x"]}},
                 {"a." + 80 * "b": {"fixed": "x"}}):  # fmt: skip
        require_remembered("identity", IDENTITY | {"space": space | more})
    for wrong in (dict(list(space.items())[:7]), dict(reversed(space.items()))):
        with pytest.raises(JumpcadError, match="all eight parameters of a design, in their order"):
            require_remembered("identity", IDENTITY | {"space": wrong})


def test_stages_are_of_known_methods() -> None:
    require_remembered("stages", [{"method": "ga", "evaluations": 0}, {"method": "bo", "evaluations": 9, "initial": 3}])
    for wrong, message in (
        ([], "at least 1"), ([{"method": "gas", "evaluations": 1}], "is none of ga"),
        ([{"method": "ga", "evaluations": -1}], "greater than or equal to 0"), ([{"method": "ga"}], "required"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=message):
            require_remembered("stages", wrong)


def test_a_search_ends_by_what_was_asked_or_for_want_of_designs() -> None:
    for by in ("evaluations", "until", "hours", "space", "proposals"):
        require_remembered("ended", {"by": by})
    for fine in ({"by": "until", "until_percent": 100.0}, {"by": "hours", "hours": 1e6}):
        require_remembered("ended", fine)
    for wrong, message in (
        ({}, "required"), ({"by": "x"}, "should be 'evaluations'"), ({"by": "space", "more": 1}, "more"),
        ({"by": "until", "until_percent": 100.1}, "less than"), ({"by": "hours", "hours": 1.1e6}, "less than"),
        ({"by": "until", "until_percent": -0.1}, "greater than"), ({"by": "hours", "hours": -1.0}, "greater than"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=message):
            require_remembered("ended", wrong)
