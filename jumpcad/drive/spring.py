"""Torsion springs, made to order: one left-hand and one right-hand, half of the stiffness each.

Formulas: Shigley, Mechanical Engineering Design, 10-12 (helical torsion springs): stiffness k = E·d⁴/(10.8·D·N) per
turn with the arms counted as (l1 + l2)/(3·pi·D) turns; bending stress K·32·M/(pi·d³) with K of the inner fibre;
D·N/(N + turns loaded) when loaded in the closing direction. Static strength: 0.78 of the tensile strength.
"""

import math
from dataclasses import dataclass
from typing import Literal

from jumpcad.catalogue import Wire
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, at_most

TURNS_MIN, INDEX_MIN, INDEX_MAX = 2.0, 4.0, 16.0
"""Least turns, and least and largest diameter of coil over wire; judgement: what makers of springs offer."""


@dataclass(frozen=True)
class SpringLimits:
    """Room and strength of the springs (mm). Values that a workshop gives have no default here.

    Attributes
    ----------
    mandrel_min_mm
        The smallest bushing that can carry a coil.
    pin_radius_min_mm
        From the axle to the pins that hold the arms, at least: the body's pin crosses the plane of the main leg.
    stress_share
        Allowable bending stress over tensile strength.
    mandrel_clearance_mm
        Gap that a loaded coil leaves around its bushing, on the diameter; judgement: it must not bind.
    outer_max_mm, body_lengths_max_mm
        Largest diameter and lengths of the loaded coil.
        The lengths are tried in this order: a long, thin spring widens the robot, a short one is
        larger around the leg's axle. Judgement: the room beside the cam, and between leg and gears.
    arm_reach_mm
        From the outside of the coil to the pins; judgement: pin, its eye and a gap.
    """

    mandrel_min_mm: float
    pin_radius_min_mm: float
    stress_share: float
    mandrel_clearance_mm: float = 0.3
    outer_max_mm: float = 18.0
    body_lengths_max_mm: tuple[float, ...] = (10.0, 13.0)
    arm_reach_mm: float = 5.0


@dataclass(frozen=True)
class TorsionSpring:
    """One of the two springs; the other is its mirror image. Lengths in mm.

    Attributes
    ----------
    turns
        Turns of the body at rest, which its maker winds; real-valued, so that the stiffness is the design's exactly.
    body_length_mm
        Length of the close-coiled body when loaded.
    mandrel_mm
        Largest bushing that clears the loaded coil.
    arm_length_mm
        Of each arm, from the coil to its pin.
    stiffness_nm_per_rad
        Of this one spring.
    stress_mpa, allowable_mpa
        Bending stress when loaded, at the inner fibre, and its limit.
    tensile_mpa
        Tensile strength of the wire, at least.
    """

    wire_mm: float
    inside_diameter_mm: float
    outer_diameter_mm: float
    turns: float
    body_length_mm: float
    mandrel_mm: float
    arm_length_mm: float
    stiffness_nm_per_rad: float
    stress_mpa: float
    allowable_mpa: float
    tensile_mpa: float
    mass_g: float
    findings: tuple[Finding, ...]
    hands: tuple[Literal["left"], Literal["right"]] = ("left", "right")

    @property
    def pin_radius_mm(self) -> float:
        """From the axle to the pins that hold the arms, which are tangents of the coil (mm)."""
        return math.hypot((self.inside_diameter_mm + self.wire_mm) / 2, self.arm_length_mm)

    @property
    def free_arm_angle_rad(self) -> float:
        """Angle between the two arms at rest, as the body's part of a turn (rad)."""
        return 2 * math.pi * (self.turns % 1.0)


def synthesise_spring(
    stiffness_nm_per_rad: float, compression_rad: float, wire: Wire, limits: SpringLimits
) -> TorsionSpring:
    """Find the pair of springs with the smallest outer diameter.

    Parameters
    ----------
    stiffness_nm_per_rad, compression_rad
        Of both springs together, and how far they are turned from rest without preload.

    Raises
    ------
    CannotBuildError
        If no wire is strong enough in the available room.
    """
    torque_nmm = 1000 * stiffness_nm_per_rad * compression_rad / 2
    for length in limits.body_lengths_max_mm:
        springs = [
            spring
            for d, tensile in zip(wire.diameters_mm, wire.tensile_strength_mpa, strict=True)
            if (spring := _of_wire(d, tensile, stiffness_nm_per_rad / 2, compression_rad, wire, limits, length))
        ]
        if springs:
            return min(springs, key=lambda spring: (spring.outer_diameter_mm, spring.mass_g))
    raise CannotBuildError(
        f"no wire of {wire.diameters_mm[0]:g} to {wire.diameters_mm[-1]:g} mm makes a torsion spring for "
        f"{torque_nmm:.0f} N·mm at {math.degrees(compression_rad):.1f}° in {limits.outer_max_mm:g} mm diameter and "
        f"{max(limits.body_lengths_max_mm):g} mm length: lower stiffness_nmm_per_deg or compression_ratio, or give the "
        "springs more room"
    )


def _of_wire(
    d: float,
    tensile_mpa: float,
    stiffness: float,
    compression_rad: float,
    wire: Wire,
    limits: SpringLimits,
    length_max_mm: float,
) -> TorsionSpring | None:
    """Return the smallest spring of one wire, or nothing where none fits."""
    loaded = compression_rad / (2 * math.pi)
    allowable = limits.stress_share * tensile_mpa
    plain_stress = 32 * 1000 * stiffness * compression_rad / (math.pi * d**3)
    index = _least_index(allowable / plain_stress)
    # Mean diameter times active turns follows from the stiffness.
    product = wire.modulus_mpa * d**4 / (10.8 * 1000 * stiffness * 2 * math.pi)
    arm = 2 * limits.arm_reach_mm
    mean = 0.0
    for _ in range(20):
        body = product - 2 * arm / (3 * math.pi)
        longest = length_max_mm / d - 1 - loaded
        loaded_mean = limits.mandrel_min_mm + limits.mandrel_clearance_mm + d
        if body <= 0 or longest <= 0 or 1 / loaded_mean <= loaded / body:
            return None
        mean = max(index * d, body / longest, 1 / (1 / loaded_mean - loaded / body))
        pin = max(mean / 2 + d / 2 + limits.arm_reach_mm, limits.pin_radius_min_mm)
        arm = math.sqrt(pin**2 - (mean / 2) ** 2)
    turns = product / mean - 2 * arm / (3 * math.pi * mean)
    if turns < TURNS_MIN or mean > INDEX_MAX * d or mean + d > limits.outer_max_mm:
        return None
    length = d * (turns + 1 + loaded)
    inside_loaded = mean * turns / (turns + loaded) - d
    stress = plain_stress * _inner_fibre(mean / d)
    volume = math.pi / 4 * d**2 * (math.pi * mean * turns + 2 * arm)
    return TorsionSpring(
        wire_mm=d,
        inside_diameter_mm=mean - d,
        outer_diameter_mm=mean + d,
        turns=turns,
        body_length_mm=length,
        mandrel_mm=inside_loaded - limits.mandrel_clearance_mm,
        arm_length_mm=arm,
        stiffness_nm_per_rad=stiffness,
        stress_mpa=stress,
        allowable_mpa=allowable,
        tensile_mpa=tensile_mpa,
        mass_g=wire.density_g_cm3 * volume / 1000,
        findings=(
            at_most(
                "spring_stress", stress, allowable, "MPa",
                f"the wound springs' wire of {d:g} mm bears {stress:.0f} of {allowable:.0f} MPa",
                "lower stiffness_nmm_per_deg or compression_ratio",
            ),
        ),
    )  # fmt: skip


def _inner_fibre(index: float) -> float:
    """Return the stress correction of the coil's inner fibre at an index D/d."""
    return (4 * index**2 - index - 1) / (4 * index * (index - 1))


def _least_index(correction: float) -> float:
    """Return the smallest index D/d whose inner-fibre correction is at most what the strength allows."""
    if correction <= 1:
        return math.inf
    b = 4 * correction - 1
    root = (b + math.sqrt(b**2 - 16 * (correction - 1))) / (8 * (correction - 1))
    return max(INDEX_MIN, root)
