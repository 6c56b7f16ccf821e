"""Rods and bars of the cage: a hoop as a ring, its bar as a beam that the rod's ends bend (N, mm, MPa, J)."""

import math

import numpy as np

from jumpcad.catalogue import CageRod
from jumpcad.workshop import Material

Two = tuple[float, float]

RING = 0.149
"""Of a ring's compliance R³/(E·I) between two opposite forces (Roark, ch. 9, case 1)."""
ENERGY = 2.25
"""Energy of such a ring over E·I·R·ΔK²: at its sides a deflection δ adds the curvature ΔK = 1.22·δ/R² (same)."""
FALLS = 2.0 / 3.0
"""Share of the springs' energy that falls to the ground again; measured: 0.46 to 0.65 on three robots with a cage."""

FOLD = 0.45
"""Energy that a hoop of 251° takes sideways until its rod breaks at a socket, over E·I/R: elastica between sockets that
its bar lets turn, glass of 1.5 mm; 0.49 at R 106 mm, 0.59 at 118 mm."""
EULER = 2.05
"""Of π²·E·I/L²: a column clamped at one end and guided at the other, which a floor's grip holds (Roark, table 15.1)."""


def two_horns(
    material: Material, length_mm: Two, high_mm: Two, thick_mm: Two, share: float, held_n: float = math.inf
) -> tuple[float, float, float]:
    """Return what two tapers bear, clamped at the plates, free to turn at the bar; heights from there on.

    Lengths are that of the taper, and the whole one; thicknesses that of the taper, and beyond. The stress for each
    newton upwards on a bar (MPa), and the energies (J) to their strength: pushed along the bar, and by a force of which
    that share bends them upwards, the rest shortens and buckles them; of it their ends hold `held_n` each.
    """
    taper, whole = length_mm
    along = whole * (np.arange(100) + 0.5) / 100.0
    high, thick = np.interp(along, (0.0, taper), high_mm), np.where(along < taper, *thick_mm)
    modulus, strength, found = material.modulus_mpa, material.strength_in_plane_mpa, []
    for section, half in ((high * thick**2 / 6.0, thick / 2.0), (thick * high**2 / 6.0, high / 2.0)):
        force = strength * float((section / along).min())
        gives = float((along**2 / (section * half)).mean()) * whole / modulus
        found.append((force, force**2 * gives / 1000.0))
    (_, sideways), (force, upwards) = found
    buckles = EULER * math.pi**2 * modulus * float((high * thick**3).mean()) / 12.0 / whole**2
    each = min(buckles, held_n, force / share)
    shortens = each**2 * (1.0 - share**2) * float((1.0 / (high * thick)).mean()) * whole / modulus / 1000.0
    return strength / force / 2.0, sideways, upwards * (each * share / force) ** 2 + shortens


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
