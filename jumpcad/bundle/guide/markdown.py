"""The guide's five documents: order, arrival, wiring, assembly, and when something goes wrong; and assembly.html.

That is all documents as one page, in the look of report.html, with their pictures inside.
"""

import base64
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from html import escape

from markdown_it import MarkdownIt
from markdown_it.token import Token

from jumpcad.building.bom import Bill, bill_of_materials, euros
from jumpcad.bundle.guide.guide_values import guide_values
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import fill, render, templates_folder
from jumpcad.parts.part import Part
from jumpcad.robot.robot import Robot
from jumpcad.robot.springs.thing import CHOOSE
from jumpcad.scene.visuals import Visual
from jumpcad.steps.assembly_steps import Step, assembly_steps
from jumpcad.steps.step_views import label_of

PARTS = ("order", "arrival", "wiring", "assembly", "trouble")
"""The guide's documents, in the order in which a builder needs them."""
BILL, LAST_WIRED = "guides/bill.md.j2", "power"
BY_ROLE = ("motor", "battery", "controller", "driver", "regulator", "gyroscope", "switch", "sensor", "capacitor",
           "plug")  # fmt: skip
"""What a step and its picture call by its part in the robot, not by its article."""


def write_guide(robot: Robot, pictures: Sequence[str] = ()) -> dict[str, str]:
    """Return the guide's documents in Markdown by their files; `pictures` are the names of those in `pictures/`."""
    steps, bill = assembly_steps(robot), bill_of_materials(robot)
    shown = [
        (number, step, [name for name in pictures if re.fullmatch(rf"step-{number}(-.*)?", name)], put_on(step))
        for number, step in enumerate(steps, start=1)
    ]
    values = {
        **guide_values(robot, steps, bill), "bill": bill_text(bill), "steps": shown,
        "wired": next(number for number, step, *_ in shown if step.key == LAST_WIRED), "pictures": pictures,
    }  # fmt: skip
    return {f"{part}.md": render(f"guides/{part}.md.j2", values) for part in PARTS}


def bill_text(bill: Bill) -> str:
    """Return the guide's sections `Print` and `Buy`; times and prices have columns where any is known."""
    printed = [item for item in bill.items if item.kind != "bought"]
    bought = [item for item in bill.items if item.kind == "bought"]
    there = [item.name.removesuffix(CHOOSE) for item in bought if not item.ordered]
    values = {"bill": bill, "printed": printed, "bought": bought, "there": there, "duration": duration, "euros": euros}
    return render(BILL, values)


def with_bill(order: str, bill: Bill) -> str:
    """Return a written order.md with another bill in place of its own."""
    tables = re.compile(r"(?<=\n)## Print\n.*\n## Buy\n.*?(?=\n\n## |\Z)", re.DOTALL)
    return tables.sub(lambda _: bill_text(bill).rstrip("\n"), order, count=1)


def duration(seconds: float) -> str:
    """Return a time in hours and minutes, rounded to whole minutes: `2:31 h`."""
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours}:{minutes:02d} h"


def put_on(step: Step) -> Counter[str]:
    """Return how many of which things a step puts on: printed ones as pictures name them, bought ones as the bill."""
    counts: Counter[str] = Counter()
    for placed in step.placed:
        if placed.move.brings or placed.move.trial:
            if not placed.move.trial:
                counts[f"the {placed.move.brings}"] = 1
            continue
        # a piece of what is listed elsewhere has no units
        counts.update(
            _name(thing) for thing in placed.things if isinstance(thing.source, Part) or thing.source.units > 0
        )
    return counts


def _name(thing: Visual) -> str:
    """Return what a thing is called, without what matters to its shop alone."""
    source, label = thing.source, label_of(thing)
    if isinstance(source, Part) or label in BY_ROLE:
        return label
    short, kind = re.split(r",| \(| ISO| DIN", source.article)[0], re.search(r", cut (.*)|, (\w+ hand)", source.article)
    if not re.search("screw|pin|standoff", short):
        short = re.sub(r" [\d.]+ (x|mm|V|W|uF)\b.*", "", short)
    return f"{short} ({kind[kind.lastindex or 0]})" if kind else short


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
    values = {"name": allowed(name), "style": style, "parts": [f"{links}{first}", *parts]}
    return fill("guides/page.html.j2", values)


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
