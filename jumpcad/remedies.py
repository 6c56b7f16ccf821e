"""Remedies with numbers: values of parameters that cure what fails, found by trying."""

import math
from collections.abc import Iterable
from dataclasses import replace

from jumpcad.checks import CHECKS, Check
from jumpcad.checks.assembly import assembly_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.checks.printability import printability_findings
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, limits_of
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.findings import Change, Finding, Remedy, least
from jumpcad.workshop import Workshop
from jumpcad.workshop.tables import PRELOAD_MAX_DEG
from jumpcad.workshop.varied import varied, workshop_value

TRIES, CAGED_TRIES = 8, 5
"""Designs that are built and simulated for the numbers of one robot, a second of work; a cage doubles that of each.

One that cannot be built takes little time, and does not count.
"""
STEPS = 4
"""Values of one parameter that are tried for one limit; once one cures, as many nearer ones."""
NEAR = 0.9
"""Share of the change that cures from which on a smaller one is not sought."""
FIRST, BEYOND = 0.125, 1.1
"""The first step as a share of the way to the end of a parameter's range; how much longer than guessed others are."""
SLOW = (printability_findings, interference_findings, assembly_findings)
"""Checks that take about a second: no number is sought for their limits."""
FAILS = "cannot be built"


class Remedies:
    """Numbers for the remedies of a design's robot in a workshop, by at most `TRIES` evaluations in all."""

    def __init__(self, design: Design, workshop: Workshop) -> None:
        self._design, self._workshop = design, workshop
        self._left = CAGED_TRIES if workshop.cage.rod else TRIES
        self._tried: dict[tuple[str, float], tuple[frozenset[str], dict[str, float]]] = {}
        self._costly: tuple[Check, ...] = ()

    def of_findings(self, findings: Iterable[Finding]) -> list[Finding]:
        """Return findings; the remedies of violated limits have a number where one is found.

        What the change for an earlier one cures has that as its remedy. Limits of `SLOW` checks keep theirs.
        """
        findings = list(findings)
        slow = {name for check in CHECKS if check.find in SLOW for name in check.basis}
        wrong = frozenset(one.name for one in findings if one.severity != "info") - slow
        self._costly = tuple(
            one for one in CHECKS if not one.cheap and one.find not in SLOW and wrong & one.basis.keys()
        )
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
        for one in sorted(changes, key=lambda one: not self._is_far(one.key, one.direction or 0)):
            value = self._cure(one.key, one.direction or 0, (name, margin), wrong)
            if value is not None:
                others = (other for other in ways if other != one)
                return (replace(one, value=value), *others), wrong - self._tried[one.key, value][0]
        return remedy, frozenset()

    def _is_far(self, key: str, direction: int) -> bool:
        """Whether a parameter lies at the end of its usual range, or beyond, from which it is to move: it is first."""
        if key not in PARAMETERS or not direction:
            return False
        bounds, now = SEARCH_BOUNDS[key], getattr(self._design, key)
        return bool(now <= bounds.lower if direction > 0 else now >= bounds.upper)

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
            design, workshop = self._design, self._workshop
            if key in PARAMETERS:
                design = Design(**design.model_dump() | {key: value})
            else:
                workshop = varied(workshop, {key: value})
            result = evaluate(design, workshop)
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
