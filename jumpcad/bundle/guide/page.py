"""assembly.html: the guide as one page of its own, with its pictures inside; no network, to be printed too."""

import base64
import re
from collections.abc import Iterator, Mapping
from html import escape

from markdown_it import MarkdownIt
from markdown_it.token import Token

from jumpcad.exporters.xml import allowed

STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 sans-serif; max-width: 80em; margin: 2em auto; padding: 0 1em; overflow-wrap: break-word; }
h2 { margin-top: 1.6em; border-top: 2px solid #8884; padding-top: 0.6em; }
p:not(:has(img)), li, blockquote { max-width: 44em; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { text-align: left; padding: 0.15em 1.2em 0.15em 0; border-bottom: 1px solid #8884; vertical-align: top; }
th:last-child, td:last-child { padding-right: 0; }
img { max-width: 100%; background: #fff; }
li:has(input) { list-style: none; text-indent: -1.5em; }
input { margin: 0 0.5em 0 0; width: 1em; height: 1em; }
blockquote { margin: 0.8em 0; padding: 0.1em 1em; border-left: 5px solid #b3322b; background: #b3322b18; }
pre { background: #8882; padding: 0.6em 1em; overflow-x: auto; }
nav { columns: 2; }
@media (min-width: 70em) { .step { display: grid; grid-template-columns: 1fr 1fr; gap: 0 1.5em; }
  .step > h2 { grid-column: 1 / 3; } }
@media (max-width: 34em) { nav { columns: 1; } th, td { padding-right: 0.5em; }
  table { display: block; overflow-x: auto; font-size: 0.93em; } }
@media print { .step { break-inside: avoid; } nav { display: none; } img { max-height: 14cm; } }
"""
TYPES = {"png": "image/png", "svg": "image/svg+xml"}
BOX, TICK = "☐ ", '<input type="checkbox" />'
"""How a line of the guide begins that is to be ticked, and what it becomes."""
BESIDE = 2
"""Pictures beside the words of a step: with more it would not fit one view. The others stay where they are."""


def write_page(guide: str, name: str, pictures: Mapping[str, bytes]) -> str:
    """Return the page of a guide in Markdown; `pictures` are its files by their paths, which become part of it."""
    reader = MarkdownIt("commonmark", {"html": False, "xhtmlOut": True}).enable("table")
    heads: dict[str, str] = {}
    body = "\n".join(_section(part, reader, heads, pictures) for part in _parts(reader.parse(allowed(guide))))
    links = "".join(f'<li><a href="#{anchor}">{escape(head)}</a></li>' for anchor, head in heads.items())
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8" /><meta name="viewport" content="width=device-width, initial-scale=1" />',
            f"<title>{escape(allowed(name))}: assembly</title><style>{STYLE}</style></head>",
            "<body>",
            body.replace("</h1>", f"</h1>\n<nav><ul>{links}</ul></nav>", 1) + "</body>",
            "</html>",
            "",
        ]
    )


def _parts(tokens: list[Token]) -> Iterator[list[Token]]:
    """Yield the tokens of each section, that before the first heading of the second level too."""
    starts = [index for index, token in enumerate(tokens) if token.type == "heading_open" and token.tag == "h2"]
    for start, end in zip([0, *starts], [*starts, len(tokens)], strict=True):
        yield tokens[start:end]


def _section(tokens: list[Token], reader: MarkdownIt, heads: dict[str, str], pictures: Mapping[str, bytes]) -> str:
    """Return a section; its heading is added to `heads` by its anchor. A step has its pictures beside its words."""
    for token in tokens:
        if token.type == "inline" and token.children:
            _embed(token.children, pictures)
            if token.content.startswith(BOX):
                token.children[0].content = token.children[0].content.removeprefix(BOX)
                token.children.insert(0, Token("html_inline", "", 0, content=TICK))
    if not (tokens and tokens[0].tag == "h2"):
        return _html(reader, tokens)
    anchor = re.sub(r"\W+", "-", tokens[1].content.lower()).strip("-")
    tokens[0].attrSet("id", anchor)
    heads[anchor] = tokens[1].content
    if not re.match(r"\d+\. ", tokens[1].content):
        return f"<section>{_html(reader, tokens)}</section>"
    alone = [at for at, token in enumerate(tokens) if re.fullmatch(r"!\[.*\]\(.*\)", token.content)]
    drawn = {at + by for at in alone[:BESIDE] for by in (-1, 0, 1)}  # a paragraph: its opening, content and closing
    shown = [token for at, token in enumerate(tokens) if at in drawn]
    told = [token for at, token in enumerate(tokens) if at > 2 and at not in drawn]
    return (
        f'<section class="step">{_html(reader, tokens[:3])}<div>{_html(reader, shown)}</div>'
        f"<div>{_html(reader, told)}</div></section>"
    )


def _html(reader: MarkdownIt, tokens: list[Token]) -> str:
    return str(reader.renderer.render(tokens, reader.options, {}))


def _embed(tokens: list[Token], pictures: Mapping[str, bytes]) -> None:
    """Put pictures' files into their elements; one that is not there keeps its path."""
    for image in (token for token in tokens if token.type == "image"):
        path = str(image.attrGet("src"))
        if path in pictures:
            data = base64.b64encode(pictures[path]).decode()
            image.attrSet("src", f"data:{TYPES[path.rpartition('.')[2]]};base64,{data}")
