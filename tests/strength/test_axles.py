"""Axles and pins as round bars, and what holds them along their axes."""

import math

import pytest
from support.workshops import workshop_with

from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.strength.axles import (
    SCREW_CORE_MM,
    SCREW_THREAD_MM,
    RoundBar,
    axle_bar,
    clipped_pins,
    pin_bar,
    pin_head_mm,
)
from jumpcad.workshop import Workshop, load_workshop


def workshop(**bought: object) -> Workshop:
    return workshop_with(bought=bought)


def test_a_bored_bar_by_the_handbook() -> None:
    """32·M·D/(pi·(D⁴ - d⁴)): 400 N·mm on 4 x 2 mm are 67.9 MPa, and without the bore 63.7."""
    assert RoundBar(4.0, 0.0, 1.0, 1.0).stress_mpa(400.0) == pytest.approx(32.0 * 400.0 / (math.pi * 64.0))
    assert RoundBar(4.0, 2.0, 1.0, 1.0).stress_mpa(400.0) == pytest.approx(12800.0 * 4.0 / (math.pi * 240.0))


def test_a_rod_in_blind_bores_is_held_by_their_floors() -> None:
    """The floor shears off around the rod: pi·d·t·(strength/sqrt 3), over the printed parts' factor."""
    shop = workshop(axle_mm=3.0)
    bar, rod = axle_bar(shop), shop.catalogue.rods[shop.bought.axle]
    strength = shop.material("body").strength_in_plane_mpa
    held = math.pi * 3.0 * AXLE_FLOOR_MM * strength / math.sqrt(3.0) / shop.safety.printed_factor
    assert bar.axial_n == pytest.approx(held, rel=1e-3)
    assert bar.yield_mpa == min(rod.yield_mpa, shop.safety.steel_yield_mpa)
    assert (bar.diameter_mm, bar.bore_mm) == (3.0, rod.bore_share * 3.0)


def test_a_clip_bears_its_rating_and_a_screw_its_yield_stress() -> None:
    clips = workshop(retention="clips", axle="silver-steel")
    assert axle_bar(clips).axial_n == clips.catalogue.clip_for(3.0).load_n / clips.safety.metal_factor
    nuts = axle_bar(workshop(retention="nuts"))
    assert nuts.bore_mm == 0.0
    assert nuts.axial_n == pytest.approx(5.03 * nuts.yield_mpa / load_workshop().safety.metal_factor, rel=1e-2)


def test_pins_are_clevis_pins_where_they_are_made_and_rods_elsewhere() -> None:
    """ISO 2341 begins at 3 mm. M3's stressed area is 5.03 mm² (ISO 898-1)."""
    usual = workshop(axle_mm=3.0)
    pin = usual.catalogue.clevis_pin_for(3.0)
    assert clipped_pins(usual.catalogue, usual.bought) is None
    assert pin_head_mm(usual.catalogue, usual.bought) == pin.head_mm
    bar = pin_bar(usual)
    assert (bar.diameter_mm, bar.bore_mm) == (pin.diameter_mm, 0.0)
    assert bar.axial_n == pin.load_n / usual.safety.metal_factor
    assert bar.yield_mpa == min(pin.yield_mpa, usual.safety.steel_yield_mpa)
    clips = workshop(retention="clips", axle="silver-steel")
    rod = clips.catalogue.rods["silver-steel"]
    assert clipped_pins(clips.catalogue, clips.bought) == rod
    assert pin_head_mm(clips.catalogue, clips.bought) == clips.catalogue.clip_for(3.0).outer_mm
    held = pin_bar(clips)
    assert held.axial_n == clips.catalogue.clip_for(3.0).load_n / clips.safety.metal_factor
    assert (held.diameter_mm, held.bore_mm) == (3.0, 3.0 * rod.bore_share)
    thin = workshop(axle_mm=2.0)
    assert clipped_pins(thin.catalogue, thin.bought) is not None


def test_the_weaker_of_rod_and_the_workshops_steel_counts() -> None:
    """A tube of 1.4301, 3 x 0.5 mm, yields at 210 MPa (EN 10217-7); of spring steel a workshop may trust 900 MPa."""
    tube = axle_bar(workshop(axle="steel-tube", axle_mm=3.0))
    assert (tube.yield_mpa, tube.bore_mm) == (210.0, pytest.approx(2.0, abs=1e-3))
    shop = workshop(axle="spring-steel", axle_mm=3.0)
    careful = workshop_with(shop, safety={"steel_yield_mpa": 900.0})
    assert axle_bar(careful).yield_mpa == 900.0
    tubes = workshop(retention="clips", axle="steel-tube", axle_mm=3.0)
    assert pin_bar(tubes).yield_mpa == 210.0
    stout = workshop_with(shop, safety={"steel_yield_mpa": 123.0})
    assert pin_bar(stout).yield_mpa == 123.0  # clevis pins too
    thin = workshop(axle_mm=2.0)
    careful = workshop_with(thin, safety={"steel_yield_mpa": 300.0})
    assert (pin_bar(thin).yield_mpa, pin_bar(careful).yield_mpa) == (400.0, 300.0)


def test_screws_as_axles_are_of_class_12_9() -> None:
    """M3: shank 2.86 mm at least, 1080 MPa, thread of 18 mm (ISO 4762), and its run-out of 5 pitches at most."""
    screw = axle_bar(workshop(retention="nuts"))
    assert (screw.diameter_mm, screw.yield_mpa) == (2.86, 1080.0)
    assert 18.0 < SCREW_THREAD_MM <= 18.0 + 5.0 * 0.5
    core = 3.0 - 1.22687 * 0.5  # ISO 724: d - 1.22687·P
    assert core == pytest.approx(SCREW_CORE_MM, abs=0.01)
