"""The springs of a robot: from stock, with the pins that fit their arms, or made to order (mm, rad).

A stock spring's turns are given: the arms' length is chosen so that they touch the pins. Springs made to order are the
smallest coil of the catalogue's wires whose arms touch their pins: the stiffness sets the product D·n, the pins the
fraction of a turn in n (`jumpcad.drive.spring`), and the whole turns are as many as the limits allow.
"""

import math

from jumpcad.catalogue import StockSpring, Wire
from jumpcad.design import Design, limits_of
from jumpcad.drive.spring import (
    ARM_BEYOND_MM,
    FULL_TURN_RAD,
    Arms,
    SpringLimits,
    TorsionSpring,
    beside_mm,
    between_pins_rad,
    plain_stress_mpa,
    torsion_spring,
)
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Basis, Change, Finding, Remedy, higher, lower
from jumpcad.mechanism.model import Spring
from jumpcad.workshop.tables import PRELOAD_MAX_DEG

BASIS = {
    "spring_rate": Basis(
        "2·k of the bought spring beside stiffness_nmm_per_deg (N·mm/°); no limit: the robot is computed with 2·k",
        "data sheet of the spring: templates/hardware/springs.toml, or [springs.NAME]",
    )
}
STIFFNESS, SPRING = "stiffness_nmm_per_deg", "bought.spring"
"""Parameter of a design that says nothing where springs are bought, and the key of a workshop that does then."""


def for_bought_springs(ways: Remedy) -> Remedy:
    """Return the ways out that can be taken where springs are bought: their rate is not the design's."""
    if isinstance(ways, str):
        return ways
    kinds = {"lower": "a weaker", "raise": "a stronger"}
    return tuple(
        Change(SPRING, "choose", kinds[one.way]) if isinstance(one, Change) and one.key == STIFFNESS else one
        for one in ways
    )


def springs_on_leg(design: Design, stock: StockSpring | None = None, preload_rad: float = 0.0) -> Spring:
    """Return both springs of a printed robot together: the design's, or two from stock with the rate that they have."""
    stiffness = design.stiffness_nm_per_rad
    if stock is not None:
        stiffness = 2.0 * stock.rate_nmm_per_deg / 1000.0 * 180.0 / math.pi
    return Spring("leg", stiffness, design.compression_rad, preload_rad, one_sided=True)


def rate_finding(design: Design, stock: StockSpring) -> Finding:
    """Return `spring_rate`: the stiffness of a design compared with that of two springs from stock."""
    asked, have = design.stiffness_nmm_per_deg, 2.0 * stock.rate_nmm_per_deg
    return Finding(
        "spring_rate", "info", abs(have - asked), "N·mm/°",  # no limit: springs may be softer, too
        f"two springs {stock.name} have {have:.2f} N·mm/°, with which the robot is built and simulated; the design "
        f"asks for {asked:.2f}",
        'bought.spring = "" has springs of the design\'s stiffness made to order', value=have,
    )  # fmt: skip


def fitted_spring(
    stock: StockSpring, on_leg: Spring, leg_pin_rad: float, wire: Wire, limits: SpringLimits
) -> TorsionSpring:
    """Return a stock spring with arms of such a length that they touch the pins at rest."""
    d, mean, turns = stock.wire_mm, stock.inside_diameter_mm + stock.wire_mm, stock.wound_turns
    beside = beside_mm(mean, d, limits.pin_mm)
    found: list[tuple[Arms, float]] = []
    for plate_pin in limits.plate_pins_rad:
        if arm_turn := _arm_turn_rad(stock, plate_pin, leg_pin_rad, on_leg.preload_rad, limits):
            found.append((Arms(mean, d, limits.pin_mm, beside * math.tan(arm_turn)), plate_pin))
    if not found:
        raise _no_pins(stock, on_leg, leg_pin_rad, limits)
    arms, plate_pin = min(found, key=lambda pair: pair[0].lever_mm)
    tensile = wire.tensile_mpa(d)
    spring = torsion_spring(arms, turns, on_leg, tensile, wire, limits, (plate_pin, leg_pin_rad), stock.name)
    if spring.mandrel_mm < limits.mandrel_min_mm:
        raise CannotBuildError(
            f"bought.spring = {stock.name!r}: when loaded, its coil leaves room for a bushing of "
            f"{spring.mandrel_mm:.2f} mm; the axle needs one of {limits.mandrel_min_mm:.2f} mm",
            "spring_bushing", spring.mandrel_mm - limits.mandrel_min_mm,
            ways=("choose one with a larger inside diameter", *lower("compression_ratio")),
        )  # fmt: skip
    return spring


def rest_angles_deg(stock: StockSpring, preload_rad: float, limits: SpringLimits) -> list[int]:
    """Return the rest angles, in whole degrees, at which the arms of a stock spring reach their pins in a free leg."""
    lower, upper = map(round, limits_of("rest_angle_deg"))
    turned = ((one, pin) for one in range(lower, upper + 1) for pin in limits.plate_pins_rad)
    return sorted({one for one, pin in turned if _arm_turn_rad(stock, pin, -math.radians(one), preload_rad, limits)})


def _arm_turn_rad(
    stock: StockSpring, plate_pin_rad: float, leg_pin_rad: float, preload_rad: float, limits: SpringLimits
) -> float | None:
    """Return the angle at the hub by which both arms touch their pins; None where they reach none."""
    shortest, longest = _arm_turns_rad(stock, limits)
    between = between_pins_rad(plate_pin_rad, leg_pin_rad)
    turn = ((between - preload_rad - FULL_TURN_RAD * stock.wound_turns) % FULL_TURN_RAD) / 2.0
    return turn if shortest <= turn <= longest else None


def _arm_turns_rad(stock: StockSpring, limits: SpringLimits) -> tuple[float, float]:
    """Return the least and the largest angle at the hub between an arm's tangent point and its pin."""
    mean = stock.inside_diameter_mm + stock.wire_mm
    beside, least = beside_mm(mean, stock.wire_mm, limits.pin_mm), limits.pin_radius_mm(mean + stock.wire_mm)
    lever = min(stock.arm_length_mm - ARM_BEYOND_MM, limits.lever_max_mm)
    return math.acos(beside / least), math.atan2(lever, beside)


def _no_pins(stock: StockSpring, on_leg: Spring, leg_pin_rad: float, limits: SpringLimits) -> CannotBuildError:
    """Return what is wrong: directions of the plate's pin that a stock spring needs, and those that are free."""
    shortest, longest = _arm_turns_rad(stock, limits)
    if longest < shortest:
        needed = math.tan(shortest) * beside_mm(stock.inside_diameter_mm + stock.wire_mm, stock.wire_mm, limits.pin_mm)
        return CannotBuildError(
            f"bought.spring = {stock.name!r}: its arms of {stock.arm_length_mm:g} mm do not reach the pins; "
            f"{needed + ARM_BEYOND_MM:.1f} mm are needed: choose one with longer arms"
        )
    first, last = min(limits.plate_pins_rad), max(limits.plate_pins_rad)
    ends = [
        math.degrees(leg_pin_rad - on_leg.preload_rad - FULL_TURN_RAD * stock.wound_turns - 2.0 * turn) % 360.0
        for turn in (longest, shortest)
    ]
    # a larger angle between the arms turns the plate's pin by as much
    less, more = (ends[0] - math.degrees(last)) % 360.0, (math.degrees(first) - ends[1]) % 360.0
    fits = (stock.arm_angle_deg + (more + 1.0 if more < less else -less - 1.0)) % 360.0
    load = higher("spring.preload_deg") if math.degrees(on_leg.preload_rad) + less <= PRELOAD_MAX_DEG else ()
    return CannotBuildError(
        f"bought.spring = {stock.name!r}: with arms {stock.arm_angle_deg:g}° apart, the plate's pin must be between "
        f"{ends[0]:.0f}° and {ends[1]:.0f}° from forward; there is room from {math.degrees(first):.0f}° to "
        f"{math.degrees(last):.0f}°, {min(less, more):.0f}° away",
        "spring_pins", -min(less, more), "°",
        (*load, f"choose a spring with arms about {fits:.0f}° apart", "change rest_angle_deg"),
    )  # fmt: skip


TURNS_MIN, INDEX_MIN, INDEX_MAX = 3.0, 4.0, 16.0
"""Least turns and index D/d (scope of EN 13906-3), and the largest index; judgement: what spring makers offer."""
ROUNDS = 20
"""Iterations of the fixed points below; each gains a digit or more."""
DIAMETER_DIGITS = 6
"""Diameters are found to a nanometre: arctangents differ between processors."""


def synthesise_spring(on_leg: Spring, leg_pin_rad: float, wire: Wire, limits: SpringLimits) -> TorsionSpring:
    """Find the pair of springs with the smallest outer diameter whose arms touch their pins, the leg's as at rest."""
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
    factor = limits.stress_share * tensile_mpa / plain_stress_mpa(500.0 * on_leg.peak_torque_nm, d)
    # the smallest index D/d whose inner-fibre factor is at most what the strength allows
    index = math.inf if factor <= 1 else max(INDEX_MIN, (0.75 * factor + 0.07) / (factor - 1))
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
