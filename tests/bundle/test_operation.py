"""How a robot is charged, stopped and put away: each board and battery has its own words and figures."""

import re
from dataclasses import replace

import pytest

from jumpcad.bundle import operation
from jumpcad.electronics.chosen import Chosen, chosen_parts
from jumpcad.workshop import load_workshop


def parts(kit: str, button: str | None = None, **controller: object) -> Chosen:
    """Return the parts of a kit, with another controller."""
    shop = load_workshop()
    bought = shop.bought.model_copy(update=shop.catalogue.kits[kit].model_dump() | {"kit": kit})
    chosen = chosen_parts(shop.model_copy(update={"bought": bought}))
    changed = controller if button is None else controller | {"button": button}
    return replace(chosen, controller=chosen.controller.model_copy(update=changed))


ONE, TWO = "light-1s", "strong-2s"


def test_two_cells_are_charged_with_1_c_outside() -> None:
    chosen = parts(TWO)
    words = operation.charging(chosen)
    assert f"Charge with {chosen.battery.capacity_mah:.0f} mA at most (1 C)" in words
    assert "LiPo 2S, outside the robot" in words
    assert "tie leg and body together" in operation.charging_loaded(chosen)
    assert "unplug the battery, charge it outside" in operation.charging_loaded(chosen)


@pytest.mark.parametrize(("permitted", "words"), [(90.0, "90 mA at most (0.5 C)"), (900.0, "180 mA at most (1 C)")])
def test_a_charger_outside_gives_no_more_than_the_battery_bears(permitted: float, words: str) -> None:
    """Of 180 mAh: 1 C, or less where its maker permits less."""
    two = parts(TWO)
    battery = two.battery.model_copy(update={"charge_ma": permitted})
    assert words in operation.charging(replace(two, battery=battery))


@pytest.mark.parametrize(("milliamperes", "rate", "hours"), [(370.0, 1.23, 1.2), (150.0, 0.5, 3.0), (300.0, 1.0, 1.5)])
def test_the_charger_on_the_board_gives_its_current(milliamperes: float, rate: float, hours: float) -> None:
    """300 mAh: at 150 mA they take 2 h, and half as long again since the current falls at the end."""
    words = operation.charging(parts(ONE, charge_ma=milliamperes))
    assert f"gives {milliamperes:.0f} mA, which cannot be set: {rate:.2f} C" in words
    assert f"full after about {hours:.1f} h: 4.2 V" in words
    assert ("More than 1 C" in words) == (rate > 1.0)
    assert ("switch on it is always charged so" in words) == (rate > 1.0)


def test_an_unknown_charger_is_measured() -> None:
    chosen = parts(ONE, charge_ma=None)
    words = operation.charging(chosen)
    assert f"is not known: measure it, {chosen.battery.bears_ma:.0f} mA at most" in words
    assert "cannot be set" not in words
    assert "charge it over USB with the switch on" in operation.charging_loaded(chosen)


def test_a_battery_is_charged_outside_where_the_board_has_no_charger_for_it() -> None:
    """A board without pads for a cell, or two cells at a board's own supply, or one cell behind a regulator."""
    one, two = parts(ONE), parts(TWO)
    bare = one.controller.model_copy(update={"charge_ma": None, "pins": {"GND": ("ground",)}})
    for chosen in (replace(one, controller=bare), replace(two, regulator=None), replace(two, battery=one.battery)):
        cells = chosen.battery.cells
        words = operation.charging(chosen)
        assert words.endswith(f"set to LiPo {cells}S, outside the robot.")
        assert ("balance lead" in words) == (cells > 1)
        assert "USB" not in words
        assert "unplug the battery, charge it outside" in operation.charging_loaded(chosen)
        assert not operation.fed_by_usb(chosen)


def test_usb_feeds_the_driver_of_one_cell_alone() -> None:
    """The board's charger is connected to the battery's pads; two cells pass a regulator and a diode."""
    one, two = parts(ONE), parts(TWO)
    assert operation.fed_by_usb(one)
    assert not operation.fed_by_usb(two)
    assert operation.switching_off(one) == "Pull the USB cable and switch off"
    assert operation.switching_off(two) == "Switch off, pull the USB cable"
    assert "with the USB cable out" in operation.stops_the_motor(one)
    assert operation.stops_the_motor(two) == "only the switch stops the motor"
    assert "its charger would be read too" in operation.usb_out(one)
    assert "it would feed the board" in operation.usb_out(two)


@pytest.mark.parametrize(("kit", "off"), [(ONE, "pull the USB cable and switch off"), (TWO, "switch off")])
def test_a_board_without_a_button_is_told_by_typing(kit: str, off: str) -> None:
    """And one with a button by pressing it: commands, ways to stop, cable, bootloader."""
    typed, pressed = parts(kit, button=""), parts(kit)
    assert operation.by_button("wind", typed.controller) == "Type `wind`."
    assert operation.by_button("jump", typed.controller) == "Type `jump`."
    assert "by type" not in operation.to_stop(typed)
    assert f"jumps: type `stop`, or {off}. The motor" in operation.to_stop(typed)
    assert "type `wind` again, it winds on" in operation.to_stop(typed)
    assert "stays in" in operation.cable(typed.controller)
    assert operation.usb_out(typed).startswith("USB cable in")
    assert "as its maker says" in operation.bootloader(typed.controller)
    assert "press the same button once more, or switch off. The motor" in operation.to_stop(pressed)
    assert "press the button again, it winds on" in operation.to_stop(pressed)
    assert operation.cable(pressed.controller).startswith("Unplug")
    assert operation.usb_out(pressed).startswith("USB cable out")
    assert f"hold the button of pin {pressed.controller.button}" in operation.bootloader(pressed.controller)
    assert operation.by_button("jump", pressed.controller).endswith("it releases after 3 s.")
    assert operation.by_button("wind", pressed.controller).startswith("Press the button of pin")


@pytest.mark.parametrize(("kit", "cells"), [(ONE, 1), (TWO, 2)])
def test_a_battery_is_stored_half_full_and_discarded_below_3_v_a_cell(kit: str, cells: int) -> None:
    chosen = parts(kit)
    text = "\n".join(operation.after_use(chosen))
    assert f"at about {3.8 * cells:.1f} V" in text
    assert f"Below {3.0 * cells:.1f} V at rest" in text
    assert operation.switching_off(chosen) in text
    hours = re.search(r"empty a full one in (\d+) h", text)
    assert hours is not None
    if cells == 1:
        assert float(hours[1]) == pytest.approx(300.0 / 25.7, abs=0.51)
