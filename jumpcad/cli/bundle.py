"""`jumpcad build`, `jumpcad render`, `jumpcad verify`: bundles and their pictures."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import JsonFlag, console, print_json, status
from jumpcad.cli.subjects import designed
from jumpcad.errors import JumpcadError

if TYPE_CHECKING:
    from jumpcad.exporters.manifest import Bundle
    from jumpcad.robot import Robot
    from jumpcad.simulation import Jump

EXPORTS = Path("exports")
WIDE = 140
"""Columns of a table that no terminal shows."""


def register(app: typer.Typer) -> None:
    """Add the commands of this module."""
    app.command()(build)
    app.command()(render)
    app.command()(verify)


def build(
    design: Annotated[str, typer.Argument(help="A template's name or a design file.", metavar="DESIGN")],
    workshop: Annotated[str, typer.Option(help="Workshop: a template's name or a file.")] = "default",
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Folder of the bundle [exports/NAME].")] = None,
    pictures: Annotated[bool, typer.Option(help="Draw the robot.")] = True,
    step: Annotated[bool, typer.Option("--step", help="Write STEP files of the parts too.")] = False,
    as_json: JsonFlag = False,
) -> None:
    """Build a robot: parts to print, files to simulate, what to buy, and how far it jumps."""
    from jumpcad.capsule import capsule_robot
    from jumpcad.exporters.bundle import export
    from jumpcad.simulation import simulate
    from jumpcad.simulation.engines import default_engine

    with progress(f"building {design}"):
        robot = designed(design, workshop)
    with progress(f"writing {robot.name}"):
        bundle = export(robot, output or EXPORTS / robot.name, pictures, step)
    with progress(f"simulating {robot.name}"):
        engine = default_engine()
        printed, capsule = (simulate(one, engine=engine) for one in (robot, capsule_robot(robot.design)))
    facts = _facts(robot, bundle, printed, capsule)
    if as_json:
        print_json(facts)
    else:
        _tell(robot, facts)


def render(
    subject: Annotated[str, typer.Argument(help="A bundle, a template or a design file.", metavar="BUNDLE|DESIGN")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Folder [BUNDLE/pictures, or NAME-pictures].")
    ] = None,
    workshop: Annotated[str, typer.Option(help="Workshop of a design: a template's name or a file.")] = "default",
    as_json: JsonFlag = False,
) -> None:
    """Draw a robot at rest, compressed and exploded, and its jump as an animated GIF."""
    from jumpcad.exporters.manifest import is_bundle
    from jumpcad.pictures.stills import jump_gif, stills
    from jumpcad.simulation import Settings, simulate
    from jumpcad.simulation.engines import default_engine

    with progress(f"building {subject}"):
        robot = designed(subject, workshop)
    beside = Path(subject) / "pictures" if is_bundle(subject) else Path(f"{robot.name}-pictures")
    folder = output or beside
    with progress(f"drawing {robot.name}"):
        files = {f"{name}.png": png for name, png in stills(robot).items()}
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), default_engine())
    if jump.trajectory is not None:
        with progress(f"filming {robot.name}"):
            files["jump.gif"] = jump_gif(robot, jump.trajectory)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, data in files.items():
            (folder / name).write_bytes(data)
    except OSError as error:
        raise JumpcadError(f"{folder}: cannot be written: {error.strerror}") from None
    if as_json:
        print_json({"folder": str(folder), "files": sorted(files), "verdict": jump.verdict})
        return
    for name in sorted(files):
        print(folder / name)
    if jump.trajectory is None:
        print(f"no jump.gif: {jump.verdict}")


def verify(
    bundle: Annotated[Path, typer.Argument(help="A bundle's folder.", metavar="BUNDLE")], as_json: JsonFlag = False
) -> None:
    """Compare a bundle's files with its manifest; the exit code is 1 if one is changed or missing."""
    from jumpcad.exporters.manifest import open_bundle
    from jumpcad.exporters.manifest import verify as differences

    wrong = differences(bundle)
    if as_json:
        print_json({"bundle": str(bundle), "differences": wrong})
    else:
        print("\n".join(wrong) or f"{bundle}: {len(open_bundle(bundle).files)} files, all as they were built")
    if wrong:
        raise typer.Exit(1)


@contextmanager
def progress(doing: str) -> Iterator[None]:
    """Show on standard error what is being done, where a person watches."""
    with status(f"{doing} …"):
        yield


def _facts(robot: "Robot", bundle: "Bundle", printed: "Jump", capsule: "Jump") -> dict[str, Any]:
    """Return what `build` says at its end."""
    from jumpcad.checks.engraving import engraving_findings
    from jumpcad.checks.strength import strength_findings
    from jumpcad.findings import errors

    assert robot.plan is not None
    train = robot.plan.drive.train
    energy = robot.spring.energy_j
    return {
        "name": robot.name,
        "folder": str(bundle.folder),
        "files": [*bundle.files],
        "mass_kg": robot.mass_kg,
        "masses": bundle.manifest["masses"],
        "spring_energy_j": energy,
        "winding": {
            "motor": train.motor.name,
            "ratio": train.ratio,
            "time_s": train.winding_s,
            "electrical_j": train.electrical_j,
            "efficiency": energy / train.electrical_j,
        },
        "notes": [finding.message for finding in engraving_findings(robot)],
        "too_weak": [finding.to_dict() for finding in errors(strength_findings(robot))],
        "jump": printed.to_dict(),
        "capsule_jump": capsule.to_dict(),
    }


def _tell(robot: "Robot", facts: dict[str, Any]) -> None:
    from rich.table import Table

    table = Table("part", "quantity", "material", "g each", "g", "mass from", box=None, pad_edge=False)
    for column in (1, 3, 4):
        table.columns[column].justify = "right"
    for line in facts["masses"]:
        grams = 1000.0 * line["mass_kg"]
        row = (line["quantity"], line["material"], f"{grams:.2f}", f"{line['quantity'] * grams:.2f}", line["source"])
        table.add_row(line["name"], *map(str, row))
    table.add_row("all", "", "", "", f"{1000.0 * facts['mass_kg']:.2f}", "", style="bold")
    screen = console()
    console(width=screen.width if screen.is_terminal else WIDE).print(table)
    winding, jump = facts["winding"], facts["jump"]
    print()
    print(f"springs        {facts['spring_energy_j']:.4f} J")
    print(
        f"winding        {winding['electrical_j']:.2f} J electrical in {winding['time_s']:.2f} s ({winding['motor']}, "
        f"{winding['ratio']:.2f}:1), {100.0 * winding['efficiency']:.1f} % of which the springs hold"
    )
    if jump["takeoff_energy_ratio"] is not None:
        print(f"take-off       {100.0 * jump['takeoff_energy_ratio']:.1f} % of the springs' energy")
    for finding in facts["too_weak"]:
        print(f"too weak       {finding['message']}: {finding['remedy']}")
    for note in facts["notes"]:
        print(f"note           {note}")
    print(f"printed robot  {_said(jump)}")
    print(f"as capsules    {_said(facts['capsule_jump'])}")
    print(f"written        {len(facts['files']) + 1} files in {facts['folder']}")


def _said(jump: dict[str, Any]) -> str:
    """Return a jump in half a line."""
    if jump["verdict"] == "jump":
        return (
            f"jumps {1000.0 * jump['ballistic_range_m']:.0f} mm far and {1000.0 * jump['com_rise_m']:.0f} mm high "
            f"with {1000.0 * jump['mass_kg']:.1f} g"
        )
    why = [
        f": {finding['message']}; {finding['remedy']}" for finding in jump["findings"] if finding["severity"] == "error"
    ]
    return f"does not jump ({jump['verdict']}){''.join(why[:1])}"
