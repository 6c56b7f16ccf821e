"""assembly.html: the guide as one page of its own, with its pictures inside; no network, to be printed too.

The page is made from the guide's Markdown, of which it knows what the guide uses: headings, paragraphs, lists, tables,
pictures, warnings (quotes) and code.
"""

import base64
import re
from collections.abc import Iterator, Mapping
from html import escape
from itertools import groupby

from jumpcad.exporters.xml import allowed

STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; background: #fff; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h2 { margin-top: 2.2em; border-top: 2px solid #ddd; padding-top: 0.6em; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { text-align: left; padding: 0.15em 1.2em 0.15em 0; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number { text-align: right; white-space: nowrap; }
img { max-width: 100%; }
blockquote { margin: 0.8em 0; padding: 0.4em 1em; border-left: 5px solid #b3322b; background: #fdf0ee; }
pre { background: #f4f4f4; padding: 0.6em 1em; }
nav { columns: 2; }
@media print { h2 { break-before: page; } nav { display: none; } img { max-height: 14cm; } }
"""
TYPES = {"png": "image/png", "svg": "image/svg+xml"}


def write_page(guide: str, name: str, pictures: Mapping[str, bytes]) -> str:
    """Return the page of a guide in Markdown; `pictures` are its files by their paths, which become part of it."""
    lines = guide.splitlines()
    title = escape(allowed(name))
    heads = [line[3:] for line in lines if line.startswith("## ")]
    links = "".join(f'<li><a href="#{_anchor(head)}">{_words(head)}</a></li>' for head in heads)
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            f'<head><meta charset="utf-8" /><title>{title}: assembly</title><style>{STYLE}</style></head>',
            "<body>",
            f"<nav><ul>{links}</ul></nav>",
            *_blocks(lines, pictures),
            "</body>",
            "</html>",
            "",
        ]
    )


def _blocks(lines: list[str], pictures: Mapping[str, bytes]) -> Iterator[str]:
    """Yield the elements of the lines, those of one kind together."""
    code = False
    kinds = []
    for line in lines:
        fence = line.startswith("```")
        kinds.append("code" if code and not fence else "fence" if fence else _kind(line))
        code = code != fence
    for kind, group in groupby(zip(kinds, lines, strict=True), key=lambda pair: pair[0]):
        yield from _element(kind, [line for _, line in group], pictures)


def _kind(line: str) -> str:
    starts = {"# ": "h1", "## ": "h2", "- ": "list", "|": "table", "> ": "quote", "![": "picture"}
    return next((kind for start, kind in starts.items() if line.startswith(start)), "text" if line else "empty")


def _element(kind: str, lines: list[str], pictures: Mapping[str, bytes]) -> Iterator[str]:
    if kind == "h1":
        yield from (f"<h1>{_words(line[2:])}</h1>" for line in lines)
    elif kind == "h2":
        yield from (f'<h2 id="{_anchor(line[3:])}">{_words(line[3:])}</h2>' for line in lines)
    elif kind == "list":
        yield "<ul>" + "".join(f"<li>{_words(line[2:])}</li>" for line in lines) + "</ul>"
    elif kind == "table":
        yield from _table([[cell.strip() for cell in line.strip("|").split("|")] for line in lines])
    elif kind == "quote":
        yield from (f"<blockquote>{_words(line[2:])}</blockquote>" for line in lines)
    elif kind == "picture":
        yield from (_picture(line, pictures) for line in lines)
    elif kind == "code":
        yield "<pre>" + escape("\n".join(lines)) + "</pre>"
    elif kind == "text":
        yield from (f"<p>{_words(line)}</p>" for line in lines)


def _table(rows: list[list[str]]) -> Iterator[str]:
    head, rule, *body = rows
    classes = [' class="number"' if cell.endswith(":") else "" for cell in rule]
    yield "<table><tr>" + "".join(f"<th>{_words(cell)}</th>" for cell in head) + "</tr>"
    for row in body:
        cells = (f"<td{kind}>{_words(cell)}</td>" for kind, cell in zip(classes, row, strict=False))
        yield "<tr>" + "".join(cells) + "</tr>"
    yield "</table>"


def _picture(line: str, pictures: Mapping[str, bytes]) -> str:
    found = re.fullmatch(r"!\[(.*)\]\((.*)\)", line)
    if found is None or found[2] not in pictures:
        return f"<p>{_words(line)}</p>"
    data = base64.b64encode(pictures[found[2]]).decode()
    kind = TYPES[found[2].rpartition(".")[2]]
    return f'<figure><img alt="{escape(found[1])}" src="data:{kind};base64,{data}" /></figure>'


def _words(text: str) -> str:
    """Return text with its bold and code words marked."""
    marked = re.sub(r"\*\*(.+?)\*\*", r"<b>\1</b>", escape(allowed(text), quote=False))
    return re.sub(r"`(.+?)`", r"<code>\1</code>", marked)


def _anchor(head: str) -> str:
    return re.sub(r"\W+", "-", head.lower()).strip("-")
