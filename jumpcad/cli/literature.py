"""`jumpcad reproduce`, `jumpcad validate`: the published study simulated again, and robots that others measured."""

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

from jumpcad.cli.output import ForceFlag, JsonFlag, answer, console, print_json, print_text, status, table
from jumpcad.cli.searching import PlotsOption, require_pictures
from jumpcad.cli.subjects import SeedOption, Texts, option
from jumpcad.errors import JumpcadError

if TYPE_CHECKING:
    from rich.table import Table

    from jumpcad.paper.reproduction import Reproduction


def reproduce(as_json: JsonFlag = False) -> None:
    """Print the published table of results, the same simulated again, and jumpcad's own results."""
    from rich.box import SIMPLE

    from jumpcad.paper import reproduction

    rows = reproduction.reproduce()
    if as_json:
        keys = "name", "in_table", "in_results"
        items = [dict(zip(keys, (name, *both), strict=True)) for name, both in reproduction.HYPERPARAMETERS.items()]
        why = reproduction.WHY_THEY_DIFFER
        print_json({"robots": [row.to_dict() for row in rows], "hyperparameters": items, "why_they_differ": why})
        return
    screen, style = console(highlight=False), dict[str, Any](title_justify="left", box=SIMPLE, pad_edge=True)
    screen.print(_results(rows, style))
    screen.print(reproduction.READING)
    title = "The study's hyperparameter table is not what its results come from"
    made = table("hyperparameter", ">in its table", ">in its results", title=title, **style)
    for name, (in_table, in_results) in reproduction.HYPERPARAMETERS.items():
        made.add_row(name, "–" if in_table is None else f"{in_table:g}", f"{in_results:g}")
    screen.print(made)
    screen.print("Why the published figures and the evaluator's differ:")
    for reason in reproduction.WHY_THEY_DIFFER:
        screen.print(f"- {reason}")


def _results(rows: "list[Reproduction]", style: dict[str, Any]) -> "Table":
    made = table(
        "robot", "quantity", ">published", ">again", ">measured", ">evaluator", "meaning", title="Published results",
        **style,
    )  # fmt: skip
    for row in rows:
        there, here, jump = row.published.simulated, row.again, row.jump
        measured = asdict(row.published.measured) if row.published.measured else {}
        built = {name: f"{value:g}" for name, value in measured.items()}
        length = ("length m", f"{there.distance_m:g}", f"{here.distance_m:.4f}", built.get("distance_m"))
        height = ("height m", f"{there.base_height_m:g}", f"{here.base_height_m:.4f}", built.get("height_m"))
        energy = ("energy J", f"{there.energy_j:g}", f"{here.energy_j:.4f}", built.get("electrical_energy_j"))
        made.add_row(row.published.title, *length, _shown(jump.ballistic_range_m), "ballistic")
        made.add_row("", "", "", "", "", _shown(jump.touchdown_distance_m), "touchdown")
        made.add_row("", *height, _shown(jump.com_rise_m), "rise")
        made.add_row("", *energy, _shown(jump.spring_energy_j), "stored")
        made.add_row("", "share", "", "", "", _shown(jump.takeoff_energy_ratio), "take-off", end_section=True)
    return made


def _shown(value: float | None) -> str:
    return "none" if value is None else f"{value:.4f}"


def validate(
    figure: Annotated[
        Texts, option("A figure that you read in its paper, ROBOT.NAME=VALUE; may be repeated.", "FIGURE")
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
    data = {"seed": seed, "entered": entered, "robots": robots}
    answer(as_json, data, print_text, "validate", tiers=TIERS, robots=robots)


def _entered(text: str) -> tuple[str, float]:
    key, _, value = text.partition("=")
    try:
        return key, float(value)
    except ValueError:
        raise JumpcadError(f"--figure {text}: give ROBOT.NAME=VALUE, as kovac-2008.spring_energy_j=0.154") from None
