"""A trial as a row of a study file and back; what no search can have written is refused."""

import json
import math
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest
from pydantic import TypeAdapter
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.findings import bare
from jumpcad.search.study import summary
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.record import COLUMNS, REMEMBERED, read_trial, to_row, validated
from jumpcad.search.study.trial import Trial

MADE = {"made.spring_factor": 0.9, "made.friction_factor": 1.1}
SCORED = next(trial for trial in trials(8, "bo", 1) if trial.score is not None)


def again(trial: Trial, keys: tuple[str, ...] = (), free: int = 7) -> Trial:
    return read_trial(to_row(trial), free, keys)


def test_a_trial_reads_back_as_it_was_written_to_the_last_bit() -> None:
    findings = (bare("loop", "error", -1.5, "mm"), bare("tips", "info", 0.1 + 0.2, ""),
                bare("audit_energy", "warning", -math.inf, "J"))  # fmt: skip
    told = replace(
        SCORED, phase="bo", run=2, step=12, place=34, score=1.0 / 3.0, model="digest", duration_s=6.25,
        evaluation=Evaluation("jump", {"fitness": math.pi, "a": -8.0}, findings, "größer"),
        proposal={"log_improvement": -1.5, "theta": {"score": [0.5, 0.25, 0.125]}, "tried": [[0.1, 0.2]]},
        workshop={"body.plate_mm": 2.0, "bought.spring": "x"},
    )  # fmt: skip
    found = again(told, ("body.plate_mm", "bought.spring"))
    assert found == told
    assert list(found.evaluation.metrics) == ["fitness", "a"]
    row = dict(zip(COLUMNS, to_row(told), strict=True))
    assert (row["phase"], row["run"], row["step"], row["place"], row["score"]) == ("bo", 2, 12, 34, 1.0 / 3.0)
    for score in (0.0, -2.5, None):  # of nothing, which is not that of a rejected design
        assert again(replace(SCORED, score=score)).score == score


def test_a_damaged_field_is_named() -> None:
    design = SCORED.design.model_dump()
    wrong: dict[str, tuple[Any, ...]] = {
        "phase": ("x", None), "run": ("one", -1), "step": (1.5, "1"), "place": (-1, None),
        "score": ("x", math.inf, math.nan, 1e13), "design": ([1.0] * 8, design | {"c_coef": 1e9}, {}, "x"),
        "workshop": ({"a.b": 1.0}, {"a.b": {}}, 5), "model": (5,), "duration_s": ("x", math.inf), "more": (1,),
        "evaluation.verdict": ("\x1b[31m", "", "=1+1", 5),
        "evaluation.metrics": ({"fitness": math.nan}, {"fitness": "x"}, {"=1": 1.0}, {"fitness": 1e300}, []),
        "evaluation.findings": ([["loop", "fine", 1.0, "mm"]], [["loop", "info", math.nan, ""]],
                                [["=1", "info", 1.0, ""]], [[]]),
        "evaluation.detail": (None,),
        "proposal": (
            5, {"log_feasible": math.nan}, {"log_feasible": [[0.5]]}, {}, {"theta": {"score": [1.0] * 2}},
            {"theta": {"score": [1.0] * 10}}, {"theta": {"score": [101.0] * 3}},
            {"theta": {"score": [1.0] * 3}, "tried": [[1.01]]}, {"theta": {"score": [1.0] * 3}, "tried": [[]]},
            {"theta": {"score": [1.0] * 3}, "tried": [[0.5] * 8]},
        ),
    }  # fmt: skip
    *place, good = to_row(SCORED)
    texts = [("record", text) for text in ("", "{", "[]", None, 5, b"\xff", "{}", "[" * 9999)]
    for name, values in wrong.items():
        for value in values:
            record = json.loads(good)
            *above, last = name.split(".")
            (record[above[0]] if above else record)[last] = value
            texts.append((last, json.dumps(record)))
    for name, text in texts:
        with pytest.raises(JumpcadError, match=r"^row 'bo' 0 1 ") as caught:
            read_trial((*place, text), 7, ())
        told = str(caught.value)
        assert told.isprintable(), (name, text)
        assert name in told or name == "design", (name, text, told)


def test_a_step_that_starts_from_the_one_before_has_its_hyperparameters() -> None:
    """Of a method that learns; its first designs, also those of its next run, are drawn and have none."""
    for phase in ("bo", "pareto", "ga", "robust", "sample"):
        for run, step in ((0, 0), (0, 1), (1, 0), (1, 1)):
            without = replace(SCORED, phase=phase, run=run, step=step, proposal={})
            if phase in ("bo", "pareto") and step:
                with pytest.raises(JumpcadError, match=rf"row '{phase}' {run} {step} .*: proposal.theta: missing"):
                    again(without)
            else:
                assert again(without) == without


def test_only_neighbours_of_the_pick_are_made_otherwise_than_designed() -> None:
    robust = replace(SCORED, phase="robust", workshop=MADE)
    assert again(robust) == robust
    with pytest.raises(JumpcadError, match=r"row 'bo'.*made\.spring_factor"):
        again(replace(robust, phase="bo"))
    varied = replace(SCORED, workshop={"body.plate_mm": 2.0, "bought.kit": "light-1s"})
    for keys in ((), ("body.plate_mm",), ("bought.kit", "body.plate_mm")):
        with pytest.raises(JumpcadError, match="not the keys of the study's space"):
            again(varied, keys)


def test_what_a_study_remembers_is_what_a_search_remembered() -> None:
    space, candidate = IDENTITY["space"], {
        "trial": ["bo", 0, 1, 0], "parameters_score": 1.0, "print_score": 2.0, "rejections": {"tips": 1},
        "neighbours": 2,
    }  # fmt: skip
    bound = {"name": "c_coef", "side": "upper", "value": 1.0, "beyond": 1.1, "worth": None, "reason": "tips"}
    pick = {"designs": 9, "evaluations": 6, "candidates": [candidate], "bounds": [bound]}
    fine: dict[str, list[Any]] = {
        "identity": [IDENTITY, *(IDENTITY | {"space": space | more} for more in (
            {"body.plate_mm": {"lower": 1.0, "upper": 2.0}}, {"a.b.c.d": {"choices": ["x"]}},
            {f"a.{80 * 'b'}": {"fixed": "x"}}))],
        "stages": [[{"method": "ga", "evaluations": 0}], [{"method": "bo", "evaluations": 9, "initial": 3}]],
        "ended": [None, {"by": "space"}, {"by": "until", "until_percent": 100.0}, {"by": "hours", "hours": 1e6}],
        "picks": [[], [{"designs": 9, "evaluations": 6}], [pick]],
    }  # fmt: skip
    wrong: dict[str, list[Any]] = {
        "identity": [[], {}, IDENTITY | {"seed": -1}, IDENTITY | {"model": {"name": "a", "workshop": "shop"}},
                     IDENTITY | {"versions": []}, IDENTITY | {"against": 5}, *(IDENTITY | {"space": some} for some in (
            dict(list(space.items())[:7]), dict(reversed(space.items())), space | {"c_coef": {"lower": 1.0}},
            space | {"c_coef": {"lower": 1.0, "upper": 2.0, "fixed": 1.0}}, space | {"c_coef": {"choices": []}},
            space | {"c_coef": {"fixed": "one"}}, space | {"c_coef": {"choices": ["one"]}},
            space | {"body": {"fixed": 1.0}}, space | {"a.b.c.d.e": {"fixed": 1.0}},
            space | {f"a.{81 * 'b'}": {"fixed": 1.0}}))],
        "stages": [[], [{"method": "gas", "evaluations": 1}], [{"method": "ga", "evaluations": -1}], [{}]],
        "ended": [{}, 0, {"by": "boredom"}, {"by": "space", "more": 1}, {"by": "until", "until_percent": 100.1},
                  {"by": "hours", "hours": -1.0}],
        "picks": [{}, [{"designs": 9}], [pick | {"candidates": [candidate | {"trial": ["moon", 0, 0, 0]}]}],
                  [pick | {"candidates": [candidate | {"print_score": "x"}]}], [pick | {"bounds": [{}]}]],
    }  # fmt: skip
    kinds: dict[str, TypeAdapter[Any]] = REMEMBERED | {"picks": summary._PICKS}
    held = SimpleNamespace(trial=lambda position: SCORED)
    for key, kind in kinds.items():
        read = partial(kind.validate_json, context=held)
        for value in fine[key]:
            validated(read, key, json.dumps(value))
        for value in [*wrong[key], "text"]:
            with pytest.raises(JumpcadError, match=f"^{key}") as caught:
                validated(read, key, json.dumps(value))
            assert str(caught.value).isprintable()
        with pytest.raises(JumpcadError, match=f"{key}: Invalid JSON"):
            validated(read, key, "{")
