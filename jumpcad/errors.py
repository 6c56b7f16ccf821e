"""Exceptions for user errors, in one line of text."""

import re
import unicodedata

from jumpcad.findings import Remedy, in_words

CONTROL_CATEGORIES = ("Cc", "Cf", "Cs", "Zl", "Zp")
"""Unicode categories: control and format characters, halves of surrogate pairs, separators of lines."""
LONGEST = 4000
"""Characters of a message; of a longer one, which quotes something long, the middle is left out."""


class JumpcadError(Exception):
    """The request is wrong: one line that names the value, the limit and the way out.

    Control characters of the message, which may quote a user's or a stranger's text, are shown as Python writes them.
    ``exit_code`` is what the command line returns for it.
    """

    exit_code = 2

    def __init__(self, message: str) -> None:
        if len(message) > LONGEST:
            message = f"{message[: LONGEST // 2]} … {message[-LONGEST // 2 :]}"
        super().__init__(without_controls(message))


class CannotBuildError(JumpcadError):
    """The request is well-formed, but the answer is no: this design cannot work or cannot be made.

    Where a number missed its limit, `limit` names it and `margin` says by how much, in `unit`; negative. `ways` are
    what to change; the text ends with them.
    """

    exit_code = 1

    def __init__(
        self, message: str, limit: str = "", margin: float | None = None, unit: str = "mm", ways: Remedy = ()
    ) -> None:
        super().__init__(message)
        self.limit, self.unit, self.ways = limit, unit, ways
        self.margin = None if margin is None else min(float(margin), 0.0)

    @property
    def what(self) -> str:
        """What is wrong, without what to change."""
        return str(self.args[0])

    def __str__(self) -> str:
        return ": ".join(filter(None, (self.what, in_words(self.ways))))


def without_controls(text: str, kept: str = "") -> str:
    """Return a text with its control characters replaced by Python's escapes, but for those of a pattern `kept`."""
    if kept:
        parts = re.split(f"({kept})", text)
        return "".join(part if number % 2 else without_controls(part) for number, part in enumerate(parts))
    if text.isprintable():  # quick for nearly every text
        return text
    return "".join(
        letter.encode("unicode_escape").decode() if unicodedata.category(letter) in CONTROL_CATEGORIES else letter
        for letter in text
    )
