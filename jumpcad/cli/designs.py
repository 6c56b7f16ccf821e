"""`jumpcad new`: a design file to edit."""

from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, escaped, print_json


def register(app: typer.Typer) -> None:
    """Add the commands of this module."""
    app.command()(new)


def new(
    file: Annotated[Path, typer.Argument(help="The design file to write.", metavar="FILE.toml")],
    template: Annotated[str, typer.Option("--from", help="A template's name or another design file.")] = "kenan-2.0",
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write a new design file, copied from a template."""
    from jumpcad.design import load_design
    from jumpcad.files.outputs import require_apart, require_target, write_atomically

    require_apart({"the design file": file}, {"--from": template})
    require_target(file, (".toml",), force)
    design = load_design(template)
    write_atomically(file, design.to_toml())
    if as_json:
        print_json({"file": str(file), "design": design.model_dump()})
    else:
        name = escaped(str(file))
        print(f"{name}: a copy of {escaped(template)}; try: jumpcad simulate {name}")
