"""What each of the eight parameters is worth alone, at equal mass: `python benchmarks/parameters.py [DESIGN]`.

One changes by 10 %, or goes through its search bounds, while the others stay. Robots are built and checked; those with
violated limits do not count. A ballast in the body's centre of mass, or the lack of one, gives each the first's mass.
"""

import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from jumpcad.building import build
from jumpcad.checks import quick_findings
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.model import BODY
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate

VALUES = 9
"""Values of each parameter, its bounds among them."""


def range_mm(robot: Robot, mass_kg: float) -> float:
    """Return the range of a robot (mm) that a ballast brings to a mass; 0 if it does not jump."""
    body = robot.bodies[BODY]
    heavier = replace(body, mass_kg=body.mass_kg + mass_kg - robot.mass_kg)
    robot = replace(robot, bodies={**robot.bodies, BODY: heavier})
    return 1000.0 * (simulate(robot, Settings(), "planar").ballistic_range_m or 0.0)


def alone(design: Design, key: str, values: Iterable[float], mass_kg: float) -> Iterator[tuple[float, float]]:
    """Yield the range (mm) for each value of a parameter with which a robot keeps its limits, and the value."""
    for value in values:
        try:
            robot = build(Design(**design.model_dump() | {key: float(value)}))
        except JumpcadError:  # allowed are other values, or it has no room
            continue
        if not errors(quick_findings(robot)):
            yield range_mm(robot, mass_kg), float(value)


def table(name: str = "kenan-2.0") -> str:
    """Return a table: each parameter, the better of 10 % more and less, its best value alone, the best first."""
    design, robot = load_design(name), build(load_design(name))
    first, rows = range_mm(robot, robot.mass_kg), []
    for key, bounds in SEARCH_BOUNDS.items():
        value = getattr(design, key)
        near = max(alone(design, key, (0.9 * value, 1.1 * value), robot.mass_kg), default=(first, value))
        through = alone(design, key, np.linspace(bounds.lower, bounds.upper, VALUES), robot.mass_kg)
        far, at = max((first, value), near, *through)
        words = f"{near[0]:.0f} mm | {at:.3g} | {far:.0f} mm | {far / first:.2f}"
        rows.append((far, f"| `{key} = {value:.3g}` | {words} |"))
    head = f"| parameter of {name} | 10 % more or less | best alone | range there | times {first:.0f} mm |"
    return "\n".join([head, "|---|--:|--:|--:|--:|", *(row for _, row in sorted(rows, reverse=True))])


if __name__ == "__main__":
    print(table(*sys.argv[1:2]))
