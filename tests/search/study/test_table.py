"""Trials as a table."""

import csv

import numpy as np
import pytest
from support import needs
from support.hills import SMALL

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial, write_table


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
