"""Axles and pins as round bars, and what holds them along their axes."""

import math

import numpy as np
import pytest
from support.workshops import workshop_with

from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.drive.gears import gear_pair
from jumpcad.strength.axles import (
    SCREW_CORE_MM,
    SCREW_THREAD_MM,
    AxleBeam,
    RoundBar,
    axle_bar,
    clipped_pins,
    mesh_force_n,
    on_hub,
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


UP = np.array([0.0, 1.0])


def test_one_load_bends_by_its_distances_to_both_plates() -> None:
    """M = F·a·b/l under the load, reactions F·b/l and F·a/l (Shigley, table A-9)."""
    beam = AxleBeam.of((30.0, -10.0), (20.0, 80.0 * UP))
    assert beam.largest_nmm() == pytest.approx(80.0 * 30.0 * 10.0 / 40.0)
    assert beam.on_plates_n() == pytest.approx(np.array([[0.0, 60.0], [0.0, 20.0]]))
    assert beam.plate_load_n == pytest.approx(60.0)
    # towards the right plate the moment falls evenly to nothing
    assert beam.largest_nmm(up_to_mm=5.0) == pytest.approx(0.5 * beam.largest_nmm())
    assert beam.moments_nmm(np.array([-10.0, 30.0])) == pytest.approx([0.0, 0.0])


def test_two_equal_loads_bend_evenly_between_them() -> None:
    """M = F·a, a from either plate (Shigley, table A-9); opposite ones leave half of it at each, and none between."""
    beam = AxleBeam.of((20.0, -20.0), (12.0, 50.0 * UP), (-12.0, 50.0 * UP))
    assert beam.moments_nmm(np.array([-12.0, 0.0, 5.0, 12.0])) == pytest.approx([400.0] * 4)
    couple = AxleBeam.of((20.0, -20.0), (12.0, 50.0 * UP), (-12.0, -50.0 * UP))
    assert couple.moments_nmm(np.array([-12.0, 0.0])) == pytest.approx([50.0 * 24.0 / 40.0 * 8.0, 0.0])


def test_plates_carry_force_and_moment_of_any_loads() -> None:
    random = np.random.default_rng(5)
    places, forces = random.uniform(-15.0, 20.0, 6), random.normal(size=(6, 2))
    beam = AxleBeam((24.0, -19.0), places, forces)
    left, right = beam.on_plates_n()
    assert left + right == pytest.approx(forces.sum(axis=0))
    assert 24.0 * left - 19.0 * right == pytest.approx(places @ forces)
    # planes at right angles do not help each other: the moments add as vectors
    apart = [AxleBeam((24.0, -19.0), places, forces * axis).moments_nmm(places) for axis in np.eye(2)]
    assert beam.moments_nmm(places) == pytest.approx(np.hypot(*apart))


@pytest.mark.parametrize("place", [0.0, 2.0, 7.0])
def test_a_hub_passes_on_force_and_moment(place: float) -> None:
    """Pushed where a bearing is, that bearing has it all; beyond, it has more and the other one pulls."""
    (near, most), (far, least) = on_hub(30.0 * UP, 2.0, place)
    assert most + least == pytest.approx(30.0 * UP)
    assert near * most + far * least == pytest.approx(place * 30.0 * UP)
    assert (least[1] > 0.0) == (place < 2.0 - 1e-9)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_teeth_turn_the_wheel_and_push_it_away(sense: float) -> None:
    """About the wheel's axis the force has the torque; its line touches both base circles, since it is normal there."""
    pair = gear_pair(12, 30, 1.0, 5.0, 0.2)
    wheel = np.array([3.0, -2.0])
    for direction in (0.3, 2.0, 4.4):
        pinion = wheel + pair.centre_distance_mm * np.array([math.cos(direction), math.sin(direction)])
        force = mesh_force_n(500.0, pair, wheel, pinion, sense)
        pitch = pair.wheel.teeth / (pair.wheel.teeth + pair.pinion.teeth)
        contact = wheel + pitch * (pinion - wheel)
        about = [_about_y(contact - axis, force) for axis in (wheel, pinion)]
        assert about[0] == pytest.approx(sense * 500.0)
        # the pinion feels it backwards, and turns the other way
        assert about[1] == pytest.approx(-sense * 500.0 * pair.pinion.teeth / pair.wheel.teeth)
        assert force @ (wheel - pinion) > 0.0
        assert abs(about[1]) / np.linalg.norm(force) == pytest.approx(pair.pinion.base_radius_mm)


def _about_y(arm: np.ndarray, force: np.ndarray) -> float:
    """Moment about +y of a force at an arm, both x-z."""
    return float(arm[1] * force[0] - arm[0] * force[1])
