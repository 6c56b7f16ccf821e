"""`jumpcad report`: a page with a robot's motion, limits and parts, or a page on a study."""

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jumpcad.cli.going import CourseOption, ToOption, recorded
from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, status
from jumpcad.cli.subjects import (
    RowOption,
    WorkshopOption,
    bundle_of,
    name_of,
    note_template,
    printed_robot,
    reject_workshop,
)
from jumpcad.cli.verdict import warn_of_no_jump
from jumpcad.errors import JumpcadError, without_controls

if TYPE_CHECKING:
    from jumpcad.landing.course import Trip
    from jumpcad.landing.series import Series
    from jumpcad.robot.robot import Robot

PAGE = "report.html"
STUDY = ".db"


def report(
    subject: Annotated[
        str, typer.Argument(help="A bundle, a template, a design file, or a study file.", metavar="BUNDLE|DESIGN|F.db")
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="File of the page [BUNDLE/report.html, or NAME-report.html].")
    ] = None,
    workshop: WorkshopOption = None,
    row: RowOption = None,
    to: ToOption = None,
    course: CourseOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write report.html: one file, without network, with the robot in 3-D; of a study, its designs and plots."""
    if subject.endswith(STUDY) and not os.path.isdir(subject):
        if given := next((name for name, value in {"jumps": row, "to": to, "course": course}.items() if value), ""):
            raise JumpcadError(f"--{given}: {subject} is a study, which does not jump; leave it out")
        written = _study_page(Path(subject), output, workshop, force)
    else:
        written = _robot_page(subject, output, workshop, partial(recorded, row=row, to=to, course=course), force)
    if as_json:
        print_json({"file": str(written)})
    else:
        print(without_controls(str(written)))


def _study_page(study: Path, output: Path | None, workshop: str | None, force: bool) -> Path:
    """Write the page of a study; return its path."""
    from jumpcad.files.outputs import require_apart, require_target, sealed, write_atomically
    from jumpcad.search.report.page import write_study_page
    from jumpcad.search.study.store import StudyStore

    reject_workshop(workshop, f"{study} is a study, which keeps the workshop of its robots; leave --workshop out")
    page = output or Path(f"{study.stem}-{PAGE}")
    require_apart({"--output": page}, {"the study": study})
    require_target(page, (".html",), force)
    with StudyStore.read(study) as store, status(f"drawing {study} …"):
        text = write_study_page(store, study.stem)
    write_atomically(page, sealed(text, "<!-- {} -->"), force)
    return page


def _robot_page(
    subject: str, output: Path | None, workshop: str | None, series: "Callable[[Robot], Series | Trip | None]",
    force: bool,
) -> Path:  # fmt: skip
    """Write the page of a robot; return its path."""
    from jumpcad.bundle.atomic_write import change_files, require_unedited
    from jumpcad.bundle.export import report_page
    from jumpcad.files.outputs import require_apart, require_target, write_atomically

    require_apart({"--output": output}, {"the design": subject, "--workshop": workshop})
    note_template(subject)
    bundle = bundle_of(subject, workshop) if output is None else None
    page = output or (bundle.folder / PAGE if bundle else Path(f"{name_of(subject)}-{PAGE}"))
    if bundle:
        require_unedited(bundle, [PAGE], force)
    else:
        require_target(page, (".html",), force)
    with status(f"building {subject} …"):
        robot = printed_robot(subject, workshop)
    with status(f"drawing {robot.name} …"):
        text = report_page(robot, bundle.files if bundle else (), series(robot))
    if bundle:
        change_files(bundle, {PAGE: text}, {}, force)
    else:
        write_atomically(page, text, force)
    warn_of_no_jump(robot)
    return page
