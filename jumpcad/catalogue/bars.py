"""Bars that legs are made of between printed ends: strips and tubes of pultruded carbon (mm, g, MPa)."""

import itertools
import math
from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.catalogue.articles import Article, Length, Positive, Source
from jumpcad.files import Contradiction

STEPS = 16
"""Least flat steps with which a round bar and its socket are drawn; judgement: 0.25 mm for 4 mm, a layer's height."""
MOST_STEPS = 256
"""Judgement: of a bar of 30 mm, steps of 0.12 mm, a thin layer's height."""


class LegBar(Article):
    """A straight bar, sold by length: a flat strip, or a round tube with a bore. `description` is what to order.

    `width_mm` lies across the robot, `height_mm` in the plane of motion. `bond_mpa` is the shear strength of its glue.
    """

    description: Source
    width_mm: Annotated[Length, Field(ge=1, le=30)]
    height_mm: Annotated[Length, Field(ge=1, le=30)]
    bore_mm: Annotated[float, Field(ge=0, le=30)] = 0.0
    round: bool = False
    density_g_cm3: Annotated[float, Field(ge=0.3, le=10)]
    modulus_mpa: Annotated[float, Field(ge=1, le=1e6)]
    strength_mpa: Positive
    shear_mpa: Positive
    bond_mpa: Positive

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield a round bar whose width is not its height, and a bore that leaves no wall."""
        if self.round and self.width_mm != self.height_mm:
            yield ("height_mm",), self.height_mm, f"must be width_mm = {self.width_mm:g}: the bar is round"
        if self.bore_mm >= min(self.width_mm, self.height_mm):
            reason = f"must be less than {min(self.width_mm, self.height_mm):g}, the bar's outside"
            yield ("bore_mm",), self.bore_mm, reason

    @property
    def area_mm2(self) -> float:
        """Area of its section."""
        outside = math.pi / 4.0 * self.width_mm**2 if self.round else self.width_mm * self.height_mm
        return outside - math.pi / 4.0 * self.bore_mm**2

    @property
    def around_mm(self) -> float:
        """Perimeter of its section, which is glued."""
        return math.pi * self.width_mm if self.round else 2.0 * (self.width_mm + self.height_mm)

    @property
    def second_moment_mm4(self) -> float:
        """Second moment of area for bending in the plane of motion."""
        return self._second_moment(self.width_mm, self.height_mm)

    @property
    def sideways_mm4(self) -> float:
        """Second moment of area for bending across it."""
        return self._second_moment(self.height_mm, self.width_mm)

    def mass_g(self, length_mm: float) -> float:
        """Return the mass of a length."""
        return self.density_g_cm3 * self.area_mm2 * length_mm / 1000.0

    def slabs_mm(self, more_mm: float = 0.0, ledge_mm: float = math.inf) -> list[tuple[float, float, float]]:
        """Return its section as slabs (from, to, height) across the robot, or that of a hole wider by `more_mm` a side.

        Steps of a round one are chords: of the bar at their middles, of a hole at their inner edges, so that it fits.
        There are so many that none stands out from the next one by more than `ledge_mm`, which prints without support.
        """
        if not self.round:
            half = self.width_mm / 2.0 + more_mm
            return [(-half, half, self.height_mm + 2.0 * more_mm)]
        steps = STEPS
        slabs = self._steps_mm(more_mm, steps)
        while steps < MOST_STEPS and max(b[2] - a[2] for a, b in itertools.pairwise(slabs)) > 2.0 * ledge_mm:
            steps *= 2
            slabs = self._steps_mm(more_mm, steps)
        return slabs

    def _steps_mm(self, more_mm: float, steps: int) -> list[tuple[float, float, float]]:
        """Return a round section as that many slabs."""
        radius = self.width_mm / 2.0 + more_mm
        edges = [round_mm(radius * (2.0 * step / steps - 1.0)) for step in range(steps + 1)]
        slabs = []
        for low, high in itertools.pairwise(edges):
            at = min(abs(low), abs(high)) if more_mm else (low + high) / 2.0
            slabs.append((low, high, round_mm(2.0 * math.sqrt(radius**2 - at**2))))
        return slabs

    def _second_moment(self, width_mm: float, height_mm: float) -> float:
        outside = math.pi / 64.0 * height_mm**4 if self.round else width_mm * height_mm**3 / 12.0
        return outside - math.pi / 64.0 * self.bore_mm**4


def round_mm(length_mm: float) -> float:
    """Return a length rounded to a nanometre."""
    return round(length_mm, 6)
