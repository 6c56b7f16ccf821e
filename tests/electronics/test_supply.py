"""The motor at a battery's voltage against Kirchhoff's law, and figures that were derived by hand."""

import math
import re
from dataclasses import replace

import pytest
from support.built import with_kit
from support.each import each
from support.limits import default_limits

from jumpcad.catalogue import load_catalogue
from jumpcad.drive.motor import allowed_nm
from jumpcad.electronics.supply import Chosen, Link, Supply, chain, chosen_parts, supply_of, supply_pin
from jumpcad.workshop import load_workshop

MOTORS = load_catalogue().motors
BARE = Supply(empty_v=3.3, nominal_v=3.7, full_v=4.2, ohm=0.0, boards_w=0.0, usable_j=1.0)
UNLIMITED = 1e3


@pytest.mark.parametrize(
    ("name", "rpm", "stall_nm", "stall_a"), [("n20-298", 26.7, 0.1165, 0.222), ("n20-298-mp", 41.8, 0.1346, 0.413)]
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


def test_what_is_named_is_there_and_what_is_not_named_is_left_out() -> None:
    shop = with_kit("strong-2s", plug="", switch="")
    bought, chosen = shop.bought, chosen_parts(shop)
    assert (chosen.battery.name, chosen.controller.name, chosen.driver.name) == (
        bought.battery, bought.controller, bought.driver,
    )  # fmt: skip
    assert chosen.components.keys() == {"sensor", "capacitor", "diode", "wire"}
    assert {role: part.name for role, part in chosen.components.items()} == {
        role: getattr(bought, role) for role in chosen.components
    }


def test_a_diode_lies_behind_a_regulator_alone() -> None:
    """A controller that the battery feeds itself has none, whatever the workshop names."""
    shop = with_kit("strong-2s")
    regulated, bare = chosen_parts(shop), chosen_parts(with_kit("strong-2s", regulator=""))
    assert regulated.boards.keys() == {"controller", "driver", "regulator"}
    assert {role: one.name for role, one in regulated.boards.items()} == {
        role: getattr(shop.bought, role) for role in ("controller", "driver", "regulator")
    }
    assert regulated.diode is not None
    assert regulated.diode.name == shop.bought.diode
    assert bare.boards.keys() == {"controller", "driver"}
    assert "diode" in bare.components
    assert bare.diode is None


def test_usb_charges_one_cell_that_lies_at_a_charger_and_no_other() -> None:
    """Two cells need 8.4 V; a regulator lets no current back; a board without charger or pads for a cell has 5 V."""
    shop = load_workshop()
    one = chosen_parts(shop)
    assert one.charged_by_usb
    two = shop.catalogue.batteries["lipo-2s-180"]
    assert (one.battery.cells, two.cells) == (1, 2)
    regulator = shop.catalogue.boards[shop.catalogue.kits["strong-2s"].regulator]
    bare = {name: tuple(f for f in able if f != "battery") for name, able in one.controller.pins.items()}
    rated = one.controller.model_copy(update={"pins": bare})
    unrated = one.controller.model_copy(update={"charge_ma": None})
    for charged in (replace(one, controller=rated), replace(one, controller=unrated)):
        assert charged.charged_by_usb
    neither = rated.model_copy(update={"charge_ma": None})
    for other in ({"battery": two}, {"regulator": regulator}, {"controller": neither}):
        assert not replace(one, **other).charged_by_usb


PEAK_A, TORQUE_NM, MOTOR = 0.5, 0.2, load_catalogue().motors["n20-298"]


def links(kit: str) -> tuple[dict[str, Link], Chosen]:
    chosen = chosen_parts(with_kit(kit))
    return of(chosen), chosen


def of(chosen: Chosen) -> dict[str, Link]:
    return {one.role: one for one in chain(chosen, MOTOR, supply_of(chosen), PEAK_A, TORQUE_NM)}


def test_one_cell_feeds_controller_and_driver() -> None:
    """3.3 V less the drop of the battery's own resistance at the motor's largest current, to 4.2 V."""
    found, chosen = links("light-1s")
    low = 3.3 - PEAK_A * chosen.battery.ohm
    for role in ("controller", "driver", "switch", "plug", "capacitor"):
        if role in found:
            assert found[role].gets_v == pytest.approx((low, 4.2)), role
    assert found["controller"].bears_v == chosen.controller.supply_v[found["controller"].pin]
    assert found["driver"].bears_v == chosen.driver.supply_v[found["driver"].pin]
    assert "regulator" not in found
    for role in ("switch", "plug", "capacitor"):
        part = chosen.components.get(role)
        assert (role in found) == (part is not None and part.rated_v is not None)
        if role in found:
            assert found[role].bears_v == (0.0, part.rated_v)


def test_a_part_whose_voltage_nobody_states_is_not_compared() -> None:
    _, chosen = links("light-1s")
    plain = {role: part.model_copy(update={"rated_v": None}) for role, part in chosen.components.items()}
    unrated = replace(chosen, components=plain)
    assert plain
    assert of(unrated).keys() == {"controller", "driver", "motor"}


def test_two_cells_pass_a_regulator_and_a_diode_to_the_controller() -> None:
    found, chosen = links("strong-2s")
    low = 6.6 - PEAK_A * chosen.battery.ohm
    assert found["regulator"].gets_v == pytest.approx((low, 8.4))
    assert found["driver"].gets_v == pytest.approx((low, 8.4))
    for role in ("switch", "plug", "capacitor"):  # before the regulator
        assert found[role].gets_v == pytest.approx((low, 8.4)), role
    logic = chosen.regulator.output_v - (chosen.diode.drop_v if chosen.diode else 0.0)
    assert found["controller"].gets_v == pytest.approx((logic, logic))
    alone = replace(chosen, components={name: one for name, one in chosen.components.items() if name != "diode"})
    assert of(alone)["controller"].gets_v == pytest.approx((chosen.regulator.output_v,) * 2)


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_what_gets_another_voltage_than_it_bears_is_to_be_exchanged(kit: str) -> None:
    """Each remedy names the key of the part itself in `[bought]`, or of what feeds it."""
    found, _ = links(kit)
    for role, link in found.items():
        own = {"motor": "motors", "controller": "regulator"}.get(role, role)  # a controller has one put before it
        assert f"bought.{own}" in link.remedy
        named = set(re.findall(r"bought\.(\w+)", link.remedy))
        assert named <= {own, "kit", "battery"}, role
        assert ("battery" in named) == (role not in ("switch", "plug", "capacitor"))


def test_the_winding_gets_the_mean_of_the_pwm() -> None:
    """A motor of 6 V on 8.4 V: no more than the highest voltage that it bears, the same share of an empty battery."""
    found, chosen = links("strong-2s")
    low, high = found["motor"].gets_v
    assert high <= MOTOR.range_v[1] + 1e-9
    assert low / high == pytest.approx(chosen.battery.range_v[0] / chosen.battery.range_v[1])
    assert found["motor"].bears_v == MOTOR.range_v
    assert found["motor"].name == "n20-298"


def test_the_input_is_the_first_that_bears_the_range() -> None:
    board = load_catalogue().boards["xiao-esp32c3"].model_copy(
        update={"supply_v": {"A": (3.0, 4.0), "B": (3.0, 6.0), "C": (2.0, 9.0)}}
    )  # fmt: skip
    assert supply_pin(board, (3.0, 4.0)) == "A"
    assert supply_pin(board, (3.0, 4.1)) == "B"
    assert supply_pin(board, (2.9, 4.0)) == "C"
    assert supply_pin(board, (1.0, 4.0)) == "A"
    assert supply_pin(board.model_copy(update={"supply_v": {}}), (3.0, 4.0)) == ""
