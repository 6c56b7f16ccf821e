"""What the plates lack for switch, USB plug and wires, and where they need material for it (mm)."""

from collections.abc import Iterator
from typing import Literal

from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.electronics.fitting_places import (
    HOLE_HALF_MM,
    HOLE_MM,
    RELIEF_APART_MM,
    RELIEF_SLOT_MM,
    RELIEF_UP_MM,
    USB_EDGE_MM,
    Fittings,
    switch_half_mm,
)
from jumpcad.solids.outline import Region, hole, rectangle, stadium
from jumpcad.transforms import Array

KNOB_MM = (8.0, 4.4)
"""Slot for the switch's knob, along its travel and across; judgement: a knob of 4 x 3 mm that goes 3 mm."""
SWITCH_SCREWS_MM, SWITCH_SLOT_MM = 7.2, (7.0, 7.8)
"""From the switch's middle to its screws, and to the ends of the plate's slots for them: ears of SS-12F15 have holes
14.4 mm apart, of others of its kind 14.8 or 15 mm."""


def fitting_pads(fittings: Fittings, more_mm: float) -> Iterator[Region]:
    """Yield where the plates need material, grown by a margin."""
    boxes = [(place, HOLE_HALF_MM) for place in (fittings.left_mm, fittings.right_mm)]
    if fittings.switch is not None and fittings.switch_mm is not None:
        boxes.append((fittings.switch_mm, switch_half_mm(fittings.switch)))
    if fittings.usb_mm is not None:
        width, height = fittings.usb_size_mm
        boxes.append((fittings.usb_mm, (width / 2.0 + USB_EDGE_MM, height / 2.0 + USB_EDGE_MM)))
    for place, half in boxes:
        yield rectangle([2.0 * (side + more_mm) for side in half], place, 1.0 + more_mm)


def fitting_openings(fittings: Fittings, holes: HoleSizes, side: Literal["left", "right"]) -> Iterator[Region]:
    """Yield what a plate lacks: holes for leads with the slots of their tie, USB plug; in the right one the switch."""
    yield from _wire_hole(fittings.left_mm if side == "left" else fittings.right_mm)
    if fittings.switch_mm is not None and side == "right":
        x, z = fittings.switch_mm
        yield rectangle(KNOB_MM, (x, z), 1.0)
        for sign in (-1.0, 1.0):
            inner, outer = ((x + sign * end, z) for end in SWITCH_SLOT_MM)
            yield stadium(inner, outer, holes.fits.m2_clearance_mm)
    if fittings.usb_mm is not None and side == fittings.usb_side:
        yield rectangle(fittings.usb_size_mm, fittings.usb_mm, 1.0)


def wire_hole_mm(place_mm: Array) -> tuple[float, float]:
    """Return the middle (x, z) of the hole for leads in the plate's room for it and its tie."""
    return float(place_mm[0]), float(place_mm[1] - HOLE_HALF_MM[1] + HOLE_MM)


def _wire_hole(place_mm: Array) -> Iterator[Region]:
    x, z = wire_hole_mm(place_mm)
    yield hole(HOLE_MM, (x, z))
    for sign in (-1.0, 1.0):
        yield rectangle(RELIEF_SLOT_MM, (x + sign * RELIEF_APART_MM / 2.0, z + RELIEF_UP_MM), 0.5)
