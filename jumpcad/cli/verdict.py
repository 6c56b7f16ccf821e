"""What is said first of a robot: how far it jumps or why not, its limits, and what became of it by itself."""

import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jumpcad.findings import Finding
    from jumpcad.robot.robot import Robot
    from jumpcad.strength.growth import Grown


def jump_in_words(jump: dict[str, Any], made_m: float | None = None) -> str:
    """Return touchdown, also in the median of robots as made, rise and mass of a jump, or why there is none."""
    if jump["verdict"] == "jump":
        made = f" ({1000.0 * made_m:.0f} as made, in the median)" if made_m else ""
        return (
            f"jumps {1000.0 * (jump.get('touchdown_distance_m') or jump['ballistic_range_m']):.0f} mm far{made} and "
            f"{1000.0 * jump['com_rise_m']:.0f} mm high with {1000.0 * jump['mass_kg']:.1f} g"
        )
    why = [
        f": {finding['message']}; {finding['remedy']}" for finding in jump["findings"] if finding["severity"] == "error"
    ]
    return f"does not jump ({jump['verdict']}){''.join(why[:1])}"


def warn_of_no_jump(robot: "Robot") -> None:
    """Print on standard error why a robot does not jump, if so."""
    from jumpcad.simulation import headline

    jump = headline(robot)
    if jump.verdict != "jump":
        print(f"jumpcad: {robot.name} {jump_in_words(jump.to_dict())}", file=sys.stderr)


def notes(robot: "Robot", findings: "Sequence[Finding]") -> Iterator[str]:
    """Yield what became of a robot by itself: sections that grew, and what bought springs do to its stiffness."""
    if asked := [f"strength.{part} = {more:g}" for part, more in robot.workshop.strength if more != 1.0]:
        yield f"{', '.join(asked)}: {_cost(robot)}"
    if robot.grown:
        yield grown_in_words(robot.grown)
    yield from (finding.message for finding in findings if finding.is_note)


def _cost(robot: "Robot") -> str:
    """Return what the strength that was asked for costs in mass and distance."""
    from jumpcad.building import build
    from jumpcad.simulation import headline
    from jumpcad.workshop import varied

    plain = {f"strength.{part}": 1.0 for part, _ in robot.workshop.strength}
    before = build(robot.design, varied(robot.workshop, plain), robot.name)
    far = [1000.0 * (headline(one).touchdown_distance_m or 0.0) for one in (robot, before)]
    return f"{1000.0 * (robot.mass_kg - before.mass_kg):+.1f} g and {far[0] - far[1]:+.0f} mm of touchdown"


def grown_in_words(grown: "Sequence[Grown]") -> str:
    """Return which sections grew, by how much and for which limit."""
    most = max((one.use for one in grown if one.use is not None), default=None)
    load = "" if most is None else f" to carry {most:.1f} times the load of their first sizing"
    each = ", ".join(f"{one.what} by {100.0 * (one.factor - 1.0):.0f} % ({one.limit})" for one in grown)
    return f"sections grew{load}: {each}"
