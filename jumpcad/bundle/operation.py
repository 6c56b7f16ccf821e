"""How a robot is charged and by what it is operated: words that the guide and the firmware's README share."""

from collections.abc import Iterator

from jumpcad.catalogue import Battery, Board
from jumpcad.catalogue.electrical import DEAD_CELL_V
from jumpcad.electronics.chosen import Chosen
from jumpcad.electronics.supply import supply_of

STORED_V = 3.8
"""Per lithium polymer cell at rest, for storage; practice."""
BUTTON_DELAY_MS = 3000
"""Time to step back after the button was pressed; judgement."""
FULL_AFTER = 1.5
"""Time to charge over that of the capacity at the full current, which falls at the end; judgement."""


def charging(chosen: Chosen) -> str:
    """Return how the battery is charged, with which current."""
    battery, controller = chosen.battery, chosen.controller
    if not chosen.charged_by_usb:
        bears_ma = min(battery.capacity_mah, battery.bears_ma)
        return (
            f"Charge with {bears_ma:.0f} mA at most ({bears_ma / battery.capacity_mah:.2g} C) by a "
            f"{charger(battery)}, set to LiPo {battery.cells}S, outside the robot."
        )
    way = "Charge through the controller's USB socket, with the switch on and somebody beside it."
    if controller.charge_ma is None:
        return (
            f"{way} What its charger gives is not known: measure it, {battery.bears_ma:.0f} mA at most. A pack that "
            "does not bear it must not be used with the USB cable in and the switch on."
        )
    rate = controller.charge_ma / battery.capacity_mah
    bears = (
        f"{way} Its charger gives {controller.charge_ma:.0f} mA, which cannot be set: {rate:.2f} C for this battery. "
        f"An empty one is full after about {FULL_AFTER / rate:.1f} h: {battery.range_v[1]:g} V, and the board's charge "
        "lamp goes out."
    )
    if rate <= 1.0:
        return bears
    return (
        f"{bears} More than 1 C: use only a pack whose maker permits {controller.charge_ma:.0f} mA. With the USB cable "
        "in and the switch on it is always charged so, and first power-up and first winding need both."
    )


def charger(battery: Battery) -> str:
    """Return what charges a battery outside the robot: a pack of one cell has no balance lead."""
    return "charger with a balance lead" if battery.cells > 1 else "charger for one cell"


def charging_loaded(chosen: Chosen) -> str:
    """Return how to charge while the springs are partly loaded, so that nobody's hand is in the leg's way."""
    if chosen.charged_by_usb:
        return (
            "Lay the robot on its side, nothing in the leg's way, and charge it over USB with the switch on; do not "
            "open it."
        )
    return (
        "Lay the robot on its side, feet away from you, and tie leg and body together with cord, so that the leg "
        "cannot swing out. Then unplug the battery, charge it outside the robot, put it back, and untie."
    )


def fed_by_usb(chosen: Chosen) -> bool:
    """Tell whether USB feeds the driver too: through the board's charger and its battery pads, past the switch."""
    return chosen.charged_by_usb


def usb_out(chosen: Chosen) -> str:
    """Return the beginning of a measurement of the battery's current: what else feeds the boards is taken away."""
    if not chosen.controller.button:
        return "USB cable in, whose computer feeds the controller, so that it is not read"
    if fed_by_usb(chosen):
        return "USB cable out, since its charger would be read too, and commands by the board's button"
    return "USB cable out, since it would feed the board, and commands by the board's button"


def switching_off(chosen: Chosen) -> str:
    """Return how all supplies but the battery's plug are cut, as the beginning of a sentence."""
    return "Pull the USB cable and switch off" if fed_by_usb(chosen) else "Switch off, pull the USB cable"


def stops_the_motor(chosen: Chosen) -> str:
    """Return what stops a motor that the program does not."""
    if fed_by_usb(chosen):
        return "only the switch, with the USB cable out, stops the motor: the board's charger feeds the driver too"
    return "only the switch stops the motor"


def to_stop(chosen: Chosen) -> str:
    """Return how a robot that winds, or is about to jump, is stopped, and what to do then."""
    if chosen.controller.button:
        by, resume = "press the same button once more, or switch off", "press the button"
    else:
        off = "pull the USB cable and switch off" if fed_by_usb(chosen) else "switch off"
        by, resume = f"type `stop`, or {off}", "type `wind`"
    return (
        f"To stop it while it winds or before it jumps: {by}. The motor is off and the springs stay as they are, "
        "held by the friction of the gearhead; should that give way, the cam turns back and they become slack. The way "
        f"out: nothing in the leg's way, {resume} again, it winds on to the end; then let it jump."
    )


def bootloader(controller: Board) -> str:
    """Return how a controller is put into its bootloader, before MicroPython is installed."""
    if not controller.button:
        return "Put the board into its bootloader as its maker says."
    return (
        f"Put the board into its bootloader: hold the button of pin {controller.button} (marked B or BOOT), on the "
        "board beside its USB socket, while you plug in the USB cable, and let go a second later."
    )


def after_use(chosen: Chosen) -> Iterator[str]:
    """Yield the guide's section on the end of use."""
    battery, supply = chosen.battery, supply_of(chosen)
    hours = battery.capacity_mah / 1000.0 * battery.voltage_v / supply.boards_w
    yield from ("", "## After use", "")
    yield (
        "- Release the springs: `jump`; where they are partly loaded, `wind` first. The leg is then back at its stop. "
        "Where nothing turns, see the next section."
    )
    yield f"- {switching_off(chosen)}, unplug the battery: boards left on empty a full one in {hours:.0f} h."
    yield (
        f"- Store it outside the robot, at about {STORED_V * battery.cells:.1f} V, where nothing near it can burn. "
        f"Below {DEAD_CELL_V * battery.cells:.1f} V at rest, swollen or dented: do not charge it, discard it where "
        "batteries are collected."
    )


def cable(controller: Board) -> str:
    """Return what becomes of the USB cable before a jump."""
    if controller.button:
        return "Unplug the USB cable before you wind for a jump: the battery supplies the board."
    return "The board has no button, so the USB cable stays in: lay a long one slack behind the robot."


def by_button(command: str, controller: Board) -> str:
    """Return how to give the command `wind` or `jump`, with the board's button where it has one."""
    if not controller.button:
        return f"Type `{command}`."
    if command == "jump":
        return f"Press the same button again and step back: it releases after {BUTTON_DELAY_MS / 1000.0:g} s."
    return (
        f"Press the button of pin {controller.button} (marked B or BOOT), on the board beside its USB socket, with a "
        "thin wooden stick, from above between the plates: it winds until it is ready and the motor stops. "
        "The other button, R or RESET, restarts the program; the springs stay as they are: press the first again."
    )
