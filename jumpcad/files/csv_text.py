"""Tables as CSV text in which no cell is a formula for a spreadsheet."""

import csv
import re
from collections.abc import Iterable, Iterator, Sequence

from jumpcad.errors import without_controls

FORMULA = ("=", "+", "-", "@", "\t", "\n", "＝", "＋", "－", "＠")
"""First characters of formulas (OWASP, CSV injection), also in full-width form."""


def to_csv(rows: Iterable[Sequence[object]]) -> str:
    """Return rows as CSV; the first is the heading. Text that would be a formula is preceded by an apostrophe."""
    return "".join(csv_lines(rows))


def csv_lines(rows: Iterable[Sequence[object]]) -> Iterator[str]:
    """Yield the rows of `to_csv` one by one, for a table that is longer than memory."""
    writer = csv.writer(_Returned(), lineterminator="\n")
    for row in rows:
        yield writer.writerow([_cell(value) for value in row])


class _Returned:
    """A file whose `write` returns the text."""

    def write(self, text: str) -> str:
        return text


def _cell(value: object) -> object:
    """Return a value that is safe in a cell; numbers, also those given as text, stay as they are."""
    if not isinstance(value, str) or _is_number(value):
        return value
    text = value.replace("\r\n", "\n").replace("\r", "\n")  # a lone \r is not quoted, and would begin another row
    text = "".join(part if part in "\n\t" else without_controls(part) for part in re.split("([\n\t])", text))
    return f"'{text}" if text.startswith(FORMULA) else text


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
