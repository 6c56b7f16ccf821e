"""Circuit boards: what their inputs bear, what each of their pins does, and where it is."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.catalogue.articles import Article, Confidence, Mass, Positive, Side, Source, Volts
from jumpcad.files import Contradiction
from jumpcad.files.records import Name, OptionalName, Text

FUNCTIONS = ("ground", "battery", "out", "adc", "pwm", "strapping", "boot_log",
             "forward", "reverse", "sleep", "motor+", "motor-",
             "forward2", "reverse2", "motor2+", "motor2-", "sda", "scl")  # fmt: skip
"""What a pin of a board can do, besides `gpio` and its number; see `Board`."""
GPIO = re.compile("gpio([0-9]{1,6})")
MOST_GPIO = 63
"""Highest number of a GPIO: an ESP32-P4, which has the most of its family, ends at 54 (its data sheet)."""


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names) or "of which it has none"


class Board(Article):
    """A circuit board with its components.

    `supply_v` holds the permitted voltages of each supply input, by the name printed beside it. `pins` holds what the
    other pins do, by their printed names: `ground` (and `battery`: of pads for a cell alone), `out`; of a controller
    `gpio6` with its number, `adc`, `pwm`, `strapping` (its level at start chooses how the chip boots), `boot_log` (the
    chip writes on it at start); of a driver `forward`, `reverse`, `sleep`, `motor+`, `motor-`, of its second bridge
    `forward2` and the like; `sda` and `scl` of a gyroscope, and of a controller's pins that may be its I2C lines, which
    are pulled up at the start. `diode_at` names inputs that need a series diode, `button` the pin of a push button on
    the board. `usb_mm` is the opening (width, height) that the plug of its USB socket needs, whose middle is
    `usb_height_mm` above the board's underside, at an end of its length. `left` and `right` are the pins along its
    sides, from that end on, as seen from above; others are underneath. `logic_v` is the level of a controller's pins,
    or the one that a driver's inputs are made for. `quiescent_a` is the board's own current, radio off, `output_a` its
    largest output current, `charge_ma` the fixed current of its battery charger (a board without it and without
    `battery` pads has none: the battery is then charged outside the robot), `micropython` the name of its image among
    MicroPython's downloads. `before` says what is done to it before it is wired.
    """

    description: Source
    length_mm: Side
    width_mm: Side
    height_mm: Side
    mass_g: Mass
    supply_v: dict[Name, Volts] = Field(default_factory=dict)
    pins: dict[Name, Annotated[tuple[Name, ...], Field(strict=False)]] = Field(default_factory=dict)
    left: Annotated[tuple[Name, ...], Field(strict=False)] = ()
    right: Annotated[tuple[Name, ...], Field(strict=False)] = ()
    diode_at: Annotated[tuple[Name, ...], Field(strict=False)] = ()
    button: OptionalName = ""
    usb_mm: Annotated[tuple[Side, Side], Field(strict=False)] | None = None
    usb_height_mm: Positive = 2.8
    logic_v: Positive | None = None
    adc_max_v: Positive | None = None
    output_v: Positive | None = None
    output_a: Positive | None = None
    quiescent_a: Annotated[float, Field(ge=0, le=10)] = 0.0
    resistance_ohm: Annotated[float, Field(ge=0, le=100)] = 0.0
    efficiency: Annotated[float, Field(ge=0.01, le=1)] = 1.0
    charge_ma: Positive | None = None
    micropython: Text = ""
    before: Text = ""
    confidence: Confidence = "stated"

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield functions that no pin has, pins that cannot be told apart, and names that are of no pin."""
        numbers: dict[int, str] = {}
        for pin, functions in self.pins.items():
            for function in functions:
                if function not in FUNCTIONS and not GPIO.fullmatch(function):
                    reason = f"is no function of a pin: use {', '.join(FUNCTIONS)}, or gpio and its number"
                    yield ("pins", pin), function, reason
            for number in sorted({int(found[1]) for found in map(GPIO.fullmatch, functions) if found}):
                if number > MOST_GPIO:
                    reason = f"must be at most gpio{MOST_GPIO}, the highest that a controller has"
                    yield ("pins", pin), f"gpio{number}", reason
                elif number in numbers:
                    reason = f"is the GPIO of {numbers[number]} already: each pin has its own number"
                    yield ("pins", pin), f"gpio{number}", reason
                elif pin in numbers.values():
                    yield ("pins", pin), f"gpio{number}", "is a second GPIO of one pin: give the one that it has"
                numbers.setdefault(number, pin)
        yield from self._wrong_names(set(numbers.values()))

    def _wrong_names(self, numbered: set[str]) -> Iterator[Contradiction]:
        """Yield pins of a function that stand at two places, and a diode or button at no such pin."""
        places = Counter((*self.left, *self.right))
        shared = {*self.supply_v, *self.with_function("ground"), *self.with_function("out")}
        for side in ("left", "right"):
            for pin in dict.fromkeys(getattr(self, side)):
                if places[pin] > 1 and pin in self.pins and pin not in shared:
                    yield (side,), pin, "stands at two places: name each pin once, from the socket's end on"
                    places[pin] = 1
        for pin in self.diode_at:
            if pin not in self.supply_v:
                yield ("diode_at",), pin, f"is none of the inputs in supply_v, {_listed(self.supply_v)}"
        if self.button and self.button not in numbered:
            reason = f'is none of its pins with a GPIO, {_listed(sorted(numbered))}: "" for a board without a button'
            yield ("button",), self.button, reason

    @property
    def uses(self) -> tuple[str, ...]:
        """What its pins make it: controller, driver, regulator, gyroscope, or several; empty where no pin is given."""
        can = {function for functions in self.pins.values() for function in functions}
        controls, drives = any(map(GPIO.fullmatch, can)), bool(can & {"forward", "reverse", "motor+", "motor-"})
        regulates = "out" in can and not controls and not drives
        kinds = {"controller": controls, "driver": drives, "regulator": regulates,
                 "gyroscope": "sda" in can and not controls}  # fmt: skip
        return tuple(kind for kind, found in kinds.items() if found)

    def with_function(self, function: str) -> tuple[str, ...]:
        """Return the pins that do something, in the board's order."""
        return tuple(name for name, functions in self.pins.items() if function in functions)
