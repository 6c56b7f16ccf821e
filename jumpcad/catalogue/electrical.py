"""Electrical articles: motors, batteries, boards, small components, and kits of them that fit together."""

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from jumpcad.catalogue.articles import Article, Confidence, Length, Mass, Positive, Side, Source
from jumpcad.files import Contradiction, TomlTable
from jumpcad.files.names import Name, OptionalName, Text

STEEL_G_CM3 = 7.85
"""Density of steel (EN 1991-1-1, table A.4: 77 to 78.5 kN/m³)."""
CELL_V = (3.3, 3.7, 4.2)
"""One lithium polymer cell: empty under light load, nominal, full; the usual figures of makers."""
CELL_OHM = 0.15
"""Internal resistance of a small cell where none is given; judgement: 0.05 to 0.3 are usual."""
FUNCTIONS = ("ground", "battery", "out", "adc", "pwm", "strapping", "boot_log",
             "forward", "reverse", "sleep", "motor+", "motor-")  # fmt: skip
"""What a pin of a board can do, besides `gpio` and its number; see `Board`."""
GPIO = re.compile("gpio([0-9]{1,6})")
MOST_GPIO = 63
"""Highest number of a GPIO: an ESP32-P4, which has the most of its family, ends at 54 (its data sheet)."""
RATED_SHARES = (0.25, 1.0)
"""Lowest and highest voltage of a motor over its rated one where none is given; judgement: below, it may not start."""


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names) or "of which it has none"


def _ascending(volts: tuple[float, float]) -> tuple[float, float]:
    if volts[0] >= volts[1]:
        raise PydanticCustomError("value_error", "must be [lowest, highest] in volts")
    return volts


Volts = Annotated[tuple[Positive, Positive], Field(strict=False), AfterValidator(_ascending)]
"""The lowest and the highest permitted voltage."""


class Motor(Article):
    """A brushed gear motor.

    Its body is a box along its axis; width and height are the largest of gearhead and motor across it. The shaft
    stands in the middle of the box, in a boss at the gearhead's front, and has a flat (`shaft_flat_mm` across it).
    """

    ratio: Positive
    voltage_v: Positive
    no_load_rpm: Positive
    no_load_current_a: Positive
    stall_torque_nm: Positive
    stall_current_a: Positive
    mass_g: Mass
    width_mm: Annotated[Length, Field(ge=5)]
    height_mm: Annotated[Length, Field(ge=5)]
    body_length_mm: Annotated[Length, Field(ge=8)]
    shaft_mm: Annotated[Length, Field(ge=1)]
    shaft_flat_mm: Length
    shaft_length_mm: Length
    boss_mm: Length
    boss_length_mm: Annotated[float, Field(ge=0, le=50)]
    article: Text = ""
    bears_v: Volts | None = None
    confidence: Confidence = "stated"

    @property
    def range_v(self) -> tuple[float, float]:
        """The lowest and highest voltage that the motor is run at."""
        low, high = RATED_SHARES
        return self.bears_v or (low * self.voltage_v, high * self.voltage_v)

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield impossible shafts and bosses, and figures that violate the conservation of energy."""
        shaft, narrow = self.shaft_mm, min(self.width_mm, self.height_mm)
        if not shaft / 2.0 < self.shaft_flat_mm < shaft:
            reason = f"must be more than {shaft / 2.0:g} and less than shaft_mm = {shaft:g}: a flat turns the pinion"
            yield ("shaft_flat_mm",), self.shaft_flat_mm, reason
        if not shaft <= self.boss_mm <= narrow:
            reason = f"must be at least shaft_mm = {shaft:g} and at most {narrow:g}, the body's narrower side"
            yield ("boss_mm",), self.boss_mm, reason
        if self.shaft_length_mm <= self.boss_length_mm:
            reason = f"must be more than boss_length_mm = {self.boss_length_mm:g}: measure both from the gearhead"
            yield ("shaft_length_mm",), self.shaft_length_mm, reason
        steel = STEEL_G_CM3 * math.pi / 4.0 * shaft**2 * self.shaft_length_mm / 1000.0
        if self.mass_g <= steel:
            yield ("mass_g",), self.mass_g, f"must be more than {steel:.2g}, what its steel shaft alone weighs"
        if self.no_load_current_a >= self.stall_current_a:
            reason = f"must be less than stall_current_a = {self.stall_current_a:g}"
            yield ("no_load_current_a",), self.no_load_current_a, reason
            return
        # of a DC machine at half its speed: half the torque, and the mean of both currents
        power = self.no_load_rpm * math.pi / 30.0 / 2.0 * self.stall_torque_nm / 2.0
        drawn = self.voltage_v * (self.no_load_current_a + self.stall_current_a) / 2.0
        if power >= drawn:
            reason = f"at half speed it would give {power:.2g} W and draw {drawn:.2g} W: is it in N·m?"
            yield ("stall_torque_nm",), self.stall_torque_nm, reason


class Battery(Article):
    """A battery pack: length along the robot, width across it; `charge_ma` is the largest charging current."""

    description: Source
    length_mm: Side
    width_mm: Side
    height_mm: Side
    mass_g: Mass
    voltage_v: Positive
    capacity_mah: Positive
    full_v: Positive | None = None
    empty_v: Positive | None = None
    discharge_a: Positive | None = None
    charge_ma: Positive | None = None
    resistance_ohm: Positive | None = None
    plug: Text = ""
    confidence: Confidence = "stated"

    @property
    def cells(self) -> int:
        """Number of cells in series."""
        return max(1, round(self.voltage_v / CELL_V[1]))

    @property
    def range_v(self) -> tuple[float, float]:
        """Voltage when empty and when full; where it is not given, that of lithium polymer cells."""
        return self.empty_v or self.cells * CELL_V[0], self.full_v or self.cells * CELL_V[2]

    @property
    def ohm(self) -> float:
        """Internal resistance."""
        return self.resistance_ohm or self.cells * CELL_OHM

    @property
    def bears_ma(self) -> float:
        """The largest charging current; where it is not given 1 C, which makers of small cells permit."""
        return self.charge_ma or self.capacity_mah

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield voltages that are not in the order empty, nominal, full."""
        empty, full = self.range_v
        if not empty < self.voltage_v < full:
            reason = f"must lie between empty_v = {empty:g} and full_v = {full:g}"
            yield ("voltage_v",), self.voltage_v, reason


class Board(Article):
    """A circuit board with its components.

    `supply_v` holds the permitted voltages of each supply input, by the name printed beside it. `pins` holds what the
    other pins do, by their printed names: `ground` (and `battery`: of pads for a cell alone), `out`; of a controller
    `gpio6` with its number, `adc`, `pwm`, `strapping` (its level at start chooses how the chip boots), `boot_log` (the
    chip writes on it at start); of a driver `forward`, `reverse`, `sleep`, `motor+`, `motor-`. `diode_at` names inputs
    that need a series diode, `button` the pin of a push button on the board. `usb_mm` is the opening (width, height)
    that the plug of its USB socket needs, whose middle is `usb_height_mm` above the board's underside, at an end of its
    length. `left` and `right` are the pins along its sides, from that end on, as seen from above; others are
    underneath. `quiescent_a` is the board's own current, radio off, `output_a` its largest output current, `charge_ma`
    the fixed current of its battery charger, `micropython` the name of its image among MicroPython's downloads.
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

    def with_function(self, function: str) -> tuple[str, ...]:
        """Return the pins that do something, in the board's order."""
        return tuple(name for name, functions in self.pins.items() if function in functions)


class Travel(TomlTable):
    """A switch's plunger: positions of its tip from the base of the case, as data sheets give them (mm, N).

    Free at most, operating with its tolerance, at the end of its travel at most; how far it must go back to open, its
    diameter, that of the seal around it, and the force that operates it.
    """

    free_mm: Length
    operating_mm: Length
    operating_tolerance_mm: Annotated[float, Field(ge=0, le=5)]
    total_mm: Length
    differential_mm: Annotated[float, Field(ge=0, le=5)]
    pin_mm: Length
    seal_mm: Length
    force_n: Positive


class Component(Article):
    """A small electrical part: sensor, switch, plug, capacitor, diode or wire; `terminals` as its maker names them.

    `rated_a` and `rated_v` are its ratings, `least_a` the least current that keeps a contact clean, `drop_v` its
    voltage drop. Length, width and height are those of its case
    without terminals; `travel` is that of a sensor's plunger, in the middle of the case, along its height.
    """

    description: Source
    mass_g: Mass
    length_mm: Side | None = None
    width_mm: Side | None = None
    height_mm: Side | None = None
    travel: Travel | None = None
    terminals: Annotated[tuple[Text, ...], Field(strict=False)] = ()
    rated_a: Positive | None = None
    rated_v: Positive | None = None
    least_a: Positive | None = None
    drop_v: Annotated[float, Field(ge=0, le=5)] = 0.0
    confidence: Confidence


class ElectricalParts(TomlTable):
    """Names of electrical parts in the catalogue; an empty name leaves a part out."""

    motors: Annotated[tuple[Name, ...], Field(strict=False)]
    battery: Name
    controller: Name
    driver: Name
    regulator: OptionalName
    sensor: OptionalName
    switch: OptionalName
    plug: OptionalName
    capacitor: OptionalName
    diode: OptionalName
    wire: OptionalName


class Kit(ElectricalParts):
    """Electrical parts that fit together; `source` says why they do."""

    name: Annotated[Name, Field(exclude=True)]
    source: Annotated[Source, Field(exclude=True)]
    confidence: Annotated[Confidence, Field(exclude=True)]
