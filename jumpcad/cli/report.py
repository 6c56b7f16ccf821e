"""`jumpcad report`, `jumpcad compare`: pages on a robot, on a study, on robots side by side."""

import os
from pathlib import Path
from typing import Annotated

import typer

import jumpcad
from jumpcad.cli import subjects
from jumpcad.cli.check import NextFlag, warn_of_no_jump
from jumpcad.cli.going import CourseOption, ToOption, recorded
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, console, print_json, status, table
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.findings import errors

PAGE = "report.html"
STUDY = ".db"
SUBJECT = "A bundle, a template, a design file, or a study file."
ROBOTS = "Templates, design files, bundles, trials of a study as F.db#28."


def report(
    subject: Annotated[str, subjects.argument(SUBJECT, "BUNDLE|DESIGN|F.db")],
    output: Annotated[
        subjects.File, subjects.output("File of the page [BUNDLE/report.html, or NAME-report.html].")
    ] = None,
    workshop: subjects.WorkshopOption = None,
    row: subjects.RowOption = None,
    to: ToOption = None,
    course: CourseOption = None,
    what_next: NextFlag = False,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write report.html: one file, without network, with the robot in 3-D; of a study, its designs and plots."""
    if subject.endswith(STUDY) and not os.path.isdir(subject):
        given = {f"--jumps {row}": row, f"--to {to}": to, f"--course {course}": course, "--next": what_next}
        for option in (option for option, value in given.items() if value):
            raise JumpcadError(f"{option}: {subject} is a study, which does not jump; leave it out")
        written = _study_page(Path(subject), output, workshop, force)
    else:
        written = _robot_page(subject, output, workshop, (row, to, course), what_next, force)
    answer(as_json, {"file": str(written)}, print, without_controls(str(written)))


def _study_page(study: Path, output: Path | None, workshop: str | None, force: bool) -> Path:
    from jumpcad.files.outputs import require_apart, require_target, sealed, write_atomically
    from jumpcad.search import StudyStore
    from jumpcad.search.report.page import write_study_page

    why = f"{study} is a study, which keeps the workshop of its robots; leave --workshop out"
    subjects.reject_workshop(workshop, why)
    page = output or Path(f"{study.stem}-{PAGE}")
    require_apart({"--output": page}, {"the study": study})
    require_target(page, (".html",), force)
    with StudyStore.read(study) as store, status(f"drawing {study} …"):
        text = write_study_page(store, study.stem)
    write_atomically(page, sealed(text, "<!-- {} -->"), force)
    return page


def _robot_page(
    subject: str, output: Path | None, workshop: str | None, way: tuple[int | None, str | None, Path | None],
    what_next: bool, force: bool,
) -> Path:  # fmt: skip
    from jumpcad.bundle.atomic_write import change_files, require_unedited
    from jumpcad.bundle.export import report_page
    from jumpcad.bundle.limits import limits_of
    from jumpcad.files.outputs import require_apart, require_target, write_atomically
    from jumpcad.remedy_numbers import next_steps, steps_in_words

    require_apart({"--output": output}, {"the design": subject, "--workshop": workshop})
    subjects.note_template(subject)
    bundle = subjects.bundle_of(subject, workshop) if output is None else None
    page = output or (bundle.folder / PAGE if bundle else Path(f"{subjects.name_of(subject)}-{PAGE}"))
    if bundle:
        require_unedited(bundle, [PAGE], force)
    else:
        require_target(page, (".html",), force)
    with status(f"building {subject} …"):
        robot = subjects.printed_robot(subject, workshop)
    with status(f"drawing {robot.name} …"):
        steps = steps_in_words(*next_steps(robot, limits_of(robot))) if what_next else ()
        text = report_page(robot, bundle.files if bundle else (), recorded(robot, *way), steps)
    if bundle:
        change_files(bundle, {PAGE: text}, {}, force)
    else:
        write_atomically(page, text, force)
    warn_of_no_jump(robot)
    return page


def compare(
    robots: Annotated[list[str], subjects.argument(ROBOTS, "A B…")],
    workshop: subjects.WorkshopOption = None,
    output: Annotated[Path, typer.Option("-o", "--output", help="File of the page.")] = Path("comparison.html"),
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Compare robots: jumps, masses, energies, costs, limits, and what differs in designs and workshops.

    Prints a table, and writes a page on which they jump side by side to one
    scale. Bundles and trials keep their own workshops. The exit code is 1 if
    one of them cannot be built, or `jumpcad check` of it has 1.
    """
    from jumpcad.files.outputs import require_apart, require_target, sealed, write_atomically

    require_apart({"--output": output}, {"a robot": robots[0], "--workshop": workshop})
    require_target(output, (".html",), force)
    for one in robots:
        subjects.note_template(one)
    with status(f"comparing {', '.join(robots)} …"):
        found = jumpcad.compare(robots, jumpcad.load_workshop(workshop) if workshop else None)
        write_atomically(output, sealed(found.to_html(), "<!-- {} -->"), force)
    if as_json:
        print_json(found.to_dict() | {"page": str(output)})
    else:
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
    if found.refused or any(errors(one.findings) for one in found.robots):
        raise typer.Exit(1)
