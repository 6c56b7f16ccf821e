"""The rest stop's bar between the plates: it prints lying, so that the impact bends it along its layers (mm)."""

from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import STOP_PAD_MM, STOP_SEAT_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement
from jumpcad.robot.layout import Layout
from jumpcad.robot.stop.place import TAB_MM
from jumpcad.solids.outline import Region, hull, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

END_SHARE = 0.6
"""Depth of the bar at the plates over that in its middle, where the impact bends it most; judgement."""
SEAT_PLAY_MM = 0.2
"""Play of the pad in its seat, either side; judgement."""
GLUE_MM = 0.02
"""Gap between pad and seat."""


def stop_bar(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    """Yield the bar: its face towards the leg with the pad's seat, deepest in the middle, a tab through each plate.

    In its printing frame x is the robot's left, y points towards the leg, z along the leg.
    """
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    stop, lateral = layout.stop, layout.lateral
    low, high = lateral.inside
    outer_low, outer_high = lateral.outside
    pad = layout.sections.thickness_mm + 2.0 * SEAT_PLAY_MM
    body = hull(
        [
            _box(low, high, -END_SHARE * stop.depth_mm, 0.0),
            _box(-pad / 2.0 - STOP_SEAT_MM, pad / 2.0 + STOP_SEAT_MM, -stop.depth_mm, 0.0),
        ]
    )
    tabs = _box(outer_low, outer_high, -TAB_MM[1], 0.0)
    seat = _box(-pad / 2.0, pad / 2.0, -STOP_SEAT_MM - GLUE_MM, 1.0)
    shape = Stack.of([(0.0, TAB_MM[0], union([body, tabs]) - seat), (TAB_MM[0], STOP_PAD_MM, body - seat)])
    yield Drawing("stop_bar", "links", holes.chamfered(shape), (Placement(BODY, _pose(layout)),))


def stop_slot(layout: Layout, play_mm: float, edge_mm: float = 0.0) -> Region:
    """Return the slot in a plate for a tab of the bar, or the plate's material around it, grown by an edge."""
    stop = layout.stop
    size = tuple(side + play_mm + 2.0 * edge_mm for side in TAB_MM)
    return rectangle(size).rotate(float(np.degrees(stop.turn_rad))).translate(tuple(stop.tab_mm))


def _pose(layout: Layout) -> Array:
    """Return the pose (4, 4) of the bar's printing frame in the body's frame."""
    stop = layout.stop
    behind, along = stop.behind, stop.along
    x, z = stop.seat_mm - STOP_PAD_MM / 2.0 * along
    return np.array(
        [
            [0.0, -behind[0], along[0], x],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, -behind[1], along[1], z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def _box(x0: float, x1: float, y0: float, y1: float) -> Region:
    return rectangle((x1 - x0, y1 - y0), ((x0 + x1) / 2.0, (y0 + y1) / 2.0))
