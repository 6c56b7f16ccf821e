"""`jumpcad build`, `jumpcad render`, `jumpcad verify`: bundles and their pictures."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

import jumpcad
from jumpcad import simulation
from jumpcad.cli import subjects
from jumpcad.cli.check import jump_in_words, notes
from jumpcad.cli.going import CourseOption, ToOption, recorded
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, console, status, table, text_of, wrapped
from jumpcad.dimensions import counted
from jumpcad.errors import CannotBuildError, JumpcadError, without_controls

EXPORTS = Path("exports")
PICTURES = "pictures"
GIF = "jump.gif"
LABEL = 15
"""Width of the words before the lines below it."""


def build(
    design: subjects.DesignArgument,
    workshop: subjects.WorkshopOption = None,
    printer: subjects.PrinterOption = None,
    material: subjects.MaterialOption = None,
    output: Annotated[subjects.File, subjects.output("Folder of the bundle.", "exports/NAME")] = None,
    pictures: Annotated[bool, typer.Option(help="Draw the robot.")] = True,
    step: Annotated[bool, typer.Option("--step", help="Write STEP files of the parts too.")] = False,
    ros2: Annotated[bool, typer.Option("--ros2", help="Write a ROS 2 description package too.")] = False,
    anyway: Annotated[bool, typer.Option("--anyway", help="Write the files of a robot that does not jump.")] = False,
    parts: Annotated[bool, typer.Option("--parts", help="List all parts with their masses.")] = False,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Build a robot: parts to print, files to simulate, what to buy, and how far it jumps.

    In a folder that holds the robot already, its files are replaced and
    everything else stays. A robot that does not jump is refused.
    """
    from jumpcad.bundle.atomic_write import require_place
    from jumpcad.bundle.export import export
    from jumpcad.files.outputs import require_apart, require_writable
    from jumpcad.mechanism.variants import capsule_robot

    require_apart({"--output": output}, {"the design": design, "--workshop": workshop})
    if output is None:
        require_writable(EXPORTS)
    else:
        require_place(output)
    subjects.note_template(design)
    with status(f"building {design} …"):
        robot = subjects.printed_robot(design, workshop, printer, material)
    folder = output or EXPORTS / robot.name
    if not force:
        _require_same_design_file(robot, subjects.design_file(design), folder)
    with status(f"simulating {robot.name} …"):
        plain = replace(capsule_robot(robot.design), springs=(replace(robot.spring, one_sided=False),))
        printed, capsule = (simulation.headline(one) for one in (robot, plain))
    if printed.verdict != "jump" and not anyway:
        raise CannotBuildError(f"{robot.name} {jump_in_words(printed.to_dict())}; --anyway writes its files")
    with status(f"writing {robot.name} …"):
        bundle = export(robot, folder, pictures, step, force, ros2)
    facts = _facts(robot, bundle, printed, capsule)
    answer(as_json, facts, _print_facts, facts, parts)


def render(
    subject: Annotated[str, typer.Argument(help="A bundle, a template or a design file.", metavar="BUNDLE|DESIGN")],
    output: Annotated[subjects.File, subjects.output("Folder.", "BUNDLE/pictures, or NAME-pictures")] = None,
    workshop: subjects.WorkshopOption = None,
    row: subjects.RowOption = None,
    to: ToOption = None,
    course: CourseOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Draw a robot at rest, compressed and exploded, and its jump as an animated GIF."""
    from jumpcad.bundle.atomic_write import change_files, require_unedited
    from jumpcad.bundle.renders import RENDERS, jump_gif, motion_gif, renders
    from jumpcad.bundle.viewer import viewer_data
    from jumpcad.files.outputs import require_apart, require_free, require_writable, write_files

    require_apart({"--output": output}, {"the design": subject, "--workshop": workshop})
    subjects.note_template(subject)
    names = [*(f"{name}.png" for name in RENDERS), GIF]
    bundle = subjects.bundle_of(subject, workshop) if output is None else None
    folder = output or (Path(subject, PICTURES) if bundle else Path(f"{subjects.name_of(subject)}-{PICTURES}"))
    if bundle:
        require_unedited(bundle, [f"{PICTURES}/{name}" for name in names], force)
    else:
        require_writable(folder)
        for name in names:
            require_free(folder / name, force)
    with status(f"building {subject} …"):
        robot = subjects.printed_robot(subject, workshop)
    with status(f"drawing {robot.name} …"):
        files = {f"{name}.png": png for name, png in renders(robot).items()}
    jump = simulation.headline(robot, trajectory=True)
    if jump.trajectory is not None:
        with status(f"drawing the jump of {robot.name} …"):
            way = recorded(robot, row, to, course)
            drawn = motion_gif(robot, viewer_data(robot, jump, way)) if way else jump_gif(robot, jump.trajectory)
            files[GIF] = drawn
    if bundle:
        change_files(bundle, {f"{PICTURES}/{name}": data for name, data in files.items()}, {}, force)
    else:
        write_files(folder, files, force)
    written = [without_controls(str(folder / name)) for name in sorted(files)]
    lines = written if GIF in files else [*written, f"no {GIF}: {jump.verdict}"]
    answer(as_json, {"folder": str(folder), "files": sorted(files), "verdict": jump.verdict}, print, *lines, sep="\n")


def verify(
    bundle: Annotated[Path, typer.Argument(help="A bundle's folder.", metavar="BUNDLE")], as_json: JsonFlag = False
) -> None:
    """Compare a bundle's files with its manifest; the exit code is 1 if one is changed or missing.

    Added files are named, but are no difference.
    """
    from jumpcad.bundle.manifest import KEEP_LINE_ENDS, LINE_ENDS, open_bundle, unlisted
    from jumpcad.bundle.manifest import verify as differences

    wrong, added = differences(bundle), unlisted(bundle)
    files = counted(len(open_bundle(bundle).files), "file")
    lines = [line for line in wrong if not line.endswith(LINE_ENDS)]
    if others := len(wrong) - len(lines):
        lines.append(f"{counted(others, 'file')}: {LINE_ENDS}; {KEEP_LINE_ENDS}")
    lines = lines or [f"{without_controls(str(bundle))}: {files}, none changed or missing"]
    lines += [f"{path}: added, not in the manifest" for path in added]
    answer(as_json, {"bundle": str(bundle), "differences": wrong, "added": added}, print, *lines, sep="\n")
    if wrong:
        raise typer.Exit(1)


def _require_same_design_file(robot: "jumpcad.Robot", file: Path, folder: Path) -> None:
    """Raise `JumpcadError` if a bundle of the robot's name was made from another design file.

    The dates decide, as in `make`: a design file that was edited since the build is newer than the bundle.
    """
    from jumpcad.bundle.manifest import DESIGN, open_bundle

    try:
        bundle = open_bundle(folder)
        kept = bundle.file(DESIGN)
        edited = file.stat().st_mtime_ns >= kept.stat().st_mtime_ns
        same = kept.read_bytes() == robot.design.to_toml().encode()
    except (JumpcadError, OSError):
        return  # no such bundle, or one that `export` rejects
    if edited or same or bundle.name != robot.name:
        return
    raise JumpcadError(
        f"{folder}: holds another design, built after {file} was last changed; choose another folder with -o, "
        "or replace it with --force"
    )


def _facts(
    robot: "jumpcad.Robot", bundle: "jumpcad.Bundle", printed: "simulation.Jump", capsule: "simulation.Jump"
) -> dict[str, Any]:
    """Return the figures that `build` prints."""
    from jumpcad.bundle.limits import limits_of, ordered, violation, with_verdict
    from jumpcad.robot.plates.thing import engraving_findings
    from jumpcad.simulation.uncertain import uncertainty_of

    train, sure = robot.layout.drive.train, uncertainty_of(robot) if printed.verdict == "jump" else None
    energy, findings = robot.spring.energy_j, with_verdict(limits_of(robot), printed)
    return {
        "name": robot.name, "folder": str(bundle.folder), "files": [*bundle.files], "mass_kg": robot.mass_kg,
        "masses": bundle.manifest["masses"], "spring_energy_j": energy,
        "winding": {
            "motor": train.motor.name, "ratio": train.ratio, "time_s": train.winding_s,
            "electrical_j": train.electrical_j, "motor_j": train.motor_j, "boards_j": train.boards_j,
            "efficiency": energy / train.electrical_j,
        },
        "notes": [*(finding.message for finding in engraving_findings(robot)), *notes(robot, findings)],
        "violated": [finding.to_dict() for finding in ordered(findings) if finding.severity != "info"],
        "violation": violation(findings), "jump": printed.to_dict(),
        "as_made": None if sure is None else sure.quantiles, "capsule_jump": capsule.to_dict(),
    }  # fmt: skip


def _print_facts(facts: dict[str, Any], parts: bool) -> None:
    screen = console()
    if parts:
        masses = table("part", ">quantity", "material", ">g each", ">g", "mass from")
        for line in facts["masses"]:
            grams = 1000.0 * line["mass_kg"]
            row = line["quantity"], line["material"], f"{grams:.2f}", f"{line['quantity'] * grams:.2f}", line["source"]
            masses.add_row(line["name"], *map(str, row))
        masses.add_row("all", "", "", "", f"{1000.0 * facts['mass_kg']:.2f}", "", style="bold")
        screen.print(masses)
        print()
    text = text_of(
        "build",
        **facts,
        printed=jump_in_words(facts["jump"], facts["as_made"] and facts["as_made"]["touchdown_distance_m"][1]),
        capsule=jump_in_words(facts["capsule_jump"]),
        pictured=any(path.startswith(f"{PICTURES}/") for path in facts["files"]),
    )
    for line in text.splitlines():
        print(wrapped(line, LABEL))
