"""What limits a design: the range that the next step beyond each of its limits would give.

At the best design the gradient of the touchdown is a sum, with factors ≥ 0, of the gradients of the limits' uses; each
factor is the limit's shadow price, Lagrange's multiplier (e.g. Nocedal and Wright, Numerical Optimization, ch. 12). It
is found by non-negative least squares from robots that are built on both sides of each of the eight numbers.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import nnls

from jumpcad.building import built_and_checked
from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.mechanism.model import BODY
from jumpcad.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation.planar import touchdown
from jumpcad.simulation.simulator import divided
from jumpcad.transforms import Array

STEP, MORE = 0.01, 0.05
"""Relative step of each number to either side; what a limit gives more."""
TIGHT, STEEP, AT_LIMITS, ROWS = 0.93, 0.5, 0.8, 5
"""Least use of a limit that may end a design; least change of it over the relative change of a number; least share of
the gradient at limits; limits shown. Judgement.

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
        more = f"{self.limit} ({self.used:.0%} used), {MORE:.0%} more"
        return f"{more}: {self.gain_mm:+.1f} mm, {self.number} {100.0 * self.change:+.1f} %"


def next_steps(robot: Robot, findings: Sequence[Finding]) -> tuple[list[NextStep], float]:
    """Return at most `ROWS` steps, the most worth first, then a gram; and the explained share of the gradient.

    Parts are laid out and sized anew for each of the sixteen robots; the planar engine computes their jumps. Where
    little is explained, the design is not at its limits, and a search would gain more. No steps without a jump.
    """
    uses = {one.name: one.use for one in reversed(findings) if one.use and one.use >= TIGHT and not one.grows}
    here, vector = np.array([_way_m(robot), *uses.values()]), np.array(robot.design.to_vector())
    moves = STEP * np.diag(vector) if here[0] else []
    sides = [[_figures(vector + sign * move, robot, list(uses)) for sign in (1.0, -1.0)] for move in moves]
    rates = np.array([_rate(here, up, down) for up, down in sides]).T
    if not rates.size or not rates[0].any():  # it does not jump, or no other can be built
        return [], 0.0
    steep = np.flatnonzero(np.abs(rates[1:]).max(axis=1, initial=0.0) > STEEP)
    limits, goal = rates[1:][steep].T, rates[0]
    price, missed = nnls(limits, goal) if len(steep) else (np.zeros(0), float(np.linalg.norm(goal)))
    paid = np.flatnonzero(price > 0.0)
    ways = MORE * np.linalg.pinv(limits[:, paid].T)
    names = [list(uses)[index] for index in steep[paid]]
    found = []
    for name, worth, way in zip(names, price[paid], ways.T, strict=True):
        most = int(np.argmax(np.abs(way)))
        gain_mm = 1000.0 * MORE * float(worth)
        found.append(NextStep(name, uses[name] or 0.0, gain_mm, PARAMETERS[most], float(way[most])))
    body = robot.bodies[BODY]
    light_kg, share = body.mass_kg - 0.001, 1.0 - 0.001 / body.mass_kg
    light = replace(body, mass_kg=light_kg, inertia_kg_m2=share * body.inertia_kg_m2)
    lighter = replace(robot, bodies={**robot.bodies, BODY: light})
    gram = NextStep("", 0.0, 1000.0 * (_way_m(lighter) - float(here[0])))
    return [*sorted(found, key=lambda one: -one.gain_mm)[:ROWS], gram], 1.0 - missed**2 / float(goal @ goal)


def steps_in_words(steps: Sequence[NextStep], explained: float) -> list[str]:
    """Return what is said of the next steps, and whether the design lies at its limits."""
    if not steps:
        return []
    end = "" if explained >= AT_LIMITS else ": it does not lie at its limits, a search would gain more"
    return ["next step, farther to the touchdown:", *map(str, steps), f"these limits hold {explained:.0%} of it{end}"]


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
