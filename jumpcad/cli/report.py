"""`jumpcad report`: one page that shows a robot moving, its limits and how to make it."""

from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.bundle import progress
from jumpcad.cli.output import ForceFlag, JsonFlag, escaped, print_json
from jumpcad.cli.subjects import WorkshopOption, bundle_of, designed, tell_template

PAGE = "report.html"


def register(app: typer.Typer) -> None:
    """Add the command of this module."""
    app.command()(report)


def report(
    subject: Annotated[str, typer.Argument(help="A bundle, a template or a design file.", metavar="BUNDLE|DESIGN")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="File of the page [BUNDLE/report.html, or NAME-report.html].")
    ] = None,
    workshop: WorkshopOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write report.html: one file, without network, with the robot in 3-D."""
    from jumpcad.bundle.export import report_page
    from jumpcad.bundle.folder import change_files, require_unedited
    from jumpcad.files.outputs import require_apart, require_target, write_files

    require_apart({"--output": output}, {"the design": subject, "--workshop": workshop})
    tell_template(subject)
    bundle = bundle_of(subject, workshop) if output is None else None
    if bundle:
        require_unedited(bundle, [PAGE], force)
    elif output is not None:
        require_target(output, (".html",), force)
    with progress(f"building {subject}"):
        robot = designed(subject, workshop)
    page = output or (bundle.folder / PAGE if bundle else Path(f"{robot.name}-{PAGE}"))
    if not bundle and output is None:
        require_target(page, (".html",), force)
    with progress(f"drawing {robot.name}"):
        text = report_page(robot, bundle.files if bundle else ())
    if bundle:
        change_files(bundle, {PAGE: text}, {}, force)
    else:
        write_files(page.parent, {page.name: text})
    if as_json:
        print_json({"file": str(page)})
    else:
        print(escaped(str(page)))
