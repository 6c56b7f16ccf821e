"""`jumpcad cage`: the lightest cage that rights a robot, as a workshop file."""

from typing import Annotated

import typer

from jumpcad.cli.output import JsonFlag, print_json, status
from jumpcad.cli.subjects import WorkshopOption, completion, note_template


def cage(
    design: Annotated[
        str,
        typer.Argument(
            help="A template's name or a design file.", metavar="DESIGN", autocompletion=completion("robots")
        ),
    ],
    workshop: WorkshopOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Find the lightest cage that rights a robot; print a workshop file with it.

    Sizes are searched by stable poses. The lightest is then dropped 50 times
    and lands 50 times in MuJoCo, and must stand up. A minute or two.
    """
    from jumpcad.design import load_design
    from jumpcad.files import to_toml
    from jumpcad.landing.lightest_cage import TRIES, lightest_cage
    from jumpcad.scene.stable_poses import least_share_on_feet, share_on_feet
    from jumpcad.workshop import load_workshop, own_workshop

    note_template(design)
    base = workshop or own_workshop(design)
    with status(f"trying cages for {design} …"):
        robot, landed = lightest_cage(load_design(design), load_workshop(base), TRIES)
    sizes, share, least = robot.workshop.cage.model_dump(), share_on_feet(robot), least_share_on_feet(robot)
    drops, landings = landed.drops_righted, landed.share_righted
    if as_json:
        figures = {"share": share, "least_share": least, "drops": drops, "landings": landings}
        print_json({"design": design, "workshop": base, "mass_kg": robot.mass_kg, **figures, "cage": sizes})
        return
    print(
        f"# {design} with it: {1000.0 * robot.mass_kg:.1f} g; on its feet in {100.0 * share:.0f} % of stable poses, "
        f"{100.0 * least:.0f} % with its centre of mass elsewhere;\n"
        f"# stands after {drops * TRIES:.0f} of {TRIES} drops and {landings * TRIES:.0f} of {TRIES} own landings"
    )
    print(to_toml({"base": base, "cage": sizes}), end="")
