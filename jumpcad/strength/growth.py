"""How sections grow that a check of the built robot finds too weak."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from jumpcad.findings import Finding
from jumpcad.workshop import Workshop

STEP, LEAP, MORE = 1.1, 1.5, 1.002
"""Largest factor by which a section grows where it is not known what growing helps, and where it is, and factor beyond
what it lacks; judgement: few rounds, little mass more than needed, and designs that differ a little stay robots that
differ a little."""
POWERS = {"release_kick": 0.65, "stop_leg": 1.45, "stop_strength": 1.75}
"""Powers of what grows by which the uses of limits fall, by the findings' names: in 15 robots 0.64 to 0.82, and in 7
1.47 to 1.61 and 1.79 to 1.91 (measured); nearly the least, so that one round is mostly enough."""
LEAST_POWER = 0.5
"""Least power of a section by which a use is taken to fall; judgement: stresses fall with the first to the third power,
and nothing that was measured falls less than the release's kick. What falls less is held by another size too, which a
leap would pass."""


OF_PARTS = {
    "main_leg": ("leg", "lever"), "front_link": ("front",), "eyes": ("thickness",), "foot": ("toe", "rail", "lug"),
    "body_plates": ("plate",), "cam": ("dog",), "stop_bar": ("stop",),
}  # fmt: skip
"""What grows with each key of `[strength]`, in proportion."""


@dataclass(frozen=True)
class Growth:
    """Factors on the sizes that `sizing.sections` gives, for those that fail a strength check of the built robot."""

    leg: float = 1.0
    lever: float = 1.0
    front: float = 1.0
    thickness: float = 1.0
    lug: float = 1.0
    toe: float = 1.0
    rail: float = 1.0
    plate: float = 1.0
    dog: float = 1.0
    stop: float = 1.0

    def stronger(self, workshop: Workshop) -> "Growth":
        """Return the factors times those that a workshop's `[strength]` asks for."""
        by = {size: getattr(workshop.strength, part) for part, sizes in OF_PARTS.items() for size in sizes}
        return replace(self, **{size: factor * getattr(self, size) for size, factor in by.items()})

    def more(self, weak: Iterable[Finding]) -> "Growth":
        """Return the factors with those of weak sections larger by at most a step.

        By what a finding lacks: stresses fall at least as fast as their section grows. By a whole step where that is
        not known.
        """
        return self._grown((finding, min(STEP, MORE * (finding.use or math.inf))) for finding in weak)

    def leap(self, weak: Iterable[Finding], before: Mapping[tuple[str, str], tuple[float, float]]) -> "Growth":
        """Return the factors with those of weak sections as large as they are expected to need to be.

        `before` are the `uses` of an earlier growth: what has fallen by some power of its section since then is taken
        to go on so (secant method), if it is one that a section can have. Else by the usual power (`POWERS`); by at
        most a step where there is none.
        """
        return self._grown((finding, self._leap(finding, before)) for finding in weak)

    def uses(self, weak: Iterable[Finding]) -> dict[tuple[str, str], tuple[float, float]]:
        """Return the factor of what grows and the use of the limit for findings, by their name and what grows."""
        return {(one.name, one.grows): (getattr(self, one.grows), one.use) for one in weak if one.use is not None}

    def grown(self, weak: Iterable[Finding]) -> "tuple[Grown, ...]":
        """Return what has grown, given the findings that were weak before, the first ones first."""
        first: dict[str, Finding] = {}
        for finding in weak:
            first.setdefault(finding.grows, finding)
        return tuple(Grown(what, getattr(self, what), one.name, one.use) for what, one in first.items()
                     if getattr(self, what) > 1.0)  # fmt: skip

    def _leap(self, finding: Finding, before: Mapping[tuple[str, str], tuple[float, float]]) -> float:
        use, power = finding.use or math.inf, POWERS.get(finding.name)
        if (finding.name, finding.grows) in before:
            power = self._power(finding, *before[finding.name, finding.grows])
        if power is None or use == math.inf:
            return min(STEP, MORE * use)
        return math.exp(min(math.log(LEAP), math.log(MORE) + math.log(use) / power))

    def _power(self, finding: Finding, factor: float, use: float) -> float | None:
        """Return the power by which a use has fallen since an earlier factor; None if it is not that of a section."""
        grown, now = getattr(self, finding.grows) / factor, finding.use or math.inf
        if grown <= 1.0 or not 1.0 < use / now < math.inf:
            return None
        power = math.log(use / now) / math.log(grown)
        return power if power >= LEAST_POWER else None

    def _grown(self, factors: Iterable[tuple[Finding, float]]) -> "Growth":
        """Return the factors times the largest of some for what grows with each finding."""
        steps: dict[str, float] = {}
        for finding, factor in factors:
            steps[finding.grows] = max(factor, steps.get(finding.grows, 1.0))
        return replace(self, **{what: step * getattr(self, what) for what, step in steps.items()})


@dataclass(frozen=True)
class Grown:
    """What grew by itself: by which factor, for which limit, and its use before; None where that is not known."""

    what: str
    factor: float
    limit: str
    use: float | None


def grown_mm(size_mm: float, factor: float) -> float:
    """Return a size as it is, or grown and rounded up to 0.01 mm."""
    return size_mm if factor == 1.0 else in_hundredths(factor * size_mm)


def in_hundredths(height_mm: float) -> float:
    """Return a height rounded up to 0.01 mm: the last digits of the loads differ between processors."""
    return math.ceil(height_mm * 100.0 - 1e-6) / 100.0
