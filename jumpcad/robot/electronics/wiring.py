"""The wiring: pins, the sensor's contact, ground, capacitor and diode."""

from collections import Counter
from collections.abc import Iterator

from jumpcad.catalogue.boards import GPIO
from jumpcad.electronics.nets import AVOIDED, GYROSCOPE, SIGNALS, Wiring, divider_ohm, logic_range
from jumpcad.electronics.supply import Chosen, supply_pin
from jumpcad.findings import Basis, Finding, Severity, at_least, at_most

OWN_PULL_UP_OHM = 45_000
"""Of a pin of the ESP32 family; its data sheet."""
LOGIC_SHARE = 0.1
"""Of a driver's logic level, by which the controller's may differ: tolerances of supplies; judgement."""
CUT_OFF = ("switch", "plug")
"""What takes the battery off the boards."""
SHEETS = "data sheets of the boards: templates/hardware/electronics.toml"
BASIS = {
    "wiring_pins": Basis(
        "every signal has a pin of its own at controller and driver, driver and regulator have one supply input; 0, or "
        "-1",
        SHEETS,
    ),
    "wiring_strapping": Basis(
        "no signal's pin is a strapping or boot log pin, and each can do what its signal needs; 0, or -1", SHEETS
    ),
    "wiring_contact": Basis(
        "U/R ≥ least current of the sensor's contact (mA); U logic supply, R pull-up resistor, or 45 kOhm in the "
        "controller",
        "Ohm; data sheets of switch and controller",
    ),
    "wiring_logic": Basis(
        "|controller's logic level - that of the driver's inputs| ≤ a tenth of the latter (V)",
        "data sheets: entries logic_v of controller and driver; the tenth, of usual supplies, is a judgement",
    ),
    "wiring_ground": Basis("every board has a terminal in the net of the battery's minus; 0, or -1", "net list"),
    "wiring_cut_off": Basis(
        "a plug lies between battery and boards, and a switch, but with a battery of one cell; 0, or -1",
        "judgement: a program that hangs may drive the motor, or hold loaded springs; plugs of more cells spark",
    ),
    "wiring_capacitor": Basis(
        "a capacitor lies at the driver's supply; 0, or -1", "judgement: usual at a motor driver"
    ),
    "wiring_diode": Basis(
        "a diode lies before a supply pin that USB feeds too; 0, or -1",
        "data sheet of the controller: its entry diode_at",
    ),
}


def wiring_findings(chosen: Chosen, wiring: Wiring) -> Iterator[Finding]:
    """Yield the findings of `BASIS`.

    `wiring_contact` is yielded where there is a sensor, `wiring_logic` where the logic levels of both boards are known,
    `wiring_diode` behind a regulator, or where the battery lies at a pin that USB feeds.
    """
    yield _enough_pins(chosen, wiring)
    yield _fit_pins(chosen, wiring)
    yield from _contact_current(chosen, wiring)
    yield from _logic_levels(chosen)
    grounded = {terminal.part for net in wiring.nets if net.kind == "ground" for terminal in net.terminals}
    lacking = [role for role in ("battery", *chosen.boards) if role not in grounded]
    yield _yes_or_no(
        "wiring_ground", not lacking, "error",
        "every board is connected to the battery's minus" if not lacking else f"no ground at {', '.join(lacking)}",
        'give the board a pin with "ground"',
    )  # fmt: skip
    needed_roles = CUT_OFF if chosen.battery.cells > 1 else ("plug",)
    missing = [role for role in needed_roles if role not in chosen.components]
    there = [role for role in CUT_OFF if role in chosen.components]
    yield _yes_or_no(
        "wiring_cut_off", not missing, "error",
        f"no {' and no '.join(missing)}: a motor that the program does not stop runs on" if missing
        else f"{' and '.join(there)} cut{'s' if len(there) == 1 else ''} off the battery",
        " and ".join(f"name one in bought.{role}" for role in missing or CUT_OFF),
    )  # fmt: skip
    yield _yes_or_no(
        "wiring_capacitor", "capacitor" in chosen.components, "warning",
        f"{'a' if 'capacitor' in chosen.components else 'no'} capacitor is connected to the driver's supply",
        "name one in bought.capacitor: without it the starting motor lowers the controller's voltage",
    )  # fmt: skip
    pin = supply_pin(chosen.controller, logic_range(chosen))
    needed = pin in chosen.controller.diode_at
    if chosen.regulator is None and needed:
        yield _yes_or_no(
            "wiring_diode", False, "error",
            f"USB feeds {pin} of {chosen.controller.name}, to which the battery is connected: it would charge the "
            "battery without a charger",
            "name a bought.regulator and a bought.diode, or a bought.controller with pads for the battery",
        )  # fmt: skip
    if chosen.regulator is not None:
        yield _yes_or_no(
            "wiring_diode", not needed or chosen.diode is not None, "error",
            f"{chosen.controller.name} {'has its' if chosen.diode else 'needs a'} diode at {pin}",
            "name one in bought.diode: without it USB feeds current into the regulator's output",
        )  # fmt: skip


def _enough_pins(chosen: Chosen, wiring: Wiring) -> Finding:
    """Return whether every signal has a pin of its own at controller and driver."""
    have = [signal for signal in SIGNALS if signal in wiring.pins]
    needed = ("motor", *(["sleep"] if chosen.driver.with_function("sleep") else []), "ready")
    needed += tuple(GYROSCOPE) if chosen.gyroscope else ()
    missing = [signal for signal in needed if signal not in wiring.pins]
    if "sensor" not in chosen.components:
        return _yes_or_no("wiring_pins", False, "error", "no sensor reports that the springs are loaded",
                          "name one in bought.sensor")  # fmt: skip
    lost = [f for f in ("forward", "motor+", "motor-") if not chosen.driver.with_function(f)]
    twice = [pin for pin, count in Counter(wiring.pins.values()).items() if count > 1]
    if missing:
        wanted = len(have) + len(missing)
        message = f"{chosen.controller.name} has no pin left for {' and '.join(missing)}: {len(have)} of {wanted} suit"
        return _yes_or_no(
            "wiring_pins", False, "error", message, "choose a controller with more pins, or give its pins"
        )
    if lost:
        message = f"driver {chosen.driver.name} has no pin {' and '.join(lost)}"
        return _yes_or_no("wiring_pins", False, "error", message, "choose another bought.driver, or give its pins")
    if twice:
        signals = " and ".join(s for s in have if wiring.pins[s] in twice)
        message = f"{chosen.controller.name}: {', '.join(twice)} is used twice, by {signals}"
        return _yes_or_no("wiring_pins", False, "error", message, "name another pin in [bought.pins]")
    for role, board in chosen.boards.items():
        if role != "controller" and len(board.supply_v) > 1:
            inputs = " and ".join(board.supply_v)
            message = f"{role} {board.name} has the supply inputs {inputs}, of which one alone would be connected"
            remedy = f"choose another bought.{role}, or leave out of its supply_v what needs no wire"
            return _yes_or_no("wiring_pins", False, "error", message, remedy)
    if "battery" not in have:
        return _unmeasured(chosen)
    used = ", ".join(f"{wiring.pins[s]} {s}" for s in have)
    return _yes_or_no("wiring_pins", True, "error", f"pins of {chosen.controller.name}: {used}", "[bought.pins]")


def _unmeasured(chosen: Chosen) -> Finding:
    """Return the warning of a battery that the controller does not measure, with the reason."""
    controller, most = chosen.controller.name, chosen.controller.adc_max_v
    if most is None:
        why = f"{controller} has no adc_max_v: nothing measures the battery"
        remedy = "give the volts that its pins with adc read"
    elif divider_ohm(chosen) is None:
        why = (
            f"{controller} reads {most:g} V at most, and the largest divider leaves more of the "
            f"{chosen.battery.range_v[1]:g} V of a full battery: nothing measures it"
        )
        remedy = "choose another bought.controller or bought.battery"
    else:
        why = f"{controller} has no pin left that measures the battery"
        remedy = "leave a pin with adc free in [bought.pins]"
    return _yes_or_no("wiring_pins", False, "warning", f"{why}, so that it may run down", remedy)


def _fit_pins(chosen: Chosen, wiring: Wiring) -> Finding:
    """Return whether the pins can do what their signals need, and that no strapping pin is among them."""
    wrong = []
    for signal, pin in wiring.pins.items():
        functions = chosen.controller.pins.get(pin, ())
        needed, avoided = SIGNALS[signal], () if signal in GYROSCOPE else AVOIDED
        wrong += [f"{pin} ({signal}) is a {bad.replace('_', ' ')} pin" for bad in avoided if bad in functions]
        if not any(map(GPIO.fullmatch, functions)):
            wrong.append(f"{pin} ({signal}) has no GPIO")
        elif needed and needed not in functions:
            wrong.append(f"{pin} ({signal}) has no {needed}")
    message = "; ".join(wrong) or "no strapping pin is used, and every pin does what its signal needs"
    return _yes_or_no("wiring_strapping", not wrong, "error", message, "name another pin in [bought.pins]")


def _contact_current(chosen: Chosen, wiring: Wiring) -> Iterator[Finding]:
    """Yield whether the sensor's contact gets the current that keeps it clean."""
    sensor, volts = chosen.components.get("sensor"), chosen.controller.logic_v
    if sensor is None or sensor.least_a is None or volts is None:
        return
    ohm = wiring.pull_up_ohm or OWN_PULL_UP_OHM
    by = f"{ohm / 1000:g} kOhm to {volts:g} V" if wiring.pull_up_ohm else "the controller's own pull-up"
    current, needed = 1000.0 * volts / ohm, 1000.0 * sensor.least_a
    yield at_least(
        "wiring_contact", current, needed, "mA",
        f"{by} gives the contact of {sensor.name} {current:.2g} mA; it is rated from {needed:g} mA",
        'give the controller a pin with "out" at its logic_v: a pull-up resistor is connected to it', "warning",
    )  # fmt: skip


def _logic_levels(chosen: Chosen) -> Iterator[Finding]:
    """Yield whether the controller's pins give the volts that the driver's inputs are made for."""
    given, made_for = chosen.controller.logic_v, chosen.driver.logic_v
    if given is None or made_for is None:
        return
    apart, allowed = abs(given - made_for), LOGIC_SHARE * made_for
    yield at_most(
        "wiring_logic", apart, allowed, "V",
        f"the pins of {chosen.controller.name} give {given:g} V, the inputs of {chosen.driver.name} are for "
        f"{made_for:g} V: {apart:.2f} V apart, of {allowed:.2f} V at most",
        "choose another bought.driver or bought.controller; if its data sheet permits that level, give it as the "
        "driver's logic_v", "warning",
    )  # fmt: skip


def _yes_or_no(name: str, good: bool, bad: Severity, message: str, remedy: str) -> Finding:
    return Finding(name, "info" if good else bad, 0.0 if good else -1.0, "", message, remedy)
