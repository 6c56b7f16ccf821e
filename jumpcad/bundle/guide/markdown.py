"""The guide's five documents: order, check on arrival, wire, assemble, and when something goes wrong."""

import re
from collections import Counter
from collections.abc import Sequence

from jumpcad.building.bom import Bill, bill_of_materials, euros
from jumpcad.bundle.guide.guide_values import guide_values
from jumpcad.files.templates import render
from jumpcad.parts.part import Part
from jumpcad.robot.robot import Robot
from jumpcad.robot.springs.wire import CHOOSE
from jumpcad.scene.visuals import Visual
from jumpcad.steps.assembly_steps import Step, assembly_steps
from jumpcad.steps.step_views import label_of

PARTS = ("order", "arrival", "wiring", "assembly", "trouble")
"""The guide's documents, in the order in which a builder needs them."""
BILL, LAST_WIRED = "guides/bill.md.j2", "power"
BY_ROLE = ("motor", "battery", "controller", "driver", "regulator", "switch", "sensor", "capacitor", "plug")
"""What a step and its picture call by its part in the robot, not by its article."""


def write_guide(robot: Robot, pictures: Sequence[str] = ()) -> dict[str, str]:
    """Return the guide's documents in Markdown by their files; `pictures` are the names of those in `pictures/`."""
    steps, bill = assembly_steps(robot), bill_of_materials(robot)
    shown = [
        (number, step, [name for name in pictures if re.fullmatch(rf"step-{number}(-.*)?", name)], put_on(step))
        for number, step in enumerate(steps, start=1)
    ]
    values = {
        **guide_values(robot, steps, bill),
        "bill": bill_text(bill),
        "steps": shown,
        "wired": next(number for number, step, *_ in shown if step.key == LAST_WIRED),
        "pictures": pictures,
    }
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
