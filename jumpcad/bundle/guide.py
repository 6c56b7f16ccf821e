"""assembly.md: what to print and how, what to buy and check, how to assemble, wire, start and weigh the robot."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence

from jumpcad.bundle.arrival import arrival_lines
from jumpcad.bundle.bom import Bill, BillLine, bill_of_materials, euros
from jumpcad.bundle.expected import expected, filled
from jumpcad.bundle.operation import after_use
from jumpcad.bundle.ordering import order_lines, print_lines, weigh_lines
from jumpcad.bundle.springs import spring_order
from jumpcad.bundle.stuck import HEADING, UNTRIED, stuck_items
from jumpcad.bundle.tools import tool_lines
from jumpcad.bundle.wiring import wiring_lines
from jumpcad.checks import quick_findings
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files.markdown import plain
from jumpcad.findings import errors
from jumpcad.parts.part import Part
from jumpcad.robot import Robot
from jumpcad.scene.assembly_order.plan import ROBOT
from jumpcad.scene.assembly_steps import Step, assembly_steps
from jumpcad.scene.step_views import label_of
from jumpcad.scene.visuals import Visual

PRINT, BUY = "## Print", "## Buy"
NO_PICTURES = "Written with `--no-pictures`: where it speaks of a picture, build without that option."


def write_guide(robot: Robot, pictures: Sequence[str] = ()) -> str:
    """Return the guide in Markdown; `pictures` are the names of those in `pictures/`."""
    steps = list(assembly_steps(robot))
    lines = [
        f"# {robot.name}",
        "",
        *_forbidden(robot),
        f"{1000.0 * robot.mass_kg:.1f} g. Left and right are as seen from behind the robot. Read all of it before you "
        "start: plan an evening for printing and ordering, and an afternoon for assembly. Torques and forces of hands "
        "are judgements.",
        *(() if pictures else ("", NO_PICTURES)),
        *_tables(bill_of_materials(robot)),
        *print_lines(robot),
        *order_lines(robot),
        *spring_order(robot),
        *tool_lines(robot, steps),
        *arrival_lines(robot),
        *wiring_lines(robot),
        *_steps(robot, steps, pictures),
        *after_use(chosen_parts(robot.workshop)),
        *("", f"## {HEADING}", "", UNTRIED, ""),
        *(f"{number}. {item}" for number, item in enumerate(stuck_items(robot), start=1)),
        *weigh_lines(robot),
    ]
    return "\n".join(lines) + "\n"


def with_bill(guide: str, bill: Bill) -> str:
    """Return a written guide with another bill in place of its own."""
    tables = re.compile(rf"\n{PRINT}\n.*\n{BUY}\n.*?(?=\n\n## |\Z)", re.DOTALL)
    return tables.sub(lambda _: "\n".join(_tables(bill)), guide, count=1)


def duration(seconds: float) -> str:
    """Return a time in hours and minutes, rounded to whole minutes: `2:31 h`."""
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours}:{minutes:02d} h"


def _forbidden(robot: Robot) -> Iterator[str]:
    """Yield a warning if limits forbid the robot."""
    if broken := [finding.name for finding in errors(quick_findings(robot))]:
        limits = f"the limit {broken[0]} is" if len(broken) == 1 else f"the limits {', '.join(broken)} are"
        yield from (
            f"> **Warning.** Do not build it as it is: {limits} violated. `jumpcad check` says by how much.",
            "",
        )


def _tables(bill: Bill) -> Iterator[str]:
    """Yield the bill's lines; times and prices have columns where any is known."""
    printed = [item for item in bill.items if item.kind != "bought"]
    bought = [item for item in bill.items if item.kind == "bought"]
    yield from ("", PRINT, "", *_table("part | copies | material | g each", printed, printed=True))
    if bill.plates:
        yield from ("", "| plate | material | time |", "|---|---|--:|")
        yield from (f"| {plate.name} | {plate.material} | {duration(plate.time_s)} |" for plate in bill.plates)
        yield f"| all | | {duration(bill.time_s or 0.0)} |"
    yield from ("", BUY, "", *_table("article | quantity | g each", bought, printed=False))
    yield from ("", bill.summary)


def _table(head: str, items: Sequence[BillLine], printed: bool) -> Iterator[str]:
    timed = any(item.time_s is not None for item in items)
    priced = any(item.price_eur is not None for item in items)
    yield f"| {head} |{' time each |' * timed}{' € |' * priced}"
    yield f"|---|--:|{'---|' * printed}--:|{'--:|' * timed}{'--:|' * priced}"
    for item in items:
        row = [item.name, str(item.quantity), *([item.material] * printed), f"{1000.0 * item.mass_kg:.2f}"]
        row += [duration(item.time_s) if item.time_s is not None else ""] * timed
        row += [euros(item.total_eur)] * priced
        yield f"| {' | '.join(map(plain, row))} |"


def _steps(robot: Robot, steps: Sequence[Step], pictures: Sequence[str]) -> Iterator[str]:
    words = expected(robot, steps)
    for number, step in enumerate(steps, start=1):
        yield from ("", f"## {number}. {step.title}", "")
        for warning in step.warnings:
            yield from (f"> **Warning.** {filled(warning, words)}", "")
        for name in pictures:
            if re.fullmatch(rf"step-{number}(-.*)?", name):
                yield from (f"![{step.title}](pictures/{name}.png)", "")
        yield from _put_on(step)
        for text in step.text:
            yield from (filled(text, words), "")
        for check in step.checks:
            yield from (f"**Check.** {filled(check, words)}", "")


def _put_on(step: Step) -> Iterator[str]:
    """Yield a line for every kind of thing that a step puts on: how many, what it is called, from where, which tool."""
    lines: Counter[str] = Counter()
    for index, placed in enumerate(step.placed):
        move = placed.move
        if move.trial:
            continue
        base = index == 0 and step.onto not in (ROBOT,)
        way = "" if move.way == "laid" or base or "body_plate_right" in move.parts else f", {move.along}"
        tool = f"; {move.tool.name}" if move.tool else ""
        if move.brings:
            lines[f"the {move.brings}{way}"] = 0
            continue
        for thing in placed.things:
            if _counts(thing):
                lines[f"{plain(_label(thing))} ({label_of(thing)}{way}{tool})"] += 1
    yield from (f"- {count} × {words}" if count else f"- {words}" for words, count in lines.items())
    if lines:
        yield ""


def _label(shape: Visual) -> str:
    source = shape.source
    return source.name if isinstance(source, Part) else source.article


def _counts(shape: Visual) -> bool:
    """Tell whether a shape is a thing of its own, not a piece of one that is listed elsewhere."""
    return isinstance(shape.source, Part) or shape.source.units > 0
