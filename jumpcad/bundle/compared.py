"""The section of report.html that sets a prototype of the study, as predicted, beside what was measured on it.

The calibration takes half a minute and an extra, so its result ships: `templates/compared/` holds what
`jumpcad calibrate ... --predict ...` says of each prototype, written by `benchmarks/readme.py --only calibration`.
"""

from typing import Annotated, Literal

from pydantic import Field

from jumpcad.design import Design, load_design
from jumpcad.files import Record, TomlTable, find_template, template_names
from jumpcad.files.names import Name


class Beside(TomlTable):
    """A measurement under one reading (m, J), quantiles of its prediction, and the share of predictions below it."""

    what: Literal["distance", "height", "battery"]
    reading: Literal["centre-of-mass", "first-touchdown", "resting-place", "rise", "absolute", "battery"]
    measured: float
    predicted: Annotated[tuple[float, float, float], Field(strict=False)]
    below_share: float


class Compared(Record):
    """A measured robot (`design`), predicted by a calibration on another."""

    design: Name
    calibrated_on: Name
    rows: Annotated[tuple[Beside, ...], Field(strict=False, min_length=1)]

    @property
    def outside(self) -> list[str]:
        """The quantities that no interval of eight in ten predictions holds, under whatever reading."""
        within = {row.what for row in self.rows if row.predicted[0] <= row.measured <= row.predicted[-1]}
        return [what for what in dict.fromkeys(row.what for row in self.rows) if what not in within]


def compared_of(design: Design) -> Compared | None:
    """Return what was predicted and measured of a design that is one of the study's prototypes."""
    for name in template_names("compared"):
        if load_design(name) == design:
            return Compared.from_toml(find_template("compared", name))
    return None
