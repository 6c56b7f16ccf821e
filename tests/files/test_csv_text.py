"""CSV in which spreadsheets find no formula, and in which numbers stay numbers."""

import csv
import io

from support.each import each

from jumpcad.files.csv_text import BOM, to_csv


@each("text", ["=1+1", "+x", "-x", "@SUM(A1)", "\tx", "\n=1", "＝1+1", "-1+cmd|' /C calc'!A0"])
def test_text_that_a_spreadsheet_would_compute_gets_an_apostrophe(text: str) -> None:
    cells = next(csv.reader(io.StringIO(to_csv([[text, "a=b"]]).removeprefix(BOM), newline="")))
    assert cells == [f"'{text}", "a=b"]


def test_numbers_stay_numbers() -> None:
    assert to_csv([[-1.5, "-1.5", "-2e-3", "+3", -4, None]]) == "-1.5,-1.5,-2e-3,+3,-4,\n"


def test_no_text_begins_a_row_of_its_own() -> None:
    rows = list(csv.reader(io.StringIO(to_csv([["a\r=1+1", "\r\n=2"], ["b", "c"]]), newline="")))
    assert rows == [["a\n=1+1", "'\n=2"], ["b", "c"]]


def test_what_is_not_ascii_opens_right_in_a_spreadsheet_on_windows() -> None:
    """Without its three bytes in front Excel reads the system's old character set: 1 N·mm/° becomes 1 NÂ·mm/Â°."""
    rows = [["rate"], ["1 N·mm/°"]]
    assert to_csv(rows).encode().startswith(b"\xef\xbb\xbfrate\n")
    assert list(csv.reader(io.StringIO(to_csv(rows).encode().decode("utf-8-sig")))) == rows
    assert to_csv([["rate"], ["1 N"]]).encode() == b"rate\n1 N\n"
