"""Rods and bars of the cage: a hoop as a ring, its bar as a beam that the rod's ends bend (N, mm, MPa, J)."""

import math

from jumpcad.catalogue import CageRod

RING = 0.149
"""Of a ring's compliance R³/(E·I) between two opposite forces (Roark, ch. 9, case 1)."""
ENERGY = 2.25
"""Energy of such a ring over E·I·R·ΔK²: at its sides a deflection δ adds the curvature ΔK = 1.22·δ/R² (same)."""
FALLS = 2.0 / 3.0
"""Share of the springs' energy that falls to the ground again; measured: 0.46 to 0.65 on three robots with a cage."""


def bent_strain(rod: CageRod, radius_mm: float) -> float:
    """Return the strain of a rod that is bent round."""
    return rod.diameter_mm / 2.0 / radius_mm


def landing_strain(rod: CageRod, radius_mm: float, energy_j: float) -> float:
    """Return the strain of a hoop that takes up an energy at its crest, as a ring: d/2·(1/R + √(U/(2.25·E·I·R)))."""
    more = math.sqrt(1000.0 * energy_j / (ENERGY * rod.bending_nmm2 * radius_mm))
    return rod.diameter_mm / 2.0 * (1.0 / radius_mm + more)


def ring_n_per_mm(rod: CageRod, radius_mm: float) -> float:
    """Return the stiffness of a hoop between the ground and its bar, as a ring."""
    return rod.bending_nmm2 / (RING * radius_mm**3)


def landing_n(rod: CageRod, radius_mm: float, energy_j: float) -> float:
    """Return the force of a hoop that takes up an energy as a spring: √(2·U·k)."""
    return math.sqrt(2000.0 * energy_j * ring_n_per_mm(rod, radius_mm))


def bar_mpa(rod: CageRod, radius_mm: float, width_mm: float, height_mm: float) -> float:
    """Return the bending stress of a bar that keeps a rod bent: the moment E·I/R all along it."""
    return rod.bending_nmm2 / radius_mm / (width_mm * height_mm**2 / 6.0)
