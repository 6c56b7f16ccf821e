"""Tables as CSV text in which no cell is a formula for a spreadsheet."""

import csv
import io
from collections.abc import Iterable, Sequence

from jumpcad.errors import without_controls

FORMULA = ("=", "+", "-", "@", "\t", "\n", "＝", "＋", "－", "＠")
"""First characters of formulas (OWASP, CSV injection), also in full-width form."""


BOM = "\ufeff"
"""Byte order mark: without it, Excel on Windows reads a file in the system's old character set."""


def to_csv(rows: Iterable[Sequence[object]]) -> str:
    """Return rows as CSV; the first is the heading. Text that would be a formula is preceded by an apostrophe.

    A table with other characters than ASCII begins with a byte order mark: read it as `utf-8-sig`.
    """
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows([_cell(value) for value in row] for row in rows)
    text = stream.getvalue()
    return text if text.isascii() else BOM + text


def _cell(value: object) -> object:
    """Return a value that is safe in a cell; numbers, also those given as text, stay as they are."""
    if not isinstance(value, str) or _is_number(value):
        return value
    text = value.replace("\r\n", "\n").replace("\r", "\n")  # a lone \r is not quoted, and would begin another row
    text = without_controls(text, "[\n\t]")
    return f"'{text}" if text.startswith(FORMULA) else text


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
