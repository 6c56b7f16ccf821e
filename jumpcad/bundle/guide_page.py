"""assembly.html: the guide as one page of its own, with its pictures inside; no network, to be printed too."""

import base64
import itertools
import re
from collections.abc import Mapping
from html import escape

from markdown_it import MarkdownIt
from markdown_it.token import Token

from jumpcad.exporters.xml import allowed

STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; overflow-wrap: break-word; }
h2 { margin-top: 2.2em; border-top: 2px solid #8884; padding-top: 0.6em; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { text-align: left; padding: 0.15em 1.2em 0.15em 0; border-bottom: 1px solid #8884; vertical-align: top; }
th:last-child, td:last-child { padding-right: 0; }
img { max-width: 100%; background: #fff; }
blockquote { margin: 0.8em 0; padding: 0.1em 1em; border-left: 5px solid #b3322b; background: #b3322b18; }
pre { background: #8882; padding: 0.6em 1em; overflow-x: auto; }
nav { columns: 2; }
@media (max-width: 34em) { nav { columns: 1; } th, td { padding-right: 0.5em; }
  table { display: block; overflow-x: auto; font-size: 0.93em; } td:nth-child(6) { min-width: 12em; } }
@media print { h2 { break-before: page; } nav { display: none; } img { max-height: 14cm; } }
"""
TYPES = {"png": "image/png", "svg": "image/svg+xml"}


def write_page(guide: str, name: str, pictures: Mapping[str, bytes]) -> str:
    """Return the page of a guide in Markdown; `pictures` are its files by their paths, which become part of it."""
    reader = MarkdownIt("commonmark", {"html": False, "xhtmlOut": True}).enable("table")
    tokens = reader.parse(allowed(guide))
    heads = _anchored(tokens)
    for token in tokens:
        for child in token.children or ():
            if child.type == "image":
                _embed(child, pictures)
    links = "".join(f'<li><a href="#{anchor}">{escape(head)}</a></li>' for anchor, head in heads.items())
    title, body = escape(allowed(name)), reader.renderer.render(tokens, reader.options, {})
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8" /><meta name="viewport" content="width=device-width, initial-scale=1" />',
            f"<title>{title}: assembly</title><style>{STYLE}</style></head>",
            "<body>",
            body.replace("</h1>", f"</h1>\n<nav><ul>{links}</ul></nav>", 1) + "</body>",
            "</html>",
            "",
        ]
    )


def _anchored(tokens: list[Token]) -> dict[str, str]:
    """Give the sections' headings anchors; return the headings by them."""
    heads = {}
    for token, words in itertools.pairwise(tokens):
        if token.type == "heading_open" and token.tag == "h2":
            anchor = re.sub(r"\W+", "-", words.content.lower()).strip("-")
            token.attrSet("id", anchor)
            heads[anchor] = words.content
    return heads


def _embed(image: Token, pictures: Mapping[str, bytes]) -> None:
    """Put a picture's file into its element; one that is not there keeps its path."""
    path = str(image.attrGet("src"))
    if path in pictures:
        data = base64.b64encode(pictures[path]).decode()
        image.attrSet("src", f"data:{TYPES[path.rpartition('.')[2]]};base64,{data}")
