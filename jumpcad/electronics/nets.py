"""The net list: which terminals are connected, and by what wire.

Terminals have the names printed on the boards. Pins of the controller are chosen by what they can do, or named by the
workshop (`[bought.pins]`).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from jumpcad.catalogue import Board
from jumpcad.catalogue.boards import GPIO
from jumpcad.electronics.supply import Chosen, supply_pin
from jumpcad.errors import CannotBuildError

LOWER_OHM = 200_000
UPPER_OHMS = (200_000, 470_000, 680_000, 1_000_000)
"""Resistors of the divider that measures the battery, below and above the pin; values of the E12 series."""
PULL_UP_OHMS = (1_000, 1_500, 2_200, 3_300, 4_700, 10_000)
"""Resistors from the sensor's pin to the logic supply; values of the E6 series."""
PULL_UP_MORE = 1.1
"""Current of the sensor's contact over the least that it is rated for: resistors of 5 %, and the supply's 5 %."""
AT = {"upper resistor": "controller", "lower resistor": "controller", "pull-up resistor": "controller",
      "diode": "controller", "capacitor": "driver"}  # fmt: skip
"""Small parts, and the board at which they are soldered where a net has a terminal of it."""
SIGNALS = {"battery": "adc", "motor": "pwm", "sleep": "", "ready": "", "steer": "pwm", "steer_reverse": "pwm",
           "gyro_data": "sda", "gyro_clock": "scl"}  # fmt: skip
"""Signals of the controller in the order in which they get their pins, and what a pin must be able to do."""
STEERING = {"steer": "forward2", "steer_reverse": "reverse2"}
"""Signals of the motor that steers, and inputs of the driver's second bridge."""
GYROSCOPE = {"gyro_data": "sda", "gyro_clock": "scl"}
"""Signals of the gyroscope, and its pins; its own board pulls them up."""
AVOIDED = ("strapping", "boot_log")
"""Functions that make a pin unsuitable: its level at start chooses how the chip boots, or the chip writes on it. Pins
that may be a gyroscope's say so."""
COLOURS = {"supply": "red", "logic": "orange", "ground": "black", "motor": "blue", "signal": "yellow"}


@dataclass(frozen=True)
class Terminal:
    """A terminal of a part: `part` is a role, such as `driver`, `pin` its printed name."""

    part: str
    pin: str

    def __str__(self) -> str:
        return f"{self.part} {self.pin}"


@dataclass(frozen=True)
class Net:
    """Terminals that are connected; the first is the source of their voltage or signal. `kind` gives the colour."""

    name: str
    kind: str
    terminals: tuple[Terminal, ...]

    @property
    def colour(self) -> str:
        return COLOURS[self.kind]

    @property
    def wires(self) -> Iterator[tuple[Terminal, Terminal]]:
        """Both ends of every wire: from the first terminal, the plug that comes after it, or a small part's board."""
        start, *others = self.terminals
        for end in others:
            board = (terminal for terminal in self.terminals if terminal.part == AT.get(end.part))
            yield next(board, start), end
            start = end if end.part == "plug" else start


@dataclass(frozen=True)
class Wiring:
    """All nets; `pins` are the controller's by signal (absent where none is left), `upper_ohm` is of the divider.

    `pull_up_ohm` is that of the sensor's pin, `contact` the sensor's terminal there.
    """

    nets: tuple[Net, ...]
    pins: dict[str, str]
    upper_ohm: int | None
    pull_up_ohm: int | None = None
    contact: str = ""

    @property
    def divider(self) -> float:
        """The battery's voltage over that at the controller's pin."""
        return 1.0 if self.upper_ohm is None else (LOWER_OHM + self.upper_ohm) / LOWER_OHM

    @property
    def ready_level(self) -> int:
        """Level of the sensor's pin at the ready position: 1 with a contact that opens there."""
        return int(self.contact == "NC")

    @property
    def resistors(self) -> dict[str, int]:
        """The resistors by their parts' names (ohm)."""
        divider = {} if self.upper_ohm is None else {"upper resistor": self.upper_ohm, "lower resistor": LOWER_OHM}
        return divider | ({} if self.pull_up_ohm is None else {"pull-up resistor": self.pull_up_ohm})


def wiring_of(chosen: Chosen, named: Mapping[Any, str], steers: bool = False) -> Wiring:
    """Return the net list of a workshop's parts; `named` are pins that the workshop names, by signal.

    A robot that `steers` has a second motor, which turns either way, at the driver's second bridge.
    """
    upper = divider_ohm(chosen)
    wanted = [s for s in SIGNALS if not (s == "battery" and upper is None)]
    wanted = [s for s in wanted if steers or s not in STEERING]
    wanted = [s for s in wanted if chosen.gyroscope or s not in GYROSCOPE]
    wanted = [s for s in wanted if not (s == "sleep" and not chosen.driver.with_function("sleep"))]
    wanted = [s for s in wanted if not (s == "ready" and "sensor" not in chosen.components)]
    pins = _pins(chosen.controller, wanted, named)
    pull_up, contact = _pull_up_ohm(chosen) if "ready" in pins else None, _contact(chosen)
    nets = (*_power_nets(chosen, pins, upper), _ground_net(chosen, pins), *_signal_nets(chosen, pins, contact, pull_up))
    nets = tuple(net for net in nets if len(net.terminals) > 1)
    return Wiring(nets, pins, upper if "battery" in pins else None, pull_up, contact)


def gpio(board: Board, pin: str) -> int:
    """Return the number of a controller's pin."""
    for function in board.pins.get(pin, ()):
        if found := GPIO.fullmatch(function):
            return int(found[1])
    raise CannotBuildError(f"{board.name} has no GPIO at {pin}: name another pin in [bought.pins]")


def _pins(controller: Board, wanted: list[str], named: Mapping[Any, str]) -> dict[str, str]:
    """Return a pin for each signal while there are any: those named, then the least capable suitable one."""
    pins = {signal: named[signal] for signal in wanted if signal in named}
    for signal in wanted:
        if signal in pins:
            continue
        free = [
            name
            for name, functions in controller.pins.items()
            if any(map(GPIO.fullmatch, functions))
            and (signal in GYROSCOPE or not set(AVOIDED) & set(functions))
            and name not in pins.values()
            and (not SIGNALS[signal] or SIGNALS[signal] in functions)
        ]
        if free:
            pins[signal] = min(free, key=lambda name: len(controller.pins[name]))
    return {signal: pins[signal] for signal in wanted if signal in pins}


def divider_ohm(chosen: Chosen) -> int | None:
    """Return the divider's upper resistor with which a full battery stays in the converter's range, if any does."""
    if chosen.controller.adc_max_v is None:
        return None
    full = chosen.battery.range_v[1]
    fits = (r for r in UPPER_OHMS if full * LOWER_OHM / (LOWER_OHM + r) <= chosen.controller.adc_max_v)
    return next(fits, None)


def _pull_up_ohm(chosen: Chosen) -> int | None:
    """Return the largest resistor that gives the sensor's contact its least current; None without one, or a supply."""
    sensor, volts = chosen.components.get("sensor"), chosen.controller.logic_v
    if sensor is None or volts is None or not chosen.controller.with_function("out"):
        return None
    most = PULL_UP_OHMS[-1] if sensor.least_a is None else volts / (PULL_UP_MORE * sensor.least_a)
    return max((ohm for ohm in PULL_UP_OHMS if ohm <= most), default=None)


def _contact(chosen: Chosen) -> str:
    """Return the sensor's terminal at the controller.

    A contact that opens at the ready position is wanted: a broken lead, a missing ground or a dirty contact then reads
    as ready, and the motor stops.
    """
    sensor = chosen.components.get("sensor")
    return "" if sensor is None else "NC" if "NC" in sensor.terminals else "NO"


def logic_range(chosen: Chosen) -> tuple[float, float]:
    """Return the volts at the controller's supply input, without load."""
    if chosen.regulator is None:
        return chosen.battery.range_v
    volts = (chosen.regulator.output_v or 0.0) - (chosen.diode.drop_v if chosen.diode else 0.0)
    return volts, volts


def _power_nets(chosen: Chosen, pins: dict[str, str], upper: int | None) -> Iterator[Net]:
    """Yield the battery's plus up to the switch, behind it, and the regulator's output."""
    components, battery = chosen.components, chosen.battery.range_v
    plug = [Terminal("plug", "+")] if "plug" in components else []
    before = [Terminal("battery", "+"), *plug]
    if "switch" in components:
        yield Net("battery", "supply", (*before, Terminal("switch", "1")))
        before = [Terminal("switch", "2")]
    ends = [*before, Terminal("driver", supply_pin(chosen.driver, battery))]
    ends += [Terminal("capacitor", "+")] if "capacitor" in components else []
    ends += [Terminal("upper resistor", "1")] if "battery" in pins else []
    controller = Terminal("controller", supply_pin(chosen.controller, logic_range(chosen)))
    if chosen.regulator is None:
        yield Net("battery switched", "supply", (*ends, controller))
        return
    yield Net("battery switched", "supply", (*ends, Terminal("regulator", supply_pin(chosen.regulator, battery))))
    out = Terminal("regulator", next(iter(chosen.regulator.with_function("out")), "OUT"))
    if chosen.diode is None:
        yield Net("regulated", "logic", (out, controller))
    else:
        yield Net("regulated", "logic", (out, Terminal("diode", "A")))
        yield Net("behind the diode", "logic", (Terminal("diode", "K"), controller))


def _ground_net(chosen: Chosen, pins: dict[str, str]) -> Net:
    """Return what is connected to the battery's minus, the driver's reverse input too: the cam must not turn back."""
    components = chosen.components
    ends = [Terminal("battery", "-")]
    ends += [Terminal("plug", "-")] if "plug" in components else []
    for role, board in chosen.boards.items():
        unused = set(board.with_function("battery")) if chosen.regulator is not None else set()
        ends += [Terminal(role, pin) for pin in board.with_function("ground") if pin not in unused][:1]
    ends += [Terminal("driver", pin) for pin in chosen.driver.with_function("reverse")]
    ends += [Terminal("capacitor", "-")] if "capacitor" in components else []
    ends += [Terminal("sensor", "COM")] if "sensor" in components else []
    ends += [Terminal("lower resistor", "2")] if "battery" in pins else []
    return Net("ground", "ground", tuple(ends))


def _signal_nets(chosen: Chosen, pins: dict[str, str], contact: str, pull_up: int | None) -> Iterator[Net]:
    """Yield the wires between controller, driver, gyroscope, sensor, divider and motor."""
    driver, gyroscope = chosen.driver, chosen.gyroscope
    for signal, function in (("motor", "forward"), ("sleep", "sleep"), *STEERING.items(), *GYROSCOPE.items()):
        part = "gyroscope" if signal in GYROSCOPE else "driver"
        if signal in pins:
            inputs = (Terminal(part, pin) for pin in chosen.boards[part].with_function(function))
            yield Net(signal, "signal", (Terminal("controller", pins[signal]), *inputs))
    if "ready" in pins:
        ends = (Terminal("controller", pins["ready"]), Terminal("sensor", contact))
        yield Net("ready", "signal", ends if pull_up is None else (*ends, Terminal("pull-up resistor", "1")))
    fed = [Terminal("pull-up resistor", "2")] if pull_up is not None else []
    if gyroscope is not None:
        fed.append(Terminal("gyroscope", supply_pin(gyroscope, (chosen.controller.logic_v or 0.0,) * 2)))
    for out in chosen.controller.with_function("out")[:1] if fed else ():
        yield Net("logic supply", "logic", (Terminal("controller", out), *fed))
    if "battery" in pins:
        middle = (Terminal("upper resistor", "2"), Terminal("lower resistor", "1"))
        yield Net("battery measured", "signal", (Terminal("controller", pins["battery"]), *middle))
    for function in ("motor+", "motor-"):
        pins_out = tuple(Terminal("driver", p) for p in driver.with_function(function)[:1])
        yield Net(function, "motor", (*pins_out, Terminal("motor", function[-1])))
    for sign in "+-" if STEERING.keys() <= pins.keys() else "":
        pins_out = tuple(Terminal("driver", p) for p in driver.with_function(f"motor2{sign}")[:1])
        yield Net(f"steering{sign}", "motor", (*pins_out, Terminal("steering motor", sign)))
