"""Torsion springs against beam theory, Winkler's curved bar, the length of the wire, and a brute-force search."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.drive.spring import synthesise_spring
from jumpcad.errors import CannotBuildError

WIRE = load_catalogue().wire
LENGTH_MM = 13.0
LIMITS = replace(default_limits().spring, body_lengths_max_mm=(LENGTH_MM,), pin_radius_min_mm=0.0)
NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"]


def spring_of(name, limits=LIMITS):
    design = load_design(name)
    return design, synthesise_spring(design.stiffness_nm_per_rad, design.compression_rad, WIRE, limits)


@pytest.mark.parametrize("name", NAMES)
def test_the_two_springs_have_the_designs_stiffness_as_bent_wire(name):
    """A wire of length l in pure bending turns by M·l/(E·I); the handbook's 10.8 for 10.19 is 6 % for friction."""
    design, spring = spring_of(name)
    mean = spring.outer_diameter_mm - spring.wire_mm
    # An arm loaded at its end bends a third as much as the same length of coil (Castigliano).
    length = math.pi * mean * spring.turns + 2 * spring.arm_length_mm / 3
    bending = WIRE.modulus_mpa * math.pi * spring.wire_mm**4 / 64 / length / 1000
    assert bending == pytest.approx(spring.stiffness_nm_per_rad * 10.8 / (32 / math.pi), rel=1e-3)
    assert 2 * spring.stiffness_nm_per_rad == pytest.approx(design.stiffness_nm_per_rad)


@pytest.mark.parametrize("name", NAMES)
def test_the_stress_is_that_of_a_curved_bar(name):
    """Winkler: the neutral axis of a curved round bar lies at (R + sqrt(R² - c²))/2 from the coil's axis."""
    design, spring = spring_of(name)
    c = spring.wire_mm / 2
    centre = (spring.outer_diameter_mm - spring.wire_mm) / 2
    neutral = (centre + math.sqrt(centre**2 - c**2)) / 2
    moment = 1000 * design.peak_spring_torque_nm / 2
    inner = moment * (neutral - (centre - c)) / (math.pi * c**2 * (centre - neutral) * (centre - c))
    assert spring.stress_mpa == pytest.approx(inner, rel=0.01)
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
    reach = math.hypot(mean / 2, spring.arm_length_mm)
    assert reach - spring.outer_diameter_mm / 2 == pytest.approx(LIMITS.arm_reach_mm, abs=1e-3)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_no_smaller_spring_does_the_work(name):
    """Every wire and many coil diameters below the chosen one break a limit."""
    design, spring = spring_of(name)
    stiffness = design.stiffness_nm_per_rad / 2
    for d, tensile in zip(WIRE.diameters_mm, WIRE.tensile_strength_mpa, strict=True):
        for outer in np.linspace(2 * d, spring.outer_diameter_mm - 0.05, 60):
            mean = outer - d
            arm = math.sqrt((outer / 2 + LIMITS.arm_reach_mm) ** 2 - (mean / 2) ** 2)
            active = WIRE.modulus_mpa * d**4 / (10.8 * mean * 1000 * stiffness * 2 * math.pi)
            turns = active - 2 * arm / (3 * math.pi * mean)
            index = mean / d
            if not 4 <= index <= 16 or turns < 2:
                continue
            wound = turns + design.compression_rad / (2 * math.pi)
            correction = (4 * index**2 - index - 1) / (4 * index * (index - 1))
            stress = correction * 32 * 1000 * stiffness * design.compression_rad / (math.pi * d**3)
            fits = (
                (wound + 1) * d <= LENGTH_MM
                and mean * turns / wound - d >= LIMITS.mandrel_min_mm + LIMITS.mandrel_clearance_mm
                and stress <= LIMITS.stress_share * tensile
            )
            assert not fits, f"wire {d} mm, outer diameter {outer:.2f} mm"


def test_a_short_body_is_preferred_to_a_thin_one_where_it_fits():
    _, short = spring_of("best-bo", replace(LIMITS, body_lengths_max_mm=(10.0, 13.0)))
    _, thin = spring_of("best-bo", replace(LIMITS, body_lengths_max_mm=(5.0, 13.0)))
    assert short.body_length_mm <= 10.0 + 1e-9 < thin.body_length_mm
    assert short.outer_diameter_mm > thin.outer_diameter_mm


def test_no_room_is_refused_with_what_to_change():
    with pytest.raises(CannotBuildError, match=r"no wire of 0\.5 to 2\.5 mm .* 780 N·mm .* stiffness_nmm_per_deg"):
        spring_of("best-bo", replace(LIMITS, body_lengths_max_mm=(5.0,)))


def test_coils_are_neither_narrower_nor_wider_than_makers_wind_them():
    """Spring index, coil over wire, of 4 to 16 and two turns at least, whatever bushing it has to clear."""
    found = 0
    for mandrel in np.arange(2.0, 40.0, 2.0):
        roomy = replace(LIMITS, mandrel_min_mm=mandrel, outer_max_mm=60.0)
        for stiffness, turn in ((0.02, 0.4), (0.2, 0.2), (0.2, 0.8), (1.0, 1.0), (4.0, 0.2)):
            try:
                spring = synthesise_spring(stiffness, turn, WIRE, roomy)
            except CannotBuildError:
                continue
            found += 1
            assert 4.0 - 1e-9 <= (spring.outer_diameter_mm - spring.wire_mm) / spring.wire_mm <= 16.0
            assert spring.turns >= 2.0
    assert found > 5
