"""Articles for axles and pins: rods, clips for grooves, and clevis pins with their split pins (mm, g, N, MPa)."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.catalogue.articles import Article, Length, Mass, Positive, Source
from jumpcad.files import Contradiction


class Rod(Article):
    """Rod of any diameter for axles: `description` is what to order, `bore_share` its bore over its outside.

    `grooves` says whether grooves can be turned or filed in it at home.
    """

    description: Source
    density_g_cm3: Annotated[float, Field(ge=0.5, le=20)]
    yield_mpa: Positive
    bore_share: Annotated[float, Field(ge=0, le=0.95)] = 0.0
    grooves: bool


class Clip(Article):
    """A retaining ring for a groove at a shaft's end; `load_n` is its load capacity, `end_mm` the shaft beyond it."""

    shaft_mm: Length
    groove_mm: Length
    groove_width_mm: Length
    end_mm: Length
    outer_mm: Length
    thickness_mm: Length
    load_n: Positive
    mass_g: Mass

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield a groove that is not smaller than its shaft."""
        if not self.groove_mm < self.shaft_mm < self.outer_mm:
            reason = f"must be less than shaft_mm = {self.shaft_mm:g}, and that less than outer_mm = {self.outer_mm:g}"
            yield ("groove_mm",), self.groove_mm, reason


class ClevisPin(Article):
    """A pin with a head and a cross hole for a split pin, `end_mm` before its end."""

    diameter_mm: Length
    head_mm: Length
    head_height_mm: Length
    end_mm: Length
    lengths_mm: list[Length]
    cotter_mm: Length
    cotter_length_mm: Length
    yield_mpa: Positive
    load_n: Positive
