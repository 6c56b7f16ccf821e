"""Textbook stresses of bars, eyes and pins, and fatigue of steel (N, mm, MPa), for sizing and checking alike.

Sources: Shigley, Mechanical Engineering Design, 3-10 (bending), 3-12 (torsion), 4-12 (columns), 8-12 (joints loaded in
shear); Roark, Formulas for Stress and Strain, ch. 8 (beams) and table A.1 (sections).
Printed parts have no fatigue here: handbooks have no such figures for them, and the strength factor covers it.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from jumpcad.transforms import Array
from jumpcad.workshop import Process

VON_MISES = math.sqrt(3.0)
"""Tension that is equivalent to a shear stress of 1 (distortion energy)."""
CREEP_MPA = 10.0
"""Stress that a printed part bears for months; judgement, creep of PLA and PETG."""
INFILL_ALONG = 0.5
"""Share of an infill's lines that run along a bar: half of a grid's."""
STATIONS = 17
"""Sections along a bar at which stress and energy are found; with twice as many they change by less than 0.1 %."""


@dataclass(frozen=True)
class Shell:
    """The solid outside of a printed bar: walls at its sides, layers below and above (mm).

    `core_share` is the infill's load-bearing share, relative to solid material.
    """

    walls_mm: float
    layers_mm: float
    core_share: float

    @classmethod
    def of(cls, process: Process) -> "Shell":
        """Return the shell that a process prints."""
        return cls(
            process.perimeters * process.line_width_mm,
            0.5 * (process.top_layers + process.bottom_layers) * process.layer_height_mm,
            process.infill if process.infill == 1.0 else INFILL_ALONG * process.infill,
        )


SOLID = Shell(0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Beam:
    """Rectangular sections of a printed bar, solid in its shell and infilled within; scalars or arrays (n,) of mm.

    `height_mm` lies in the plane of bending. A bar that prints lying has its walls at the ends of its height, one that
    prints `upright` its layers.
    """

    width_mm: float | Array
    height_mm: float | Array
    shell: Shell = SOLID
    upright: bool = False

    @property
    def area_mm2(self) -> float | Array:
        """Load-carrying area (mm²)."""
        width, height = self._core
        return self.width_mm * self.height_mm - (1.0 - self.shell.core_share) * width * height

    @property
    def second_moment_mm4(self) -> float | Array:
        """Second moment of area, b·h³/12 less the missing part of the core."""
        width, height = self._core
        return (self.width_mm * self.height_mm**3 - (1.0 - self.shell.core_share) * width * height**3) / 12.0

    @property
    def _core(self) -> tuple[float | Array, float | Array]:
        walls, layers = 2.0 * self.shell.walls_mm, 2.0 * self.shell.layers_mm
        across, along = (walls, layers) if self.upright else (layers, walls)
        return _positive(self.width_mm - across), _positive(self.height_mm - along)

    def stress_mpa(self, moment_nmm: float | Array, axial_n: float | Array = 0.0) -> float | Array:
        """Return the largest stress under bending and a force along the bar, M·h/(2·I) + F/A."""
        bending = moment_nmm * self.height_mm / (2.0 * self.second_moment_mm4)
        return bending + np.abs(axial_n) / self.area_mm2


def _positive(value: float | Array) -> float | Array:
    return np.maximum(value, 0.0) if isinstance(value, np.ndarray) else max(value, 0.0)


def height_for_mm(moment_nmm: float, width_mm: float, stress_mpa: float, shell: Shell, upright: bool = False) -> float:
    """Return the least height of a bar for a bending moment; 0 without a moment.

    The solid bar's height, the root of 6·M/(b·stress), is the first guess; it grows for the missing part of the core.
    """
    if moment_nmm == 0.0:
        return 0.0
    height = math.sqrt(6.0 * moment_nmm / (width_mm * stress_mpa))
    for _ in range(20):
        height *= math.sqrt(float(Beam(width_mm, height, shell, upright).stress_mpa(moment_nmm)) / stress_mpa)
    return height


def tapered_stress_mpa(bar: Beam, moment_nmm: float, axial_n: float = 0.0) -> float:
    """Return the largest stress of a cantilever whose moment falls linearly from its root to zero at its tip.

    `bar` holds the sections (n,) at equal distances from root to tip.
    """
    share = np.linspace(1.0, 0.0, len(np.atleast_1d(bar.height_mm)))
    return float(np.max(bar.stress_mpa(moment_nmm * share, axial_n)))


def tapered_energy_nmm(stiffness_nmm2: Array, moment_nmm: float, length_mm: float) -> float:
    """Return the bending energy of such a cantilever of stiffness E·I (n,), the integral of M²/(2·E·I) (N·mm)."""
    share = np.linspace(1.0, 0.0, len(stiffness_nmm2))
    return float(np.trapezoid((moment_nmm * share) ** 2 / (2.0 * stiffness_nmm2), dx=length_mm / (len(share) - 1)))


def tip_stiffness_n_per_mm(bar: Beam, length_mm: float, modulus_mpa: float) -> float:
    """Return the force over the deflection at the tip of such a cantilever, F²/(2·U) with its bending energy U."""
    return 1.0 / (2.0 * tapered_energy_nmm(np.asarray(modulus_mpa * bar.second_moment_mm4), length_mm, length_mm))


def bored_stress_mpa(moment_nmm: float, width_mm: float, height_mm: float, bore_mm: float) -> float:
    """Return the bending stress of a bar at a cross bore in its middle, 6·M·H/(b·(H³ - d³))."""
    return 6.0 * moment_nmm * height_mm / (width_mm * (height_mm**3 - bore_mm**3))


def eye_stress_mpa(force_n: float, thickness_mm: float, outer_mm: float, bore_mm: float) -> float:
    """Return the larger of an eye's bearing pressure and its tear-out beside the pin, as an equivalent tension.

    The tension across the same ligaments is less than the tear-out by the square root of 3.
    """
    bearing = force_n / (bore_mm * thickness_mm)
    tear_out = VON_MISES * force_n / ((outer_mm - bore_mm) * thickness_mm)
    return max(bearing, tear_out)


def pin_stress_mpa(moment_nmm: float, diameter_mm: float) -> float:
    """Return the bending stress of a round pin, 32·M/(pi·d³)."""
    return 32.0 * moment_nmm / (math.pi * diameter_mm**3)


def tube_shear_mpa(torque_nmm: float, outer_mm: float, bore_mm: float) -> float:
    """Return the shear stress at the outside of a tube under torsion, 16·T·D/(pi·(D⁴ - d⁴))."""
    return 16.0 * torque_nmm * outer_mm / (math.pi * (outer_mm**4 - bore_mm**4))


def jaw_stress_mpa(
    torque_nmm: float, jaw_rad: float, jaws: int, inner_mm: float, outer_mm: float, long_mm: float
) -> float:
    """Return the stress at the root of a dog's jaws that share a torque, as an equivalent tensile stress.

    A jaw is a short cantilever along the axle, pushed in the middle of its length at its mean radius: bending
    6·M/(b·h²) and shear 3·F/(2·b·h), b from inside to outside (diameters), h along the mean circle.
    """
    radial, mean = (outer_mm - inner_mm) / 2.0, (outer_mm + inner_mm) / 4.0
    force, around = torque_nmm / (jaws * mean), mean * jaw_rad
    bending = 6.0 * force * long_mm / 2.0 / (radial * around**2)
    return math.hypot(bending, VON_MISES * 1.5 * force / (radial * around))


def bar_shear_mpa(torque_nmm: float | Array, width_mm: float | Array, height_mm: float | Array) -> float | Array:
    """Return the largest shear stress of a rectangular bar under torsion, T/(b·c²)·(3 + 1.8·c/b) with b ≥ c."""
    long, short = np.maximum(width_mm, height_mm), np.minimum(width_mm, height_mm)
    stress: float | Array = torque_nmm / (long * short**2) * (3.0 + 1.8 * short / long)
    return stress


def twisted_height_mm(torque_nmm: float, width_mm: float, stress_mpa: float) -> float:
    """Return the other side of a rectangular bar whose `bar_shear_mpa` is a given stress; 0 without a torque.

    With b, the side asked for, and a, the known one: S·a²·b² = T·(3·b + 1.8·a) where b ≥ a, T·(1.8·b + 3·a) else.
    """
    for along, across in ((3.0, 1.8), (1.8, 3.0)):
        half = along * torque_nmm / (2.0 * stress_mpa * width_mm**2)
        height = half + math.sqrt(half**2 + across * torque_nmm / (stress_mpa * width_mm))
        if height >= width_mm:
            break
    return height


def buckling_load_n(second_moment_mm4: float | Array, length_mm: float, modulus_mpa: float) -> float:
    """Return Euler's load of a bar with a hinge at either end, pi²·E·I/l²."""
    return float(math.pi**2 * modulus_mpa * second_moment_mm4 / length_mm**2)


LOW_CYCLES, LASTING = 1e3, 1e6
"""Cycles: up to the first, yield is the limit; from the second on, lives are infinite (Shigley, 6-8)."""
YIELD_SHARE = 0.78
"""Yield over tensile strength of cold-drawn spring wire in bending (Shigley, 10-12)."""
SPRING_SHARES = ((LOW_CYCLES, YIELD_SHARE), (1e5, 0.53), (LASTING, 0.50))
"""Jumps, and largest stress at the coil's inner fibre over tensile strength: music wire, not shot-peened, repeated
bending (Shigley, table 10-10); below 1e5 on a straight line in logarithms to yield."""
LOW_CYCLE_SHARE = 0.77
"""Alternating strength at 1e3 cycles over tensile strength, at 1400 MPa and more (Shigley, figure 6-18)."""


def spring_share(jumps: float) -> float:
    """Return the largest bending stress of a torsion spring's wire over its tensile strength, for a number of jumps."""
    at = min(max(jumps, LOW_CYCLES), LASTING)
    (n0, s0), (n1, s1) = next(pair for pair in itertools.pairwise(SPRING_SHARES) if at <= pair[1][0])
    return s0 * math.pow(at / n0, math.log(s1 / s0) / math.log(n1 / n0))


def spring_jumps(share: float) -> float:
    """Return the jumps that a spring lasts with a stress over its tensile strength; infinite from `LASTING` on."""
    if share <= SPRING_SHARES[-1][1]:
        return math.inf
    (n0, s0), (n1, s1) = next(pair for pair in itertools.pairwise(SPRING_SHARES) if share >= pair[1][1])
    return n0 * math.pow(share / s0, math.log(n1 / n0) / math.log(s1 / s0))


def pin_limit_mpa(tensile_mpa: float, jumps: float) -> float:
    """Return the largest bending stress of a thin cold-drawn pin for a number of jumps.

    Fatigue strength: half of the tensile strength, at most 700 MPa, times the surface factor 4.51·S^-0.265 for an
    infinite life (Shigley, 6-7 and 6-9), and S-N lines below (6-8). A 3 mm pin that does not turn needs no factor for
    its size. Goodman's line for a stress that is half mean and half amplitude (6-12), yield at most.
    """
    endless = min(0.5 * tensile_mpa, 700.0) * min(1.0, 4.51 * math.pow(tensile_mpa, -0.265))
    first = LOW_CYCLE_SHARE * tensile_mpa
    at = min(max(jumps, LOW_CYCLES), LASTING)
    strength = first * math.pow(at / LOW_CYCLES, math.log(endless / first) / math.log(LASTING / LOW_CYCLES))
    return min(2.0 / (1.0 / strength + 1.0 / tensile_mpa), YIELD_SHARE * tensile_mpa)
