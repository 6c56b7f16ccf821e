"""Texts and tables of a page that is HTML and XML; the texts come from study files and may have any characters."""

from collections.abc import Iterator, Sequence
from html import escape

from jumpcad.exporters.xml import allowed


def escape_html(text: str) -> str:
    """Return a text escaped for the page."""
    return escape(allowed(text))


def broken(name: str) -> str:
    """Return an escaped name with a possible line break after each underscore."""
    return escape_html(name).replace("_", "_<wbr />")


def table(
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    numbers: Sequence[int] = (),
    bars: int = -1,
    extra: Sequence[int] = (),
) -> Iterator[str]:
    """Yield a table; cells are HTML.

    The columns `numbers` are right-aligned, the column `bars` is narrow. On a phone the columns `extra` are left out;
    a table without any has the cells of a row below each other there, each after its heading.
    """
    kinds = [
        " ".join(kind for kind, places in (("number", numbers), ("bars", (bars,)), ("extra", extra)) if place in places)
        for place in range(len(head))
    ]
    marks = [f' class="{kind}"' if kind else "" for kind in kinds]
    heads = [escape_html(title) for title in head]
    yield f'<div class="wide{"" if extra else " stacked"}"><table>'
    yield f"<tr>{''.join(f'<th{mark}>{broken(title)}</th>' for mark, title in zip(marks, head, strict=True))}</tr>"
    for row in rows:
        cells = zip(marks, heads, row, strict=True)
        yield "<tr>" + "".join(f'<td{mark} data-head="{title}">{cell}</td>' for mark, title, cell in cells) + "</tr>"
    yield "</table></div>"
