"""Free text in Markdown, where it stays text."""

import re

SIGNS = re.compile(r"[\\|<&`\[\]]")
"""What begins another cell of a table, HTML, code, a link or an escape."""


def plain(text: str) -> str:
    """Return text that Markdown shows as it is, also in a cell of a table."""
    return SIGNS.sub(r"\\\g<0>", text)
