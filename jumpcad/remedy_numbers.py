"""Numbers for remedies, found by trying; what a step beyond a limit would give. Words of remedies: `findings`."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linprog

from jumpcad.building import built_and_checked
from jumpcad.checks import CHECKS, Check
from jumpcad.checks.assembly import assembly_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.checks.printability import printability_findings
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, limits_of
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.findings import Change, Finding, Remedy, least
from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.variants import LIMITS
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation.planar import touchdown
from jumpcad.simulation.simulator import divided
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop
from jumpcad.workshop.tables import PRELOAD_MAX_DEG
from jumpcad.workshop.varied import varied, workshop_value

TRIES, CAGED_TRIES = 8, 5
"""Designs that are built and simulated for the numbers of one robot, a second of work; a cage doubles that of each. One
that cannot be built takes little time, and does not count."""
STEPS, NEAR = 4, 0.9
"""Values of one parameter that are tried for one limit, and once one cures, as many nearer ones; share of the change
that cures from which on a smaller one is not sought."""
FIRST, BEYOND = 0.125, 1.1
"""The first step as a share of the way to the end of a parameter's range; how much longer than guessed others are."""
SLOW = (printability_findings, interference_findings, assembly_findings)
"""Checks that take about a second: no number is sought for their limits."""
FAILS = "cannot be built"
STEP, REACH, MORE = 0.01, 0.05, 0.05
"""Relative steps of each number, of the robots that are built and at most; what a limit gives more."""
ALL = f"{MORE:.0%} more of all limits"
TIGHT, STEEP, LEAST_MM, ROWS = 0.9, 0.5, 0.5, 5
"""Least use of a limit that may end a design; least change of it over the relative change of a number: one that the
eight numbers hardly move is one that parts are sized for, which costs grams, not range; least gain that is told; limits
that are told. Judgement."""


class Remedies:
    """Numbers for the remedies of a design's robot in a workshop, by at most `TRIES` evaluations in all."""

    def __init__(self, design: Design, workshop: Workshop) -> None:
        self._design, self._workshop = design, workshop
        self._left = CAGED_TRIES if workshop.cage.rod else TRIES
        self._tried: dict[tuple[str, float], tuple[frozenset[str], dict[str, float]]] = {}
        self._costly: tuple[Check, ...] = ()

    def of_findings(self, findings: Sequence[Finding]) -> list[Finding]:
        """Return findings; the remedies of violated limits have a number where one is found.

        What the change for an earlier one cures has that as its remedy. Limits of `SLOW` checks keep theirs.
        """
        slow = {name for check in CHECKS if check.find in SLOW for name in check.basis}
        wrong = frozenset(one.name for one in findings if one.severity != "info") - slow
        self._costly = tuple(one for one in CHECKS if not one.cheap and wrong & one.basis.keys())
        cured: dict[str, Remedy] = {}
        numbered = []
        for one in findings:
            ways = cured.get(one.name, one.ways)
            if one.name in wrong and one.name not in cured:
                ways, gone = self._numbered(one.ways, one.name, one.margin, wrong)
                cured |= dict.fromkeys(gone - cured.keys(), f"the change for {one.name} is enough")
            numbered.append(replace(one, ways=ways))
        return numbered

    def of_refusal(self, refusal: CannotBuildError) -> CannotBuildError:
        """Return why a design cannot be built, its remedy with a number where one is found."""
        ways, _ = self._numbered(refusal.ways, FAILS, _margin(refusal), frozenset([FAILS]))
        return CannotBuildError(refusal.what, refusal.limit, refusal.margin, refusal.unit, ways)

    def _numbered(
        self, remedy: Remedy, name: str, margin: float, wrong: frozenset[str]
    ) -> tuple[Remedy, frozenset[str]]:
        """Return a remedy, that with a number first where one is found, and the limits that it cures."""
        ways = () if isinstance(remedy, str) else remedy
        changes = [one for one in ways if isinstance(one, Change) and one.direction is not None]
        for one in sorted(changes, key=self._is_inside):
            value = self._cure(one.key, one.direction or 0, (name, margin), wrong)
            if value is not None:
                others = (other for other in ways if other != one)
                return (replace(one, value=value), *others), wrong - self._tried[one.key, value][0]
        return remedy, frozenset()

    def _is_inside(self, change: Change) -> bool:
        """Whether a parameter lies in its usual range: one at an end from which it is to move, or beyond, is first."""
        if change.key not in PARAMETERS or not change.direction:
            return True
        bounds, now = SEARCH_BOUNDS[change.key], getattr(self._design, change.key)
        return bool(now > bounds.lower if change.direction > 0 else now < bounds.upper)

    def _cure(self, key: str, direction: int, fails: tuple[str, float], wrong: frozenset[str]) -> float | None:
        """Return a value of a parameter with which a limit is kept, and all that were kept before.

        `fails` is the limit's name and margin. The next value lies a little beyond where a line through the margins at
        the last two is 0; once one cures, nearer ones are tried.
        """
        try:
            now = getattr(self._design, key) if key in PARAMETERS else workshop_value(self._workshop, key)
        except JumpcadError:
            return None
        if isinstance(now, str):
            return None
        end, (name, margin) = _end(key, float(now), direction), fails
        best, at, last, share = None, math.inf, (0.0, margin), FIRST
        for step in range(2 * STEPS):
            value = float(f"{now + share * (end - now):.3g}")
            if (best is None and step == STEPS) or not self._try(key, value):
                break
            violated, margins = self._tried[key, value]
            here = share, margins.get(name, math.nan)
            if name not in violated and violated <= wrong:
                best, at = value, share
                share = _beyond_zero(last, here, (last[0] + share) / 2.0)
            elif best is not None:
                last, share = here, (share + at) / 2.0
            elif share < 1.0:
                farther = _beyond_zero(last, here, 3.0 * share) if name in violated else 2.0 * share
                last, share = here, min(max(farther, 1.5 * share), 1.0)
            else:
                break
            if share > NEAR * at:
                break
        return best

    def _try(self, key: str, value: float) -> bool:
        """Tell whether a value has been tried, now or before; not if too many have been."""
        if (key, value) not in self._tried:
            if self._left == 0:
                return False
            self._tried[key, value] = self._found(key, value)
            self._left -= FAILS not in self._tried[key, value][0]
        return True

    def _found(self, key: str, value: float) -> tuple[frozenset[str], dict[str, float]]:
        """Return the names of the limits that are violated with another value, or `FAILS`, and margins of limits."""
        try:
            if key in PARAMETERS:
                result = evaluate(Design(**self._design.model_dump() | {key: value}), self._workshop)
            else:
                result = evaluate(self._design, varied(self._workshop, {key: value}))
            found = [*result.findings, *(one for check in self._costly for one in check.find(result.robot))]
        except CannotBuildError as refusal:
            return frozenset([FAILS]), {FAILS: _margin(refusal)}
        except JumpcadError:
            return frozenset([FAILS]), {}
        margins = {name: one.margin for name, one in least(found).items()}
        return frozenset(one.name for one in found if one.severity != "info"), margins


def _margin(refusal: CannotBuildError) -> float:
    return math.nan if refusal.margin is None else refusal.margin


def _beyond_zero(last: tuple[float, float], here: tuple[float, float], otherwise: float) -> float:
    """Return a share of a way a little beyond that where a line through two (share, margin) is 0.

    `otherwise` if the first margin is kept, if margins do not grow, or if one is not known.
    """
    (start, low), (share, high) = last, here
    return start + BEYOND * (share - start) * low / (low - high) if high > low < 0.0 else otherwise


def _end(key: str, now: float, direction: int) -> float:
    """Return the end of what is tried: that of searches, of the parameter beyond; else twice, half or 1, 20 from 0."""
    if key not in PARAMETERS:
        if key == "spring.preload_deg" and direction > 0:
            return PRELOAD_MAX_DEG
        return now * (2.0 if direction > 0 else 0.5) or 20.0 * (direction > 0)
    if direction == 0:
        return 1.0
    bounds, side = SEARCH_BOUNDS[key], int(direction > 0)
    usual = (bounds.lower, bounds.upper)[side]
    return usual if direction * (usual - now) > 0.0 else limits_of(key)[side]


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

    Sixteen robots, built on both sides of each of the eight numbers, their parts laid out and sized anew, give the
    gradients of the touchdown, by the planar engine, and of the limits' uses. A linear programme then finds the best
    change of the numbers that keeps all limits. Its gain with one limit relaxed, less that with none, is what this
    limit costs, its shadow price (e.g. Nocedal and Wright, Numerical Optimization, ch. 12). Where much is gained within
    all limits, a search would gain more. No steps without a jump.
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
