"""What limits a design: the range that the next step beyond each of its limits would give.

Sixteen robots, built on both sides of each of the eight numbers, give the gradients of the touchdown and of the limits'
uses. A linear programme then finds the best change of the numbers that keeps all limits. Its gain with one limit
relaxed, less that with none, is what this limit costs, its shadow price (e.g. Nocedal and Wright, Numerical
Optimization, ch. 12).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linprog

from jumpcad.building import built_and_checked
from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.variants import LIMITS
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation.planar import touchdown
from jumpcad.simulation.simulator import divided
from jumpcad.transforms import Array

STEP, REACH, MORE = 0.01, 0.05, 0.05
"""Relative steps of each number, of the robots that are built and at most; what a limit gives more."""
ALL = f"{MORE:.0%} more of all limits"
TIGHT, STEEP, LEAST_MM, ROWS = 0.9, 0.5, 0.5, 5
"""Least use of a limit that may end a design; least change of it over the relative change of a number; least gain that
is told; limits that are told. Judgement.

A limit that the eight numbers hardly move is one that parts are sized for: it costs grams, not range.
"""


@dataclass(frozen=True)
class NextStep:
    """The range gained (mm), to first order, if a limit gave `MORE`, and how the number that moves most would change.

    `used` is the share of the limit that is used. Of a gram less of the body limit and number are empty.
    """

    limit: str
    used: float
    gain_mm: float
    number: str = ""
    change: float = 0.0

    def __str__(self) -> str:
        if not self.limit:
            return f"a gram less of the body: {self.gain_mm:+.1f} mm"
        more = self.limit if self.limit == ALL else f"{self.limit} ({self.used:.0%} used), {MORE:.0%} more"
        return f"{more}: {self.gain_mm:+.1f} mm, {self.number} {100.0 * self.change:+.1f} %"


def next_steps(robot: Robot, findings: Sequence[Finding]) -> tuple[list[NextStep], float]:
    """Return at most `ROWS` steps, the most worth first, then a gram; and the gain within all limits (mm).

    Parts are laid out and sized anew for each of the sixteen robots; the planar engine computes their jumps. Where
    much is gained within all limits, a search would gain more. No steps without a jump.
    """
    uses = {one.name: one.use for one in reversed(findings) if one.use and one.use >= TIGHT and not one.grows}
    here, vector = np.array([_way_m(robot), *uses.values()]), np.array(robot.design.to_vector())
    moves: Array = STEP * np.diag(vector)
    sides = [[_figures(vector + sign * move, robot, list(uses)) for sign in (1.0, -1.0)] for move in moves if here[0]]
    rates = np.array([_rate(here, up, down) for up, down in sides]).T
    if not rates.size or not rates[0].any():  # it does not jump, or no other can be built
        return [], 0.0
    steep = np.flatnonzero(np.abs(rates[1:]).max(axis=1, initial=0.0) > STEEP)
    ends = np.clip(LIMITS / vector - 1.0, -REACH, REACH).T

    def best(more: Array) -> Array:
        """Return the relative changes of the numbers that gain most."""
        left = np.maximum(1.0 - here[1:][steep], 0.0) + more
        return np.asarray(linprog(-rates[0], rates[1:][steep], left, bounds=ends).x)

    usual, found = best(np.zeros(len(steep))), []
    for row, name in enumerate([*np.array(list(uses))[steep].tolist(), ALL]):
        change = best(MORE * np.append(np.eye(len(steep)), np.ones((1, len(steep))), axis=0)[row]) - usual
        most, gain_mm = int(np.argmax(np.abs(change))), 1000.0 * float(rates[0] @ change)
        found.append(NextStep(name, uses.get(name) or 1.0, gain_mm, PARAMETERS[most], float(change[most])))
    body = robot.bodies[BODY]
    light_kg, share = body.mass_kg - 0.001, 1.0 - 0.001 / body.mass_kg
    light = replace(body, mass_kg=light_kg, inertia_kg_m2=share * body.inertia_kg_m2)
    lighter = replace(robot, bodies={**robot.bodies, BODY: light})
    gram = NextStep("", 0.0, 1000.0 * (_way_m(lighter) - float(here[0])))
    worth = sorted((one for one in found if one.gain_mm > LEAST_MM), key=lambda one: -one.gain_mm)
    return [*worth[:ROWS], gram], 1000.0 * float(rates[0] @ usual)


def steps_in_words(steps: Sequence[NextStep], usual_mm: float) -> list[str]:
    """Return what is said of the next steps."""
    within = f"within the limits, {REACH:.0%} of each number may gain {usual_mm:.0f} mm"
    return ["next step, farther to the touchdown:", *map(str, steps), within] if steps else []


def _way_m(robot: Robot) -> float:
    """Return the way to the touchdown; 0 without a jump."""
    return (touchdown(robot, divided(robot, Settings())) or (0.0, 0.0))[0]


def _figures(vector: Array, like: Robot, names: Sequence[str]) -> Array | None:
    """Return touchdown and uses of another robot of the workshop; None where it cannot be built, or does not jump."""
    try:
        robot, findings = built_and_checked(Design.from_vector(vector.tolist()), like.workshop, name="")
    except JumpcadError:
        return None
    uses = {name: max((one.use or 0.0 for one in findings if one.name == name), default=0.0) for name in names}
    way = _way_m(robot)
    return np.array([way, *uses.values()]) if way else None


def _rate(here: Array, up: Array | None, down: Array | None) -> Array:
    """Return the change of figures over the relative change of a number, from the sides that there are."""
    sides = (up is not None) + (down is not None)
    return ((here if up is None else up) - (here if down is None else down)) / (STEP * max(sides, 1))
