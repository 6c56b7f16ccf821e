"""`jumpcad studio`: sliders and the robot in a browser."""

import contextlib
import io
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jumpcad.cli.subjects import WorkshopOption, bundle_of, design_file
from jumpcad.errors import JumpcadError

if TYPE_CHECKING:
    from jumpcad.design import Design

PORT = 8080


def register(app: typer.Typer) -> None:
    """Add the command of this module."""
    app.command()(studio)


def studio(
    design: Annotated[
        str, typer.Argument(help="A template, a design file, a bundle, or a study (its best).", metavar="DESIGN|F.db")
    ] = "kenan-2.0",
    workshop: WorkshopOption = None,
    port: Annotated[int, typer.Option(help="Port of the page, on this computer alone.", min=1, max=65535)] = PORT,
) -> None:
    """Change the eight numbers in a browser and see the robot that they give (extra `studio`)."""
    from jumpcad.design import load_design
    from jumpcad.files.templates import template_names
    from jumpcad.workshop import DEFAULT

    try:
        import viser
    except ImportError:
        raise JumpcadError("the studio needs viser: pip install 'jumpcad[studio]'") from None
    from jumpcad.studio import Studio

    if design.endswith(".db"):
        opened = _best(Path(design))
    else:
        bundle_of(design, workshop)
        opened = load_design(design_file(design))
    name = Path(design).name.removesuffix(".toml").removesuffix(".db")
    chosen = workshop or DEFAULT
    workshops = [chosen, *(other for other in template_names("workshops") if other != chosen)]
    with contextlib.redirect_stdout(io.StringIO()):  # its banner has the address too
        server = viser.ViserServer(host="127.0.0.1", port=port, label="jumpcad studio", verbose=False)
    shown = Studio(opened, name, workshops, server, Path.cwd())
    shown.start()
    print(f"http://127.0.0.1:{server.get_port()}  (Ctrl-C ends the studio)")
    try:
        server.sleep_forever()
    finally:
        shown.end()


def _best(file: Path) -> "Design":
    """Return the best design of a study; raise `JumpcadError` if none can be built."""
    from jumpcad.search.store import StudyStore
    from jumpcad.search.trial import feasible_trials, searched

    with StudyStore.read(file) as store:
        top = feasible_trials(searched(store.trials()))
    if not top:
        raise JumpcadError(f"{file}: no design of this study can be built")
    return top[0].design
