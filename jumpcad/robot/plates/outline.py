"""Outlines of the two body plates around what they carry, and the pockets between (mm, in the body frame)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from manifold3d import JoinType
from scipy.spatial import Delaunay

from jumpcad.dimensions import PAD_WALL_MM, STANDOFF_PAD_MM, STOP_EDGE_MM, TAB_MM, TRAY_MM
from jumpcad.parts.part import Face
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.cage.thing import horns
from jumpcad.robot.electronics.fittings import fitting_pads
from jumpcad.robot.layout import Layout
from jumpcad.robot.sensor.thing import plate_pad
from jumpcad.robot.steering.drawing import tail
from jumpcad.robot.steering.place import Steering
from jumpcad.robot.stop.place import EAR_MM
from jumpcad.robot.stop.thing import stop_slot
from jumpcad.robot.train.thing import socket_outline
from jumpcad.solids.outline import (
    SAGITTA_MM,
    Region,
    boxes_apart,
    disc,
    grown,
    hull,
    middle_of,
    rectangle,
    rounded,
    stadium,
    strips,
    union,
)

RIB_MM = 3.2
EDGE_MM = 3.2
POCKET_RADIUS_MM = 1.5
"""Width of ribs, distance of pockets from the edge, radius of their corners: judgement."""
SPRING_PIN_PAD_MM = 8.0
"""Material around the springs' pin (diameter): 2.5 mm around a pin of 3 mm; judgement."""
SLOT_AROUND_MM = 2.5
"""Material around the slot for a tray's tab; judgement: more than five lines of a 0.4 mm nozzle."""
SLOT_PAD_RADIUS_MM = 1.0
"""Radius of the corners of that material; judgement: no notch where it meets a rib."""
SLOT_END_MM = 1.0
"""From a tray's end to its tab; judgement: beyond the round corner of the floor's end."""


def tray_slots(layout: Layout, side: Face) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Return the middles (x, z) of a plate's slots for the tabs of the lower and of the upper tray.

    Where a plate has the opening for a USB plug, above the upper tray's back end, it has no slot.
    """
    middle, reach = layout.tray_mm, layout.electronics.length_mm / 2.0 - TAB_MM / 2.0 - SLOT_END_MM
    levels = (TRAY_MM / 2.0, layout.electronics.upper_tray_mm + TRAY_MM / 2.0)
    lower, upper = (
        [(float(middle[0] + sign * reach), float(middle[1] + level)) for sign in (-1.0, 1.0)] for level in levels
    )
    return lower, upper[1:] if side == layout.fittings.usb_side else upper


def _pads(layout: Layout, more_mm: float = 0.0) -> list[Region]:
    """Return the regions in which the plate needs material, each grown by a margin."""
    more = 2.0 * more_mm
    pads = [disc(layout.axle_mm + 2.0 * PAD_WALL_MM + more, place) for place in layout.axles.values()]
    pads += [disc(STANDOFF_PAD_MM + more, place) for place in layout.standoffs_mm]
    pads.append(disc(SPRING_PIN_PAD_MM + more, layout.spring_pin_mm))
    slot = (TAB_MM + 2.0 * SLOT_AROUND_MM + more, TRAY_MM + 2.0 * SLOT_AROUND_MM + more)
    whole: Face = "right" if layout.fittings.usb_side == "left" else "left"
    pads += [
        rectangle(slot, place, SLOT_PAD_RADIUS_MM + more_mm) for level in tray_slots(layout, whole) for place in level
    ]
    pads += fitting_pads(layout.fittings, more_mm)
    pads.append(grown(socket_outline(layout), more_mm))
    pads += [plate_pad(layout.sensor, more_mm)] if layout.sensor is not None else []
    return pads


class Blank(NamedTuple):
    """What both plates' outlines have in common: the hull of all pads, and its pockets."""

    hull: Region
    pockets: Region


def blank_of(layout: Layout, wall_mm: float) -> Blank:
    """Return the hull of all pads, and pockets between an edge, the pads and ribs that join their middles.

    The pockets' corners are round: what stands between them is drawn thicker by their radius, and they are widened by
    it again. All ribs end within pads. Where pads that no rib joins lie side by side, the pockets beside them are set
    back until a printable wall is left.
    """
    pads = _pads(layout)
    around = hull(pads)
    middles = np.array([middle_of(pad) for pad in pads])
    simplices = Delaunay(middles).simplices
    pairs = np.unique(np.sort(simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    more = 2.0 * POCKET_RADIUS_MM
    solid = [
        *_pads(layout, POCKET_RADIUS_MM),
        strips(middles[pairs[:, 0]], middles[pairs[:, 1]], RIB_MM + more),
        strips(layout.hub_mm, layout.front_mm, layout.axle_mm + 2.0 * PAD_WALL_MM + more),
    ]
    pockets = (grown(around, -EDGE_MM - POCKET_RADIUS_MM) - union(solid)).simplify(2.0 * SAGITTA_MM)
    return Blank(rounded(around, 2.0), _apart(grown(pockets, POCKET_RADIUS_MM), wall_mm))


def _apart(pockets: Region, wall_mm: float) -> Region:
    """Return pockets set back from each other where less than a wall is between two of them."""
    half = wall_mm / 2.0 + SAGITTA_MM
    wider = grown(pockets, half)
    if wider.num_contour() == pockets.num_contour():
        return pockets
    each = pockets.decompose()
    between = (wider.offset(-half, JoinType.Miter) - pockets).simplify(SAGITTA_MM).decompose()  # without slivers
    thin = [piece for piece in between if _touched(grown(piece, SAGITTA_MM), each) > 1]
    return pockets - grown(union(thin), wall_mm / 2.0) if thin else pockets


def _touched(piece: Region, regions: Sequence[Region]) -> int:
    """Return how many of some regions a piece overlaps."""
    return sum(not (piece ^ region).is_empty() for region in regions if not boxes_apart(piece, region))


def outline(layout: Layout, blank: Blank, side: Face) -> Region:
    """Return a plate's outline, with its pockets.

    Ears below the hull of the pads hold the rest stop; the left one has material around the hole for the leg's pin too.
    """
    axle = layout.axle_mm + 2.0 * PAD_WALL_MM
    base = strips(layout.hub_mm, layout.hub_mm + np.array([EAR_MM, 0.0]), axle)
    around_pin = [pin_hole(layout, layout.pin_hole.pad_mm)] if side == "left" else []
    slot = rounded(stop_slot(layout, 0.0, STOP_EDGE_MM), 2.0)
    stop = hull([disc(axle, layout.hub_mm), base, slot, *around_pin])
    whole = blank.hull + stop - (blank.pockets - stop)
    whole = whole + horns(layout) if layout.of(Cage) else whole
    return whole + tail(layout) if layout.of(Steering) else whole


def pin_hole(layout: Layout, width_mm: float) -> Region:
    """Return the hole through which the leg's pin goes in, or what is around it, of some width."""
    ends = layout.pin_hole
    return stadium(tuple(ends.rest_mm), tuple(ends.stop_mm), width_mm)
