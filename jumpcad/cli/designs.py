"""`jumpcad new`, `cage`, `variants`: files to edit, a workshop with the lightest cage, robots as they may be made."""

import os
from pathlib import Path
from typing import Annotated

import typer

import jumpcad
from jumpcad.cli import subjects
from jumpcad.cli.check import warn_of_no_jump
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, shell_quoted, status
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files import to_toml

TEMPLATE = "kenan-2.0"

FROM = "Design to copy: a template's name or a file."
NEW = "Write a workshop file instead, copied from this one: a template's name or a file."
FromOption = Annotated[
    subjects.Text, subjects.option(FROM, None, "--from", shown=TEMPLATE, autocompletion=subjects.completion("robots"))
]
NewWorkshopOption = Annotated[subjects.Text, subjects.option(NEW, autocompletion=subjects.completion("workshops"))]


def new(
    file: Annotated[Path, typer.Argument(help="The file to write.", metavar="FILE.toml")],
    template: FromOption = None,
    workshop: NewWorkshopOption = None,
    printer: subjects.PrinterOption = None,
    material: subjects.MaterialOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write a new design file, copied from a template; with --workshop, --printer or --material a workshop file."""
    from jumpcad.cli.commented import commented_design, commented_workshop
    from jumpcad.design import DEFAULT, own_workshop
    from jumpcad.files.outputs import require_apart, require_target, write_atomically

    for_workshop = any(value is not None for value in (workshop, printer, material))
    if for_workshop and template is not None:
        raise JumpcadError(f"--from {template}: a workshop file has no design; leave --from out, or write two files")
    require_apart({"the new file": file}, {"--from": template, "--workshop": workshop, "--printer": printer})
    require_target(file, (".toml",), force)
    name, quoted = without_controls(str(file)), shell_quoted(str(file))
    if for_workshop:
        base = DEFAULT if workshop is None else workshop
        shop = jumpcad.load_workshop(base, printer, material)
        text, data = commented_workshop(shop, without_controls(base)), {"workshop": shop.model_dump(exclude_none=True)}
        use = f"check {base if own_workshop(base) == base != DEFAULT else TEMPLATE} --workshop {quoted}"
    else:
        base = TEMPLATE if template is None else template
        design = jumpcad.load_design(base)
        text, data = commented_design(design, without_controls(base), name), {"design": design.model_dump()}
        use = f"simulate {quoted}"
    write_atomically(file, text, force)
    told = f"{name}: a copy of {without_controls(base)}; try: jumpcad {use}"
    answer(as_json, {"file": str(file), **data}, print, told)


def cage(
    design: subjects.OwnDesignArgument,
    workshop: subjects.WorkshopOption = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="The workshop file; printed without.")] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Find the lightest cage that rights a robot; write a workshop file with it.

    Sizes are searched by stable poses. The lightest is then dropped 50 times
    and lands 50 times in MuJoCo, and must stand up. A minute or two.
    """
    from jumpcad.collision.hulls import least_share_on_feet, share_on_feet
    from jumpcad.files.outputs import require_apart, require_target, write_atomically
    from jumpcad.landing.lightest_cage import TRIES, lightest_cage

    if output is not None:
        require_apart({"--output": output}, {"the design": design, "--workshop": workshop})
        require_target(output, (".toml",), force)
    subjects.note_template(design)
    asked = jumpcad.load_design(design)
    base = workshop or asked.workshop_name
    with status(f"trying cages for {design} …"):
        robot, landed = lightest_cage(asked, jumpcad.load_workshop(base), TRIES)
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
    figures = {"share": share, "least_share": least, "drops": drops, "landings": landings}
    use = f"jumpcad check {shell_quoted(design)} --workshop {shell_quoted(str(output))}"
    told = f"{found}{without_controls(str(output))}: a workshop with this cage; try: {use}\n" if output else text
    data = {"design": design, "workshop": base, "mass_kg": robot.mass_kg, **figures, "cage": sizes}
    answer(as_json, data, print, told, end="")


def variants(
    design: subjects.DesignArgument,
    count: Annotated[int, typer.Option(help="Number of robots.", min=1, max=10_000)] = 100,
    kind: Annotated[str, typer.Option("--format", help="mjcf or urdf.", metavar="mjcf|urdf")] = "mjcf",
    seed: subjects.SeedOption = 0,
    workshop: subjects.WorkshopOption = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Folder.", show_default="NAME-variants")] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write robots as they may be made of a design, for MuJoCo or as URDF, with one set of meshes.

    Lengths, springs, mass and friction differ within the tolerances of the
    workshop; variants.csv says by how much.
    """
    from jumpcad.bundle.atomic_write import require_place
    from jumpcad.bundle.variants import FORMATS, TABLE, export_variants
    from jumpcad.files.outputs import require_apart

    if kind not in FORMATS:
        raise JumpcadError(f"--format {kind}: must be {' or '.join(FORMATS)}")
    require_apart({"--output": output}, {"the design": design, "--workshop": workshop})
    if output is not None:
        require_place(output)
    subjects.note_template(design)
    with status(f"building {design} …"):
        robot = subjects.printed_robot(design, workshop)
        made = jumpcad.variants(robot, count, seed)
    with status(f"writing {count} variants of {robot.name} …"):
        bundle = export_variants(robot, made, output or Path(f"{robot.name}-variants"), kind, force)
    warn_of_no_jump(robot)
    folder = str(bundle.folder)
    names = [one.name for one in made]
    told = f"{without_controls(folder)}: {names[0]} to {names[-1]}, {kind.upper()}; {TABLE} says what differs"
    answer(as_json, {"folder": folder, "format": kind, "seed": seed, "variants": names}, print, told)
