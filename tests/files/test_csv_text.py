"""CSV in which spreadsheets find no formula, and in which numbers stay numbers."""

import csv
import io

import pytest

from jumpcad.files.csv_text import to_csv


@pytest.mark.parametrize("text", ["=1+1", "+x", "-x", "@SUM(A1)", "\tx", "\n=1", "＝1+1", "-1+cmd|' /C calc'!A0"])
def test_text_that_a_spreadsheet_would_compute_gets_an_apostrophe(text: str) -> None:
    cells = next(csv.reader(io.StringIO(to_csv([[text, "a=b"]]), newline="")))
    assert cells == [f"'{text}", "a=b"]


def test_numbers_stay_numbers() -> None:
    assert to_csv([[-1.5, "-1.5", "-2e-3", "+3", -4, None]]) == "-1.5,-1.5,-2e-3,+3,-4,\n"


def test_no_text_begins_a_row_of_its_own() -> None:
    rows = list(csv.reader(io.StringIO(to_csv([["a\r=1+1", "\r\n=2"], ["b", "c"]]), newline="")))
    assert rows == [["a\n=1+1", "'\n=2"], ["b", "c"]]
