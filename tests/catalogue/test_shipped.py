"""The catalogue against standards and physics, and its answers to names that it does not have."""

import math

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import JumpcadError

CATALOGUE = load_catalogue()


def test_bearings_have_the_boundary_dimensions_of_iso_15():
    # d x D x B of diameter series 2 and 8 (width series 3 of shielded ones), and the makers' MR series.
    expected = {"623": (3, 10, 4), "683": (3, 7, 3), "MR63": (3, 6, 2.5)}
    for name, size in expected.items():
        bearing = CATALOGUE.bearings[name]
        assert (bearing.bore_mm, bearing.outer_mm, bearing.width_mm) == size


def test_screws_and_nuts_have_the_sizes_of_iso_4762_and_4032():
    m3, m2 = CATALOGUE.screws["M3"], CATALOGUE.screws["M2"]
    assert (m3.cylinder_head_mm, m3.cylinder_head_height_mm) == (5.5, 3.0)
    assert (m2.cylinder_head_mm, m2.cylinder_head_height_mm) == (3.8, 2.0)
    assert (CATALOGUE.nuts["M3"].across_flats_mm, CATALOGUE.nuts["M3"].height_mm) == (5.5, 2.4)
    assert (CATALOGUE.nuts["M2"].across_flats_mm, CATALOGUE.nuts["M2"].height_mm) == (4.0, 1.6)


def test_a_screws_low_head_is_that_of_its_standard():
    """Of ISO 7380-1 5.7 mm wide and 1.65 mm high at M3; with the collar of part 2, 6.9 mm. M2 is a cheese head."""
    m3, m2 = CATALOGUE.screws["M3"], CATALOGUE.screws["M2"]
    assert (m3.norm, m3.button_head_mm, m3.button_head_height_mm) == ("ISO 7380-1", 5.7, 1.65)
    assert (m2.norm, m2.button_head_mm, m2.button_head_height_mm) == ("ISO 14580", 3.8, 1.55)


def test_nuts_weigh_their_hexagon_less_the_thread():
    for name, thread in (("M3", 3.0), ("M2", 2.0)):
        nut = CATALOGUE.nuts[name]
        area = math.sqrt(3) / 2 * nut.across_flats_mm**2 - math.pi / 4 * (0.9 * thread) ** 2
        assert nut.mass_g == pytest.approx(7.85e-3 * area * nut.height_mm, rel=0.15)


def test_motors_obey_energy_conservation():
    """Mechanical power at half speed and half torque stays below the electrical power there, and is not absurd."""
    for motor in CATALOGUE.motors.values():
        power = motor.no_load_rpm * math.pi / 30 / 2 * motor.stall_torque_nm / 2
        drawn = motor.voltage_v * (motor.no_load_current_a + motor.stall_current_a) / 2
        assert 0.1 < power / drawn < 0.6, motor.name


def test_one_motor_behind_all_gearboxes():
    """Of the LP family: speed times ratio is the bare motor's; torque over ratio falls only by the gearbox's losses."""
    for motor in (motor for name, motor in CATALOGUE.motors.items() if name.count("-") == 1):
        assert motor.no_load_rpm * motor.ratio == pytest.approx(13500, rel=0.04)
        assert motor.stall_torque_nm / motor.ratio == pytest.approx(8e-4, rel=0.25)


def test_stronger_wire_is_thinner_and_follows_the_standards_logarithm():
    # EN 10270-1 states Rm of grade SM as 1980 - 740·lg(d) MPa at the lower limit.
    wire = CATALOGUE.wire
    assert wire.diameters_mm == sorted(wire.diameters_mm)
    for diameter, strength in zip(wire.diameters_mm, wire.tensile_strength_mpa, strict=True):
        assert strength == pytest.approx(1980 - 740 * math.log10(diameter), abs=15)


def test_strength_is_linear_between_the_wires_of_the_list_and_beyond_them():
    rows = {1.0: 2000.0, 2.0: 1900.0, 4.0: 1500.0}
    listed = CATALOGUE.wire.model_copy(update={"diameters_mm": list(rows), "tensile_strength_mpa": list(rows.values())})
    for diameter, strength in (rows | {0.5: 2050.0, 1.5: 1950.0, 3.0: 1700.0, 5.0: 1300.0}).items():
        assert listed.tensile_mpa(diameter) == pytest.approx(strength)


def test_a_rod_weighs_its_volume_of_steel():
    assert CATALOGUE.rod_mass_g(3.0, 100.0) == pytest.approx(5.55, abs=0.01)


def test_the_shortest_long_enough_screw_is_taken():
    assert CATALOGUE.screws["M3"].length_for(10.5) == 12.0
    for length in CATALOGUE.screws["M3"].lengths_mm:  # one that is just long enough, also by a sum with round-off
        assert CATALOGUE.screws["M3"].length_for(length) == CATALOGUE.screws["M3"].length_for(length + 1e-12) == length
    with pytest.raises(JumpcadError, match=r"no M3 screw of 99\.0 mm; the longest in stock is 30 mm"):
        CATALOGUE.screws["M3"].length_for(99.0)


def test_clips_and_clevis_pins_are_found_by_their_shafts():
    assert (CATALOGUE.clip_for(3.0).groove_mm, CATALOGUE.clip_for(2.0).groove_mm) == (2.3, 1.5)  # DIN 6799
    assert CATALOGUE.clevis_pin_for(3.0).head_mm == 5.0  # ISO 2341
    with pytest.raises(JumpcadError, match=r"bought\.axle_mm = 2\.5: no clip of that size \(2, 3.* mm\): use one"):
        CATALOGUE.clip_for(2.5)
    with pytest.raises(JumpcadError, match=r"bought\.axle_mm = 2: no clevis pin of that size"):
        CATALOGUE.clevis_pin_for(2.0)
