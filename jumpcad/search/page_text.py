"""Texts and tables of a page that is HTML and XML; the texts come from study files and may have any characters."""

from collections.abc import Iterator, Sequence
from html import escape

from jumpcad.exporters.xml import allowed


def written(text: str) -> str:
    """Return a text escaped for the page."""
    return escape(allowed(text))


def broken(name: str) -> str:
    """Return an escaped name with a possible line break after each underscore."""
    return written(name).replace("_", "_<wbr />")


def table(
    head: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[int] = (), bars: int = -1
) -> Iterator[str]:
    """Yield a table; cells are HTML. The columns `numbers` are right-aligned, the column `bars` is narrow."""
    kinds = [' class="number"' if place in numbers else ' class="bars"' * (place == bars) for place in range(len(head))]
    yield '<div class="wide"><table>'
    yield f"<tr>{''.join(f'<th{kind}>{broken(title)}</th>' for kind, title in zip(kinds, head, strict=True))}</tr>"
    for row in rows:
        yield f"<tr>{''.join(f'<td{kind}>{cell}</td>' for kind, cell in zip(kinds, row, strict=True))}</tr>"
    yield "</table></div>"
