"""`jumpcad validate`: robots that others measured, beside what the engines compute of them."""

from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, print_text, status
from jumpcad.cli.searching import PlotsOption, require_pictures
from jumpcad.cli.subjects import SeedOption
from jumpcad.errors import JumpcadError


def validate(
    figure: Annotated[
        list[str] | None,
        typer.Option(help="A figure that you read in its paper, ROBOT.NAME=VALUE; may be repeated.", metavar="FIGURE"),
    ] = None,
    seed: SeedOption = 0,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Compare the engines with robots that others built and measured.

    Tiers are never mixed: what a mechanism does, flights, whole robots, bounds.
    A figure that is only remembered decides nothing.
    """
    from jumpcad.validation.table import TIERS
    from jumpcad.validation.table import validate as compare

    if plots:
        from jumpcad.search.report.figures import save_figure
        from jumpcad.validation.plot import PICTURES, validation

        require_pictures(plots, PICTURES, force)
    entered = dict(_entered(one) for one in figure or ())
    with status("simulating robots of which dimensions are unknown …"):
        robots = compare(entered, seed)
    if plots:
        save_figure(validation(robots), plots, *PICTURES, force)
    if as_json:
        print_json({"seed": seed, "entered": entered, "robots": robots})
    else:
        print_text("validate", tiers=TIERS, robots=robots)


def _entered(text: str) -> tuple[str, float]:
    key, _, value = text.partition("=")
    try:
        return key, float(value)
    except ValueError:
        raise JumpcadError(f"--figure {text}: give ROBOT.NAME=VALUE, as kovac-2008.spring_energy_j=0.154") from None
