"""The motor at a battery's voltage against Kirchhoff's law, and figures that were derived by hand."""

import math
from dataclasses import replace

import pytest
from support.built import with_kit
from support.each import each
from support.limits import default_limits

from jumpcad.catalogue import load_catalogue
from jumpcad.drive.motor import allowed_nm
from jumpcad.electronics.chain import chain
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import Supply, supply_of

MOTORS = load_catalogue().motors
BARE = Supply(empty_v=3.3, nominal_v=3.7, full_v=4.2, ohm=0.0, boards_w=0.0, usable_j=1.0)
UNLIMITED = 1e3


@pytest.mark.parametrize(
    ("name", "rpm", "stall_nm", "stall_a"),
    [("n20-298", 26.7, 0.1165, 0.222), ("n20-298-mp", 41.8, 0.1346, 0.413)],
)
def test_motors_of_6_v_on_one_cell(name: str, rpm: float, stall_nm: float, stall_a: float) -> None:
    """By hand with the linear model at 3.7 V, R = 6 V over the stall current: LP 20 and 360 mA, MP 70 and 670 mA."""
    driven = BARE.driven(MOTORS[name], 3.7, UNLIMITED)
    assert driven.no_load_rpm == pytest.approx(rpm, rel=0.02)
    assert driven.stall_torque_nm == pytest.approx(stall_nm, rel=0.02)
    assert driven.stall_current_a == pytest.approx(stall_a, rel=0.02)


@pytest.mark.parametrize(("volts", "rpm", "stall_nm"), [(6.6, 57, 0.152), (7.4, 65, 0.175), (8.4, 76, 0.204)])
def test_the_12_v_motor_on_two_cells(volts: float, rpm: float, stall_nm: float) -> None:
    driven = BARE.driven(MOTORS["n20-298-hpcb12"], volts, UNLIMITED)
    assert driven.no_load_rpm == pytest.approx(rpm, rel=0.02)
    assert driven.stall_torque_nm == pytest.approx(stall_nm, rel=0.01)


@each("ohm", [0.0, 0.5, 3.0])
@each("name", ["n20-298", "n20-298-mp", "n20-75-hpcb12"])
def test_every_working_point_obeys_kirchhoff(name: str, ohm: float) -> None:
    """U = I·(R + r) + k·speed at no load, half torque and stall, and torque rises in proportion to current."""
    motor, volts = MOTORS[name], 5.0
    supply = Supply(4.0, volts, 5.5, ohm, 0.0, 1.0)
    driven = supply.driven(motor, volts, UNLIMITED)
    winding = motor.voltage_v / motor.stall_current_a
    k = (motor.voltage_v - motor.no_load_current_a * winding) / (motor.no_load_rpm * math.pi / 30.0)
    per_a = motor.stall_torque_nm / (motor.stall_current_a - motor.no_load_current_a)
    for share in (0.0, 0.5, 1.0):
        current = driven.no_load_current_a + share * (driven.stall_current_a - driven.no_load_current_a)
        speed = driven.no_load_rpm * math.pi / 30.0 * (1.0 - share)
        assert current * (winding + ohm) + k * speed == pytest.approx(volts)
        assert share * driven.stall_torque_nm == pytest.approx(per_a * (current - motor.no_load_current_a))


def test_at_its_own_voltage_a_motor_is_as_in_the_catalogue() -> None:
    motor = MOTORS["n20-298"]
    assert BARE.driven(motor, 6.0, UNLIMITED).no_load_rpm == pytest.approx(motor.no_load_rpm)


def test_pwm_keeps_the_blocked_gearbox_at_its_limit() -> None:
    """Without resistance before it, the capped motor stalls with the limit itself: 4 % under the uncapped 0.204 N·m."""
    supply, motor = Supply(6.6, 7.4, 8.4, 0.0, 0.0, 1.0), MOTORS["n20-298-hpcb12"]
    assert supply.driven(motor, 8.4, 0.196).stall_torque_nm == pytest.approx(0.196)
    assert supply.duty(motor, 0.196) == pytest.approx(0.97, abs=0.005)
    assert BARE.duty(MOTORS["n20-298-mp"], 0.196) == 1.0


def test_pwm_keeps_a_winding_at_its_voltage() -> None:
    """Two full cells have 40 % more than the 6 V of an LP winding."""
    supply = Supply(6.6, 7.4, 8.4, 0.0, 0.0, 1.0)
    assert supply.duty(MOTORS["n20-30"], 0.196) == pytest.approx(6.0 / 8.4)
    bears_more = MOTORS["n20-30"].model_copy(update={"bears_v": (3.0, 7.5)})  # than what it is rated for
    assert supply.duty(bears_more, UNLIMITED) == pytest.approx(7.5 / 8.4)


def test_boards_take_their_current_through_the_regulator() -> None:
    """24 mA at 5 V and 90 % efficiency from two cells, 24 mA at 3.7 V from one; and driver and regulator."""
    one, two = (supply_of(chosen_parts(with_kit(kit))) for kit in ("light-1s", "strong-2s"))
    assert one.boards_w == pytest.approx(3.7 * (0.024 + 0.0017))
    assert two.boards_w == pytest.approx(0.024 * 5.0 / 0.9 + 7.4 * (0.0017 + 0.001))
    assert two.usable_j == pytest.approx(0.18 * 3600.0 * 7.4)


def test_a_motor_that_an_empty_battery_does_not_turn_gets_no_gears() -> None:
    """0.5 V drive 0.045 A through 11 ohm at most, hardly more than the 0.04 A that the unloaded motor needs."""
    motor = MOTORS["n20-298-mp"]
    flat = replace(BARE, empty_v=0.5, ohm=2.0)
    limits = replace(default_limits().train, supply=flat)
    assert allowed_nm(motor, limits) <= 0.6 * 0.2354 * (0.5 / (6.0 / 0.67 + 2.0) - 0.04) / 0.63 + 1e-9
    assert allowed_nm(motor, replace(limits, supply=None)) == pytest.approx(0.25 * 0.95 / 1.1 * 0.2354)


def test_under_pwm_a_winding_gets_its_share_of_a_full_and_of_an_empty_battery() -> None:
    """Two cells, 6.6 to 8.4 V, at a motor of 6 V: a share of 6/8.4, so that it gets 4.7 to 6.0 V."""
    motor, chosen = MOTORS["n20-30"], chosen_parts(with_kit("strong-2s"))
    links = {link.role: link for link in chain(chosen, motor, supply_of(chosen), 0.0, UNLIMITED)}
    assert links["motor"].gets_v == pytest.approx((6.6 * 6.0 / 8.4, 6.0))
    assert links["driver"].gets_v == pytest.approx((6.6, 8.4))  # PWM is behind it


@pytest.mark.parametrize("name", ["n20-298", "n20-298-hpcb12"])
def test_the_share_of_pwm_gives_the_mean_voltage_through_the_drivers_diodes(name: str) -> None:
    """The current of a blocked winding, in steps of 10 ns: U while the input is high, -U in the pauses (fast decay).

    20 kHz, L/R of 0.2 ms; U·D alone would leave the motor 2·D - 1 of it.
    """
    supply, motor = Supply(6.6, 7.4, 8.4, 0.0, 0.0, 1.0), MOTORS[name]
    share, ohm = supply.pwm(motor, 0.196), motor.voltage_v / motor.stall_current_a
    current, charge, step_s, period = 0.0, 0.0, 1e-8, 5000
    for number in range(40 * period):
        volts = 8.4 if number % period < share * period else -8.4
        current = max(0.0, current + (volts - ohm * current) / (2e-4 * ohm) * step_s)
        charge += current * step_s if number >= 30 * period else 0.0
    assert charge / (10 * period * step_s) * ohm == pytest.approx(supply.duty(motor, 0.196) * 8.4, rel=0.005)


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_a_supply_is_the_battery_behind_the_drivers_resistance(kit: str) -> None:
    """In series; 3.6 J of every milliampere-hour at the nominal voltage."""
    chosen = chosen_parts(with_kit(kit))
    supply, battery = supply_of(chosen), chosen.battery
    assert (battery.ohm > 0.0, chosen.driver.resistance_ohm > 0.0) == (True, True)
    assert supply.ohm == pytest.approx(battery.ohm + chosen.driver.resistance_ohm)
    assert (supply.empty_v, supply.nominal_v, supply.full_v) == (
        battery.range_v[0], battery.voltage_v, battery.range_v[1],
    )  # fmt: skip
    assert supply.usable_j == pytest.approx(3.6 * battery.capacity_mah * battery.voltage_v)
