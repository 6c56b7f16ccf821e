"""leads.svg: where every lead runs: both plates from outside, the trays from above; numbered as in the wiring table."""

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from jumpcad.bundle.drawings.lead_lines import Lead, leads_of, pads_of
from jumpcad.dimensions import TRAY_MM
from jumpcad.electronics.nets import Terminal
from jumpcad.exporters.dxf import sheet
from jumpcad.files.templates import fill
from jumpcad.robot.electronics.fittings import wire_hole_mm
from jumpcad.robot.electronics.leads import OWN_LEGS, outer_way, plate_of
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.place import Steering
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

STROKES = {"red": "#c62828", "orange": "#ef6c00", "black": "#222222", "blue": "#1565c0", "yellow": "#c9a400"}
WIDTH_MM, MARGIN_MM, TITLE_MM = 250.0, 6.0, 6.0
BESIDE_TRAYS_MM = (10.0, 5.0)
"""What the view from above shows beside the trays: along and, at least, across."""
LEAD_EDGE_MM = 1.0
"""What it shows beyond the outermost lead."""
HEAD_MM = 2.9
"""Radius of a standoff's screw head (ISO 7380-1 M3)."""
OUTSIDE = ("sensor", "motor", "steering motor")
"""Parts whose terminals are beside the trays, in the view of a plate."""
USB_MM = 2.5
"""How much of the USB socket is drawn on the board; judgement."""
FINE_MM = 0.05
"""Detail of outlines that is left out."""
BADGE_MM, BADGES_APART_MM = 1.7, 3.9
"""Radius of a number's circle, and between the middles of two."""


@dataclass(frozen=True)
class Projection:
    """A projection: two rows (2, 3) that map points of the body frame (mm) onto the drawing, and its offset (2,)."""

    rows: Array
    offset: Array

    def on(self, *points_mm: npt.ArrayLike) -> Array:
        """Return points (n, 2) of the drawing."""
        stacked = np.array(points_mm, dtype=float).reshape(-1, 3)
        return np.stack([(stacked * row).sum(axis=1) for row in self.rows], axis=1) + self.offset


def leads_svg(robot: Robot) -> str:
    """Return the drawing: the left plate seen from the left, the right one from the right, the trays from above."""
    leads = leads_of(robot)
    width = (WIDTH_MM - 3.0 * MARGIN_MM) / 2.0
    places = {"left": MARGIN_MM, "right": 2.0 * MARGIN_MM + width}
    plates = [plate for side, left in places.items() if (plate := _plate(robot, leads, side, left, width))]
    trays = _trays(robot, leads, max((plate["bottom"] + 4.0 for plate in plates), default=0.0) + MARGIN_MM)
    values = {
        "width": WIDTH_MM, "plates": plates, "trays": trays, "text_y": MARGIN_MM + 3.0, "badge": BADGE_MM,
        "n": lambda value: f"{round(float(value), 1) + 0.0:g}",  # no negative zero
    }  # fmt: skip
    return fill("drawings/leads.svg.j2", values)


def _plate(robot: Robot, leads: list[Lead], side: str, left: float, width: float) -> dict[str, Any] | None:
    """Return the view of a plate from outside, and its lower edge: leads inside are dashed.

    A bundle of some of a robot's parts may lack the plate: nothing is drawn then.
    """
    layout, sign = robot.layout, -1.0 if side == "left" else 1.0
    part = next((part for part in robot.parts if part.name == f"body_plate_{side}"), None)
    if part is None:
        return None
    y = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
    region = sheet(part, y[1] - y[0])[0].simplify(FINE_MM)
    low_x, low_z, high_x, high_z = region.bounds()
    scale = width / (high_x - low_x)
    view = Projection(scale * np.array([[sign, 0.0, 0.0], [0.0, 0.0, -1.0]]),
                np.array([left - scale * low_x, MARGIN_MM + TITLE_MM + scale * high_z]))  # fmt: skip
    mine = [lead for lead in leads if any(plate_of(layout, part) == side for part in lead.parts)]
    named = {end: end.pin for lead in mine for end in lead.ends if end.part in OUTSIDE}
    outside = (y[1], np.inf) if side == "left" else (-np.inf, y[0])
    return {
        "side": side,
        "left": left,
        "outline": [view.on(*[(sign * x, 0.0, z) for x, z in contour]) for contour in region.to_polygons()],
        "heads": [view.on([x, 0.0, z])[0] for x, z in layout.standoffs_mm],
        "head": scale * HEAD_MM,
        "boxes": [_box(view, box, words if "tray" in words else "") for words, box in _inside(layout)],
        "leads": sorted(  # words stand above the upper end of two and below the lower one
            (_lines(view, lead, 1, outside, named) for lead in mine),
            key=lambda drawn: min((at[1] for at, words in drawn["ends"] if words), default=0.0),
        ),
        "badges": _badges(view, mine, None),
        "names": [(words, view.on(at)[0]) for words, at in _named(layout, side)],
        "front": (left, "← front", "start") if side == "left" else (left + width, "front →", "end"),
        "bottom": float(view.on([0.0, 0.0, low_z])[0][1]),
    }


def _named(layout: Layout, side: str) -> Iterator[tuple[str, list[float]]]:
    """Yield what is written in the view of a plate, and where (mm)."""
    fittings = layout.fittings
    x, z = wire_hole_mm(fittings.left_mm if side == "left" else fittings.right_mm)
    yield "wire hole, tie above it", [x, 0.0, z + 10.0]
    wheel = [("steering motor", 7.5)] * (layout.of(Steering) is not None)
    for part, below in (("sensor", 7.0), ("motor", 7.0), ("switch", 4.5), *wheel):
        if plate_of(layout, part) == side:
            at = outer_way(layout, part)[0]
            yield part, [float(at[0]), 0.0, float(at[2]) - below]
    if fittings.usb_mm is not None and side == fittings.usb_side:
        yield "USB", [float(fittings.usb_mm[0]), 0.0, float(fittings.usb_mm[1]) - 1.0]


def _inside(layout: Layout) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Yield the trays and what lies on them: name, least and largest corner (3,) each (mm)."""
    (x, z), electronics, (low, high) = layout.tray_mm, layout.electronics, layout.lateral.inside
    half = electronics.length_mm / 2.0
    for name, level in (("lower tray", 0.0), ("upper tray", electronics.upper_tray_mm)):
        yield name, (np.array([x - half, low, z + level]), np.array([x + half, high, z + level + TRAY_MM]))
    for name, seat in electronics.seats(layout.lateral.inside).items():
        size = np.array(seat.size_mm)
        least = np.array([x + seat.x_mm, seat.y_mm, z + seat.bottom_mm]) - size * (0.5, 0.5, 0.0)
        yield name, (least, least + size)


def _trays(robot: Robot, leads: list[Lead], top: float) -> dict[str, Any]:
    """Return the view of the trays from above, and its lower edge: what is below the upper tray is dashed."""
    layout, pads = robot.layout, pads_of(robot)
    (x, z), (low, high), (along, across) = layout.tray_mm, layout.lateral.outside, BESIDE_TRAYS_MM
    holes = [place[0] for place in (layout.fittings.left_mm, layout.fittings.right_mm)]
    half = layout.electronics.length_mm / 2.0
    back, front = min(x - half, *holes) - along, max(x + half, *holes) + along
    out = [max(y - high, low - y) for lead in leads for y in _ys_between(lead.points_mm, back, front)]
    across = max(across, max(out, default=0.0) + LEAD_EDGE_MM)
    scale = min((WIDTH_MM - 2.0 * MARGIN_MM) / (front - back), 3.6)
    left = (WIDTH_MM - scale * (front - back)) / 2.0
    upper = top + TITLE_MM
    view = Projection(scale * np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
                np.array([left - scale * back, upper + scale * (high + across)]))  # fmt: skip
    frame = view.on([back, high + across, 0.0], [front, low - across, 0.0])
    plates = []
    for side, hole in zip(("left", "right"), holes, strict=True):
        y = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
        spans = {(back, front): "#d5d8dc", (hole - 2.5, hole + 2.5): "#ffffff"}
        aside, outside = (y[1] + 0.8, "sensor") if side == "left" else (y[0] - 1.8, "motor")
        names = {
            f"{side} plate": (back + 0.6, sum(y) / 2.0 - 0.4),
            f"wire hole of the {side} plate": (hole + 3.5, aside),
            f"← to the {outside}, outside": (back + 0.6, aside),
        }
        if side == "right" and layout.of(Steering) is not None:
            names["← to the wheel"] = (back + 0.6, y[1] + 0.8)
        drawn = [
            _box(view, (np.array([first, y[0], 0.0]), np.array([last, y[1], 0.0])), "", colour)
            for (first, last), colour in spans.items()
        ]
        plates.append({"boxes": drawn, "names": [(words, view.on([*at, 0.0])[0]) for words, at in names.items()]})
    fills = {"upper tray": "#eef2f7", "lower tray": None, "battery": None}
    boxes = [
        _box(view, box, "" if words.endswith("tray") else words, fills.get(words, "#e3ead9"))
        for words, box in _inside(layout)
    ]
    switch, place = layout.fittings.switch, layout.fittings.switch_mm
    if switch is not None and place is not None:
        size = np.array([switch.length_mm or 0.0, switch.height_mm or 0.0])
        least = np.array([place[0] - size[0] / 2.0, layout.lateral.inside[0], 0.0])
        boxes.append(_box(view, (least, least + np.array([*size, 0.0])), "switch"))
    seat = layout.electronics.seats(layout.lateral.inside)["controller"]
    middle, half = x + seat.x_mm, layout.fittings.usb_size_mm[0] / 2.0
    edge = seat.y_mm - layout.electronics.inwards("controller") * (seat.size_mm[1] - USB_MM) / 2.0 - USB_MM / 2.0
    if layout.fittings.usb_mm is not None:
        socket = np.array([middle - half, edge, 0.0]), np.array([middle + half, edge + USB_MM, 0.0])
        boxes.append(_box(view, socket, "USB socket", "#c3c9d1"))
    above = (z + layout.electronics.upper_tray_mm, np.inf)
    ends = {end for lead in leads for end in lead.ends}
    below = " (underneath)" if pads else ""  # what is in no row
    named = {
        end: str(end) if end.part in OWN_LEGS else end.pin + below * (end.part == "controller")
        for end in ends
        if end not in pads and end.part not in OUTSIDE
    }
    return {
        "left": left, "top": top, "plates": plates, "boxes": boxes, "frame": frame,
        "leads": [_lines(view, lead, 2, above, named) for lead in leads],
        "pads": [(view.on(at)[0], end.pin, end in ends, at[0] > middle) for end, at in pads.items()],
        "unknown": [role for role, board in robot.layout.electronics.boards.items() if not (board.left or board.right)],
        "badges": _badges(view, leads, frame), "height": float(frame[1][1]) + MARGIN_MM,
    }  # fmt: skip


def _ys_between(points_mm: Array, back: float, front: float) -> Iterator[float]:
    """Yield the y of the corners of a lead (n, 3) between two x, and of where it crosses them."""
    for a, b in itertools.pairwise(points_mm):
        shares = [0.0, 1.0, *((x - a[0]) / (b[0] - a[0]) for x in (back, front) if a[0] != b[0])]
        for at in (a + share * (b - a) for share in shares if 0.0 <= share <= 1.0):
            if back - FINE_MM <= at[0] <= front + FINE_MM:
                yield float(at[1])


def _lines(view: Projection, lead: Lead, axis: int, open_mm: Interval, named: Mapping[Terminal, str]) -> dict[str, Any]:
    """Return a lead's line in pieces, and which are seen: in the interval of an axis that is open to view.

    `named` terminals have those words at its ends.
    """
    points = view.on(*lead.points_mm)
    seen = (lead.points_mm[:, axis] > open_mm[0]) & (lead.points_mm[:, axis] < open_mm[1])
    both = [bool(a and b) for a, b in itertools.pairwise(seen)]
    pieces = []
    for shown, group in itertools.groupby(range(len(both)), lambda index: both[index]):
        indices = list(group)
        pieces.append((points[indices[0] : indices[-1] + 2], shown))
    words = [named.get(end, "") for end in lead.ends]
    ends = list(zip((points[0], points[-1]), words, strict=True))
    return {"stroke": STROKES[lead.colour], "pieces": pieces, "ends": ends}


def _badges(view: Projection, leads: list[Lead], frame: Array | None) -> list[dict[str, Any]]:
    """Return every lead's number and its place on its line, apart from the others; in the frame (2, 2) if any."""
    badges: list[dict[str, Any]] = []
    for lead in leads:
        points = view.on(*lead.points_mm)
        pieces = sorted(itertools.pairwise(points), key=lambda ends: -round(math.dist(*ends), 3))
        places = [a + share * (b - a) for a, b in pieces for share in (0.5, 0.3, 0.7, 0.15, 0.85)]
        if frame is not None:
            places = [at for at in places if ((at > frame[0] + 2.0) & (at < frame[1] - 2.0)).all()] or places
        free = [at for at in places if all(math.dist(at, other["at"]) > BADGES_APART_MM for other in badges)]
        badges.append({"at": (free or places)[0], "stroke": STROKES[lead.colour], "number": lead.number})
    return badges


def _box(view: Projection, box: tuple[Array, Array], words: str, fill: str | None = None) -> dict[str, Any]:
    """Return a box by its least and largest corner; without a fill it is dashed."""
    low, high = (np.array(end) for end in zip(*(sorted(pair) for pair in view.on(*box).T), strict=True))
    return {"low": low, "high": high, "words": words, "fill": fill}
