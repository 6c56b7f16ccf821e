"""Trials in order, the best of them, and what rejected the others."""

from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL, Hill

from jumpcad.findings import Finding
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import (
    Trial,
    best_trial,
    count_rejections,
    feasible_trials,
    in_order,
    searched,
)


@pytest.fixture
def trial() -> Trial:
    design = SMALL.to_design(np.full(3, 0.5))
    return Trial("ga", 0, 0, design, Hill()(design), 4.0, "m", 0.1)


def test_the_best_is_the_first_of_equals_and_none_where_all_are_rejected(trial: Trial) -> None:
    scores = [1.0, None, 3.0, -2.0, 3.0]
    trials = [replace(trial, place=place, score=score) for place, score in enumerate(scores)]
    assert [found.place for found in feasible_trials(trials)] == [2, 4, 0, 3]
    assert best_trial(trials) is trials[2]
    assert best_trial([trials[1]]) is None


def test_trials_stand_in_the_order_of_phases_runs_steps_and_places(trial: Trial) -> None:
    order = [
        ("ga", 0, 0, 1),
        ("ga", 0, 1, 0),
        ("ga", 1, 0, 2),
        ("bo", 0, 0, 0),
        ("robust", 0, 0, 0),
    ]
    trials = [replace(trial, phase=phase, run=run, step=step, place=place) for phase, run, step, place in order]
    backwards = trials[::-1]
    assert in_order(backwards) == trials
    assert searched(trials) == trials[:4]


def test_every_reason_of_a_rejection_is_counted_most_frequent_first(trial: Trial) -> None:
    broken = Evaluation(
        "jump", {"fitness": 1.0}, tuple(Finding(name, "error", -1.0, "mm", "", "") for name in ("bed_fit", "leg_flex"))
    )
    rejected = [replace(trial, evaluation=one, score=None) for one in (Evaluation("loop"), broken, broken)]
    assert count_rejections([trial, *rejected]) == {"bed_fit": 2, "leg_flex": 2, "loop": 1}
    assert list(count_rejections([trial, *rejected]))[-1] == "loop"


def test_a_rejected_design_has_no_fitness_in_its_record(trial: Trial) -> None:
    assert trial.to_dict()["fitness"] == trial.evaluation.metrics["fitness"] > 0.0
    rejected = replace(trial, evaluation=Evaluation("loop"), score=None).to_dict()
    assert (rejected["fitness"], rejected["score"], rejected["verdict"]) == (0.0, None, "loop")


def test_a_record_has_every_figure_under_its_name_and_the_workshop_where_one_varied(trial: Trial) -> None:
    limits = (Finding("loop", "info", 0.25, "", "", ""), Finding("leg_flex", "warning", -0.5, "mm", "", ""))
    told = Evaluation("jump", {"fitness": 3.0, "mass_kg": 0.125}, limits, "a detail")
    record = replace(trial, phase="bo", evaluation=told, score=4.0).to_dict()
    assert record.pop("design") == trial.design.model_dump()
    assert record == {
        "phase": "bo", "score": 4.0, "fitness": 3.0, "verdict": "jump", "detail": "a detail",
        "metrics": {"fitness": 3.0, "mass_kg": 0.125},
        "margins": {"loop": {"margin": 0.25, "unit": ""}, "leg_flex": {"margin": -0.5, "unit": "mm"}},
    }  # fmt: skip
    varied = replace(trial, workshop={"body.plate_mm": 2.0})
    assert varied.to_dict()["workshop"] == {"body.plate_mm": 2.0}
    assert varied.key == (*trial.design.to_vector(), 2.0)
    assert varied.variant.workshop == varied.workshop
