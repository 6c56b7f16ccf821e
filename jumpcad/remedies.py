"""Remedies with numbers: values of parameters that cure what fails, found by trying."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from jumpcad.checks import CHECKS, Check
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, limits_of
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.findings import Finding
from jumpcad.workshop import Workshop
from jumpcad.workshop.varied import varied, workshop_value

TRIES = 10
"""Designs that are built and simulated for the numbers of one robot, a second of work; judgement."""
SHARES, HALVINGS = (0.125, 0.3, 1.0), 2
"""Steps towards the end of a parameter's range until one cures, and halvings of the last step."""
FAILS = "cannot be built"
DIRECTIONS = {"lower": -1, "smaller": -1, "shorter": -1, "shorten": -1, "less": -1, "raise": 1, "larger": 1,
              "longer": 1, "lengthen": 1, "more": 1}  # fmt: skip
WORD = re.compile(rf"\b(?:({'|'.join(DIRECTIONS)})|([a-z]+\.[a-z_]+|{'|'.join(PARAMETERS)}))\b")


class Remedies:
    """Numbers for the remedies of a design's robot in a workshop, by at most `TRIES` evaluations in all."""

    def __init__(self, design: Design, workshop: Workshop) -> None:
        self._design, self._workshop, self._left = design, workshop, TRIES
        self._tried: dict[tuple[str, float], frozenset[str]] = {}
        self._costly: tuple[Check, ...] = ()

    def of_findings(self, findings: Iterable[Finding]) -> list[Finding]:
        """Return findings; the remedies of violated limits have a number where one is found.

        What the change for an earlier one cures has that as its remedy.
        """
        findings = list(findings)
        wrong = frozenset(one.name for one in findings if one.severity != "info")
        self._costly = tuple(one for one in CHECKS if not one.cheap and wrong & one.basis.keys())
        cured: dict[str, str] = {}
        numbered = []
        for one in findings:
            remedy = cured.get(one.name) or one.remedy
            if one.name in wrong and one.name not in cured:
                remedy, gone = self._numbered(one.remedy, one.name, wrong)
                cured |= dict.fromkeys(gone - cured.keys(), f"the change for {one.name} is enough")
            numbered.append(replace(one, remedy=remedy))
        return numbered

    def of_refusal(self, refusal: CannotBuildError) -> CannotBuildError:
        """Return why a design cannot be built, its remedy with a number where one is found."""
        what, colon, remedy = str(refusal).rpartition(": ")
        text = what + colon + self._numbered(remedy, FAILS, frozenset([FAILS]))[0]
        return CannotBuildError(text, refusal.limit, refusal.margin, refusal.unit)

    def _numbered(self, remedy: str, name: str, wrong: frozenset[str]) -> tuple[str, frozenset[str]]:
        """Return a remedy, with a number where one is found, and the limits that it cures."""
        for key, direction in asked(remedy):
            value = self._cure(key, direction, name, wrong)
            if value is not None:
                return remedy.replace(key, f"{key} to {value:g}", 1), wrong - self._tried[key, value]
        return remedy, frozenset()

    def _cure(self, key: str, direction: int, name: str, wrong: frozenset[str]) -> float | None:
        """Return a value of a parameter with which a limit is kept, and all that were kept before."""
        try:
            now = getattr(self._design, key) if key in PARAMETERS else workshop_value(self._workshop, key)
        except JumpcadError:
            return None
        if isinstance(now, str):
            return None
        end = _end(key, float(now), direction)
        worse = float(now)
        for share in SHARES:
            better = float(f"{now + share * (end - now):.3g}")
            if self._cures(key, better, name, wrong):
                break
            worse = better
        else:
            return None
        for _ in range(HALVINGS):
            value = float(f"{(worse + better) / 2.0:.3g}")
            if self._cures(key, value, name, wrong):
                better = value
            else:
                worse = value
        return better

    def _cures(self, key: str, value: float, name: str, wrong: frozenset[str]) -> bool:
        if (key, value) not in self._tried:
            if self._left == 0:
                return False
            self._left -= 1
            self._tried[key, value] = self._wrong(key, value)
        found = self._tried[key, value]
        return name not in found and found <= wrong

    def _wrong(self, key: str, value: float) -> frozenset[str]:
        """Return the names of the limits that are violated with another value, or `FAILS`."""
        try:
            design, workshop = self._design, self._workshop
            if key in PARAMETERS:
                design = Design(**design.model_dump() | {key: value})
            else:
                workshop = varied(workshop, {key: value})
            result = evaluate(design, workshop)
        except JumpcadError:
            return frozenset([FAILS])
        found = [*result.findings, *(one for check in self._costly for one in check.find(result.robot))]
        return frozenset(one.name for one in found if one.severity != "info")


def asked(remedy: str) -> Iterator[tuple[str, int]]:
    """Yield the parameters that a remedy names, with the direction (-1, 1) in which each is to be changed."""
    direction = 0
    for word, key in WORD.findall(remedy):
        direction = DIRECTIONS.get(word, direction)
        if key and direction:
            yield key, direction


def _end(key: str, now: float, direction: int) -> float:
    """Return the end of what is tried: that of searches, of the parameter beyond these; twice or half elsewhere."""
    if key not in PARAMETERS:
        return now * (2.0 if direction > 0 else 0.5)
    bounds, side = SEARCH_BOUNDS[key], int(direction > 0)
    usual = (bounds.lower, bounds.upper)[side]
    return usual if direction * (usual - now) > 0.0 else limits_of(key)[side]
