"""`jumpcad cage`: the lightest cage that rights a robot, as a workshop file."""

import os
from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, shell_quoted, status
from jumpcad.cli.subjects import WorkshopOption, completion, note_template
from jumpcad.errors import without_controls


def cage(
    design: Annotated[
        str,
        typer.Argument(
            help="A template's name or a design file.", metavar="DESIGN", autocompletion=completion("robots")
        ),
    ],
    workshop: WorkshopOption = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="The workshop file; printed without.")] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Find the lightest cage that rights a robot; write a workshop file with it.

    Sizes are searched by stable poses. The lightest is then dropped 50 times
    and lands 50 times in MuJoCo, and must stand up. A minute or two.
    """
    from jumpcad.collision.hulls import least_share_on_feet, share_on_feet
    from jumpcad.design import load_design
    from jumpcad.files import to_toml
    from jumpcad.files.outputs import require_apart, require_target, write_atomically
    from jumpcad.landing.lightest_cage import TRIES, lightest_cage
    from jumpcad.workshop import load_workshop, own_workshop

    if output is not None:
        require_apart({"--output": output}, {"the design": design, "--workshop": workshop})
        require_target(output, (".toml",), force)
    note_template(design)
    base = workshop or own_workshop(design)
    with status(f"trying cages for {design} …"):
        robot, landed = lightest_cage(load_design(design), load_workshop(base), TRIES)
    sizes, share, least = robot.workshop.cage.model_dump(), share_on_feet(robot), least_share_on_feet(robot)
    drops, landings = landed.drops_righted, landed.share_righted
    found = (
        f"# {without_controls(design)} with it: {1000.0 * robot.mass_kg:.1f} g; on its feet in {100.0 * share:.0f} % "
        f"of stable poses, {100.0 * least:.0f} % with its centre of mass elsewhere;\n"
        f"# stands after {drops * TRIES:.0f} of {TRIES} drops and {landings * TRIES:.0f} of {TRIES} own landings\n"
    )
    beside = os.path.relpath(base, output.parent) if output is not None and os.path.isfile(base) else base
    text = found + to_toml({"base": beside, "cage": sizes})
    if output is not None:
        write_atomically(output, text, force)
    if as_json:
        figures = {"share": share, "least_share": least, "drops": drops, "landings": landings}
        print_json({"design": design, "workshop": base, "mass_kg": robot.mass_kg, **figures, "cage": sizes})
    elif output is None:
        print(text, end="")
    else:
        use = f"jumpcad check {shell_quoted(design)} --workshop {shell_quoted(str(output))}"
        print(f"{found}{without_controls(str(output))}: a workshop with this cage; try: {use}")
