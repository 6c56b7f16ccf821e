"""Trials in order, the best of them, what rejected the others, and all of them as a table."""

import csv
import sys
from dataclasses import replace

import numpy as np
import pytest
from support import needs
from support.hills import SMALL, Hill

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import (
    Trial,
    best_trial,
    count_rejections,
    feasible_trials,
    in_order,
    searched,
    to_frame,
    write_table,
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
    order = [("ga", 0, 0, 1), ("ga", 0, 1, 0), ("ga", 1, 0, 2), ("bo", 0, 0, 0), ("robust", 0, 0, 0)]
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


def test_of_several_margins_of_one_name_the_least_counts_everywhere(trial: Trial, tmp_path) -> None:
    """A requirement is checked on several floors."""
    for margins in ((12.0, -5.0), (-5.0, 12.0)):
        floors = tuple(Finding("turn_deg<=9", "error" if m < 0 else "info", m, "°", "", "") for m in margins)
        one = replace(trial, evaluation=Evaluation("jump", {}, floors), score=None)
        write_table([one], tmp_path / "t.csv", force=True)
        (row,) = csv.DictReader((tmp_path / "t.csv").read_text().splitlines())
        assert one.to_dict()["margins"] == {"turn_deg<=9": {"margin": -5.0, "unit": "°"}}
        assert (row["margin_turn_deg<=9"], one.evaluation.margins) == ("-5.0", {"turn_deg<=9": -5.0})


@pytest.fixture
def trials(evaluator):
    one = evaluator()
    return one.evaluate([SMALL.to_design(p) for p in SMALL.spread(16, np.random.default_rng(0))], "ga", 0)


def test_csv_holds_every_row_margins_to_six_digits(trials, tmp_path):
    write_table(trials, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(newline="") as stream:
        records = list(csv.DictReader(stream))
    assert [float(record["rest_angle_deg"]) for record in records] == [trial.design.rest_angle_deg for trial in trials]
    assert [record["score"] == "" for record in records] == [trial.score is None for trial in trials]
    assert [float(r["margin_loop"]) for r in records] == pytest.approx(
        [0.7 - trial.design.compression_ratio for trial in trials], rel=1e-5
    )


def test_parquet_says_the_same(trials, tmp_path):
    parquet = needs.package("pyarrow.parquet")
    write_table(trials, tmp_path / "t.parquet")
    table = parquet.read_table(tmp_path / "t.parquet").to_pylist()
    assert [record["score"] for record in table] == [trial.score for trial in trials]
    assert [record["feasible"] for record in table] == [trial.evaluation.feasible for trial in trials]


def test_a_frame_has_the_rows_of_the_table_or_says_what_is_lacking(trials, tmp_path, monkeypatch):
    write_table(trials, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open() as stream:
        head = next(csv.reader(stream))
    with monkeypatch.context() as without:
        without.setitem(sys.modules, "pandas", None)
        with pytest.raises(JumpcadError, match="pip install pandas"):
            to_frame(trials)
    frame = needs.package("pandas") and to_frame(trials)
    assert list(frame.columns) == head
    assert frame[frame.feasible].score.max() == best_trial(trials).score
    assert len(frame) == len(trials)


def test_tables_that_cannot_be_written(trials, tmp_path):
    (tmp_path / "t.csv").write_text("mine")
    for name, message in (
        ("t.csv", "exists already"),
        ("t.xlsx", "must end in .csv or .parquet"),
        ("no/t.csv", "there is no folder"),
    ):
        with pytest.raises(JumpcadError, match=message):
            write_table(trials, tmp_path / name)
    assert (tmp_path / "t.csv").read_text() == "mine"


def test_a_row_has_every_column_of_any_trial_each_with_its_own_value(tmp_path):
    """A figure, margin or value of the workshop that a trial does not have is empty, whichever trial stands first."""
    design = load_design("kenan-2.0")
    limit = Finding("bed", "warning", -0.25, "mm", "", "")
    jumps = Evaluation("jump", {"fitness": 2.0, "mass_kg": 0.125}, (limit,), "a, b")
    trials = [
        Trial("ga", 3, 7, design, jumps, 1.5, "first", 0.75, {}, {"body.plate_mm": 2.0, "bought.spring": "x"}),
        Trial("bo", 4, 8, design, Evaluation("tips", {"size_m": 0.5}), None, "second", 0.5),
    ]
    write_table(trials, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(newline="") as stream:
        one, other = csv.DictReader(stream)
    assert {name: float(one[name]) for name in design.model_dump()} == design.model_dump()
    shared = {"body.plate_mm", "bought.spring", "fitness", "mass_kg", "size_m", "margin_bed", *design.model_dump()}
    told = [{name: text for name, text in row.items() if name not in shared} for row in (one, other)]
    assert told == [
        {"phase": "ga", "run": "0", "step": "3", "place": "7", "verdict": "jump", "feasible": "True", "reasons": "",
         "score": "1.5", "detail": "a, b", "duration_s": "0.75", "model": "first"},
        {"phase": "bo", "run": "0", "step": "4", "place": "8", "verdict": "tips", "feasible": "False",
         "reasons": "tips", "score": "", "detail": "", "duration_s": "0.5", "model": "second"},
    ]  # fmt: skip
    assert [one[name] for name in ("body.plate_mm", "bought.spring", "fitness", "mass_kg", "size_m", "margin_bed")] == [
        "2.0", "x", "2.0", "0.125", "", "-0.25",
    ]  # fmt: skip
    assert [other[name] for name in ("body.plate_mm", "bought.spring", "fitness", "size_m", "margin_bed")] == [
        "", "", "", "0.5", "",
    ]  # fmt: skip
