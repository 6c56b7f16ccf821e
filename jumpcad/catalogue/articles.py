"""Entries of the catalogue: motors, bearings, batteries, boards and springs, shipped and a user's own.

Every article names the source of its figures. Lengths in mm, masses in g, torques in N·m.
"""

import math
from collections.abc import Iterable, Iterator
from typing import Annotated, Any, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field
from pydantic_core import PydanticCustomError

from jumpcad.files import Contradiction, TomlTable
from jumpcad.files.names import Name, Text

STEEL_G_CM3 = 7.85
"""Density of steel (EN 1991-1-1, table A.4: 77 to 78.5 kN/m³)."""
RINGS_MM = 2.0
"""Least difference of outside diameter and bore of a bearing: that of the smallest of ISO 15, 1 x 3 mm."""


def _not_blank(text: str) -> str:
    if not text.strip():
        raise PydanticCustomError("value_error", "is empty: say where the figures come from")
    return text


# Lower limits keep quotients finite: they are below the figures of any article.
Length = Annotated[float, Field(ge=0.01, le=500)]
Side = Annotated[float, Field(ge=0.5, le=500)]
Mass = Annotated[float, Field(ge=1e-3, le=5000)]
Positive = Annotated[float, Field(ge=1e-4, le=1e5)]
Source = Annotated[Text, AfterValidator(_not_blank)]


class Article(TomlTable):
    """A part to buy; its name is that of its table."""

    name: Annotated[Name, Field(exclude=True)]
    source: Source

    def contradictions(self) -> Iterable[Contradiction]:
        """Return values that are allowed alone but not together."""
        return ()


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

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield shafts and bosses that no motor has, and figures that break the conservation of energy."""
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


class Bearing(Article):
    """A ball bearing."""

    bore_mm: Length
    outer_mm: Length
    width_mm: Annotated[Length, Field(le=50)]
    mass_g: Mass
    static_load_n: Positive

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield a bearing without room for its rings and balls."""
        if self.outer_mm < self.bore_mm + RINGS_MM:
            reason = f"must be at least bore_mm + {RINGS_MM:g} = {self.bore_mm + RINGS_MM:g}: rings and balls between"
            yield ("outer_mm",), self.outer_mm, reason


class Battery(Article):
    """A battery pack: length along the robot, width across it."""

    description: Source
    length_mm: Side
    width_mm: Side
    height_mm: Side
    mass_g: Mass
    voltage_v: Positive
    capacity_mah: Positive


class Board(Article):
    """A circuit board with its components."""

    description: Source
    length_mm: Side
    width_mm: Side
    height_mm: Side
    mass_g: Mass


class StockSpring(Article):
    """A torsion spring from stock; `arm_angle_deg` is the angle between its two arms when it is free."""

    wire_mm: Annotated[Length, Field(le=10)]
    inside_diameter_mm: Length
    turns: Annotated[float, Field(ge=0.1, le=100)]
    arm_angle_deg: Annotated[float, Field(ge=0, le=360)]
    arm_length_mm: Length
    rate_nmm_per_deg: Positive

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield wire that is too thick for the inside diameter."""
        if self.wire_mm >= self.inside_diameter_mm:
            reason = f"must be less than inside_diameter_mm = {self.inside_diameter_mm:g}"
            yield ("wire_mm",), self.wire_mm, reason


AnyArticle = TypeVar("AnyArticle", bound=Article)


def _with_names(tables: Any) -> Any:
    """Return tables of articles, each with its key for a name."""
    if not isinstance(tables, dict):
        return tables
    return {key: {"name": key} | table if isinstance(table, dict) else table for key, table in tables.items()}


OwnParts = Annotated[dict[Name, AnyArticle], BeforeValidator(_with_names)]
"""Articles of one kind that a user adds, by name."""
