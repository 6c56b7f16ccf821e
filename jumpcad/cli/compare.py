"""`jumpcad compare`: robots side by side, as a table and as a page on which they jump to one scale."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, console, print_json, status, table
from jumpcad.cli.subjects import WorkshopOption, note_template
from jumpcad.errors import without_controls

if TYPE_CHECKING:
    from jumpcad.comparison import Comparison

PAGE = Path("comparison.html")


def compare(
    robots: Annotated[
        list[str],
        typer.Argument(help="Templates, design files, bundles, trials of a study as F.db#28.", metavar="A B…"),
    ],
    workshop: WorkshopOption = None,
    output: Annotated[Path, typer.Option("-o", "--output", help="File of the page.")] = PAGE,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Compare robots: jumps, masses, energies, costs, limits, and what differs in designs and workshops.

    Prints a table, and writes a page on which they jump side by side to one
    scale. Bundles and trials keep their own workshops. The exit code is 1 if
    one of them cannot be built, or `jumpcad check` of it has 1.
    """
    from jumpcad.comparison import compare as compare_robots
    from jumpcad.files.outputs import require_apart, require_target, sealed, write_atomically
    from jumpcad.findings import errors
    from jumpcad.workshop import load_workshop

    require_apart({"--output": output}, {"a robot": robots[0], "--workshop": workshop})
    require_target(output, (".html",), force)
    for one in robots:
        note_template(one)
    with status(f"comparing {', '.join(robots)} …"):
        found = compare_robots(robots, load_workshop(workshop) if workshop else None)
        write_atomically(output, sealed(found.to_html(), "<!-- {} -->"), force)
    if as_json:
        print_json(found.to_dict() | {"page": str(output)})
    else:
        _print(found, output)
    if found.refused or any(errors(one.findings) for one in found.robots):
        raise typer.Exit(1)


def _print(found: "Comparison", output: Path) -> None:
    figures = table("", *(f">{without_controls(one.label)}" for one in found.robots), collapse_padding=True)
    for row in found.rows():
        figures.add_row(*row)
    for column in figures.columns:
        column.overflow = "fold"
    figures.columns[0].no_wrap = True
    console().print(figures)
    for label, why in found.refused.items():
        print(f"{without_controls(label)} cannot be built: {why}")
    print(f"open {without_controls(str(output))}: they jump side by side to one scale")
