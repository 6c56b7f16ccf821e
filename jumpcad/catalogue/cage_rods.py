"""Rods that a cage is bent of (mm, g, MPa)."""

import math
from typing import Annotated

from pydantic import Field

from jumpcad.catalogue.articles import Article, Source


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
        """Return the mass of a length."""
        return self.density_g_cm3 * math.pi / 4.0 * self.diameter_mm**2 * length_mm / 1000.0
