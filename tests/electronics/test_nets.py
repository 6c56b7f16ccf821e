"""The net list traced as a circuit: where current flows, what a pin sees, and one wire less than terminals."""

import re
from dataclasses import replace

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.nets import AT, LOWER_OHM, UPPER_OHMS, Wiring, gpio, logic_range, wiring_of
from jumpcad.electronics.supply import Chosen, chosen_of

CATALOGUE = load_catalogue()
KITS = ("light-1s", "strong-2s")


def parts(kit: str) -> Chosen:
    return chosen_of(CATALOGUE, CATALOGUE.kits[kit])


Edges = set[tuple[str, str]]


def wires(wiring: Wiring) -> Edges:
    """Both ends of all wires."""
    return {(str(one), str(other)) for net in wiring.nets for one, other in net.wires}


def reached(start: str, edges: Edges) -> set[str]:
    """Every terminal that is connected to one."""
    found, grown = set(), {start}
    while grown != found:
        found = grown
        grown = found | {end for edge in edges if found & set(edge) for end in edge}
    return found


@pytest.mark.parametrize("kit", KITS)
def test_wires_join_each_net_and_no_two(kit: str) -> None:
    """A tree: connected, with one wire less than terminals."""
    wiring = wiring_of(parts(kit), {})
    for net in wiring.nets:
        assert reached(str(net.terminals[0]), wires(wiring)) == set(map(str, net.terminals))
        assert len(list(net.wires)) == len(net.terminals) - 1


@pytest.mark.parametrize("kit", KITS)
def test_current_flows_from_the_battery_through_plug_and_switch_and_back(kit: str) -> None:
    """With the switch open, only the plug is live; with it closed, what needs power has it, and never on ground."""
    chosen = parts(kit)
    edges = wires(wiring_of(chosen, {}))

    def live() -> set[str]:
        return reached("battery +", edges)

    assert live() == {"battery +", "plug +", "switch 1"}
    edges.add(("switch 1", "switch 2"))
    driver = next(iter(chosen.driver.supply_v))
    assert {f"driver {driver}", "capacitor +", "upper resistor 1"} <= live()
    if chosen.regulator is None:
        assert any(terminal.startswith("controller ") for terminal in live())
    else:
        assert not any(terminal.startswith("controller ") for terminal in live())
        (before,) = (terminal for terminal in live() if terminal.startswith("regulator "))
        assert before.removeprefix("regulator ") in chosen.regulator.supply_v
        edges.add((before, f"regulator {chosen.regulator.with_function('out')[0]}"))
        edges.add(("diode A", "diode K"))
        takes_5_v = next(pin for pin, (_, high) in chosen.controller.supply_v.items() if high >= 5.0)
        assert f"controller {takes_5_v}" in live()
    ground = reached("battery -", edges)
    assert {"plug -", "capacitor -", "sensor COM", "lower resistor 2"} <= ground
    for role, board in chosen.boards.items():
        assert any(f"{role} {pin}" in ground for pin in board.with_function("ground"))
    assert {f"driver {pin}" for pin in chosen.driver.with_function("reverse")} <= ground
    assert not live() & ground


@pytest.mark.parametrize("kit", KITS)
def test_each_board_has_one_ground_wire_and_behind_a_regulator_none_at_its_charger(kit: str) -> None:
    """A XIAO takes one cell at its battery pads, and 5 V at the pins beside them; a board grounded twice is a loop."""
    chosen = parts(kit)
    (net,) = (net for net in wiring_of(chosen, {}).nets if net.kind == "ground")
    at = {role: [end.pin for end in net.terminals if end.part == role] for role in chosen.boards}
    at["driver"] = [pin for pin in at["driver"] if pin not in chosen.driver.with_function("reverse")]
    assert at.pop("controller") == ["BAT-" if chosen.regulator is None else "GND"]
    assert all(pins == ["GND"] for pins in at.values())


@pytest.mark.parametrize("kit", KITS)
def test_the_converter_sees_as_much_of_a_full_battery_as_it_bears(kit: str) -> None:
    """Of dividers with a lower resistor of 200 kOhm: the next smaller one of those listed would be too much."""
    chosen = parts(kit)
    wiring = wiring_of(chosen, {})
    full, most = chosen.battery.range_v[1], chosen.controller.adc_max_v
    assert wiring.upper_ohm is not None
    assert most is not None
    assert full / wiring.divider == pytest.approx(full * LOWER_OHM / (LOWER_OHM + wiring.upper_ohm))
    assert full / wiring.divider <= most
    smaller = [ohm for ohm in UPPER_OHMS if ohm < wiring.upper_ohm]
    assert not smaller or full * LOWER_OHM / (LOWER_OHM + max(smaller)) > most
    assert wiring.resistors["upper resistor"] == wiring.upper_ohm
    assert wiring.resistors["lower resistor"] == LOWER_OHM


@pytest.mark.parametrize("kit", KITS)
def test_a_divider_that_no_pin_reads_is_not_soldered(kit: str) -> None:
    """The pins with a converter drive the motor here: no resistor of a divider is ordered, and no net has one."""
    wiring = wiring_of(parts(kit), {"motor": "D1", "sleep": "D2"})
    assert "battery" not in wiring.pins
    assert wiring.upper_ohm is None
    assert set(wiring.resistors) == {"pull-up resistor"}
    assert {end.part for net in wiring.nets for end in net.terminals} & {"upper resistor", "lower resistor"} == set()


@pytest.mark.parametrize("kit", KITS)
def test_the_driver_turns_the_motor_and_the_controller_the_driver(kit: str) -> None:
    chosen = parts(kit)
    wiring = wiring_of(chosen, {})
    for pole in ("motor+", "motor-"):
        (out, *_) = chosen.driver.with_function(pole)
        assert reached(f"motor {pole[-1]}", wires(wiring)) == {f"motor {pole[-1]}", f"driver {out}"}
    for signal, function in (("motor", "forward"), ("sleep", "sleep")):
        inputs = {f"driver {pin}" for pin in chosen.driver.with_function(function)}
        pin = f"controller {wiring.pins[signal]}"
        assert reached(pin, wires(wiring)) == inputs | {pin}


def test_of_several_outputs_of_a_driver_one_is_wired_to_each_pole() -> None:
    """A driver for two motors has two pins for each; the motor's are the first ones."""
    chosen = parts("light-1s")
    twice = {f"second {pin}": able for pin, able in chosen.driver.pins.items() if {"motor+", "motor-"} & set(able)}
    assert len(twice) >= 2
    double = replace(chosen, driver=chosen.driver.model_copy(update={"pins": {**chosen.driver.pins, **twice}}))
    nets = {net.name: list(map(str, net.terminals)) for net in wiring_of(double, {}).nets}
    for pole in ("motor+", "motor-"):
        assert nets[pole] == [f"driver {chosen.driver.with_function(pole)[0]}", f"motor {pole[-1]}"]


@pytest.mark.parametrize("kit", KITS)
def test_a_closed_contact_carries_its_least_current_even_with_five_per_cent_off(kit: str) -> None:
    chosen = parts(kit)
    wiring, sensor = wiring_of(chosen, {}), chosen.components["sensor"]
    assert wiring.pull_up_ohm is not None
    assert sensor.least_a is not None
    volts = chosen.controller.logic_v or 0.0
    assert 0.95 * volts / (1.05 * wiring.pull_up_ohm) >= 0.995 * sensor.least_a
    assert volts / (10.0**0.2 * wiring.pull_up_ohm) < 1.1 * sensor.least_a  # the next of the series is too large
    assert wiring.resistors["pull-up resistor"] == wiring.pull_up_ohm


def test_a_controller_that_supplies_nothing_reads_the_contact_by_its_own_pull_up() -> None:
    """Nothing else is joined to pin and contact, and there is no net of its supply."""
    chosen = parts("light-1s")
    dark = replace(chosen, controller=chosen.controller.model_copy(update={"logic_v": None}))
    wiring = wiring_of(dark, {})
    nets = {net.name: {str(terminal) for terminal in net.terminals} for net in wiring.nets}
    assert "logic supply" not in nets
    assert nets["ready"] == {f"controller {wiring.pins['ready']}", "sensor NC"}
    assert wiring.pull_up_ohm is None
    assert "pull-up resistor" not in wiring.resistors


def test_a_contact_without_a_least_current_has_the_largest_pull_up() -> None:
    """10 kOhm: 0.3 mA at 3.3 V."""
    chosen = parts("light-1s")
    dry = chosen.components["sensor"].model_copy(update={"least_a": None})
    wiring = wiring_of(replace(chosen, components={**chosen.components, "sensor": dry}), {})
    assert wiring.pull_up_ohm == 10_000


@pytest.mark.parametrize("kit", KITS)
def test_a_signal_takes_the_least_capable_pin_that_can_do_it(kit: str) -> None:
    """What is left at its turn can do no less: pins with an analogue input stay free for who needs one."""
    chosen = parts(kit)
    pins, taken = wiring_of(chosen, {}).pins, set()
    needed = {"battery": "adc", "motor": "pwm"}
    for signal, pin in pins.items():
        free = {name: does for name, does in chosen.controller.pins.items() if name not in taken}
        suitable = [
            does for does in free.values()
            if any(re.fullmatch(r"gpio\d+", one) for one in does) and not {"strapping", "boot_log"} & set(does)
            and needed.get(signal, does[0]) in does
        ]  # fmt: skip
        assert len(free[pin]) == min(map(len, suitable)), signal
        taken.add(pin)


@pytest.mark.parametrize("bad", ["strapping", "boot_log"])
def test_pins_that_choose_how_a_chip_boots_are_left_alone(bad: str) -> None:
    """Though they can do no more than a signal needs, and all others can do more."""
    chosen = parts("light-1s")
    able = {f"S{number}": (f"gpio{60 + number}", "pwm", bad) for number in range(4)}
    able |= {pin: (*does, "adc", "pwm", "i2c", "spi") for pin, does in chosen.controller.pins.items()}
    board = chosen.controller.model_copy(update={"pins": able})
    pins = wiring_of(replace(chosen, controller=board), {}).pins
    assert len(pins) == 4
    assert not [pin for pin in pins.values() if pin.startswith("S") and pin[1:].isdigit()]


@pytest.mark.parametrize("kit", KITS)
def test_each_signal_has_its_own_pin_that_can_do_it(kit: str) -> None:
    chosen = parts(kit)
    wiring = wiring_of(chosen, {})
    assert list(wiring.pins) == ["battery", "motor", "sleep", "ready"]
    numbers = [gpio(chosen.controller, pin) for pin in wiring.pins.values()]
    assert len(set(numbers)) == 4
    functions = {signal: chosen.controller.pins[pin] for signal, pin in wiring.pins.items()}
    assert "adc" in functions["battery"]
    assert "pwm" in functions["motor"]
    for has in functions.values():
        assert not {"strapping", "boot_log"} & set(has)
    named = wiring_of(chosen, {"ready": wiring.pins["battery"]})
    assert named.pins["ready"] == wiring.pins["battery"]
    assert len(set(named.pins.values())) == len(named.pins)


def test_behind_the_diode_there_is_its_drop_less() -> None:
    """5 V of the regulator less the drop of a Schottky diode; without a regulator what the battery has."""
    chosen = parts("strong-2s")
    assert chosen.regulator is not None
    assert chosen.diode is not None
    assert logic_range(chosen) == (pytest.approx(5.0 - chosen.diode.drop_v),) * 2
    bare = replace(chosen, components={k: v for k, v in chosen.components.items() if k != "diode"})
    assert logic_range(bare) == (5.0, 5.0)
    assert logic_range(parts("light-1s")) == (3.3, 4.2)


@pytest.mark.parametrize("gone", ["switch", "plug", "capacitor", "diode", "sensor"])
def test_a_part_that_is_left_out_leaves_the_others_connected(gone: str) -> None:
    chosen = parts("strong-2s")
    less = replace(chosen, components={role: one for role, one in chosen.components.items() if role != gone})
    whole, wiring = wiring_of(chosen, {}), wiring_of(less, {})

    def terminals(of: Wiring) -> set[str]:
        return {str(terminal) for net in of.nets for terminal in net.terminals}

    lost = {terminal for terminal in terminals(whole) if terminal.startswith(f"{gone} ")}
    assert lost
    if gone == "sensor":
        lost |= {f"controller {whole.pins['ready']}", "pull-up resistor 1", "pull-up resistor 2", "controller 3V3"}
    assert terminals(wiring) == terminals(whole) - lost
    if gone == "switch":
        assert f"driver {next(iter(chosen.driver.supply_v))}" in reached("battery +", wires(wiring))
    assert {"controller GND", "driver GND"} <= reached("battery -", wires(wiring))


@pytest.mark.parametrize(("function", "net"), [("forward", "motor"), ("motor+", "motor+")])
def test_a_terminal_alone_is_no_net(function: str, net: str) -> None:
    """A driver whose pins do not say which of them turns the motor, or where it is soldered."""
    chosen = parts("light-1s")
    pins = {pin: tuple(f for f in able if f != function) for pin, able in chosen.driver.pins.items()}
    unsaid = replace(chosen, driver=chosen.driver.model_copy(update={"pins": pins}))
    whole, wiring = wiring_of(chosen, {}), wiring_of(unsaid, {})
    assert [one.name for one in wiring.nets] == [one.name for one in whole.nets if one.name != net]


@pytest.mark.parametrize("kit", KITS)
def test_the_sensors_contact_is_pulled_up_where_the_controller_reads_it(kit: str) -> None:
    """One wire from pin, contact and resistor; the resistor's other end has the controller's own supply."""
    chosen = parts(kit)
    wiring = wiring_of(chosen, {})
    (ready,) = (net for net in wiring.nets if net.name == "ready")
    joined = {str(terminal) for terminal in ready.terminals}
    assert {f"controller {wiring.pins['ready']}", "pull-up resistor 1"} < joined
    (contact,) = (one for one in joined if one.startswith("sensor "))
    assert contact != "sensor COM"
    assert len(joined) == 3
    assert "pull-up resistor 2" in reached(f"controller {chosen.controller.with_function('out')[0]}", wires(wiring))


@pytest.mark.parametrize(
    ("kit", "role", "pin"),
    [("light-1s", "driver", "LOW"), ("strong-2s", "driver", "HIGH"), ("strong-2s", "regulator", "HIGH")],
)
def test_a_board_of_two_inputs_gets_the_battery_at_the_one_that_bears_it(kit: str, role: str, pin: str) -> None:
    """One cell has 3.3 to 4.2 V, two have 6.6 to 8.4 V; the voltage behind a regulator is another."""
    chosen = parts(kit)
    two = getattr(chosen, role).model_copy(update={"supply_v": {"LOW": (2.7, 5.5), "HIGH": (5.6, 11.0)}})
    edges = wires(wiring_of(replace(chosen, **{role: two}), {})) | {("switch 1", "switch 2")}
    assert f"{role} {pin}" in reached("battery +", edges)
    assert f"{role} {'HIGH' if pin == 'LOW' else 'LOW'}" not in {end for edge in edges for end in edge}


@pytest.mark.parametrize("kit", KITS)
def test_a_small_part_is_wired_to_the_board_at_which_it_is_soldered(kit: str) -> None:
    """The capacitor at the driver's supply, the resistors at the pins that read them, the diode where USB feeds too."""
    chosen = parts(kit)
    assert AT["capacitor"] == "driver"
    assert [role for role, board in chosen.boards.items() if board.diode_at] == [AT["diode"]]
    boards, direct = {"capacitor": "driver"} | dict.fromkeys(("upper", "lower", "pull-up"), "controller"), set()
    for net in wiring_of(chosen, {}).nets:
        there = {terminal.part for terminal in net.terminals}
        for one, other in net.wires:
            part = other.part.removesuffix(" resistor")
            if boards.get(part) in there:
                assert one.part == boards[part], f"{net.name}: {other}"
                direct.add(part)
    assert direct == set(boards)


@pytest.mark.parametrize(("terminals", "level"), [(("COM", "NC", "NO"), 1), (("COM", "NC"), 1), (("COM", "NO"), 0)])
def test_at_ready_a_contact_that_opens_reads_high_and_one_that_closes_low(
    terminals: tuple[str, ...], level: int
) -> None:
    """It lies between the pin, which is pulled up, and ground."""
    chosen = parts("light-1s")
    sensor = chosen.components["sensor"].model_copy(update={"terminals": terminals})
    wiring = wiring_of(replace(chosen, components=chosen.components | {"sensor": sensor}), {})
    assert wiring.ready_level == level
