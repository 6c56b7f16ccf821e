"""`jumpcad new`: a design file or a workshop file to edit, every value with a comment."""

from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, shell_quoted
from jumpcad.cli.subjects import MaterialOption, PrinterOption, completion
from jumpcad.errors import JumpcadError, without_controls

TEMPLATE = "kenan-2.0"

FromOption = Annotated[
    str | None,
    typer.Option(
        "--from", help="Design to copy: a template's name or a file.", show_default=TEMPLATE,
        autocompletion=completion("robots"),
    ),
]  # fmt: skip
NewWorkshopOption = Annotated[
    str | None,
    typer.Option(
        help="Write a workshop file instead, copied from this one: a template's name or a file.",
        autocompletion=completion("workshops"),
    ),
]


def new(
    file: Annotated[Path, typer.Argument(help="The file to write.", metavar="FILE.toml")],
    template: FromOption = None,
    workshop: NewWorkshopOption = None,
    printer: PrinterOption = None,
    material: MaterialOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write a new design file, copied from a template; with --workshop, --printer or --material a workshop file."""
    from jumpcad.files.outputs import require_apart, require_target

    for_workshop = any(value is not None for value in (workshop, printer, material))
    if for_workshop and template is not None:
        raise JumpcadError(f"--from {template}: a workshop file has no design; leave --from out, or write two files")
    require_apart({"the new file": file}, {"--from": template, "--workshop": workshop, "--printer": printer})
    require_target(file, (".toml",), force)
    if for_workshop:
        _new_workshop(file, workshop, printer, material, force, as_json)
    else:
        _new_design(file, TEMPLATE if template is None else template, force, as_json)


def _new_design(file: Path, template: str, force: bool, as_json: bool) -> None:
    from jumpcad.cli.commented import commented_design
    from jumpcad.design import load_design
    from jumpcad.files.outputs import write_atomically

    design, name = load_design(template), without_controls(str(file))
    write_atomically(file, commented_design(design, without_controls(template), name), force)
    if as_json:
        print_json({"file": str(file), "design": design.model_dump()})
    else:
        print(f"{name}: a copy of {without_controls(template)}; try: jumpcad simulate {shell_quoted(str(file))}")


def _new_workshop(
    file: Path, base: str | None, printer: str | None, material: str | None, force: bool, as_json: bool
) -> None:
    from jumpcad.cli.commented import commented_workshop
    from jumpcad.files.outputs import write_atomically
    from jumpcad.workshop import DEFAULT, load_workshop, own_workshop

    base = DEFAULT if base is None else base
    workshop, name = load_workshop(base, printer, material), without_controls(str(file))
    write_atomically(file, commented_workshop(workshop, without_controls(base)), force)
    if as_json:
        print_json({"file": str(file), "workshop": workshop.model_dump(exclude_none=True)})
    else:
        design = base if own_workshop(base) == base != DEFAULT else TEMPLATE
        use = f"jumpcad check {design} --workshop {shell_quoted(str(file))}"
        print(f"{name}: a copy of {without_controls(base)}; try: {use}")
