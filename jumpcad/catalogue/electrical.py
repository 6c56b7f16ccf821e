"""Electrical articles: motors, batteries, small components, and kits of parts that fit together."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from jumpcad.catalogue.articles import STEEL_G_CM3, Article, Confidence, Length, Mass, Positive, Side, Source, Volts
from jumpcad.files import Contradiction, TomlTable
from jumpcad.files.records import Name, OptionalName, Text

CELL_V = (3.3, 3.7, 4.2)
"""One lithium polymer cell: empty under light load, nominal, full; the usual figures of makers."""
PACK_WH_KG = (20.0, 500.0)
"""Energy of a lithium pack by its mass, with leads and plug; judgement: 80 to 265 Wh/kg are usual."""
DEAD_CELL_V = 3.0
"""One lithium polymer cell at rest, below which it is spoiled; practice."""
CELL_OHM = 0.15
"""Internal resistance of a small cell where none is given; judgement: 0.05 to 0.3 are usual."""
ROUND_OFF_V = 1e-6
RATED_SHARES = (0.25, 1.0)
"""Lowest and highest voltage of a motor over its rated one where none is given; judgement: below, it may not start."""

EFFICIENCY, FREE_SHARE, ROTOR_RPM = 0.5, 0.06, 20000.0
"""Of a gear motor where none is given: efficiency at stall, no-load over stall current, no-load speed of the rotor;
judgement: 0.48 to 0.70, 0.056 to 0.107 and 13,000 to 34,000 of those that ship."""

ComponentKind = Literal["sensor", "switch", "plug", "capacitor", "diode", "wire"]
"""What a small part is; a workshop names one of each kind under that word."""


class Motor(Article):
    """A brushed gear motor.

    Its body is a box along its axis; width and height are the largest of gearhead and motor across it. The shaft
    stands in the middle of the box, in a boss at the gearhead's front, and has a flat (`shaft_flat_mm` across it).
    Without `stall_torque_nm` it follows from no-load speed and stall current at `voltage_v` with the gearhead's
    `efficiency` at stall, 0.5 unless given. `ratio` and `no_load_current_a` may be left out too. `torque_max_nm` is
    what its gears bear, where that is not what an N20's do.
    """

    ratio: Positive = 0.0
    voltage_v: Positive
    no_load_rpm: Positive
    no_load_current_a: Positive = 0.0
    stall_torque_nm: Positive = 0.0
    efficiency: Annotated[float | None, Field(exclude=True, ge=0.05, le=1)] = None
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
    torque_max_nm: Positive | None = None
    confidence: Confidence = "stated"

    @property
    def range_v(self) -> tuple[float, float]:
        """The lowest and highest voltage that the motor is run at."""
        low, high = RATED_SHARES
        return self.bears_v or (low * self.voltage_v, high * self.voltage_v)

    @property
    def lossless_nm(self) -> float:
        """Stall torque of a DC machine without friction, (V - I0·R)/ω0·(Is - I0) with R = V/Is."""
        free = self.no_load_current_a / self.stall_current_a
        per_a = self.voltage_v * (1.0 - free) / (self.no_load_rpm * math.pi / 30.0)
        return per_a * self.stall_current_a * (1.0 - free)

    @model_validator(mode="after")
    def _completed(self) -> Self:
        ratio, free_a = ROTOR_RPM / self.no_load_rpm, FREE_SHARE * self.stall_current_a
        self._follows(ratio=float(f"{min(max(ratio, 1.0), 1e5):.3g}"), no_load_current_a=max(free_a, 1e-4))
        self._follows("efficiency", stall_torque_nm=float(f"{(self.efficiency or EFFICIENCY) * self.lossless_nm:.4g}"))
        return self

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
        if self.stall_torque_nm > (most := self.lossless_nm):
            reason = (
                f"must be at most {most:.3g}, which no_load_rpm and stall_current_a give at {self.voltage_v:g} V "
                f"with an efficiency of 100 %; this is {100.0 * self.stall_torque_nm / most:.0f} %: is it in N·m?"
            )
            yield ("stall_torque_nm",), self.stall_torque_nm, reason
        elif self.efficiency:
            yield ("efficiency",), self.efficiency, "stall_torque_nm says it too: give one of the two"
        elif not 1e-4 <= self.stall_torque_nm <= 1e5:
            reason = f"with no_load_rpm it makes a motor of {self.stall_torque_nm:.2g} N·m: is it in A?"
            yield ("stall_current_a",), self.stall_current_a, reason


class Battery(Article):
    """A pack of lithium polymer or lithium-ion cells: length along the robot, width across it.

    `charge_ma` is the largest charging current. Packs of other cells (LiFePO4, NiMH, alkaline) are not for these
    robots: a LiPo charger charges each cell to 4.2 V.
    """

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
        """Yield voltages out of their order, or that lithium polymer cells do not have, and an energy that none has."""
        empty, full = self.range_v
        if not empty < self.voltage_v < full:
            reason = f"must lie between empty_v = {empty:g} and full_v = {full:g}"
            yield ("voltage_v",), self.voltage_v, reason
        cells = "one lithium cell" if self.cells == 1 else f"{self.cells} lithium cells"
        charged, dead = self.cells * CELL_V[2], self.cells * DEAD_CELL_V
        if full < charged - ROUND_OFF_V:
            reason = f"must be at least {charged:g}, to which LiPo chargers charge {cells}: others are overcharged"
            yield ("full_v",), full, reason
        if empty < dead - ROUND_OFF_V:
            yield ("empty_v",), empty, f"must be at least {dead:g}: below, {cells} would be spoiled"
        least, most = PACK_WH_KG
        held = self.capacity_mah * self.voltage_v / self.mass_g  # mW·h/g, which is W·h/kg
        if not least <= held <= most:
            reason = f"with {self.mass_g:g} g that is {held:.2g} Wh/kg, and lithium packs have {least:g} to {most:g}"
            yield ("capacity_mah",), self.capacity_mah, f"{reason}: is it in mAh, and mass_g in g?"


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
    """A small electrical part: its `kind` says which, `terminals` are as its maker names them.

    `rated_a` and `rated_v` are its ratings, `least_a` the least current that keeps a contact clean, `drop_v` its
    voltage drop. Length, width and height are those of its case
    without terminals; `travel` is that of a sensor's plunger, in the middle of the case, along its height.
    """

    kind: ComponentKind
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
