"""The fit coupon: printed once, tested with the bought parts, and read back into a workshop's fits.

A fit in a workshop is what a hole must be drawn larger per side so that, printed, it fits: shrinkage is included. So
the hole of a ladder that fits *is* the fit, and its engraved offset is taken over as it stands. Where several readings
give one fit, the value is taken that still works for all of them:

- `press_mm`: the smallest. A seat that is a step too tight still takes its part, one that is too wide drops it.
- `sliding_mm`, `loose_mm`: the largest. A running fit that is a step too wide runs, one that is too tight seizes.
- `hole_allowance_diameter_mm`: a hole that just holds a part has, once printed, the part's own diameter, so printing
  narrows holes by twice the press fit; the largest reading counts, for such holes must not be too small.
- `backlash_circumferential_mm`: of the tightest pinion that turns freely. Where the gears were not tried it follows
  from the pegs, since teeth are outer surfaces too: pegs that came out g larger in diameter have every flank g/2
  further out, which takes g/cos 20° from each gear's gaps along the pitch circle and 2·g/cos 20° from the pair's
  backlash; the drawn backlash is that plus the least play. Lengths in mm.
"""

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.coupon.joints import TAP_STEP_MM, rib_steps_mm, steps_mm
from jumpcad.coupon.pieces import PEGS_MM, STEP_MM, coupon_holes, ladders
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.drive.gears import PRESSURE_ANGLE_RAD
from jumpcad.errors import JumpcadError
from jumpcad.files import Contradiction, Record, TomlTable
from jumpcad.files.names import Name
from jumpcad.strength.stress import VON_MISES
from jumpcad.workshop import Workshop

LEAST_PLAY_MM = 0.05
"""Circumferential play that keeps printed gears from binding where they run eccentrically (judgement)."""
PEG_ERROR_MM = 0.5
"""A peg further than this from its diameter was misread, or its printer's error is too large for any fit."""


AXLE_KEYS = ("axle_press_mm", "axle_sliding_mm", "axle_loose_mm")


class Tried(TomlTable):
    """Readings of one material's gauge; what was not tried is left out."""

    axle_press_mm: float | None = None
    axle_sliding_mm: float | None = None
    axle_loose_mm: float | None = None
    bearing_press_mm: float | None = None
    pegs_mm: Annotated[tuple[float, ...], Field(strict=False)] = ()

    @property
    def peg_growth_mm(self) -> float:
        """By how much the pegs came out larger in diameter than drawn."""
        return sum(self.pegs_mm) / len(self.pegs_mm) - sum(PEGS_MM) / len(PEGS_MM)


class TriedGears(TomlTable):
    """Reading of the gears: the backlash engraved on the tightest pinion that turns freely all round."""

    turns_freely_mm: float | None = None


JOINT_KEYS = {
    "m2_tap_mm": ("m2_tap_mm", TAP_STEP_MM),
    "rib_mm": ("rib_mm", STEP_MM),
    "lying_mm": ("lying_mm", STEP_MM),
    "dog_sliding_mm": ("sliding_mm", STEP_MM),
    "socket_sliding_mm": ("sliding_mm", STEP_MM),
    "tray_sliding_mm": ("sliding_mm", STEP_MM),
    "seat_press_mm": ("press_mm", STEP_MM),
}
"""Readings of the joints: the fit that each is of, and the step between its three."""


class TriedJoints(TomlTable):
    """Readings of the joints, as engraved; `floor_n` is the force that broke the floor of a blind bore."""

    m2_tap_mm: float | None = None
    rib_mm: float | None = None
    lying_mm: float | None = None
    dog_sliding_mm: float | None = None
    socket_sliding_mm: float | None = None
    tray_sliding_mm: float | None = None
    seat_press_mm: float | None = None
    floor_n: Annotated[float | None, Field(gt=0, le=1e4)] = None

    @property
    def sliding_mm(self) -> tuple[float | None, ...]:
        """The readings of running fits."""
        return self.dog_sliding_mm, self.socket_sliding_mm, self.tray_sliding_mm


class Readings(Record):
    """Everything read from a coupon: gauges by material, joints and gears."""

    gauge: dict[Name, Tried] = Field(default_factory=dict)
    joints: TriedJoints = TriedJoints()
    gears: TriedGears = TriedGears()

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield pegs that were misread, and fits that are tighter than the one before them."""
        for name, tried in self.gauge.items():
            place = ("gauge", name)
            if tried.pegs_mm and len(tried.pegs_mm) != len(PEGS_MM):
                nominal = ", ".join(f"{peg:g}" for peg in PEGS_MM)
                yield (*place, "pegs_mm"), tried.pegs_mm, f"must be {len(PEGS_MM)} diameters, of the pegs {nominal} mm"
            for peg, measured in zip(PEGS_MM, tried.pegs_mm, strict=False):
                if abs(measured - peg) > PEG_ERROR_MM:
                    limits = f"{peg - PEG_ERROR_MM:g}…{peg + PEG_ERROR_MM:g}"
                    reason = f"{measured:g} for the peg of {peg:g} mm is outside {limits}: measure again"
                    yield (*place, "pegs_mm"), tried.pegs_mm, f"{reason}, or calibrate the printer first"
            fits = [(key, getattr(tried, key)) for key in AXLE_KEYS if getattr(tried, key) is not None]
            for (tight, low), (wide, high) in itertools.pairwise(fits):
                if high < low:
                    yield (*place, wide), high, f"must be at least {tight} = {low:g}, the tighter fit: try them again"


def measured_workshop(readings: Readings, workshop: Workshop, source: str = "readings") -> Workshop:
    """Return the workshop with the fits that were read from its coupon, and nothing else changed but a weak floor.

    A floor that broke below what its material's strength says lowers that strength.

    Parameters
    ----------
    readings
        Of the coupon that this workshop gives.
    workshop
        The base.
    source
        Where the readings come from, for errors.

    Raises
    ------
    JumpcadError
        If there is no reading, one lies outside of its ladder or contradicts another, or the fits contradict each
        other.
    """
    if wrong := list(_complaints(readings, workshop)):
        raise JumpcadError("; ".join(f"{source}: {complaint}" for complaint in wrong))
    fits = _fits(readings, workshop)
    if not fits and readings.joints.floor_n is None:
        raise JumpcadError(f"{source}: no reading: fill in at least one, such as axle_press_mm under [gauge.PETG]")
    data = workshop.model_dump()
    if readings.joints.floor_n is not None:
        body = data["materials"][workshop.material_name("body")]
        body["strength_in_plane_mpa"] = min(
            body["strength_in_plane_mpa"], _floor_mpa(readings.joints.floor_n, workshop)
        )
    return Workshop.from_data(data | {"fits": data["fits"] | fits}, source)


def _floor_mpa(force_n: float, workshop: Workshop) -> float:
    """Return the strength that a floor had which was sheared off around the axle."""
    sheared = math.pi * workshop.bought.axle_mm * AXLE_FLOOR_MM
    return round(VON_MISES * force_n / sheared, 1)


def _fits(readings: Readings, workshop: Workshop) -> dict[str, float]:
    """Return the fits that the readings decide."""
    tried, joints = list(readings.gauge.values()), readings.joints
    press = _given(value for gauge in tried for value in (gauge.axle_press_mm, gauge.bearing_press_mm))
    press += _given([joints.seat_press_mm])
    sliding = _given([*(gauge.axle_sliding_mm for gauge in tried), *joints.sliding_mm])
    loose = _given(gauge.axle_loose_mm for gauge in tried)
    own = {key: getattr(joints, key) for key in ("m2_tap_mm", "rib_mm", "lying_mm")}
    fits: dict[str, float] = {key: value for key, value in own.items() if value is not None}
    if press:
        fits |= {"press_mm": min(press), "hole_allowance_diameter_mm": 2.0 * max(press)}
    if sliding:
        fits["sliding_mm"] = max(sliding)
    if loose:
        fits["loose_mm"] = max(loose)
    teeth = readings.gauge.get(workshop.material_name("gears"), Tried())
    if readings.gears.turns_freely_mm is not None:
        fits["backlash_circumferential_mm"] = readings.gears.turns_freely_mm
    elif teeth.pegs_mm:
        lost = 2.0 * teeth.peg_growth_mm / math.cos(PRESSURE_ANGLE_RAD)
        fits["backlash_circumferential_mm"] = max(LEAST_PLAY_MM + lost, 0.0)
    return {key: round(value, 3) for key, value in fits.items()}


def _given(values: Iterable[float | None]) -> list[float]:
    return [value for value in values if value is not None]


def _complaints(readings: Readings, workshop: Workshop) -> Iterator[str]:
    """Yield complaints about readings that a workshop's coupon cannot give."""
    steps = ladders(coupon_holes(workshop))
    for name, tried in readings.gauge.items():
        if name not in workshop.materials:
            yield f"gauge.{name}: the workshop prints in {', '.join(workshop.materials)}"
        for key in AXLE_KEYS:
            yield from _off_ladder(f"gauge.{name}.{key}", getattr(tried, key), steps.axle_mm)
        yield from _off_ladder(f"gauge.{name}.bearing_press_mm", tried.bearing_press_mm, steps.bearing_mm)
    for key, (fit, step) in JOINT_KEYS.items():
        around = rib_steps_mm(workshop.fits) if key == "rib_mm" else steps_mm(getattr(workshop.fits, fit), step)
        yield from _off_ladder(f"joints.{key}", getattr(readings.joints, key), around)
    yield from _off_ladder("gears.turns_freely_mm", readings.gears.turns_freely_mm, steps.backlash_mm)


def _off_ladder(key: str, value: float | None, ladder: tuple[float, ...]) -> Iterator[str]:
    """Yield a complaint about a reading outside of its ladder; between two steps is allowed."""
    if value is None:
        return
    if not ladder:
        yield f"{key} = {value:g}: the workshop's legs have no bearing; leave it out"
    elif not ladder[0] <= value <= ladder[-1]:
        limits = f"{ladder[0]:.2f}…{ladder[-1]:.2f}"
        yield f"{key} = {value:g}: must be {limits} as engraved; if nothing fits, set the fit by hand and print again"
