"""Torsion springs against beam theory, Winkler's curved bar, EN 13906-3, and the wire's length."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.each import each
from support.springs import LENGTH_MM, LIMITS, NAMES, WIRE, spring_of

from jumpcad.design import load_design
from jumpcad.drive.spring import Arms, beside_mm, between_pins_rad, free_arm_angle_rad, inner_fibre, torsion_spring
from jumpcad.drive.spring_choice import springs_on_leg, synthesise_spring


@pytest.mark.parametrize("name", NAMES)
def test_the_stress_is_that_of_a_curved_bar(name):
    """Winkler: the neutral axis of a curved round bar lies at (R + sqrt(R² - c²))/2 from the coil's axis."""
    design, spring = spring_of(name)
    c = spring.wire_mm / 2
    centre = (spring.outer_diameter_mm - spring.wire_mm) / 2
    neutral = (centre + math.sqrt(centre**2 - c**2)) / 2
    moment = 1000 * design.peak_spring_torque_nm / 2
    inner = moment * (neutral - (centre - c)) / (math.pi * c**2 * (centre - neutral) * (centre - c))
    assert inner <= spring.stress_mpa <= 1.025 * inner  # the standard's q is a little above it
    assert spring.stress_mpa <= spring.allowable_mpa + 1e-6


@pytest.mark.parametrize("name", NAMES)
def test_the_wound_coil_keeps_its_wire_and_clears_its_bushing(name):
    design, spring = spring_of(name)
    mean = spring.outer_diameter_mm - spring.wire_mm
    wound_turns = spring.turns + design.compression_rad / (2 * math.pi)
    wound_mean = mean * spring.turns / wound_turns
    assert wound_mean - spring.wire_mm - spring.mandrel_mm == pytest.approx(LIMITS.mandrel_clearance_mm)
    assert spring.mandrel_mm >= LIMITS.mandrel_min_mm - 1e-9
    assert spring.body_length_mm == pytest.approx((wound_turns + 1) * spring.wire_mm)
    assert spring.body_length_mm <= LENGTH_MM + 1e-9
    wire_length = math.pi * mean * spring.turns + 2 * spring.arm_length_mm
    assert spring.mass_g == pytest.approx(7.85e-3 * math.pi / 4 * spring.wire_mm**2 * wire_length)
    assert spring.arms.pin_radius_mm - spring.outer_diameter_mm / 2 == pytest.approx(LIMITS.arm_reach_mm, abs=1e-6)


@pytest.mark.parametrize("least_mm", [0.0, 14.0, 16.0])
def test_pins_keep_away_from_the_hub_though_the_coil_is_small(least_mm):
    """As far as hub and leg ask for; else as near as the coil and the arm's reach beside it allow."""
    coil_mm = 20.0
    limits = replace(LIMITS, pin_radius_min_mm=least_mm)
    assert limits.pin_radius_mm(coil_mm) == max(least_mm, 10.0 + limits.arm_reach_mm)
    _, spring = spring_of("kenan-2.0", limits)
    assert spring.arms.pin_radius_mm >= max(least_mm, spring.outer_diameter_mm / 2 + limits.arm_reach_mm) - 1e-6


@each("name", NAMES)
@each("preload_deg", [0.0, 15.0])
def test_a_preloaded_coil_winds_up_by_preload_and_travel_together(name, preload_deg):
    """Wire's length kept: D·n is the same relaxed and loaded. Body, bushing and stress keep their limits loaded."""
    design, preload = load_design(name), math.radians(preload_deg)
    on_leg = springs_on_leg(design, None, preload)
    limits = replace(LIMITS, outer_max_mm=40.0, body_lengths_max_mm=(15.0,))
    spring = synthesise_spring(on_leg, -math.radians(design.rest_angle_deg), WIRE, limits)
    loaded = spring.turns + (design.compression_rad + preload) / (2 * math.pi)
    mean = spring.outer_diameter_mm - spring.wire_mm
    assert mean * spring.turns / loaded - spring.wire_mm - limits.mandrel_clearance_mm == pytest.approx(
        spring.mandrel_mm
    )
    assert spring.mandrel_mm >= limits.mandrel_min_mm - 1e-9
    assert spring.body_length_mm == pytest.approx((loaded + 1) * spring.wire_mm)
    assert spring.body_length_mm <= 15.0 + 1e-9
    assert spring.torque_nmm == pytest.approx(500 * design.stiffness_nm_per_rad * (design.compression_rad + preload))
    assert spring.stress_mpa <= spring.allowable_mpa + 1e-6


@each("name", NAMES)
@each("plate_pin_deg", [20.0, 40.0, 75.0])
@each("preload_deg", [0.0, 4.0])
def test_relaxed_arms_are_tangents_that_touch_the_sides_of_their_pins(name, plate_pin_deg, preload_deg):
    """Drawn by complex numbers: along the coil from the plate's arm, and off along the tangent to the leg's pin."""
    design = load_design(name)
    on_leg, leg = springs_on_leg(design, None, math.radians(preload_deg)), -math.radians(design.rest_angle_deg)
    limits = replace(LIMITS, plate_pins_rad=(math.radians(plate_pin_deg),), outer_max_mm=30.0)
    spring = synthesise_spring(on_leg, leg, WIRE, limits)
    assert (spring.plate_pin_rad, spring.leg_pin_rad) == (math.radians(plate_pin_deg), leg)
    mean, beside = spring.arms.mean_mm, (spring.wire_mm + limits.pin_mm) / 2
    pins = [spring.arms.pin_radius_mm * np.exp(1j * angle) for angle in (math.radians(plate_pin_deg), leg)]

    def from_line(pin, start, along):
        """Return how far a pin's axis is to the right of a line, and how far along."""
        offset = (pin - start) / along
        return -offset.imag, offset.real

    out = np.exp(1j * (math.radians(plate_pin_deg) + spring.arms.turn_rad))
    beside_plate, along_plate = from_line(pins[0], mean / 2 * out, -1j * out)
    assert -beside_plate == pytest.approx(beside, abs=1e-6)
    assert 0 < along_plate < spring.arm_length_mm
    # counter-clockwise by the relaxed turns, then closed by the preload
    out *= np.exp(1j * (2 * math.pi * spring.turns + math.radians(preload_deg)))
    beside_leg, along_leg = from_line(pins[1], mean / 2 * out, 1j * out)
    assert beside_leg == pytest.approx(beside, abs=2e-4)
    assert along_leg == pytest.approx(along_plate, abs=2e-4)
    # the force square to the arm has the arm's length for a lever
    assert spring.pin_force_n * along_leg == pytest.approx(500 * on_leg.peak_torque_nm, rel=1e-4)


@pytest.mark.parametrize(("index", "q"), [(4.0, 1.252), (6.0, 1.156), (10.0, 1.089), (16.0, 1.054)])
def test_the_stress_factor_is_that_of_en_13906_3(index, q):
    """q = (w + 0.07)/(w - 0.75)."""
    assert inner_fibre(index) == pytest.approx(q, abs=5e-4)


def test_the_wire_of_each_side_turns_as_its_hand_says():
    """A curve is right-handed where its torsion is positive, first x second · third derivative (Frenet).

    From the plate outside to the leg inside, counter-clockwise from the robot's right; x forward, y left, z up.
    """
    _, spring = spring_of("kenan-2.0")
    for side, hand in zip((1.0, -1.0), spring.hands, strict=True):
        first, second, third = np.array([[0.0, -side, 1.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])  # at the front
        assert hand == ("right" if np.cross(first, second) @ third > 0.0 else "left")


def test_a_made_spring_that_is_stressed_too_much_asks_for_a_softer_design():
    """One from stock has its own stiffness, and asks for another."""
    for stock, asked in (("", "lower stiffness_nmm_per_deg or compression_ratio"), ("own", "another bought.spring")):
        made = spring_of("kenan-2.0")[1]
        on_leg, pins = springs_on_leg(load_design("kenan-2.0")), (made.plate_pin_rad, made.leg_pin_rad)
        (finding,) = torsion_spring(made.arms, made.turns, on_leg, made.tensile_mpa, WIRE, LIMITS, pins, stock).findings
        assert (finding.value, finding.limit) == pytest.approx((made.stress_mpa, made.allowable_mpa))
        assert asked in finding.remedy
        assert ("stiffness_nmm_per_deg" in finding.remedy) == (stock == "")


@pytest.mark.parametrize(("turns", "degrees"), [(5.0, 180.0), (5.25, 90.0), (5.5, 0.0), (5.75, 270.0), (0.25, 90.0)])
def test_arms_of_whole_turns_point_in_opposite_directions(turns: float, degrees: float) -> None:
    """A quarter of a turn more closes them to a right angle."""
    assert math.degrees(free_arm_angle_rad(turns)) == pytest.approx(degrees, abs=1e-9)


@pytest.mark.parametrize(("plate", "leg", "between"), [(10.0, 100.0, 90.0), (100.0, 10.0, 270.0), (-30.0, 30.0, 60.0)])
def test_pins_are_counted_counter_clockwise_from_the_plates(plate: float, leg: float, between: float) -> None:
    assert math.degrees(between_pins_rad(math.radians(plate), math.radians(leg))) == pytest.approx(between)


def test_an_arm_touches_coil_and_pin() -> None:
    """Coil of 8 mm mean and 1 mm wire on a pin of 3 mm: axes 6 mm apart square to the arm; with 10 mm along it 11.7.

    The arm's axis is a tangent of the coil's mean circle; the pin's surface is half a wire beside it.
    """
    arms = Arms(8.0, 1.0, 3.0, 10.0)
    assert beside_mm(8.0, 1.0, 3.0) == 6.0
    assert arms.pin_radius_mm == pytest.approx(math.sqrt(136.0))
    tangent = np.array([4.0, 0.0])
    touched = tangent + np.array([0.0, 10.0])
    pin = touched + np.array([0.5 + 1.5, 0.0])
    assert np.hypot(*pin) == pytest.approx(arms.pin_radius_mm)
    assert arms.turn_rad == pytest.approx(math.atan2(pin[1], pin[0]))
    assert Arms.to_pins(8.0, 1.0, 3.0, math.sqrt(136.0)).lever_mm == pytest.approx(10.0)


def test_both_arms_bend_as_a_third_of_their_length_of_coil() -> None:
    """A cantilever with a force at its end gives way there by F·l³/(3·E·I): as much as l/3 of wire in pure bending.

    Wire of a turn: pi·D. Two arms of 12 mm on a coil of 8 mm: 8 mm over 25.1 mm.
    """
    assert Arms(8.0, 1.0, 3.0, 12.0).arm_turns == pytest.approx(2.0 * 12.0 / 3.0 / (8.0 * math.pi))
