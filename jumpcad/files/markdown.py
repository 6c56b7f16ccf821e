"""Escapes free text for Markdown."""

import re

SIGNS = re.compile(r"[\\|<&`\[\]]")
"""Characters that begin a table's cell, HTML, code, a link or an escape."""


def plain(text: str) -> str:
    """Return text so that Markdown shows it unchanged, also in a cell of a table."""
    return SIGNS.sub(r"\\\g<0>", text)
