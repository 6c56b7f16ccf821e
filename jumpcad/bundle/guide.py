"""assembly.md: what to print, what to buy, which springs to order, and how to assemble it."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence

from jumpcad.bundle.bom import Bill, BillLine, bill_of_materials, euros
from jumpcad.bundle.springs import spring_order
from jumpcad.bundle.wiring import wiring_lines
from jumpcad.files.markdown import plain
from jumpcad.parts.part import Part
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import assembly_steps
from jumpcad.scene.visuals import Visual

PRINT, BUY = "## Print", "## Buy"


def write_guide(robot: Robot, pictures: bool = True) -> str:
    """Return the guide in Markdown; `pictures` says whether `pictures/step-N.png` are beside it."""
    lines = [
        f"# {robot.name}",
        "",
        f"{1000.0 * robot.mass_kg:.1f} g. Left and right are as seen from behind the robot.",
        *_tables(bill_of_materials(robot)),
        *spring_order(robot),
        *_steps(robot, pictures),
        *wiring_lines(robot),
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


def _tables(bill: Bill) -> Iterator[str]:
    """Yield the bill's lines; times and prices have columns where any is known."""
    printed = [item for item in bill.items if item.kind == "printed"]
    bought = [item for item in bill.items if item.kind == "bought"]
    yield from ("", PRINT, "", *_table("part | copies | material | g each", printed, printed=True))
    if bill.plates:
        yield from ("", "| plate | material | time |", "|---|---|--:|")
        yield from (f"| {plate.name} | {plate.material} | {duration(plate.time_s)} |" for plate in bill.plates)
        yield f"| all | | {duration(bill.time_s or 0.0)} |"
    yield from ("", BUY, "", *_table("article | quantity | g each", bought, printed=False))
    cost = "" if bill.cost_eur is None else f", {euros(bill.cost_eur)} € together"
    yield from ("", f"In all {1000.0 * bill.mass_kg:.1f} g; {bill.known}{cost}.")


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


def _steps(robot: Robot, pictures: bool) -> Iterator[str]:
    for number, step in enumerate(assembly_steps(robot), start=1):
        yield from ("", f"## {number}. {step.title}", "", plain(step.text), "")
        if pictures:
            yield from (f"![{step.title}](pictures/step-{number}.png)", "")
        for label, count in Counter(_label(shape) for shape in step.added if _counts(shape)).items():
            yield f"- {count} × {plain(label)}"


def _label(shape: Visual) -> str:
    source = shape.source
    return source.name if isinstance(source, Part) else source.article


def _counts(shape: Visual) -> bool:
    """Tell whether a shape is a thing of its own, not a piece of one that is listed elsewhere."""
    return isinstance(shape.source, Part) or shape.source.units > 0
