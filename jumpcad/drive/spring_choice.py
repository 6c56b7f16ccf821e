"""Springs made to order: the smallest coil of the catalogue's wires whose arms touch their pins (mm, rad).

The stiffness sets the product D·n. The pins set the fraction of a turn in n, since the arms touch them at rest
(`jumpcad.drive.spring_arms`); the whole turns are as many as the limits allow. A stock spring's turns are given: there
the arms' length is chosen so that they touch the pins.
"""

import math

from jumpcad.catalogue import Wire
from jumpcad.drive.spring import SpringLimits, TorsionSpring, plain_stress_mpa, torsion_spring
from jumpcad.drive.spring_arms import FULL_TURN_RAD, Arms, between_pins_rad
from jumpcad.errors import CannotBuildError
from jumpcad.findings import lower
from jumpcad.mechanism.model import Spring

TURNS_MIN, INDEX_MIN, INDEX_MAX = 3.0, 4.0, 16.0
"""Least turns and index D/d (scope of EN 13906-3), and the largest index; judgement: what spring makers offer."""
ROUNDS = 20
"""Iterations of the fixed points below; each gains a digit or more."""
DIAMETER_DIGITS = 6
"""Diameters are found to a nanometre: arctangents differ between processors."""


def synthesise_spring(on_leg: Spring, leg_pin_rad: float, wire: Wire, limits: SpringLimits) -> TorsionSpring:
    """Find the pair of springs with the smallest outer diameter whose arms touch their pins.

    Parameters
    ----------
    on_leg
        Both springs together.
    leg_pin_rad
        Direction of the leg's pin in the rest pose.
    """
    for length in limits.body_lengths_max_mm:
        smallest = [
            (arms, tensile)
            for d, tensile in zip(wire.diameters_mm, wire.tensile_strength_mpa, strict=True)
            if (arms := _smallest_arms(d, tensile, on_leg, wire, limits, length)) and _fits(arms, limits)
        ]
        for plate_pin in limits.plate_pins_rad:
            between = between_pins_rad(plate_pin, leg_pin_rad)
            springs = [
                _finished(arms, on_leg, tensile, wire, limits, (plate_pin, leg_pin_rad))
                for least, tensile in smallest
                if (arms := _arms_between(least, on_leg, between, wire, limits))
            ]
            if springs:
                return min(springs, key=lambda spring: (spring.outer_diameter_mm, spring.mass_g))
    torque_nmm, loaded = 500.0 * on_leg.peak_torque_nm, math.degrees(on_leg.wind_rad + on_leg.preload_rad)
    raise CannotBuildError(
        f"no wire of {wire.diameters_mm[0]:g} to {wire.diameters_mm[-1]:g} mm makes a torsion spring for "
        f"{torque_nmm:.0f} N·mm at {loaded:.1f}° in {limits.outer_max_mm:g} mm diameter and "
        f"{max(limits.body_lengths_max_mm):g} mm length",
        ways=(*lower("stiffness_nmm_per_deg", "compression_ratio"), "give the springs more room"),
    )


def _smallest_arms(
    d: float, tensile_mpa: float, on_leg: Spring, wire: Wire, limits: SpringLimits, length_max_mm: float
) -> Arms | None:
    """Return the smallest coil of one wire that strength, length and bushing allow; None if there is none."""
    loaded = (on_leg.wind_rad + on_leg.preload_rad) / FULL_TURN_RAD
    index = _least_index(limits.stress_share * tensile_mpa / plain_stress_mpa(500.0 * on_leg.peak_torque_nm, d))
    product = _product_mm(d, on_leg, wire)
    loaded_mean = limits.mandrel_min_mm + limits.mandrel_clearance_mm + d
    longest = length_max_mm / d - 1 - loaded
    mean = max(index, INDEX_MIN) * d
    if not (longest > 0 and mean < INDEX_MAX * d):
        return None
    for _ in range(ROUNDS):
        body = product - mean * _arms_of(mean, d, limits).arm_turns
        if body <= 0 or 1 / loaded_mean <= loaded / body:
            return None
        before, mean = mean, max(index * d, body / longest, 1 / (1 / loaded_mean - loaded / body))
        if mean == before:
            break
    return _arms_of(mean, d, limits)


def _arms_between(least: Arms, on_leg: Spring, between_rad: float, wire: Wire, limits: SpringLimits) -> Arms | None:
    """Return the smallest coil of a wire whose arms touch pins an angle apart; None if there is none.

    `least` is the smallest coil that the limits allow. The pins set the fraction of a turn; the whole turns are reduced
    where needed, and fewer turns make the coil wider.
    """
    arms, d = least, least.wire_mm
    product = _product_mm(d, on_leg, wire)
    turns = product / arms.mean_mm - arms.arm_turns
    asked = between_rad - on_leg.preload_rad
    whole = math.floor((FULL_TURN_RAD * turns + 2 * arms.turn_rad - asked) / FULL_TURN_RAD + 1e-9)
    for _ in range(ROUNDS):
        turns = whole + (asked - 2 * arms.turn_rad) / FULL_TURN_RAD
        if turns < TURNS_MIN:
            return None
        before, arms = arms, _arms_of(round(product / (turns + arms.arm_turns), DIAMETER_DIGITS), d, limits)
        if arms == before:
            break
    return arms if _fits(arms, limits) else None


def _fits(arms: Arms, limits: SpringLimits) -> bool:
    """Whether a coil has room and can be wound; one that has not has none with other arms either, which widen it."""
    d = arms.wire_mm
    return arms.mean_mm <= INDEX_MAX * d and arms.mean_mm + d <= limits.outer_max_mm


def _arms_of(mean_mm: float, wire_mm: float, limits: SpringLimits) -> Arms:
    return Arms.to_pins(mean_mm, wire_mm, limits.pin_mm, limits.pin_radius_mm(mean_mm + wire_mm))


def _product_mm(d: float, on_leg: Spring, wire: Wire) -> float:
    """Return the mean diameter times the turns, arms counted, that give one spring half of the stiffness."""
    return wire.modulus_mpa * d**4 / (64 * 500 * on_leg.stiffness_nm_per_rad)


def _finished(
    arms: Arms, on_leg: Spring, tensile_mpa: float, wire: Wire, limits: SpringLimits, pins_rad: tuple[float, float]
) -> TorsionSpring:
    """Return the spring of a coil, its turns from the stiffness."""
    turns = _product_mm(arms.wire_mm, on_leg, wire) / arms.mean_mm - arms.arm_turns
    return torsion_spring(arms, turns, on_leg, tensile_mpa, wire, limits, pins_rad)


def _least_index(factor: float) -> float:
    """Return the smallest index D/d whose inner-fibre factor is at most what the strength allows."""
    if factor <= 1:
        return math.inf
    return max(INDEX_MIN, (0.75 * factor + 0.07) / (factor - 1))
