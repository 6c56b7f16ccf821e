"""Springs made to order against beam theory and a search by force: the smallest coil whose arms touch their pins."""

import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from support.each import each
from support.springs import LENGTH_MM, LIMITS, NAMES, WIRE, spring_of

from jumpcad.design import load_design
from jumpcad.drive.spring import Arms, TorsionSpring, inner_fibre
from jumpcad.drive.spring_choice import (
    _arms_between,
    _arms_of,
    _finished,
    _smallest_arms,
    springs_on_leg,
    synthesise_spring,
)
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.model import Spring

ONE_WIRE = WIRE.model_copy(update={"diameters_mm": (1.2,), "tensile_strength_mpa": (2000.0,)})
TURN = 2.0 * math.pi


def test_the_turns_of_a_coil_follow_from_the_stiffness() -> None:
    """Arms bend as a third of their length of coil, which is taken off the turns; two of them."""
    on_leg, arms = Spring("leg", 0.4, 0.5, 0.1), Arms(11.0, 1.2, 3.0, 9.0)
    spring = _finished(arms, on_leg, 1900.0, WIRE, LIMITS, (0.7, -0.9))
    length = math.pi * 11.0 * spring.turns + 2.0 * 9.0 / 3.0
    assert WIRE.modulus_mpa * math.pi * 1.2**4 / 64.0 / length == pytest.approx(200.0)
    assert (spring.plate_pin_rad, spring.leg_pin_rad, spring.tensile_mpa) == (0.7, -0.9, 1900.0)
    assert spring.arms == arms
    assert spring.torque_nmm == pytest.approx(200.0 * 0.6)


@each("between", [0.3, 1.9, 4.4, 6.2])
@each("preload", [0.0, 0.25])
def test_turns_and_both_arms_lead_from_one_pin_to_the_other(between: float, preload: float) -> None:
    """Around the hub: back from the plate's pin to the coil, the turns, on to the leg's pin, and the preload.

    A whole turn more would need a narrower coil than the limits allow.
    """
    on_leg, limits = Spring("leg", 0.2, 0.5, preload), replace(LIMITS, outer_max_mm=30.0)
    least = _arms_of(8.0, 1.2, limits)
    arms = _arms_between(least, on_leg, between, WIRE, limits)
    assert arms is not None
    product = WIRE.modulus_mpa * 1.2**4 / (64.0 * 100.0)
    turns = product / arms.mean_mm - 2.0 * arms.lever_mm / (3.0 * math.pi * arms.mean_mm)
    whole = (TURN * turns + 2.0 * arms.turn_rad + preload - between) / TURN
    assert whole == pytest.approx(round(whole), abs=1e-4)
    assert arms.mean_mm >= 8.0 - 1e-6
    assert arms.mean_mm == round(arms.mean_mm, 6)
    at_least = product / 8.0 - least.arm_turns
    most = (TURN * at_least + 2.0 * least.turn_rad + preload - between) / TURN
    assert round(whole) == math.floor(most)


@each("stiffness", [0.1, 0.4, 0.7])
@each("mandrel", [2.0, 5.0, 8.0])
def test_the_smallest_coil_keeps_every_limit(stiffness: float, mandrel: float) -> None:
    """Loaded by 0.6 rad: length, bushing and stress; the wire keeps its length, so that D·n stays."""
    limits, on_leg, d = replace(LIMITS, mandrel_min_mm=mandrel), Spring("leg", stiffness, 0.5, 0.1), 1.2
    arms = _smallest_arms(d, 2000.0, on_leg, WIRE, limits, 20.0)
    assert arms is not None
    turns = WIRE.modulus_mpa * d**4 / (64.0 * 500.0 * stiffness * arms.mean_mm) - arms.arm_turns
    loaded = turns + 0.6 / TURN
    stress = inner_fibre(arms.mean_mm / d) * 32.0 * 500.0 * stiffness * 0.6 / (math.pi * d**3)
    room = [
        20.0 - (loaded + 1.0) * d,
        arms.mean_mm * turns / loaded - d - mandrel - limits.mandrel_clearance_mm,
        1.0 - stress / (limits.stress_share * 2000.0),
        arms.mean_mm / d - 4.0,
    ]
    assert min(room) == pytest.approx(0.0, abs=1e-6)


def tried(pins: tuple[float, ...], lengths: tuple[float, ...], outer: float) -> TorsionSpring | None:
    """Return the spring of one wire for pins and lengths in their order, if there is one."""
    limits = replace(LIMITS, plate_pins_rad=pins, body_lengths_max_mm=lengths, outer_max_mm=outer)
    with suppress(CannotBuildError):
        return synthesise_spring(Spring("leg", 0.1, 0.5), -1.0, ONE_WIRE, limits)
    return None


def test_pins_are_tried_in_their_order_within_each_length() -> None:
    """The first where it fits, although another has a narrower coil; a short coil on the second before a long one."""
    pins = tuple(np.radians([20.0, 50.0, 80.0, 110.0, 140.0, 170.0]))
    widths = {pin: spring.outer_diameter_mm for pin in pins if (spring := tried((pin,), (16.0,), 60.0))}
    narrow, wide = min(widths, key=lambda pin: widths[pin]), max(widths, key=lambda pin: widths[pin])
    assert widths[wide] > widths[narrow] + 0.3
    for order in ((narrow, wide), (wide, narrow)):
        spring = tried(order, (16.0,), 60.0)
        assert spring is not None
        assert spring.plate_pin_rad == order[0]
    between = (widths[narrow] + widths[wide]) / 2.0
    assert tried((wide,), (16.0,), between) is None
    spring = tried((wide, narrow), (16.0,), between)
    assert spring is not None
    assert spring.plate_pin_rad == narrow
    long = tried((wide,), (16.0, 30.0), between)
    assert long is not None
    assert long.body_length_mm > 16.0
    first = tried((wide, narrow), (16.0, 30.0), between)
    assert first is not None
    assert (first.plate_pin_rad, first.body_length_mm <= 16.0) == (narrow, True)


def test_of_two_wires_the_one_with_the_narrower_coil_is_taken() -> None:
    """In whatever order the catalogue has them."""
    on_leg, limits, alone = Spring("leg", 0.4, 0.5), replace(LIMITS, plate_pins_rad=(0.7,)), {}
    for d, tensile in zip(WIRE.diameters_mm, WIRE.tensile_strength_mpa, strict=True):
        wire = WIRE.model_copy(update={"diameters_mm": (d,), "tensile_strength_mpa": (tensile,)})
        with suppress(CannotBuildError):
            alone[d] = synthesise_spring(on_leg, -1.0, wire, limits)
    assert len(alone) > 1
    best = min(alone.values(), key=lambda spring: spring.outer_diameter_mm)
    backwards = {"diameters_mm": WIRE.diameters_mm[::-1], "tensile_strength_mpa": WIRE.tensile_strength_mpa[::-1]}
    for wire in (WIRE, WIRE.model_copy(update=backwards)):
        assert synthesise_spring(on_leg, -1.0, wire, limits) == best


@pytest.mark.parametrize("name", NAMES)
def test_the_two_springs_have_the_designs_stiffness_as_bent_wire(name: str) -> None:
    """A wire of length l in pure bending turns by M·l/(E·I)."""
    design, spring = spring_of(name)
    mean = spring.outer_diameter_mm - spring.wire_mm
    # An arm loaded at its end bends a third as much as the same length of coil (Castigliano).
    length = math.pi * mean * spring.turns + 2 * spring.arms.lever_mm / 3
    bending = WIRE.modulus_mpa * math.pi * spring.wire_mm**4 / 64 / length / 1000
    assert bending == pytest.approx(spring.stiffness_nm_per_rad, rel=1e-9)
    assert 2 * spring.stiffness_nm_per_rad == pytest.approx(design.stiffness_nm_per_rad)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_no_smaller_spring_does_the_work(name: str) -> None:
    """Every wire and every number of turns that meets the pins with a coil below the chosen one breaks a limit."""
    design, spring = spring_of(name)
    stiffness, tried = design.stiffness_nm_per_rad / 2, 0
    (pin, *_), leg = LIMITS.plate_pins_rad, -math.radians(design.rest_angle_deg)
    assert spring.plate_pin_rad == pin
    for d, tensile in zip(WIRE.diameters_mm, WIRE.tensile_strength_mpa, strict=True):
        outer = np.linspace(2 * d + 0.2, spring.outer_diameter_mm - 0.02, 40000)
        mean = outer - d
        beside, radius = (mean + d + 3.0) / 2, outer / 2 + LIMITS.arm_reach_mm
        lever = np.sqrt(radius**2 - beside**2)
        active = WIRE.modulus_mpa * d**4 / (64 * mean * 1000 * stiffness)
        turns = active - 2 * lever / (3 * math.pi * mean)
        left = (2 * math.pi * turns - (leg - pin) + 2 * np.arctan2(lever, beside)) / (2 * math.pi)
        meets = np.abs(left - np.round(left)) < 1e-3
        index, wound = mean / d, turns + design.compression_rad / (2 * math.pi)
        stress = (index + 0.07) / (index - 0.75) * 32 * 1000 * stiffness * design.compression_rad / (math.pi * d**3)
        fits = (
            ((wound + 1) * d <= LENGTH_MM)
            & (mean * turns / wound - d >= LIMITS.mandrel_min_mm + LIMITS.mandrel_clearance_mm)
            & (stress <= LIMITS.stress_share * tensile)
            & (index >= 4) & (index <= 16) & (turns >= 3)
        )  # fmt: skip
        tried += int(meets.sum())
        assert not (meets & fits).any(), f"wire {d} mm, outer diameter {outer[meets & fits]}"
    assert tried > 100


def test_a_short_body_is_preferred_to_a_thin_one_where_it_fits() -> None:
    _, short = spring_of("kenan-1.0", replace(LIMITS, body_lengths_max_mm=(10.0, 13.0)))
    _, thin = spring_of("kenan-1.0", replace(LIMITS, body_lengths_max_mm=(5.0, 13.0)))
    assert short.body_length_mm <= 10.0 + 1e-9 < thin.body_length_mm
    assert short.outer_diameter_mm > thin.outer_diameter_mm


def test_no_room_is_refused_with_what_to_change() -> None:
    with pytest.raises(
        CannotBuildError, match=r"no wire of 0\.5 to 2\.5 mm .* 780 N·mm .* lower stiffness_nmm_per_deg or compr"
    ):
        spring_of("best-bo", replace(LIMITS, body_lengths_max_mm=(5.0,)))
    design, preload = load_design("best-bo"), math.radians(10.0)
    on_leg = springs_on_leg(design, None, preload)
    loaded = math.degrees(design.compression_rad) + 10.0
    torque = 500.0 * design.stiffness_nm_per_rad * (design.compression_rad + preload)
    with pytest.raises(CannotBuildError, match=rf" for {torque:.0f} N·mm at {loaded:.1f}° in 18 mm diameter and 5 mm"):
        synthesise_spring(on_leg, -1.0, WIRE, replace(LIMITS, body_lengths_max_mm=(5.0,)))


def test_the_longest_room_is_told_where_none_is_enough() -> None:
    with pytest.raises(CannotBuildError, match="in 18 mm diameter and 6 mm length"):
        spring_of("best-bo", replace(LIMITS, body_lengths_max_mm=(6.0, 4.0)))


def test_coils_are_neither_narrower_nor_wider_than_makers_wind_them() -> None:
    """Spring index, coil over wire, of 4 to 16 and three turns at least, whatever bushing it has to clear."""
    found = 0
    for mandrel in np.arange(2.0, 40.0, 2.0):
        roomy = replace(LIMITS, mandrel_min_mm=mandrel, outer_max_mm=60.0)
        for stiffness, turn in ((0.02, 0.4), (0.2, 0.2), (0.2, 0.8), (1.0, 1.0), (4.0, 0.2)):
            try:
                spring = synthesise_spring(Spring("leg", stiffness, turn), -1.5, WIRE, roomy)
            except CannotBuildError:
                continue
            found += 1
            assert 4.0 - 1e-9 <= (spring.outer_diameter_mm - spring.wire_mm) / spring.wire_mm <= 16.0
            assert spring.turns >= 3.0
    assert found > 5


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_a_preloaded_spring_keeps_to_room_and_bushing_whatever_they_are(name: str) -> None:
    design = load_design(name)
    on_leg, leg, found = springs_on_leg(design, None, math.radians(40.0)), -math.radians(design.rest_angle_deg), 0
    for length in np.linspace(8.0, 16.0, 17):
        for mandrel in (4.0, 5.5, 7.0):
            limits = replace(LIMITS, body_lengths_max_mm=(length,), mandrel_min_mm=mandrel, outer_max_mm=40.0)
            with suppress(CannotBuildError):
                spring = synthesise_spring(on_leg, leg, WIRE, limits)
                assert spring.body_length_mm <= length + 1e-6
                assert spring.mandrel_mm >= mandrel - 1e-6
                found += 1
    assert found > 20


@pytest.mark.parametrize("stiffness", [0.02, 0.2, 1.0])
def test_no_coil_is_wider_or_longer_than_its_room(stiffness: float) -> None:
    """From a room that no wire fits into to one that is larger than the coil."""
    found = refused = 0
    for outer in np.arange(6.0, 40.0, 2.0):
        for length in (0.5, 1.0, 2.0, 4.0, 8.0, 13.0):
            limits = replace(LIMITS, outer_max_mm=outer, body_lengths_max_mm=(length,), mandrel_min_mm=3.0)
            try:
                spring = synthesise_spring(Spring("leg", stiffness, 0.6), -1.5, WIRE, limits)
            except CannotBuildError:
                refused += 1
                continue
            found += 1
            assert spring.outer_diameter_mm <= outer + 1e-6
            assert spring.body_length_mm <= length + 1e-6
    assert found > 5
    assert refused > 20
