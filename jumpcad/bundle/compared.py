"""The section of report.html that sets a prototype of the study, as predicted, beside what was measured on it.

The calibration takes half a minute and an extra, so its result ships: `templates/compared/` holds what
`jumpcad calibrate ... --predict ...` says of each prototype, written by `benchmarks/readme.py --only calibration`.
"""

from collections.abc import Iterator, Sequence
from html import escape
from typing import Annotated, Literal

from pydantic import Field

from jumpcad.design import Design, load_design
from jumpcad.files import Record, TomlTable, find_template, template_names
from jumpcad.files.names import Name

READINGS = {
    ("distance", "centre-of-mass"): "distance, as ballistic range",
    ("distance", "first-touchdown"): "distance, as first touchdown",
    ("distance", "resting-place"): "distance, as resting place",
    ("height", "rise"): "height, as rise of the centre of mass",
    ("height", "absolute"): "height of the centre of mass above the floor",
    ("battery", "battery"): "energy from the battery",
}
"""What was measured, and as what a length of which that is unknown may be read."""


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


def compared_of(design: Design) -> Compared | None:
    """Return what was predicted and measured of a design that is one of the study's prototypes."""
    for name in template_names("compared"):
        if load_design(name) == design:
            return Compared.from_toml(find_template("compared", name))
    return None


def compared(found: Compared) -> Iterator[str]:
    """Yield the section of the page: each measurement, as what it may be read, with its interval."""
    yield "<h2>Beside the study's prototype</h2>"
    yield (
        f"<p>The study built this robot. Calibrated on its other prototype, {escape(found.calibrated_on)}, the model "
        "predicts, errors of measuring included (<code>jumpcad calibrate "
        f"{escape(found.calibrated_on)} --predict {escape(found.design)}</code>):</p>"
    )
    yield '<table class="sure"><tr><th>measured</th><th></th><th class="number">predicted, 10, 50 and 90 %</th>'
    yield '<th class="number">predictions below it</th></tr>'
    for row in found.rows:
        cells = _value([row.measured], row.what), _value(row.predicted, row.what), _percent(row.below_share)
        label = escape(READINGS[row.what, row.reading])
        yield f"<tr><td>{label}</td>" + "".join(f'<td class="number">{cell}</td>' for cell in cells) + "</tr>"
    yield "</table>"
    none = " A draw without a jump counts as 0." if any(row.predicted[0] == 0.0 for row in found.rows) else ""
    yield f"<p>{_verdict(found)}{none} Mass, floor and what was measured are not published.</p>"


def _verdict(found: Compared) -> str:
    """Return which quantities lie outside all their intervals."""
    within = {row.what for row in found.rows if row.predicted[0] <= row.measured <= row.predicted[-1]}
    outside = [what for what in dict.fromkeys(row.what for row in found.rows) if what not in within]
    if not outside:
        return "Every measurement lies within an interval of eight in ten predictions."
    words = " and ".join({"battery": "battery energy"}.get(what, what) for what in outside)
    return (
        f"The calibration does not predict the measured {words}: no interval of eight in ten predictions holds it, "
        "whatever was measured."
    )


def _value(values: Sequence[float], what: str) -> str:
    if what == "battery":
        return "…".join(f"{value:.2f}" for value in values) + " J"
    return "…".join(f"{1000.0 * value:.0f}" for value in values) + " mm"


def _percent(share: float) -> str:
    """Return a share in per cent; that of draws is never whole."""
    return f"{min(max(100.0 * share, 1.0), 99.0):.0f} %"
