"""The checks of the wiring, each on a chosen part that breaks it; whole robots in test_electronics.py."""

from dataclasses import replace
from typing import Any

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.nets import wiring_of
from jumpcad.electronics.supply import Chosen, chosen_of
from jumpcad.findings import Finding
from jumpcad.robot.electronics.wiring import BASIS, wiring_findings

CATALOGUE = load_catalogue()


def parts(kit: str) -> Chosen:
    return chosen_of(CATALOGUE, CATALOGUE.kits[kit])


def found(chosen: Chosen, pins: dict[str, str] | None = None) -> dict[str, Finding]:
    return {finding.name: finding for finding in wiring_findings(chosen, wiring_of(chosen, pins or {}))}


def without(chosen: Chosen, role: str) -> Chosen:
    return replace(chosen, components={name: one for name, one in chosen.components.items() if name != role})


def board(chosen: Chosen, role: str, **changes: Any) -> Chosen:
    return replace(chosen, **{role: getattr(chosen, role).model_copy(update=changes)})


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_a_kit_breaks_nothing(kit: str) -> None:
    findings = found(parts(kit))
    assert set(findings) == set(BASIS) - (set() if kit == "strong-2s" else {"wiring_diode"})
    assert {finding.severity for finding in findings.values()} == {"info"}
    numbers = {"wiring_contact", "wiring_logic"}
    assert {finding.margin for name, finding in findings.items() if name not in numbers} == {0.0}


def test_what_is_left_out_is_missed() -> None:
    chosen = parts("strong-2s")
    for role, name, severity in (
        ("sensor", "wiring_pins", "error"),
        ("capacitor", "wiring_capacitor", "warning"),
        ("diode", "wiring_diode", "error"),
    ):
        finding = found(without(chosen, role))[name]
        assert (finding.severity, finding.margin) == (severity, -1.0)
        assert f"bought.{role}" in finding.remedy
    for role in ("switch", "plug"):
        finding = found(without(chosen, role))["wiring_cut_off"]
        assert (finding.severity, finding.remedy) == ("error", f"name one in bought.{role}")
    found_alone = found(without(parts("light-1s"), "switch"))["wiring_cut_off"]
    assert (found_alone.severity, found_alone.message) == ("info", "plug cuts off the battery")  # 4.2 V do not spark
    apart = board(chosen, "controller", diode_at=[])
    assert found(without(apart, "diode"))["wiring_diode"].severity == "info"
    fed = board(parts("light-1s"), "controller", supply_v={"VSYS": (1.8, 5.5)}, diode_at=["VSYS"])
    assert found(fed)["wiring_diode"].severity == "error", "USB would charge the battery without a charger"


def test_a_second_supply_that_no_wire_reaches_is_named() -> None:
    """A TB6612 needs a supply of its motor and one of its logic; a controller's inputs are alternatives."""
    both = {"VM": (2.5, 13.5), "VCC": (2.7, 5.5)}
    for role in ("driver", "regulator"):
        finding = found(board(parts("strong-2s"), role, supply_v=both))["wiring_pins"]
        assert finding.severity == "error"
        assert "VM and VCC" in finding.message
        assert f"bought.{role}" in finding.remedy
    assert len(parts("strong-2s").controller.supply_v) == 2


def test_a_converter_that_no_divider_brings_the_battery_to_is_named_with_both_voltages() -> None:
    """Six times less than 8.4 V are 1.4 V: with the largest divider, 1000 to 200 kOhm."""
    for most, severity in ((1.39, "warning"), (1.41, "info")):
        finding = found(board(parts("strong-2s"), "controller", adc_max_v=most))["wiring_pins"]
        assert finding.severity == severity
        assert ("1.39 V at most" in finding.message and "8.4 V" in finding.message) == (severity == "warning")
    assert "pin left" not in finding.message


@pytest.mark.parametrize(("pins_v", "inputs_v", "good"), [(3.3, 3.3, True), (5.0, 3.3, False), (3.3, 5.0, False)])
def test_pins_have_the_level_of_the_drivers_inputs(pins_v: float, inputs_v: float, good: bool) -> None:
    chosen = board(board(parts("light-1s"), "controller", logic_v=pins_v), "driver", logic_v=inputs_v)
    finding = found(chosen)["wiring_logic"]
    assert finding.severity == ("info" if good else "warning")
    assert finding.margin == pytest.approx(0.1 * inputs_v - abs(pins_v - inputs_v))
    assert f"give {pins_v:g} V" in finding.message
    assert f"are for {inputs_v:g} V" in finding.message


def test_a_board_without_ground_is_named() -> None:
    """A driver's reverse input is on ground too."""
    chosen = parts("strong-2s")
    for role in ("controller", "driver", "regulator"):
        pins = getattr(chosen, role).pins.items()
        others = {name: does for name, does in pins if not {"ground", "reverse"} & set(does)}
        finding = found(board(chosen, role, pins=others))["wiring_ground"]
        assert (finding.severity, finding.message) == ("error", f"no ground at {role}")


def test_too_few_pins_and_a_driver_that_cannot_be_driven() -> None:
    chosen = parts("light-1s")
    few = {name: chosen.controller.pins[name] for name in ("BAT-", "GND", "3V3", "D1", "D2")}
    finding = found(board(chosen, "controller", pins=few))["wiring_pins"]
    assert finding.severity == "error"
    assert "no pin left for sleep and ready: 2 of 4 suit" in finding.message
    for lost in ("forward", "motor+", "motor-"):
        pins = {name: does for name, does in chosen.driver.pins.items() if lost not in does}
        finding = found(board(chosen, "driver", pins=pins))["wiring_pins"]
        assert (finding.severity, finding.message) == ("error", f"driver {chosen.driver.name} has no pin {lost}")


def test_a_driver_that_nothing_wakes_is_missed() -> None:
    """A DRV8833 sleeps while its nSLEEP is open, since it pulls it down: a named pin may leave none for it."""
    chosen = parts("light-1s")
    few = {name: chosen.controller.pins[name] for name in ("BAT-", "GND", "3V3", "D1", "D3", "D4")}
    short = board(chosen, "controller", pins=few)
    finding = found(short, {"ready": "D4"})["wiring_pins"]
    assert (finding.severity, finding.margin) == ("error", -1.0)
    assert "no pin left for sleep: 3 of 4 suit" in finding.message
    awake = {name: does for name, does in chosen.driver.pins.items() if "sleep" not in does}
    assert found(board(short, "driver", pins=awake), {"ready": "D4"})["wiring_pins"].severity == "info"


@pytest.mark.parametrize(
    ("pins", "name", "words"),
    [
        ({"ready": "D0"}, "wiring_strapping", "D0 (ready) is a strapping pin"),
        ({"ready": "D6"}, "wiring_strapping", "D6 (ready) is a boot log pin"),
        ({"battery": "D4"}, "wiring_strapping", "D4 (battery) has no adc"),
        ({"ready": "GND"}, "wiring_strapping", "GND (ready) has no GPIO"),
        ({"ready": "D2", "motor": "D2"}, "wiring_pins", "D2 is used twice, by motor and ready"),
    ],
)
def test_pins_that_cannot_do_it_are_named(pins: dict[str, str], name: str, words: str) -> None:
    finding = found(parts("light-1s"), pins)[name]
    assert (finding.severity, finding.margin) == ("error", -1.0)
    assert words in finding.message


def test_a_battery_that_no_pin_measures_is_told() -> None:
    """The pins with an analogue input are taken by other signals; nothing else is wrong."""
    chosen = parts("light-1s")
    free = [pin for pin, does in chosen.controller.pins.items() if "adc" in does and "strapping" not in does]
    assert len(free) == 2
    finding = found(chosen, dict(zip(("motor", "ready"), free, strict=True)))["wiring_pins"]
    assert (finding.severity, finding.margin) == ("warning", -1.0)
    assert "measures the battery" in finding.message


def test_a_contact_gets_the_current_of_its_pull_up_or_of_the_pins_own() -> None:
    """Ohm: 3.3 V over the resistor at the supply's pin, or over 45 kOhm in a controller without such a pin."""
    chosen = parts("light-1s")
    ohm = wiring_of(chosen, {}).pull_up_ohm
    finding = found(chosen)["wiring_contact"]
    assert ohm is not None
    assert finding.value == pytest.approx(3300.0 / ohm)
    assert finding.message.startswith(f"{ohm / 1000:g} kOhm to 3.3 V gives")
    assert 1.0 <= ohm / 1000 <= 10.0
    assert finding.limit == pytest.approx(1000.0 * chosen.components["sensor"].least_a)
    pins = {name: does for name, does in chosen.controller.pins.items() if "out" not in does}
    weak = found(board(chosen, "controller", pins=pins))["wiring_contact"]
    assert weak.value == pytest.approx(3.3 / 45.0)
    for volts, other in ((3.0, 5.0), (1.8, None)):  # what a board supplies to others is no matter
        slow = found(board(chosen, "controller", pins=pins, logic_v=volts, output_v=other))["wiring_contact"]
        assert slow.value == pytest.approx(volts / 45.0)
    assert weak.message.startswith("the controller's own pull-up gives")
    assert weak.severity == "warning"
    dry = chosen.components["sensor"].model_copy(update={"least_a": None})
    assert "wiring_contact" not in found(replace(chosen, components=chosen.components | {"sensor": dry}))
