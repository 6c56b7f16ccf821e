"""`jumpcad reproduce`: the published study's table of results, simulated again, with explanations."""

from dataclasses import asdict
from typing import TYPE_CHECKING

from jumpcad.cli.output import JsonFlag, console, print_json

if TYPE_CHECKING:
    from rich.table import Table

    from jumpcad.paper.reproduction import Hyperparameter, Reproduction


def reproduce(as_json: JsonFlag = False) -> None:
    """Print the published table of results, the same simulated again, and jumpcad's own results."""
    from jumpcad.paper import reproduction

    rows = reproduction.reproduce()
    if as_json:
        print_json(
            {
                "robots": [row.to_dict() for row in rows],
                "hyperparameters": [asdict(item) for item in reproduction.HYPERPARAMETERS],
                "why_they_differ": reproduction.WHY_THEY_DIFFER,
            }
        )
        return
    screen = console(highlight=False)
    screen.print(_results(rows))
    screen.print(reproduction.READING)
    screen.print(_hyperparameters(reproduction.HYPERPARAMETERS))
    screen.print("Why the published figures and the evaluator's differ:")
    for reason in reproduction.WHY_THEY_DIFFER:
        screen.print(f"- {reason}")


def _results(rows: "list[Reproduction]") -> "Table":
    table = _table(
        "Published results", "robot", "quantity", ">published", ">again", ">measured", ">evaluator", "meaning"
    )
    for row in rows:
        there, here, jump = row.published.simulated, row.again, row.jump
        measured = asdict(row.published.measured) if row.published.measured else {}
        built = {name: f"{value:g}" for name, value in measured.items()}
        length = ("length m", f"{there.distance_m:g}", f"{here.distance_m:.4f}", built.get("distance_m"))
        height = ("height m", f"{there.base_height_m:g}", f"{here.base_height_m:.4f}", built.get("height_m"))
        energy = ("energy J", f"{there.energy_j:g}", f"{here.energy_j:.4f}", built.get("electrical_energy_j"))
        table.add_row(row.published.title, *length, _shown(jump.ballistic_range_m), "ballistic")
        table.add_row("", "", "", "", "", _shown(jump.touchdown_distance_m), "touchdown")
        table.add_row("", *height, _shown(jump.com_rise_m), "rise")
        table.add_row("", *energy, _shown(jump.takeoff_energy_ratio), "share", end_section=True)
    return table


def _hyperparameters(items: "tuple[Hyperparameter, ...]") -> "Table":
    title = "The study's hyperparameter table is not what its results come from"
    table = _table(title, "hyperparameter", ">in its table", ">in its results")
    for item in items:
        table.add_row(item.name, "–" if item.in_table is None else f"{item.in_table:g}", f"{item.in_results:g}")
    return table


def _table(title: str, *headings: str) -> "Table":
    """Return an empty table; a heading that starts with > is right-aligned."""
    from rich.box import SIMPLE
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=SIMPLE)
    for heading in headings:
        table.add_column(heading.removeprefix(">"), justify="right" if heading.startswith(">") else "left")
    return table


def _shown(value: float | None) -> str:
    return "none" if value is None else f"{value:.4f}"
