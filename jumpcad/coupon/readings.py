"""Readings of the fit coupon, printed once and tested with the bought parts, and the fits that follow (mm).

A workshop's fit is the offset per side with which a hole is drawn, so that it fits when printed: it includes shrinkage.
So the engraved offset of the hole that fits *is* the fit. If several readings determine one fit, the value is taken
that works for all of them:

- `press_mm`: the smallest. A seat that is a step too tight still takes its part, one that is too wide does not hold it.
- `sliding_mm`, `loose_mm`: the largest. A running fit that is a step too wide runs, one that is too tight seizes.
- `holes_small_mm`: a hole that just holds a part has, when printed, the part's own diameter. So holes come out smaller
  than the fits allow for by twice what the press fit is read wider; the largest reading counts, because holes must not
  be too small. Without one, a caliper's reading of such a hole says it. Fits that were not read follow.
- `backlash_circumferential_mm`: that of the tightest pinion that turns freely. Without this reading it follows from the
  pegs, because teeth are outer surfaces too: if pegs are printed g larger in diameter, every flank is g/2 further out,
  which takes g/cos 20° from each gear's gaps along the pitch circle and 2·g/cos 20° from the pair's backlash; the drawn
  backlash is that plus the least play.
"""

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import Field

from jumpcad.coupon.joints import TAP_STEP_MM, rib_steps_mm, steps_mm
from jumpcad.coupon.pieces import PEGS_MM, STEP_MM, coupon_holes, series_of
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.drive.gears import PRESSURE_ANGLE_RAD
from jumpcad.errors import JumpcadError
from jumpcad.files import Contradiction, Record, TomlTable
from jumpcad.files.records import Name
from jumpcad.strength.stress import VON_MISES
from jumpcad.workshop import Workshop
from jumpcad.workshop.tables import SHARES

LEAST_PLAY_MM = 0.05
"""Circumferential play that keeps printed gears from binding where they run eccentrically (judgement)."""
PEG_ERROR_MM = 0.5
"""Largest error of a peg's diameter; beyond, it was misread, or the printer is too inaccurate for any fit."""


AXLE_KEYS = ("axle_press_mm", "axle_sliding_mm", "axle_loose_mm")


class GaugeReadings(TomlTable):
    """Readings of one material's gauge; a missing one was not made."""

    axle_press_mm: float | None = None
    axle_sliding_mm: float | None = None
    axle_loose_mm: float | None = None
    bearing_press_mm: float | None = None
    pegs_mm: Annotated[tuple[float, ...], Field(strict=False)] = ()


class GearReadings(TomlTable):
    """Reading of the gears: the backlash engraved on the tightest pinion that turns freely all round."""

    turns_freely_mm: float | None = None


JOINT_KEYS = {
    "m2_tap_mm": ("m2_tap_mm", TAP_STEP_MM), "rib_mm": ("rib_mm", STEP_MM), "lying_mm": ("lying_mm", STEP_MM),
    "dog_sliding_mm": ("sliding_mm", STEP_MM), "socket_sliding_mm": ("sliding_mm", STEP_MM),
    "tray_sliding_mm": ("sliding_mm", STEP_MM), "seat_press_mm": ("press_mm", STEP_MM),
}  # fmt: skip
"""Readings of the joints: the fit that each determines, and the step between its three offsets."""


class JointReadings(TomlTable):
    """Readings of the joints, as engraved; `floor_n` is the force that broke the floor of a blind bore."""

    m2_tap_mm: float | None = None
    rib_mm: float | None = None
    lying_mm: float | None = None
    dog_sliding_mm: float | None = None
    socket_sliding_mm: float | None = None
    tray_sliding_mm: float | None = None
    seat_press_mm: float | None = None
    floor_n: Annotated[float | None, Field(gt=0, le=1e4)] = None


class Readings(Record):
    """Everything read from a coupon made for rods of `axle_mm`: gauges by material, joints and gears.

    `press_hole_mm` is a caliper's reading of the hole that should hold the axle.
    """

    axle_mm: float | None = None
    press_hole_mm: float | None = None
    gauge: dict[Name, GaugeReadings] = Field(default_factory=dict)
    joints: JointReadings = JointReadings()
    gears: GearReadings = GearReadings()

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield implausible pegs, and sliding or loose fits that are tighter than a tighter kind of fit."""
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
    """Return the workshop with the fits that were read from its coupon; errors name the source.

    A floor that broke below its computed strength lowers the strength of the body's material, and that between its
    layers to no more than it; nothing else changes.
    """
    if wrong := list(_complaints(readings, workshop)):
        raise JumpcadError("; ".join(f"{source}: {complaint}" for complaint in wrong))
    fits = _fits(readings, workshop)
    if not fits and readings.joints.floor_n is None:
        gauge = next(iter(workshop.materials))
        raise JumpcadError(f"{source}: no reading: fill in at least one, such as axle_press_mm under [gauge.{gauge}]")
    data = workshop.model_dump()
    if (force := readings.joints.floor_n) is not None:
        body = data["materials"][workshop.material_name("body")]
        strength_mpa = round(VON_MISES * force / _sheared_mm2(workshop), 1)
        if strength_mpa < body["strength_in_plane_mpa"]:
            said = body["source"].rstrip(".")
            body["strength_in_plane_mpa"] = strength_mpa
            body["strength_interlayer_mpa"] = min(body["strength_interlayer_mpa"], strength_mpa)
            body["source"] = f"{said}; strength in plane: a bore's floor broke at {force:g} N".removeprefix("; ")
    return Workshop.from_data(data | {"fits": data["fits"] | fits}, source)


def floor_breaks_n(workshop: Workshop) -> float:
    """Return the force (N) on the axle that shears off a blind bore's floor of the body's material around it."""
    return workshop.material("body").strength_in_plane_mpa * _sheared_mm2(workshop) / VON_MISES


def _sheared_mm2(workshop: Workshop) -> float:
    return math.pi * workshop.bought.axle_mm * AXLE_FLOOR_MM


def _fits(readings: Readings, workshop: Workshop) -> dict[str, float]:
    """Return the fits that follow from the readings, by key."""
    tried, joints = list(readings.gauge.values()), readings.joints
    press = _press(readings)
    running = (getattr(joints, key) for key, (fit, _) in JOINT_KEYS.items() if fit == "sliding_mm")
    sliding = _given([*(gauge.axle_sliding_mm for gauge in tried), *running])
    loose = _given(gauge.axle_loose_mm for gauge in tried)
    own = {key: getattr(joints, key) for key in ("m2_tap_mm", "rib_mm", "lying_mm")}
    fits: dict[str, float] = {key: value for key, value in own.items() if value is not None}
    for key, read, chosen in (("press_mm", press, min), ("sliding_mm", sliding, max), ("loose_mm", loose, max)):
        if read:
            fits[key] = chosen(read)
    if small := _smaller_mm(readings, workshop) + workshop.fits.holes_small_mm:
        fits = {key: value - SHARES[key] * small for key, value in fits.items()}
    if press or readings.press_hole_mm is not None:
        fits["holes_small_mm"] = small
    teeth = readings.gauge.get(workshop.material_name("gears"), GaugeReadings())
    if readings.gears.turns_freely_mm is not None:
        fits["backlash_circumferential_mm"] = readings.gears.turns_freely_mm
    elif teeth.pegs_mm:
        growth = sum(teeth.pegs_mm) / len(teeth.pegs_mm) - sum(PEGS_MM) / len(PEGS_MM)
        lost = 2.0 * growth / math.cos(PRESSURE_ANGLE_RAD)
        fits["backlash_circumferential_mm"] = max(LEAST_PLAY_MM + lost, 0.0)
    return {key: round(value, 3) for key, value in fits.items()}


def _press(readings: Readings) -> list[float]:
    """Return the readings of press fits."""
    read = [value for one in readings.gauge.values() for value in (one.axle_press_mm, one.bearing_press_mm)]
    return _given([*read, readings.joints.seat_press_mm])


def _smaller_mm(readings: Readings, workshop: Workshop) -> float:
    """Return by how much more than the workshop says holes come out too small in diameter; 0 if that was not read."""
    if press := _press(readings):
        return 2.0 * (max(press) - workshop.fits.drawn.press_mm)
    return 0.0 if readings.press_hole_mm is None else workshop.bought.axle_mm - readings.press_hole_mm


def _given(values: Iterable[float | None]) -> list[float]:
    return [value for value in values if value is not None]


def _complaints(readings: Readings, workshop: Workshop) -> Iterator[str]:
    """Yield the errors of readings that a workshop's coupon cannot give."""
    steps = series_of(coupon_holes(workshop))
    if readings.axle_mm not in (None, workshop.bought.axle_mm):
        yield (
            f"axle_mm = {readings.axle_mm:g}: this coupon is for rods of {readings.axle_mm:g} mm, the workshop has "
            f"{workshop.bought.axle_mm:g}: print the workshop's own (jumpcad coupon --workshop FILE)"
        )
    small = _smaller_mm(readings, workshop)
    for name, tried in readings.gauge.items():
        if name not in workshop.materials:
            yield f"gauge.{name}: the workshop prints in {', '.join(workshop.materials)}"
        for key in AXLE_KEYS:
            yield from _out_of_range(f"gauge.{name}.{key}", getattr(tried, key), steps.axle_mm)
        yield from _out_of_range(f"gauge.{name}.bearing_press_mm", tried.bearing_press_mm, steps.bearing_mm)
    for key, (fit, step) in JOINT_KEYS.items():
        drawn, off = workshop.fits.drawn, SHARES[fit] * small
        around = rib_steps_mm(drawn) if key == "rib_mm" else steps_mm(getattr(drawn, fit), step)
        around = (around[0] + min(off, 0.0), around[-1] + max(off, 0.0))
        yield from _out_of_range(f"joints.{key}", getattr(readings.joints, key), around)
    yield from _out_of_range("gears.turns_freely_mm", readings.gears.turns_freely_mm, steps.backlash_mm)


def _out_of_range(key: str, value: float | None, offsets: tuple[float, ...]) -> Iterator[str]:
    """Yield the error of a reading outside of the offsets; between two of them is allowed."""
    if value is None:
        return
    if not offsets:
        yield f"{key} = {value:g}: the workshop's legs have no bearing; leave it out"
    elif not offsets[0] <= value <= offsets[-1]:
        limits = f"{offsets[0]:.2f}…{offsets[-1]:.2f}"
        yield f"{key} = {value:g}: must be {limits} as engraved; if nothing fits, give press_hole_mm and print again"
