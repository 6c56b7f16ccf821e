"""Electrical articles: voltages of lithium cells, and figures of motors that energy forbids."""

import math

import pytest
from pydantic import ValidationError

from jumpcad.catalogue import Battery, Motor, load_catalogue


@pytest.mark.parametrize(
    ("voltage_v", "cells", "empty_v", "full_v"),
    [(3.6, 1, 3.3, 4.2), (3.7, 1, 3.3, 4.2), (7.4, 2, 6.6, 8.4), (22.2, 6, 19.8, 25.2)],
)
def test_a_pack_has_the_voltage_of_its_cells(voltage_v: float, cells: int, empty_v: float, full_v: float) -> None:
    pack = Battery(
        name="own", source="a label", description="pack", length_mm=30.0, width_mm=20.0, height_mm=8.0, mass_g=9.0,
        voltage_v=voltage_v, capacity_mah=300.0,
    )  # fmt: skip
    assert pack.cells == cells
    assert pack.range_v == pytest.approx((empty_v, full_v))
    assert pack.bears_ma == 300.0  # 1 C


def test_a_motor_without_a_stated_range_runs_from_a_quarter_of_its_rated_voltage_to_all_of_it() -> None:
    motor = next(iter(load_catalogue().motors.values()))
    for volts in (3.0, 6.0, 12.0):
        rated = motor.model_copy(update={"voltage_v": volts, "bears_v": None})
        assert rated.range_v == pytest.approx((volts / 4.0, volts))
    assert motor.model_copy(update={"bears_v": (4.0, 7.5)}).range_v == (4.0, 7.5)


def test_a_motor_gives_no_more_power_than_it_draws() -> None:
    for motor in load_catalogue().motors.values():
        in_nmm = motor.model_copy(update={"stall_torque_nm": 1000.0 * motor.stall_torque_nm})
        assert [place for place, *_ in in_nmm.contradictions()] == [("stall_torque_nm",)]


def test_a_motor_is_refused_by_its_figures_from_just_beyond_what_can_be() -> None:
    """A steel rod's mass by 7.85 g/cm³; a DC machine's torque constant is its back-EMF's, (V - I·R)/ω."""
    motor = next(iter(load_catalogue().motors.values()))
    steel = 7.85e-3 * math.pi / 4.0 * motor.shaft_mm**2 * motor.shaft_length_mm
    winding_ohm = motor.voltage_v / motor.stall_current_a
    back_emf_v = motor.voltage_v - motor.no_load_current_a * winding_ohm
    per_a = back_emf_v / (2.0 * math.pi * motor.no_load_rpm / 60.0)
    torque = per_a * (motor.stall_current_a - motor.no_load_current_a)
    narrow = min(motor.width_mm, motor.height_mm)
    for key, value, inwards in (
        ("shaft_flat_mm", motor.shaft_mm / 2.0, 1.0), ("shaft_flat_mm", motor.shaft_mm, -1.0),
        ("boss_mm", motor.shaft_mm - 1e-9, 1.0), ("boss_mm", narrow + 1e-9, -1.0),
        ("shaft_length_mm", motor.boss_length_mm, 1.0), ("mass_g", steel, 1.0),
        ("no_load_current_a", motor.stall_current_a, -1.0), ("stall_torque_nm", torque * (1.0 + 1e-9), -1.0),
    ):  # fmt: skip
        beyond = {place: told for place, told, _ in motor.model_copy(update={key: value}).contradictions()}
        assert beyond[key,] == value, key
        inside = motor.model_copy(update={key: value + inwards * 1e-6 * value})
        assert (key,) not in [place for place, *_ in inside.contradictions()], key


def test_a_motor_from_a_drawer_has_the_torque_of_its_speed_and_stall_current() -> None:
    """Pololu's data sheets state the torque: 0.48 to 0.70 of a lossless machine's. 100 % is borne, 101 % not."""
    for motor in load_catalogue().motors.values():
        figures = motor.model_dump(exclude={"stall_torque_nm", "ratio"}) | {"name": "own"}
        share = motor.stall_torque_nm / Motor(**figures, efficiency=1.0).stall_torque_nm
        assert 0.47 < share < 0.71, motor.name
        assert Motor(**figures, efficiency=share).stall_torque_nm == pytest.approx(motor.stall_torque_nm, rel=1e-3)
        assert not list(Motor(**figures).contradictions())
        ((*_, reason),) = Motor(**figures, stall_torque_nm=1.01 * Motor(**figures).lossless_nm).contradictions()
        assert "101 %" in reason
        with pytest.raises(ValidationError, match="efficiency"):
            Motor(**figures, efficiency=1.01)


@pytest.mark.parametrize(
    ("voltage_v", "empty_v", "full_v", "refused"),
    [
        (3.7, 3.0, 4.2, None), (3.85, 3.3, 4.35, None), (11.1, 9.9, 12.6, None), (3.2, 3.0, 3.65, "full_v"),
        (6.4, 6.0, 7.3, "full_v"), (4.0, 3.3, 4.19, "full_v"), (7.4, 5.9, 8.4, "empty_v"),
    ],
)  # fmt: skip
def test_a_battery_that_a_lipo_charger_would_overcharge_is_refused(
    voltage_v: float, empty_v: float, full_v: float, refused: str | None
) -> None:
    """4.2 V a cell, and 3.0 V at least, of lithium polymer; iron phosphate cells are full at 3.65 V."""
    figures = {"voltage_v": voltage_v, "empty_v": empty_v, "full_v": full_v}
    battery = load_catalogue().batteries["lipo-1s-300"].model_copy(update=figures)
    assert [place for place, *_ in battery.contradictions()] == ([(refused,)] if refused else [])


def test_a_battery_in_ampere_hours_or_kilograms_is_refused() -> None:
    """Lithium packs hold 80 to 265 Wh/kg; 300 mAh of 3.7 V in 8 g are 139. A digit too many or too few is told too."""
    battery = load_catalogue().batteries["lipo-1s-300"]
    for key, value, refused in (
        ("capacity_mah", 200.0, False), ("capacity_mah", 550.0, False), ("capacity_mah", 0.3, True),
        ("capacity_mah", 3e5, True), ("capacity_mah", 3000.0, True), ("capacity_mah", 30.0, True),
        ("mass_g", 6.0, False), ("mass_g", 0.008, True), ("mass_g", 80.0, True),
    ):  # fmt: skip
        found = battery.model_copy(update={key: value}).contradictions()
        assert [place for place, *_ in found] == [("capacity_mah",)] * refused, (key, value)


def test_a_cell_of_unknown_resistance_has_0_15_ohm() -> None:
    battery = load_catalogue().batteries["lipo-2s-180"]
    assert battery.ohm == battery.resistance_ohm == 0.4
    assert battery.model_copy(update={"resistance_ohm": None}).ohm == pytest.approx(2 * 0.15)


def test_of_the_shipped_small_parts_the_diode_alone_drops_a_voltage() -> None:
    """A Schottky diode has about 0.3 V; a contact, a plug or a capacitor that says nothing of it has none."""
    drops = {name: one.drop_v for name, one in load_catalogue().components.items() if one.drop_v}
    assert list(drops.values()) == [0.3]
    assert [load_catalogue().components[name].kind for name in drops] == ["diode"]
