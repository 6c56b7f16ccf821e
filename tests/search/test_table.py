"""Rows as a table."""

import csv

import numpy as np
import pytest
from support.hills import SMALL

from jumpcad.errors import JumpcadError
from jumpcad.search.table import write_table


@pytest.fixture
def rows(evaluator):
    one = evaluator()
    return one.evaluate([SMALL.to_design(p) for p in SMALL.spread(16, np.random.default_rng(0))], "ga", 0)


def test_csv_holds_every_row_to_the_last_bit(rows, tmp_path):
    write_table(rows, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(newline="") as stream:
        records = list(csv.DictReader(stream))
    assert [float(record["rest_angle_deg"]) for record in records] == [row.design.rest_angle_deg for row in rows]
    assert [record["score"] == "" for record in records] == [row.score is None for row in rows]
    assert [float(r["margin_loop"]) for r in records] == [0.7 - row.design.compression_ratio for row in rows]


def test_parquet_says_the_same(rows, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    write_table(rows, tmp_path / "t.parquet")
    table = parquet.read_table(tmp_path / "t.parquet").to_pylist()
    assert [record["score"] for record in table] == [row.score for row in rows]
    assert [record["feasible"] for record in table] == [row.evaluation.feasible for row in rows]


def test_tables_that_cannot_be_written(rows, tmp_path):
    (tmp_path / "t.csv").write_text("mine")
    for name, message in (
        ("t.csv", "exists already"),
        ("t.xlsx", "must end in .csv or .parquet"),
        ("no/t.csv", "there is no folder"),
    ):
        with pytest.raises(JumpcadError, match=message):
            write_table(rows, tmp_path / name)
    assert (tmp_path / "t.csv").read_text() == "mine"
