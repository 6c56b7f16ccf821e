"""`jumpcad variants`: robots as they may be made, for simulations by others."""

from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, status
from jumpcad.cli.subjects import DesignArgument, SeedOption, WorkshopOption, note_template, printed_robot
from jumpcad.cli.verdict import warn_of_no_jump
from jumpcad.errors import JumpcadError, without_controls


def variants(
    design: DesignArgument,
    count: Annotated[int, typer.Option(help="Number of robots.", min=1, max=10_000)] = 100,
    kind: Annotated[str, typer.Option("--format", help="mjcf or urdf.", metavar="mjcf|urdf")] = "mjcf",
    seed: SeedOption = 0,
    workshop: WorkshopOption = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Folder.", show_default="NAME-variants")] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write robots as they may be made of a design, for MuJoCo or as URDF, with one set of meshes.

    Lengths, springs, mass and friction differ within the tolerances of the
    workshop; variants.csv says by how much.
    """
    from jumpcad.bundle.atomic_write import require_place
    from jumpcad.files.outputs import require_apart
    from jumpcad.variation import FORMATS, TABLE, export_variants
    from jumpcad.variation import variants as made_of

    if kind not in FORMATS:
        raise JumpcadError(f"--format {kind}: must be {' or '.join(FORMATS)}")
    require_apart({"--output": output}, {"the design": design, "--workshop": workshop})
    if output is not None:
        require_place(output)
    note_template(design)
    with status(f"building {design} …"):
        robot = printed_robot(design, workshop)
        made = made_of(robot, count, seed)
    with status(f"writing {count} variants of {robot.name} …"):
        bundle = export_variants(robot, made, output or Path(f"{robot.name}-variants"), kind, force)
    warn_of_no_jump(robot)
    folder = str(bundle.folder)
    if as_json:
        print_json({"folder": folder, "format": kind, "seed": seed, "variants": [one.name for one in made]})
    else:
        print(
            f"{without_controls(folder)}: {made[0].name} to {made[-1].name}, {kind.upper()}; {TABLE} says what differs"
        )
