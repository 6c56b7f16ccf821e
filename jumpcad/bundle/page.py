"""report.html: a page on one robot, without network: verdict, motion in 3-D, limits, energy, printing, parts.

The HTML is well-formed XML too. The same robot and jump give the same bytes.
"""

import base64
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from urllib.parse import quote

from jumpcad.bundle.bom import Bill, BillLine, bill_of_materials, euros
from jumpcad.bundle.compared import compared, compared_of
from jumpcad.bundle.limits import limits, verdict_on
from jumpcad.bundle.uncertainty import uncertainty
from jumpcad.bundle.viewer import viewer
from jumpcad.checks import quick_findings
from jumpcad.dimensions import unit_of_key
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import templates_folder
from jumpcad.findings import Finding, errors
from jumpcad.robot import Robot
from jumpcad.simulation.jump import ACCOUNT, Jump
from jumpcad.simulation.uncertain import Uncertainty
from jumpcad.version import __version__

NUMERIC = ("quantity", "g each", "€", "margin", "value", "mJ", "share")
"""Columns that are right-aligned."""
GUIDE = "assembly.html"
FIRST_LINKS = {GUIDE: "Assembly guide", "bom.csv": "Bill of materials"}
"""Files of the bundle to which the page's top links, and their titles."""
SECTIONS = {"limits": "Limits", "energy": "Energy", "printing": "Printing", "parts": "Parts"}
"""Sections to which the page's top links, by their anchors."""


def write_report(
    robot: Robot,
    pictures: Mapping[str, bytes],
    jump: Jump,
    glb: bytes | None = None,
    files: Iterable[str] = (),
    sure: Uncertainty | None = None,
) -> str:
    """Return the page.

    Parameters
    ----------
    robot, jump
        The robot and its jump, with its trajectory if the page shows the motion.
    pictures
        PNG files by title; they become part of the page.
    glb
        The robot's GLB file; without it there is no 3-D view.
    files
        Paths in the bundle that the page links to.
    sure
        How sure range and rise are.
    """
    name, files, findings = escape(allowed(robot.name)), tuple(files), quick_findings(robot)
    style = (templates_folder() / "report" / "style.css").read_text(encoding="ascii")
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8" /><meta name="viewport" content="width=device-width, initial-scale=1" />',
            f"<title>{name}</title><style>{style}</style></head>",
            "<body>",
            f"<h1>{name}</h1>",
            *_links(files),
            *_verdict(robot, jump, sure, findings),
            *(viewer(robot, jump, glb) if glb is not None else ()),
            *_pictures(pictures),
            *limits(findings),
            *_energy(jump),
            *(uncertainty(sure) if sure is not None else ()),
            *(compared(beside) if (beside := compared_of(robot.design)) is not None else ()),
            *_printing(robot, files),
            *_parts(robot),
            *_downloads(files),
            "<h2>Design and figures</h2>",
            *_table(("figure", "value", "unit"), _figures(robot)),
            f"<p>Made by jumpcad {escape(__version__)} from design.toml and workshop.toml.</p>",
            "</body>",
            "</html>",
            "",
        ]
    )


def _links(files: Sequence[str]) -> Iterator[str]:
    """Yield links to the files that a reader wants first, if they are beside the page, and to its sections."""
    targets = {path: title for path, title in FIRST_LINKS.items() if path in files}
    targets |= {f"#{anchor}": title for anchor, title in SECTIONS.items()}
    yield "<nav>"
    yield from (f'<a href="{target}">{title}</a>' for target, title in targets.items())
    yield "</nav>"


def _verdict(robot: Robot, jump: Jump, sure: Uncertainty | None, findings: Sequence[Finding]) -> Iterator[str]:
    """Yield the range or the reason for no jump, the main figures, the price, and what is violated or tight."""
    if jump.ballistic_range_m is None or jump.com_rise_m is None:
        yield from _no_jump(jump)
        shown = []
    else:
        far, high = 1000.0 * jump.ballistic_range_m, 1000.0 * jump.com_rise_m
        yield f'<p class="verdict">It jumps {far:.0f} mm far; its centre of mass rises {high:.0f} mm.</p>'
        shown = [("range", f"{far:.0f} mm"), ("rise", f"{high:.0f} mm")]
        if sure is not None:
            low, _, most = sure.quantiles["ballistic_range_m"]
            shown.insert(1, ("eight of ten ranges", f"{1000.0 * low:.0f} to {1000.0 * most:.0f} mm"))
    violated, tight = verdict_on(findings)
    yield from violated
    train = robot.layout.drive.train
    shown += [
        ("mass", f"{1000.0 * robot.mass_kg:.1f} g"),
        ("energy in the springs", f"{1000.0 * robot.spring.energy_j:.0f} mJ"),
        ("winding", f"{train.winding_s:.1f} s"),
        ("electrical energy of a jump", f"{train.electrical_j:.2f} J"),
    ]
    yield '<dl class="cards">'
    yield from (f"<div><dt>{escape(term)}</dt><dd>{escape(value)}</dd></div>" for term, value in shown)
    yield "</dl>"
    yield f"<p>{_price(bill_of_materials(robot))}</p>"
    yield from tight


def _no_jump(jump: Jump) -> Iterator[str]:
    """Yield why there is no jump, and what to change."""
    broken = errors(jump.findings)
    reason = broken[0].message if broken else jump.verdict.replace("_", " ")
    yield f'<p class="verdict error">It does not jump: {escape(allowed(reason))}.</p>'
    if broken:
        yield f"<p>What to change: {escape(allowed(broken[0].remedy))}.</p>"


def _price(bill: Bill) -> str:
    """Return what the robot costs in a sentence, and where prices that are not known are entered."""
    enter = "<code>[prices_eur]</code> and <code>price_eur_per_kg</code> of the workshop file"
    if bill.cost_eur is None:
        return f"What it costs is not known: no price is. Enter yours in {enter}, and build again."
    together = f"Its parts and filament cost {euros(bill.cost_eur)} €"
    if all(item.price_eur is not None for item in bill.items):
        return f"{together}."
    return f"{together} at least: {bill.known}; the others are entered in {enter}."


def _energy(jump: Jump) -> Iterator[str]:
    """Yield the energy account at take-off as a bar and a table."""
    account = jump.energy_account_j
    if account is None:
        return
    whole = sum(account.values())
    yield '<h2 id="energy">Where the energy goes</h2>'
    yield f"<p>Of {1000.0 * whole:.1f} mJ in the springs, at take-off:</p>"
    yield '<div class="stack">'
    for number, (kind, energy) in enumerate(account.items()):
        share = 100.0 * max(energy, 0.0) / whole
        yield f'<span class="share share{number}" style="width: {share:.2f}%" title="{escape(kind)}"></span>'
    yield "</div>"
    rows = (
        (kind, f"{1000.0 * energy:.1f}", f"{100.0 * energy / whole:.1f} %", ACCOUNT[kind])
        for kind, energy in account.items()
    )
    yield from _table(("energy", "mJ", "share", "what it is"), rows)


def _printing(robot: Robot, files: Sequence[str]) -> Iterator[str]:
    """Yield the print settings in words, the plates, and the guide."""
    process, workshop = robot.workshop.process, robot.workshop
    walls = f"{process.perimeters} perimeters of {process.line_width_mm:g} mm"
    infill = "solid" if process.infill == 1.0 else f"{100.0 * process.infill:g} % {process.infill_pattern} infill"
    yield '<h2 id="printing">Printing</h2>'
    yield (
        f"<p>Layers of {process.layer_height_mm:g} mm, the first {process.first_layer_mm:g} mm; {walls}; "
        f"{process.top_layers} solid layers above and {process.bottom_layers} below; {infill}; nozzle of "
        f"{workshop.printer.nozzle_mm:g} mm; no supports. Print every part as it lies in its file.</p>"
    )
    if plates := [file for file in files if file.startswith("print/") and file.endswith(".3mf")]:
        yield f"<p>Plates, with these settings inside: {', '.join(_link(file) for file in plates)}.</p>"
    if "print/README.md" in files:
        yield f"<p>For other slicers than PrusaSlicer: {_link('print/README.md')} beside them.</p>"
    if GUIDE in files:
        yield f'<p><a href="{GUIDE}">Assembly guide</a>: what to print and order, and how to put it together, step by '
        yield "step, with wiring, program and first jump.</p>"
    else:
        yield "<p><code>jumpcad build</code> writes the plates, and the assembly guide, into a folder.</p>"


def _downloads(files: Sequence[str]) -> Iterator[str]:
    """Yield links to the files of the bundle, by folder."""
    folders: dict[str, list[str]] = {}
    for file in files:
        folders.setdefault(file.rpartition("/")[0], []).append(file)
    if not folders:
        return
    yield "<h2>Files</h2>"
    yield "<p>Links work where this page lies in its folder.</p>"
    for folder, paths in folders.items():
        yield f"<details><summary>{escape(allowed(folder or 'this folder'))} ({len(paths)})</summary>"
        yield f"<p>{', '.join(_link(path) for path in paths)}</p></details>"


def _link(path: str) -> str:
    return f'<a href="{escape(quote(path))}">{escape(allowed(path.rpartition("/")[2]))}</a>'


def _pictures(pictures: Mapping[str, bytes]) -> Iterator[str]:
    for title, png in pictures.items():
        data = base64.b64encode(png).decode()
        shown = escape(allowed(title))
        yield f'<figure><img alt="{shown}" src="data:image/png;base64,{data}" />'
        yield f"<figcaption>{shown}</figcaption></figure>"


def _figures(robot: Robot) -> Iterator[Sequence[str]]:
    """Yield the design's parameters and the robot's figures."""
    for key, field in type(robot.design).model_fields.items():
        value = getattr(robot.design, key)
        yield f"{key}: {field.description}", f"{value:g}", unit_of_key(key) or "ratio"
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


def _parts(robot: Robot) -> Iterator[str]:
    bill = bill_of_materials(robot)
    for title, anchor, kinds, columns in (
        ("Printed parts", "parts", ("printed", "pad"), ("part", "material", "quantity", "g each", "€")),
        ("Bought parts", "bought", ("bought",), ("article", "quantity", "g each", "€")),
    ):
        yield f'<h2 id="{anchor}">{title}</h2>'
        head = columns if bill.cost_eur is not None else columns[:-1]
        yield from _table(head, ([_cell(item, column) for column in head] for item in bill.items if item.kind in kinds))
    yield f"<p>{bill.summary}</p>"


def _cell(item: BillLine, column: str) -> str:
    cells = {"quantity": str(item.quantity), "g each": f"{1000.0 * item.mass_kg:.2f}", "€": euros(item.total_eur)}
    return cells.get(column, item.material if column == "material" else item.name)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield a table."""
    classes = [' class="number"' if title in NUMERIC else "" for title in head]
    yield "<table>"
    yield "<tr>" + "".join(f"<th{kind}>{title}</th>" for kind, title in zip(classes, head, strict=True)) + "</tr>"
    for row in rows:
        cells = zip(classes, row, strict=True)
        yield "<tr>" + "".join(f"<td{kind}>{escape(allowed(cell))}</td>" for kind, cell in cells) + "</tr>"
    yield "</table>"
