"""`jumpcad check`: limits of printing, strength, drive and clearance."""

from typing import TYPE_CHECKING, Annotated

import typer

from jumpcad.cli.output import JsonFlag, console, print_json
from jumpcad.cli.subjects import tell_template

if TYPE_CHECKING:
    from jumpcad.findings import Finding

SEVERITIES = ("error", "warning", "info")
STYLES = {"error": "bold red", "warning": "yellow", "info": "green"}
WORDS = {"error": "error", "warning": "warning", "info": "holds"}


def register(app: typer.Typer) -> None:
    """Add the commands of this module."""
    app.command()(check)


def check(
    design: Annotated[str, typer.Argument(help="A template's name or a design file.", metavar="DESIGN")],
    workshop: Annotated[str, typer.Option(help="Workshop: a template's name or a TOML file.")] = "default",
    as_json: JsonFlag = False,
) -> None:
    """Check the robot of a design: printing, strength, drive, clearances.

    The exit code is 1 if a limit is violated that forbids the robot.
    """
    from jumpcad.building import build
    from jumpcad.checks import check as check_robot
    from jumpcad.design import load_design
    from jumpcad.findings import errors
    from jumpcad.workshop import load_workshop

    tell_template(design)
    robot = build(load_design(design), load_workshop(workshop))
    findings = sorted(check_robot(robot), key=lambda finding: SEVERITIES.index(finding.severity))
    if as_json:
        data = [finding.to_dict() | {"use": finding.use} for finding in findings]
        print_json({"design": design, "workshop": workshop, "findings": data})
    else:
        _print_table(findings)
    if errors(findings):
        raise typer.Exit(1)


def _print_table(findings: "list[Finding]") -> None:
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False)
    for title in ("", "check", "margin", "found"):
        table.add_column(title, justify="right" if title == "margin" else "left", no_wrap=title in ("check", "margin"))
    for finding in findings:
        remedy = "" if finding.severity == "info" else f" → {finding.remedy}"
        style = STYLES[finding.severity]
        margin = f"{finding.margin:+.3g} {finding.unit}"
        table.add_row(Text(WORDS[finding.severity], style), finding.name, margin, finding.message + remedy)
    screen = console()
    screen.print(table)
    counts = {severity: sum(finding.severity == severity for finding in findings) for severity in SEVERITIES}
    screen.print(f"{counts['error']} errors, {counts['warning']} warnings, {counts['info']} limits hold")
