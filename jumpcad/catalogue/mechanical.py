"""Mechanical articles: ball bearings, torsion springs from stock, and pads."""

import math
from collections.abc import Iterator
from typing import Annotated, Self

from pydantic import Field, model_validator

from jumpcad.catalogue.articles import STEEL_G_CM3, Article, Length, Mass, Positive, Source
from jumpcad.files import Contradiction
from jumpcad.files.records import Text

RINGS_MM = 2.0
"""Least difference of outside diameter and bore of a bearing: that of the smallest of ISO 15, 1 x 3 mm."""
HOLLOW = 0.1
"""Least mass of a bearing over that of a ring of steel of its size; judgement: plastic 0.12, steel 0.6."""
STEEL_MPA = 206000.0
"""Young's modulus of spring steel (EN 13906-3)."""
RATE_OFF = 3.0
"""By how much a spring's rate may differ from that of its wire; judgement: bronze is half as stiff as steel."""
TURNS_OFF = 0.1
"""By how much a spring's turns may differ from what its arms' angle says; judgement: makers round to a quarter."""
ARMS_SHARE = 0.5
"""Share of its length at which an arm is taken to be loaded where no rate is given; judgement: so the rates of all that
ship follow within 6 %."""
GENT = 0.64
"""Factor of the shape of a rubber block's free sides, of Shore A 60 to 70 (Gent)."""


class Bearing(Article):
    """A ball bearing."""

    bore_mm: Length
    outer_mm: Length
    width_mm: Annotated[Length, Field(le=50)]
    mass_g: Mass
    static_load_n: Positive

    @property
    def outer_ring_mm(self) -> float:
        """Where its outer ring's face begins, about (diameter): that of a 623 at 8.2 of 3 to 10 mm (SKF)."""
        return self.outer_mm - (10.0 - 8.2) / (10.0 - 3.0) * (self.outer_mm - self.bore_mm)

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield a bearing without room for its rings and balls, or whose mass is not that of its size."""
        if self.outer_mm < self.bore_mm + RINGS_MM:
            reason = f"must be at least bore_mm + {RINGS_MM:g} = {self.bore_mm + RINGS_MM:g}: rings and balls between"
            yield ("outer_mm",), self.outer_mm, reason
            return
        solid = STEEL_G_CM3 * math.pi / 4.0 * (self.outer_mm**2 - self.bore_mm**2) * self.width_mm / 1000.0
        if not HOLLOW * solid <= self.mass_g <= solid:
            reason = f"must be {HOLLOW * solid:.2g}…{solid:.2g} for its size: a ring of solid steel has {solid:.2g} g"
            yield ("mass_g",), self.mass_g, reason


class ORing(Article):
    """A rubber ring: its inside diameter and that of its section."""

    inside_mm: Length
    section_mm: Length
    density_g_cm3: Positive

    @property
    def description(self) -> str:
        return f"O-ring {self.inside_mm:g} x {self.section_mm:g} mm, NBR 70 Shore A"

    @property
    def mass_g(self) -> float:
        """Mass of a torus."""
        volume = math.pi**2 / 4.0 * self.section_mm**2 * (self.inside_mm + self.section_mm)
        return self.density_g_cm3 * volume / 1000.0


class StockSpring(Article):
    """A torsion spring from stock, of which shops keep both hands: its arms are tangents of the coil.

    `arm_angle_deg` is the angle between the relaxed arms, 180 where they point in opposite directions; loading in the
    closing direction lowers it. `outer_diameter_mm` may take the place of `inside_diameter_mm`. `rate_nmm_per_deg` is
    the torque per degree; that of the steel wire where it is not given. `left_hand` and `right_hand` are what to
    order; without one of them it is ordered as the other's mirror image, without both by its name.
    """

    left_hand: Text = ""
    right_hand: Text = ""
    wire_mm: Annotated[Length, Field(le=10)]
    inside_diameter_mm: Length = 0.0
    outer_diameter_mm: Annotated[Length | None, Field(exclude=True)] = None
    turns: Annotated[float, Field(ge=0.1, le=100)]
    arm_angle_deg: Annotated[float, Field(ge=0, le=360)]
    arm_length_mm: Length
    rate_nmm_per_deg: Positive = 0.0

    @model_validator(mode="after")
    def _completed(self) -> Self:
        if self.outer_diameter_mm is not None:
            inside = round(self.outer_diameter_mm - 2.0 * self.wire_mm, 6)
            self._follows("outer_diameter_mm" if inside > self.wire_mm else "", inside_diameter_mm=inside)
        if self.inside_diameter_mm > 0.0:
            self._follows(rate_nmm_per_deg=float(f"{self._steel_rate(ARMS_SHARE):.4g}"))
        return self

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield wire too thick for the coil, and an angle or a rate that turns and wire do not have."""
        if self.inside_diameter_mm <= 0.0 or self.outer_diameter_mm is not None:
            reason = f"give inside_diameter_mm, or outer_diameter_mm of more than three wires, {3.0 * self.wire_mm:g}"
            yield ("outer_diameter_mm",), self.outer_diameter_mm, reason
            return
        if not 1e-4 <= self.rate_nmm_per_deg <= 1e5:
            yield ("wire_mm",), self.wire_mm, f"makes a spring of {self.rate_nmm_per_deg:.2g} N·mm/°: is it in mm?"
            return
        if self.wire_mm >= self.inside_diameter_mm:
            reason = f"must be less than inside_diameter_mm = {self.inside_diameter_mm:g}"
            yield ("wire_mm",), self.wire_mm, reason
        softest, stiffest = self._steel_rate(1.0), self._steel_rate(0.0)
        if not softest / RATE_OFF <= self.rate_nmm_per_deg <= stiffest * RATE_OFF:
            reason = f"steel wire wound so has {softest:.2g} to {stiffest:.2g}, with and without its arms"
            yield ("rate_nmm_per_deg",), self.rate_nmm_per_deg, f"{reason}: is it per degree, and of one spring?"
        if abs(self.wound_turns - self.turns) > TURNS_OFF:
            angle = (180.0 - 360.0 * self.turns) % 360.0
            other = self.model_copy(update={"arm_angle_deg": 360.0 - self.arm_angle_deg})
            seen = f", and {other.arm_angle_deg:g}°, measured on the other side, {other.wound_turns:g}"
            reason = (
                f"{self.turns:g} turns with tangent arms have {angle:.0f}° between them; {self.arm_angle_deg:g}° take "
                f"{self.wound_turns:g} turns{seen if other.arm_angle_deg != self.arm_angle_deg else ''}: look at the "
                "spring and correct one of the two"
            )
            yield ("arm_angle_deg",), self.arm_angle_deg, reason

    def article(self, hand: str) -> str:
        """Return what to order of a hand, `left` or `right`."""
        left, right = self.left_hand, self.right_hand
        number, other = (left, right) if hand == "left" else (right, left)
        if number or not other:
            return f"torsion spring, {hand} hand, {number or self.name}"
        return (
            f"torsion spring, {hand} hand, twin of {other} ({self.arm_angle_deg:g}°, wire {self.wire_mm:g} mm, outside "
            f"diameter {self.inside_diameter_mm + 2.0 * self.wire_mm:.2f} mm, {self.turns:g} turns), number not known"
        )

    def _steel_rate(self, share: float) -> float:
        """Return the rate (N·mm/°) of steel wire loaded at a share of the arms' length: E·d⁴/(64·D·n) (EN 13906-3)."""
        mean = self.inside_diameter_mm + self.wire_mm
        with_arms = self.turns + share * 2.0 * self.arm_length_mm / (3.0 * math.pi * mean)
        return math.radians(STEEL_MPA * self.wire_mm**4 / (64.0 * mean)) / with_arms

    @property
    def wound_turns(self) -> float:
        """Turns of the relaxed body at which tangent arms have `arm_angle_deg`: those nearest to `turns`."""
        fraction = (0.5 - self.arm_angle_deg / 360.0) % 1.0
        return fraction + round(self.turns - fraction)


class Pad(Article):
    """A soft strip, glued under nose and toes or on the rest stop: `description` is what to order, or to print it of.

    `modulus_mpa` is Young's modulus for small strains, as hardness gives it; `friction_min` and `friction_max` are
    the range of coefficients of dry friction on a clean floor. One that is `printed` has STL files instead of a size
    to cut.
    """

    description: Source
    printed: bool = False
    thickness_mm: Annotated[Length, Field(ge=0.3, le=6)]
    density_g_cm3: Annotated[float, Field(ge=0.1, le=3)]
    modulus_mpa: Annotated[float, Field(ge=0.2, le=200)]
    friction_min: Annotated[float, Field(ge=1e-3, le=2)]
    friction_max: Annotated[float, Field(ge=1e-3, le=2)]

    def contradictions(self) -> Iterator[Contradiction]:
        if self.friction_max < self.friction_min:
            yield ("friction_max",), self.friction_max, f"must be at least friction_min = {self.friction_min:g}"

    def rate_n_per_mm(self, width_mm: float, length_mm: float) -> float:
        """Return the stiffness of a block pressed flat: E·(1 + 2·φ·S²)·A/t with φ = 0.64, S = loaded over free area.

        Gent, Engineering with Rubber, for a block that both faces hold; one that slips is softer.
        """
        area = width_mm * length_mm
        shape = area / (2.0 * (width_mm + length_mm) * self.thickness_mm)
        return self.modulus_mpa * (1.0 + 2.0 * GENT * shape**2) * area / self.thickness_mm
