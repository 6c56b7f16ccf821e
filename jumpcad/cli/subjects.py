"""Arguments of commands: a template, a design file, a bundle, or the file of a robot with bodies of its own."""

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import jumpcad
from jumpcad.errors import JumpcadError
from jumpcad.files import find_template, template_names

if TYPE_CHECKING:
    from jumpcad.mechanism.model import Multibody

Text = str | None
Texts = list[str] | None
File = Path | None


def option(help: str, metavar: str | None = None, *names: str, shown: str | bool = True, **more: Any) -> Any:
    """Return an option with its help; `shown` is what stands there for a default."""
    return typer.Option(*names, help=help, metavar=metavar, show_default=shown, **more)


def output(help: str, shown: str | bool = True) -> Any:
    """Return the option `--output` of a command."""
    return option(help, None, "-o", "--output", shown=shown)


def argument(help: str, metavar: str, **more: Any) -> Any:
    """Return an argument with its help."""
    return typer.Argument(help=help, metavar=metavar, **more)


def completion(kind: str) -> Callable[[str], list[str]]:
    """Return the shell completion for the names of a kind of templates."""
    return lambda incomplete: [name for name in template_names(kind) if name.startswith(incomplete.lower())]


ROBOTS = {"autocompletion": completion("robots")}
DesignArgument = Annotated[str, argument("A template's name, a design file, a bundle.", "DESIGN|BUNDLE", **ROBOTS)]
OwnDesignArgument = Annotated[str, argument("A template's name or a design file.", "DESIGN", **ROBOTS)]
SeedOption = Annotated[int, typer.Option(help="Random seed.", min=0, max=2**32 - 1)]
RowOption = Annotated[int | None, typer.Option("--jumps", help="Show so many jumps in a row (MuJoCo).", min=1, max=20)]
WORKSHOP = "Workshop of the printed robot: a template's name or a file."
OWN_WORKSHOPS = "default; best-jumper, best-steered and first-robot have their own"
PRINTER = "Printer instead of the workshop's: see jumpcad list printers."
MATERIAL = "One material for all printed parts: see jumpcad list materials."
WorkshopOption = Annotated[Text, option(WORKSHOP, shown=OWN_WORKSHOPS, autocompletion=completion("workshops"))]
PrinterOption = Annotated[Text, option(PRINTER, autocompletion=completion("printers"))]
MaterialOption = Annotated[Text, option(MATERIAL, autocompletion=completion("materials"))]


def note_template(subject: str) -> None:
    """Print that a bare name means the template, if the working directory has a bundle of that name."""
    from jumpcad.bundle.manifest import MANIFEST

    folder = os.path.join(os.curdir, subject)
    if _is_template(subject) and os.path.lexists(os.path.join(folder, MANIFEST)):
        print(f"jumpcad: {subject} is the template; write {folder} for the bundle of this name", file=sys.stderr)


def bundle_of(subject: str, workshop: str | None = None) -> "jumpcad.Bundle | None":
    """Return the bundle that a subject names: a folder, unless it is a template's bare name; else None."""
    from jumpcad.bundle.manifest import open_bundle

    if _is_template(subject) or not os.path.isdir(subject):
        return None
    bundle = open_bundle(subject)
    own = f"{subject} is a bundle, built in a workshop of its own"
    reject_workshop(workshop, f"{own}; give {Path(subject, 'design.toml')} to build it in another")
    return bundle


def printed_robot(
    subject: str, workshop: str | None, printer: str | None = None, material: str | None = None
) -> "jumpcad.Robot":
    """Return the printed robot of a bundle (built again from its inputs), of a template, or of a design file."""
    from jumpcad.building import build as build_robot
    from jumpcad.bundle.manifest import kept_robot

    if bundle := bundle_of(subject, workshop):
        for given in (f"--printer {printer}" if printer else "", f"--material {material}" if material else ""):
            if given:
                raise JumpcadError(f"{given}: {subject} is a bundle, built in a workshop of its own; give a design")
        return kept_robot(bundle)
    design = jumpcad.load_design(subject)
    shop = jumpcad.load_workshop(workshop or design.workshop_name, printer, material)
    return build_robot(design, shop, name_of(subject))


def name_of(subject: str) -> str:
    """Return the name of the robot of a template or of a design file, which is engraved on it."""
    return Path(subject).name.removesuffix(".toml")


def design_file(subject: str) -> Path:
    """Return the design file of a bundle, a template or a path."""
    bundle = bundle_of(subject)
    return bundle.file("design.toml") if bundle else find_template("robots", subject)


def robot_from_file(subject: str, workshop: str | None) -> "Multibody | None":
    """Return the robot of a URDF file, also that in a bundle, or of a TOML file with bodies; None for anything else."""
    from jumpcad.simulation.robot_file import is_robot_file, load_robot

    if bundle := bundle_of(subject, workshop):
        return load_robot(bundle.urdf)
    path = Path(subject)
    if path.suffix != ".urdf" and (_is_template(subject) or not is_robot_file(path)):
        return None
    reject_workshop(workshop, f"{subject} is simulated as it is written; leave --workshop out")
    return load_robot(path)


def reject_workshop(workshop: str | None, reason: str) -> None:
    """Raise `JumpcadError` if the option `--workshop` is given, where it does not apply."""
    if workshop is not None:
        raise JumpcadError(f"--workshop {workshop}: {reason}")


def _is_template(subject: str) -> bool:
    return subject in template_names("robots")
