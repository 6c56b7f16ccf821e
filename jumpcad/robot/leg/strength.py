"""Stresses of a bar that is glued into a leg's printed socket (N, N·mm, mm, MPa).

A bar that enters a socket with a moment M presses on its walls over a length a as a rigid bar on an elastic bed: the
pressure changes evenly from end to end, 6·M/(b·a²) at the ends, and the shear force in the bar reaches 1.5·M/a.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import LegBar
from jumpcad.strength import stress
from jumpcad.transforms import Array

STATIONS = 65
"""Sections along a leg at which its bending energy is summed."""


@dataclass(frozen=True)
class Socket:
    """A printed socket of a length around a bar; `thickness_mm` and `height_mm` are the leg's outside there."""

    bar: LegBar
    length_mm: float
    thickness_mm: float
    height_mm: float
    gap_mm: float

    def pressure_mpa(self, moment_nmm: float, shear_n: float) -> float:
        """Return the largest pressure of the bar on a wall; glue that also holds its sides is neglected."""
        per_length = 6.0 * moment_nmm / self.length_mm**2 + shear_n / self.length_mm
        return per_length / self.bar.width_mm

    def wall_mpa(self, moment_nmm: float, shear_n: float) -> float:
        """Return the tensile stress in the side walls, which hold the wall that the bar presses on."""
        skins = self.thickness_mm - self.bar.width_mm - 2.0 * self.gap_mm
        return self.pressure_mpa(moment_nmm, shear_n) * self.bar.width_mm / skins

    def bending_mpa(self, moment_nmm: float) -> float:
        """Return the stress of the hollow section at the socket's floor, which carries the whole moment."""
        gap = 2.0 * self.gap_mm
        hollow = (self.bar.width_mm + gap) * (self.bar.height_mm + gap) ** 3
        return moment_nmm * self.height_mm / 2.0 / ((self.thickness_mm * self.height_mm**3 - hollow) / 12.0)

    def bond_mpa(self, axial_n: float, twist_nmm: float) -> float:
        """Return the shear stress of the glue under a force along the bar and a moment about it."""
        area = self.bar.around_mm * self.length_mm
        radius = min(self.bar.width_mm, self.bar.height_mm) / 2.0
        return math.hypot(axial_n / area, twist_nmm / (area * radius))


def bar_bending_mpa(bar: LegBar, moment_nmm: float, axial_n: float) -> float:
    """Return the largest stress of a bar under bending in the plane of motion and a force along it."""
    return moment_nmm * bar.height_mm / 2.0 / bar.second_moment_mm4 + axial_n / bar.area_mm2


def bar_sideways_mpa(bar: LegBar, moment_nmm: float) -> float:
    """Return the largest stress of a bar bent across the plane of motion."""
    return moment_nmm * bar.width_mm / 2.0 / bar.sideways_mm4


def bar_shear_mpa(bar: LegBar, force_n: float, twist_nmm: float) -> float:
    """Return the shear stress of a bar: 2·F/A of a force across a tube, 1.5·F/A of a strip, and that of its torsion.

    Torsion: 16·T·D/(pi·(D⁴ - d⁴)) of a tube.
    """
    if bar.round:
        torsion = 16.0 * twist_nmm * bar.width_mm / (math.pi * (bar.width_mm**4 - bar.bore_mm**4))
    else:
        torsion = float(stress.bar_shear_mpa(twist_nmm, bar.width_mm, bar.height_mm))
    return (2.0 if bar.round else 1.5) * force_n / bar.area_mm2 + torsion


def bent_energy_nmm(stiffness_nmm2: Array, moment_nmm: float, length_mm: float) -> float:
    """Return the bending energy of a cantilever with a force at its tip, by stiffness E·I (n,) along it."""
    share = np.linspace(1.0, 0.0, len(stiffness_nmm2))
    return float(np.trapezoid((moment_nmm * share) ** 2 / (2.0 * stiffness_nmm2), dx=length_mm / (len(share) - 1)))


def buckling_n(bar: LegBar, length_mm: float) -> float:
    """Return Euler's load of a bar with a hinge at either end, about its weaker axis."""
    weaker = min(bar.second_moment_mm4, bar.sideways_mm4)
    return math.pi**2 * bar.modulus_mpa * weaker / length_mm**2
