"""`jumpcad studio`: sliders and the robot in a browser."""

import contextlib
import io
from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.subjects import WorkshopOption, bundle_of, design_file
from jumpcad.errors import JumpcadError

PORT = 8080
STUDY = ".db"


def register(app: typer.Typer) -> None:
    """Add the command of this module."""
    app.command()(studio)


def studio(
    design: Annotated[
        str, typer.Argument(help="A template, a design file, a bundle, or a study.", metavar="DESIGN|F.db")
    ] = "kenan-2.0",
    workshop: WorkshopOption = None,
    trial: Annotated[
        int | None, typer.Option(help="Trial of the study, numbered from 1.", show_default="the best", metavar="N")
    ] = None,
    port: Annotated[int, typer.Option(help="Port of the page, on this computer alone.", min=1, max=65535)] = PORT,
) -> None:
    """Change the eight numbers in a browser and see the robot that they give, wind and jump (extra `studio`)."""
    from jumpcad.design import load_design
    from jumpcad.files.templates import template_names
    from jumpcad.workshop import DEFAULT

    try:
        import viser
    except ImportError:
        raise JumpcadError("the studio needs viser: pip install 'jumpcad[studio]'") from None
    from jumpcad.studio import Points, Studio
    from jumpcad.studio.app import STUDYS

    others = template_names("workshops")
    if design.endswith(STUDY) and not Path(design).is_dir():
        points = Points(Path(design))
        number = points.best if trial is None else trial
        opened, first = points.trial(number).design, workshop or STUDYS
        if trial is not None and workshop is None:
            points.require_built(number)
        others = [STUDYS, *others]
    else:
        if trial is not None:
            raise JumpcadError(f"--trial {trial}: {design} is no study (F.db)")
        bundle_of(design, workshop)
        points, number = None, 1
        opened, first = load_design(design_file(design)), workshop or DEFAULT
    name = Path(design).name.removesuffix(".toml").removesuffix(STUDY)
    workshops = [first, *(other for other in others if other != first)]
    with contextlib.redirect_stdout(io.StringIO()):  # its banner has the address too
        server = viser.ViserServer(host="127.0.0.1", port=port, label="jumpcad studio", verbose=False)
    shown = Studio(opened, name, workshops, server, Path.cwd(), points, number)
    shown.start()
    print(f"http://127.0.0.1:{server.get_port()}  (Ctrl-C ends the studio; the browser needs WebGL)")
    try:
        server.sleep_forever()
    finally:
        shown.end()
