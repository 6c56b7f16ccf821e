"""report.html: a self-contained page on one robot: pictures, figures, limits, parts.

Plain HTML that is well-formed XML too. The same robot gives the same bytes.
"""

import base64
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape

from jumpcad.bundle.bom import BillLine, bill_of_materials, euros
from jumpcad.checks import quick_findings
from jumpcad.exporters.xml import allowed
from jumpcad.findings import Finding
from jumpcad.robot import Robot
from jumpcad.simulation import simulate

STYLE = """
body { font: 15px/1.45 sans-serif; color: #222; max-width: 60em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { text-align: left; padding: 0.15em 1.2em 0.15em 0; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number, th.number { text-align: right; white-space: nowrap; }
figure { display: inline-block; width: 31%; margin: 0 1% 1em 0; }
img { width: 100%; }
.error { color: #b3322b; font-weight: bold; }
.warning { color: #a8641b; font-weight: bold; }
"""
NUMERIC = ("quantity", "g each", "€", "margin", "value", "mJ", "%")
"""Columns that are right-aligned."""
COLOURS = ("#1f5fa8", "#d9822b", "#8a8f98", "#b3322b", "#4f9d69", "#8d5fa8", "#6b4a2f")
"""Of the energy account: useful, internal, springs, release, pins, slip, contact."""


def write_report(robot: Robot, pictures: Mapping[str, bytes]) -> str:
    """Return the page; `pictures` are PNG files by what they show, and become part of it."""
    name = escape(allowed(robot.name))
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            f'<head><meta charset="utf-8" /><title>{name}</title><style>{STYLE}</style></head>',
            "<body>",
            f"<h1>{name}</h1>",
            *_pictures(pictures),
            "<h2>Figures</h2>",
            *_table(("figure", "value", "unit"), _figures(robot)),
            *_jump(robot),
            *_limits(robot),
            *_parts(robot),
            "</body>",
            "</html>",
            "",
        ]
    )


def _pictures(pictures: Mapping[str, bytes]) -> Iterator[str]:
    for title, png in pictures.items():
        data = base64.b64encode(png).decode()
        shown = escape(allowed(title))
        yield f'<figure><img alt="{shown}" src="data:image/png;base64,{data}" />'
        yield f"<figcaption>{shown}</figcaption></figure>"


def _figures(robot: Robot) -> Iterator[Sequence[str]]:
    """Yield the design's parameters and the robot's figures."""
    for key, value in robot.design.model_dump().items():
        yield key, f"{value:g}", ""
    yield "mass", f"{1000.0 * robot.mass_kg:.1f}", "g"
    for name, body in robot.bodies.items():
        yield f"mass of the {name.replace('_', ' ')}", f"{1000.0 * body.mass_kg:.1f}", "g"
    yield "spring energy", f"{robot.spring.energy_j:.4f}", "J"
    yield "spring angle, loaded", f"{math.degrees(robot.spring.wind_rad):.1f}", "°"
    train = robot.layout.drive.train
    yield "gear motor", train.motor.name, ""
    yield "gear ratio", f"{train.ratio:.2f}", ": 1"
    yield "winding time", f"{train.winding_s:.2f}", "s"
    yield "electrical energy of a jump", f"{train.electrical_j:.2f}", "J"
    yield "… of it, the boards' while winding", f"{train.boards_j:.2f}", "J"
    yield "motor current, mean", f"{1000.0 * train.mean_current_a:.0f}", "mA"
    yield "motor current, peak", f"{1000.0 * train.peak_current_a:.0f}", "mA"


def _jump(robot: Robot) -> Iterator[str]:
    """Yield the jump by the planar engine, which every machine has, and where the springs' energy went."""
    jump = simulate(robot, engine="planar")
    yield "<h2>Jump</h2>"
    account = jump.energy_account_j
    if account is None:
        yield f"<p>No jump: {escape(jump.verdict)}.</p>"
        return
    figures = (
        ("range", jump.ballistic_range_m, 1000.0, "mm"), ("rise of the centre of mass", jump.com_rise_m, 1000.0, "mm"),
        ("take-off speed", jump.takeoff_speed_m_s, 1.0, "m/s"), ("take-off angle", jump.takeoff_angle_deg, 1.0, "°"),
    )  # fmt: skip
    yield from _table(
        ("figure", "value", "unit"), ((name, f"{(value or 0.0) * by:.3g}", unit) for name, value, by, unit in figures)
    )
    yield "<p>Where the energy of the springs is at take-off:</p>"
    total = math.fsum(account.values())
    rows = [(name, round(1000.0 * value), round(100.0 * value / total, 1)) for name, value in account.items()]
    yield from _table(("energy", "mJ", "%"), ((name, f"{mj:d}", f"{share:g}") for name, mj, share in rows))
    yield '<svg viewBox="0 0 100 4" width="100%" height="24" role="img" aria-label="shares of the springs\' energy">'
    left = 0.0
    for (name, _, share), colour in zip(rows, COLOURS, strict=True):
        width = max(share, 0.0)
        yield f'<rect x="{left:.1f}" y="0" width="{width:.1f}" height="4" fill="{colour}"><title>{name}</title></rect>'
        left += width
    yield "</svg>"


def _limits(robot: Robot) -> Iterator[str]:
    """Yield the quick checks, the violated ones first."""
    order = ("error", "warning", "info")
    found = sorted(quick_findings(robot), key=lambda finding: order.index(finding.severity))
    violated = sum(finding.severity != "info" for finding in found)
    yield "<h2>Limits</h2>"
    yield f"<p>{violated} of {len(found)} are violated. <code>jumpcad check</code> also checks"
    yield "printability, and interference over the whole motion, which takes longer.</p>"
    yield from _table(("limit", "margin", "unit", "found"), (_limit(finding) for finding in found))


def _limit(finding: Finding) -> Sequence[str]:
    words = (
        finding.message if finding.severity == "info" else f"{finding.severity}: {finding.message}: {finding.remedy}"
    )
    return finding.name, f"{finding.margin:.3g}", finding.unit, words


def _parts(robot: Robot) -> Iterator[str]:
    bill = bill_of_materials(robot)
    head = ("quantity", "g each", "€")
    for title, kind, first in (("Printed parts", "printed", "part"), ("Bought parts", "bought", "article")):
        yield f"<h2>{title}</h2>"
        rows = (_line(item) for item in bill.items if item.kind == kind)
        yield from _table((first, "material", *head), rows)
    cost = "" if bill.cost_eur is None else f", {euros(bill.cost_eur)} € together"
    yield f"<p>In all {1000.0 * bill.mass_kg:.1f} g; {bill.known}{cost}.</p>"


def _line(item: BillLine) -> Sequence[str]:
    return item.name, item.material, str(item.quantity), f"{1000.0 * item.mass_kg:.2f}", euros(item.total_eur)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield a table; a row whose last cell begins with `error` or `warning` has its colour."""
    classes = [' class="number"' if title in NUMERIC else "" for title in head]
    yield "<table>"
    yield "<tr>" + "".join(f"<th{kind}>{title}</th>" for kind, title in zip(classes, head, strict=True)) + "</tr>"
    for row in rows:
        severity = row[-1].partition(":")[0]
        start = f'<tr class="{severity}">' if severity in ("error", "warning") else "<tr>"
        cells = zip(classes, row, strict=True)
        yield start + "".join(f"<td{kind}>{escape(allowed(cell))}</td>" for kind, cell in cells) + "</tr>"
    yield "</table>"
