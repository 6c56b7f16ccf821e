"""assembly.html: all documents of the guide as one page, in the look of report.html, with their pictures inside."""

import base64
import re
from collections.abc import Iterator, Mapping
from html import escape

from markdown_it import MarkdownIt
from markdown_it.token import Token

from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import templates_folder

STYLES = ("report/style.css", "guides/page.css")
TYPES = {"png": "image/png", "svg": "image/svg+xml"}
BOX, TICK = "☐ ", '<input type="checkbox" />'
"""How a line of the guide begins that is to be ticked, and what it becomes."""
BESIDE = 3
"""Pictures beside the words of a step: with more it would not fit one view. The others stay where they are."""


def write_page(guide: Mapping[str, str], name: str, pictures: Mapping[str, bytes]) -> str:
    """Return the page of a guide's documents in Markdown, by their files; what stands before assembly.md's steps leads.

    `pictures` are the files of pictures by their paths, which become part of it.
    """
    reader = MarkdownIt("commonmark", {"html": False, "xhtmlOut": True}).enable("table")
    opening, mark, steps = guide["assembly.md"].partition("\n## ")
    heads: dict[str, str] = {}
    parts = []
    for path, text in {**guide, "assembly.md": f"# 4. Assemble\n{mark}{steps}"}.items():
        anchor, tokens = path.removesuffix(".md"), reader.parse(allowed(text))
        heads[anchor] = tokens[1].content
        parts.append(_document(tokens, anchor, reader, pictures))
    links = _links(heads)
    (first,) = _sections(reader.parse(allowed(opening)), reader, pictures)
    style = "".join((templates_folder() / path).read_text(encoding="ascii") for path in STYLES)
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8" /><meta name="viewport" content="width=device-width, initial-scale=1" />',
            f"<title>{escape(allowed(name))}: assembly</title><style>{style}</style></head>",
            "<body>",
            f"{links}{first}",
            *parts,
            "</body>",
            "</html>",
            "",
        ]
    )


def _document(tokens: list[Token], anchor: str, reader: MarkdownIt, pictures: Mapping[str, bytes]) -> str:
    """Return a document: its headings one level lower, after its own the links to the others."""
    heads: dict[str, str] = {}
    for index, token in enumerate(tokens):
        if token.type == "heading_open" and token.tag in ("h1", "h2"):
            words = tokens[index + 1].content
            slug = anchor if token.tag == "h1" else re.sub(r"\W+", "-", words.lower()).strip("-")
            token.attrSet("id", slug)
            heads[slug] = words
    heads.pop(anchor)
    opening, *others = _sections(tokens, reader, pictures)
    page = "\n".join([opening.replace("</h1>", f"</h1>{_links(heads)}", 1), *others])
    return re.sub("(</?h)([1-3])(?=[ >])", lambda found: f"{found[1]}{int(found[2]) + 1}", page)


def _links(heads: Mapping[str, str]) -> str:
    return "<nav>" + " ".join(f'<a href="#{anchor}">{escape(head)}</a>' for anchor, head in heads.items()) + "</nav>"


def _sections(tokens: list[Token], reader: MarkdownIt, pictures: Mapping[str, bytes]) -> Iterator[str]:
    """Yield the sections, that before the first heading of the second level too.

    A step, and what leads the page, has its pictures beside its words.
    """
    for token in tokens:
        if token.type == "inline" and token.children:
            _embed(token.children, pictures)
            if token.content.startswith(BOX):
                token.children[0].content = token.children[0].content.removeprefix(BOX)
                token.children.insert(0, Token("html_inline", "", 0, content=TICK))
    starts = [index for index, token in enumerate(tokens) if token.type == "heading_open" and token.tag == "h2"]
    for start, end in zip([0, *starts], [*starts, len(tokens)], strict=True):
        yield _section(tokens[start:end], reader)


def _section(tokens: list[Token], reader: MarkdownIt) -> str:
    alone = [at for at, token in enumerate(tokens) if re.fullmatch(r"!\[.*\]\(.*\)", token.content)]
    if not alone or not (tokens[0].tag == "h1" or re.match(r"\d+\. ", tokens[1].content)):
        return f"<section>{_html(reader, tokens)}</section>"
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
    """Put pictures' files into their elements (one that is not there keeps its path); documents are on this page."""
    for link in (token for token in tokens if token.type == "link_open"):
        link.attrSet("href", "#" + str(link.attrGet("href")).removesuffix(".md"))
    for image in (token for token in tokens if token.type == "image"):
        path = str(image.attrGet("src"))
        if path in pictures:
            data = base64.b64encode(pictures[path]).decode()
            image.attrSet("tabindex", "0")  # on a phone a tap shows it in full size
            image.attrSet("src", f"data:{TYPES[path.rpartition('.')[2]]};base64,{data}")
