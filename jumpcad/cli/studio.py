"""`jumpcad studio`: sliders and the robot in a browser."""

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import jumpcad
from jumpcad.cli.subjects import WorkshopOption, argument, bundle_of, design_file, option
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.process import collect_seldom

if TYPE_CHECKING:
    from jumpcad.studio.points import Points

PORT = 8080
STUDY = ".db"


def studio(
    design: Annotated[str, argument("A template, a design file, a bundle, or a study.", "DESIGN|F.db")] = "kenan-2.0",
    workshop: WorkshopOption = None,
    trial: Annotated[int | None, option("Trial of the study, numbered from 1.", "N", shown="the best")] = None,
    port: Annotated[int, typer.Option(help="Port of the page, on this computer alone.", min=1, max=65535)] = PORT,
) -> None:
    """Change the eight numbers in a browser and see the robot that they give, wind and jump (extra `studio`)."""
    try:
        from jumpcad.studio.server import OwnServer
    except ImportError:
        raise JumpcadError("the studio needs viser: pip install 'jumpcad[studio]'") from None
    from jumpcad.studio import Studio

    is_study = design.endswith(STUDY) and not os.path.isdir(design)
    if trial is not None and not is_study:
        raise JumpcadError(f"--trial {trial}: {design} is no study (F.db)")
    opened, own, points, number = (
        _point(Path(design), trial, workshop) if is_study else (*_design(design, workshop), None, 1)
    )
    shops = dict.fromkeys(name for name in (workshop, own, *template_names("workshops")) if name is not None)
    name = Path(design).name.removesuffix(".toml").removesuffix(STUDY)
    server = OwnServer(port)
    shown = Studio(opened, name, list(shops), server, Path.cwd(), points, number)
    shown.start()
    print(f"{server.address}  (Ctrl-C ends the studio; the browser needs WebGL)")
    collect_seldom(False)
    try:
        while True:
            time.sleep(1.0)  # a signal that comes just before a sleep is seen after it
    finally:
        shown.end()


def _point(file: Path, trial: int | None, workshop: str | None) -> "tuple[jumpcad.Design, str, Points, int]":
    """Return a trial's design, the name of its workshop in the studio, the study's points and the trial's number."""
    from jumpcad.studio.points import STUDYS, Points

    points = Points(file)
    number = points.best if trial is None else trial
    design = points.trial(number).design
    if trial is not None and workshop is None:
        points.require_built(number)
    return design, STUDYS, points, number


def _design(subject: str, workshop: str | None) -> "tuple[jumpcad.Design, str]":
    """Return the design of a bundle, a template or a file, and its workshop; raise `JumpcadError` if there is none."""
    from jumpcad.bundle.manifest import WORKSHOP, kept_workshop

    bundle = bundle_of(subject, workshop)
    if bundle is None:
        design = jumpcad.load_design(subject)
        return design, design.workshop_name
    kept_workshop(bundle)  # raises if it names other files
    return jumpcad.load_design(design_file(subject)), str(bundle.file(WORKSHOP))
