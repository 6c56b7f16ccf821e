"""Bars of legs between printed ends, rods that cages are bent of, axles and pins with what keeps them (mm, g, MPa)."""

import itertools
import math
from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.catalogue.articles import Article, Length, Mass, Positive, Source
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


class Rod(Article):
    """Rod of any diameter for axles: `description` is what to order, `bore_share` its bore over its outside.

    `grooves` says whether grooves can be turned or filed in it at home.
    """

    description: Source
    density_g_cm3: Annotated[float, Field(ge=0.5, le=20)]
    yield_mpa: Positive
    bore_share: Annotated[float, Field(ge=0, le=0.95)] = 0.0
    grooves: bool


class Clip(Article):
    """A retaining ring for a groove at a shaft's end; `load_n` is its load capacity, `end_mm` the shaft beyond it."""

    shaft_mm: Length
    groove_mm: Length
    groove_width_mm: Length
    end_mm: Length
    outer_mm: Length
    thickness_mm: Length
    load_n: Positive
    mass_g: Mass

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield a groove that is not smaller than its shaft."""
        if not self.groove_mm < self.shaft_mm < self.outer_mm:
            reason = f"must be less than shaft_mm = {self.shaft_mm:g}, and that less than outer_mm = {self.outer_mm:g}"
            yield ("groove_mm",), self.groove_mm, reason


class ClevisPin(Article):
    """A pin with a head and a cross hole for a split pin, `end_mm` before its end."""

    diameter_mm: Length
    head_mm: Length
    head_height_mm: Length
    end_mm: Length
    lengths_mm: list[Length]
    cotter_mm: Length
    cotter_length_mm: Length
    yield_mpa: Positive
    load_n: Positive


class CageRod(Article):
    """A straight round rod, sold by length and bent cold; `description` is what to order.

    It breaks, or stays bent, at `breaking_strain`, of which it bears `sustained_share` for months.
    """

    description: Source
    diameter_mm: Annotated[float, Field(ge=0.3, le=5)]
    density_g_cm3: Annotated[float, Field(ge=0.3, le=20)]
    modulus_mpa: Annotated[float, Field(ge=100, le=1e6)]
    breaking_strain: Annotated[float, Field(ge=1e-3, le=0.2)]
    sustained_share: Annotated[float, Field(ge=0.05, le=1)]

    @property
    def bending_nmm2(self) -> float:
        """Bending stiffness E·I."""
        return self.modulus_mpa * math.pi / 64.0 * self.diameter_mm**4

    def mass_g(self, length_mm: float) -> float:
        return self.density_g_cm3 * math.pi / 4.0 * self.diameter_mm**2 * length_mm / 1000.0
