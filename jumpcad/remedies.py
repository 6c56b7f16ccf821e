"""Remedies with numbers: values of parameters that cure what fails, found by trying."""

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from jumpcad.checks import CHECKS, Check
from jumpcad.checks.assembly import assembly_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.checks.printability import printability_findings
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, limits_of
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.findings import Finding, least
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
VERBS = {"lower": -1, "shorten": -1, "raise": 1, "lengthen": 1, "bring": 0}
NEARER = " nearer to 1"
DIRECTIONS = VERBS | {"a lower": -1, "smaller": -1, "shorter": -1, "less": -1, "larger": 1, "longer": 1, "more": 1}
KEY = rf"(?:[a-z]+\.[a-z_]+|{'|'.join(PARAMETERS)})"
KEYS = re.compile(rf"\b{KEY}(?:(?:, | or ){KEY})*\b")
WORD = re.compile(rf"\b(?:({'|'.join(reversed(DIRECTIONS))})|({KEY}))\b")


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
        cured: dict[str, str] = {}
        numbered = []
        for one in findings:
            remedy = cured.get(one.name) or one.remedy
            if one.name in wrong and one.name not in cured:
                remedy, gone = self._numbered(one.remedy, one.name, one.margin, wrong)
                cured |= dict.fromkeys(gone - cured.keys(), f"the change for {one.name} is enough")
            numbered.append(replace(one, remedy=remedy))
        return numbered

    def of_refusal(self, refusal: CannotBuildError) -> CannotBuildError:
        """Return why a design cannot be built, its remedy with a number where one is found."""
        what, colon, remedy = str(refusal).rpartition(": ")
        numbered, _ = self._numbered(remedy, FAILS, _margin(refusal), frozenset([FAILS]))
        return CannotBuildError(what + colon + numbered, refusal.limit, refusal.margin, refusal.unit)

    def _numbered(self, remedy: str, name: str, margin: float, wrong: frozenset[str]) -> tuple[str, frozenset[str]]:
        """Return a remedy, with a number where one is found, and the limits that it cures."""
        for word, key in sorted(asked(remedy), key=lambda one: not self._is_far(*one)):
            value = self._cure(key, DIRECTIONS[word], (name, margin), wrong)
            if value is not None:
                said = f"{key} {'to' if word in VERBS else '='} {value:g}"
                return told_first(remedy, key, said), wrong - self._tried[key, value][0]
        return remedy, frozenset()

    def _is_far(self, word: str, key: str) -> bool:
        """Whether a parameter lies at the end of its usual range, or beyond, from which it is to move: it is first."""
        if key not in PARAMETERS or not (direction := DIRECTIONS[word]):
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


def asked(remedy: str) -> Iterator[tuple[str, str]]:
    """Yield the word of `DIRECTIONS` and the name of each parameter that a remedy asks to change."""
    last = ""
    for word, key in WORD.findall(remedy):
        last = word or last
        if key and last:
            yield last, key


def told_first(remedy: str, key: str, said: str) -> str:
    """Return a remedy that says a parameter's number before the other parameters in a row, which have none."""
    for row in KEYS.finditer(remedy):
        if key in (names := re.split(", | or ", row[0])):
            others = [name for name in names if name != key]
            return remedy[: row.start()] + " or ".join([said, *others]) + remedy[row.end() :].removeprefix(NEARER)
    return remedy


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
