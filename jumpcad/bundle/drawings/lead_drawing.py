"""leads.svg: where every lead runs: both plates from outside, the trays from above; numbered as in the wiring table."""

import itertools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from html import escape

import numpy as np
import numpy.typing as npt

from jumpcad.bundle.drawings.lead_lines import Lead, leads_of
from jumpcad.dimensions import TRAY_MM
from jumpcad.exporters.dxf import sheet
from jumpcad.layout.lateral import Interval
from jumpcad.layout.layout import Layout
from jumpcad.parts.fittings import wire_hole_mm
from jumpcad.parts.lead_ways import outer_way, plate_of
from jumpcad.robot import Robot
from jumpcad.transforms import Array

STROKES = {"red": "#c62828", "orange": "#ef6c00", "black": "#222222", "blue": "#1565c0", "yellow": "#c9a400"}
WIDTH_MM, MARGIN_MM, TITLE_MM = 250.0, 6.0, 6.0
BESIDE_TRAYS_MM = (10.0, 5.0)
"""What the view from above shows beside the trays: along and, at least, across."""
LEAD_EDGE_MM = 1.0
"""What it shows beyond the outermost lead."""
HEAD_MM = 2.9
"""Radius of a standoff's screw head (ISO 7380-1 M3)."""
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
    left, below_left = _plate(robot, leads, "left", MARGIN_MM, width)
    right, below_right = _plate(robot, leads, "right", 2.0 * MARGIN_MM + width, width)
    trays, height = _trays(robot.layout, leads, max(below_left, below_right) + MARGIN_MM)
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH_MM:.1f} {height:.1f}" '
            f'width="{4 * WIDTH_MM:.0f}" font-family="sans-serif" font-size="3">',
            f'<rect width="{WIDTH_MM:.1f}" height="{height:.1f}" fill="#ffffff"/>',
            *left,
            *right,
            *trays,
            "</svg>",
            "",
        ]
    )


def _plate(robot: Robot, leads: list[Lead], side: str, left: float, width: float) -> tuple[list[str], float]:
    """Return the view of a plate from outside, and its lower edge: leads inside are dashed.

    A bundle of some of a robot's parts may lack the plate: nothing is drawn then.
    """
    layout, sign = robot.layout, -1.0 if side == "left" else 1.0
    part = next((part for part in robot.parts if part.name == f"body_plate_{side}"), None)
    if part is None:
        return [], 0.0
    y = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
    region = sheet(part, y[1] - y[0])[0].simplify(FINE_MM)
    low_x, low_z, high_x, high_z = region.bounds()
    scale = width / (high_x - low_x)
    view = Projection(scale * np.array([[sign, 0.0, 0.0], [0.0, 0.0, -1.0]]),
                np.array([left - scale * low_x, MARGIN_MM + TITLE_MM + scale * high_z]))  # fmt: skip
    outline = [[(sign * x, 0.0, z) for x, z in contour] for contour in region.to_polygons()]
    drawn = [
        _text((left, MARGIN_MM + 3.0), f"{side} plate, seen from the {side}: leads inside it are dashed", size=3.6)
    ]
    drawn.append(_outline([view.on(*contour) for contour in outline]))
    drawn += [_circle(view.on([x, 0.0, z])[0], scale * HEAD_MM) for x, z in layout.standoffs_mm]
    drawn += [shape for words, box in _inside(layout) for shape in _box(view, box, words if "tray" in words else "")]
    mine = [lead for lead in leads if any(plate_of(layout, part) == side for part in lead.parts)]
    outside = (y[1], np.inf) if side == "left" else (-np.inf, y[0])
    drawn += [line for lead in mine for line in _lines(view, lead, 1, outside)]
    drawn += _badges(view, mine, None)
    for words, at in _named(layout, side):
        drawn.append(_text(view.on(at)[0], words, "middle", halo=True))
    front = (left, "← front", "start") if side == "left" else (left + width, "front →", "end")
    bottom = float(view.on([0.0, 0.0, low_z])[0][1])
    return [*drawn, _text((front[0], bottom + 3.0), front[1], front[2])], bottom + 4.0


def _named(layout: Layout, side: str) -> Iterator[tuple[str, list[float]]]:
    """Yield what is written in the view of a plate, and where (mm)."""
    fittings = layout.fittings
    x, z = wire_hole_mm(fittings.left_mm if side == "left" else fittings.right_mm)
    yield "wire hole, tie above it", [x, 0.0, z + 10.0]
    for part, below in (("sensor", 7.0), ("motor", 7.0), ("switch", 4.5)):
        if plate_of(layout, part) == side:
            at = outer_way(layout, part)[0]
            yield part, [float(at[0]), 0.0, float(at[2]) - below]
    if side == "right" and fittings.usb_mm is not None:
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


def _trays(layout: Layout, leads: list[Lead], top: float) -> tuple[list[str], float]:
    """Return the view of the trays from above, and its lower edge: what is below the upper tray is dashed."""
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
    drawn = [_text((left, top + 3.0), "trays and plates from above: leads below the upper tray are dashed", size=3.6)]
    for side, hole in zip(("left", "right"), holes, strict=True):
        y = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
        drawn += _box(view, (np.array([back, y[0], 0.0]), np.array([front, y[1], 0.0])), "", "#d5d8dc")
        drawn += _box(view, (np.array([hole - 2.5, y[0], 0.0]), np.array([hole + 2.5, y[1], 0.0])), "", "#ffffff")
        drawn.append(_text(view.on([back + 0.6, sum(y) / 2.0 - 0.4, 0.0])[0], f"{side} plate", halo=True))
        aside = y[1] + 3.0 if side == "left" else y[0] - 4.0
        drawn.append(_text(view.on([hole + 3.5, aside, 0.0])[0], f"wire hole of the {side} plate", halo=True))
        part = "sensor" if side == "left" else "motor"
        drawn.append(_text(view.on([back + 0.6, aside, 0.0])[0], f"← to the {part}, outside", halo=True))
    for words, box in _inside(layout):
        fill = {"upper tray": "#eef2f7", "lower tray": None, "battery": None}.get(words, "#e3ead9")
        drawn += _box(view, box, "" if words.endswith("tray") else words, fill)
    switch, place = layout.fittings.switch, layout.fittings.switch_mm
    if switch is not None and place is not None:
        size = np.array([switch.length_mm or 0.0, switch.height_mm or 0.0])
        least = np.array([place[0] - size[0] / 2.0, layout.lateral.inside[0], 0.0])
        drawn += _box(view, (least, least + np.array([*size, 0.0])), "switch")
    above = (z + layout.electronics.upper_tray_mm, np.inf)
    drawn += [
        *_clipped((line for lead in leads for line in _lines(view, lead, 2, above)), frame),
        *_badges(view, leads, frame),
    ]
    bottom = float(frame[1][1])
    drawn.append(_text((float(frame[1][0]), bottom + 3.0), "front →", "end"))
    return drawn, bottom + MARGIN_MM


def _ys_between(points_mm: Array, back: float, front: float) -> Iterator[float]:
    """Yield the y of the corners of a lead (n, 3) between two x, and of where it crosses them."""
    for a, b in itertools.pairwise(points_mm):
        shares = [0.0, 1.0, *((x - a[0]) / (b[0] - a[0]) for x in (back, front) if a[0] != b[0])]
        for at in (a + share * (b - a) for share in shares if 0.0 <= share <= 1.0):
            if back - FINE_MM <= at[0] <= front + FINE_MM:
                yield float(at[1])


def _lines(view: Projection, lead: Lead, axis: int, open_mm: Interval) -> Iterator[str]:
    """Yield a lead's line in pieces, dashed outside the interval of an axis that is open to view; dots are its ends."""
    points, stroke = view.on(*lead.points_mm), STROKES[lead.colour]
    seen = (lead.points_mm[:, axis] > open_mm[0]) & (lead.points_mm[:, axis] < open_mm[1])
    both = [bool(a and b) for a, b in itertools.pairwise(seen)]
    for shown, group in itertools.groupby(range(len(both)), lambda index: both[index]):
        indices = list(group)
        corners_on = " ".join(f"{_n(x)},{_n(y)}" for x, y in points[indices[0] : indices[-1] + 2])
        dashes = "" if shown else ' stroke-dasharray="1.6 1"'
        yield (
            f'<polyline points="{corners_on}" fill="none" stroke="{stroke}" stroke-width="0.55" '
            f'stroke-linejoin="round"{dashes}/>'
        )
    for x, y in (points[0], points[-1]):
        yield f'<circle cx="{_n(x)}" cy="{_n(y)}" r="0.7" fill="{stroke}"/>'


def _badges(view: Projection, leads: list[Lead], frame: Array | None) -> Iterator[str]:
    """Yield every lead's number in a circle on its line, apart from the others; in the frame (2, 2) if there is one."""
    taken: list[Array] = []
    for lead in leads:
        points = view.on(*lead.points_mm)
        pieces = sorted(itertools.pairwise(points), key=lambda ends: -round(math.dist(*ends), 3))
        places = [a + share * (b - a) for a, b in pieces for share in (0.5, 0.3, 0.7, 0.15, 0.85)]
        if frame is not None:
            places = [at for at in places if ((at > frame[0] + 2.0) & (at < frame[1] - 2.0)).all()] or places
        free = [at for at in places if all(math.dist(at, other) > BADGES_APART_MM for other in taken)]
        at = (free or places)[0]
        taken.append(at)
        yield (
            f'<circle cx="{_n(at[0])}" cy="{_n(at[1])}" r="{BADGE_MM:g}" fill="#ffffff" '
            f'stroke="{STROKES[lead.colour]}" stroke-width="0.4"/>'
        )
        yield _text((at[0], at[1] + 0.8), str(lead.number), "middle", size=2.3)


def _box(view: Projection, box: tuple[Array, Array], words: str, fill: str | None = None) -> Iterator[str]:
    """Yield a box by its least and largest corner; without a fill dashed."""
    low, high = (np.array(end) for end in zip(*(sorted(pair) for pair in view.on(*box).T), strict=True))
    look = f'fill="{fill}"' if fill else 'fill="none" stroke-dasharray="1 0.8"'
    yield (
        f'<rect x="{_n(low[0])}" y="{_n(low[1])}" width="{_n(high[0] - low[0])}" height="{_n(high[1] - low[1])}" '
        f'{look} stroke="#7b8794" stroke-width="0.25"/>'
    )
    if words:
        yield _text((low[0] + 0.6, high[1] - 0.7), words, size=2.4, halo=True)


def _outline(contours: Iterable[Array]) -> str:
    path = " ".join("M " + " L ".join(f"{_n(x)},{_n(y)}" for x, y in contour) + " Z" for contour in contours)
    return f'<path d="{path}" fill="#e6e8eb" fill-rule="evenodd" stroke="#7b8794" stroke-width="0.25"/>'


def _circle(at: Array, radius: float) -> str:
    where = f'cx="{_n(at[0])}" cy="{_n(at[1])}" r="{_n(radius)}"'
    return f'<circle {where} fill="#c3c9d1" stroke="#7b8794" stroke-width="0.25"/>'


def _clipped(parts: Iterable[str], frame: Array) -> Iterator[str]:
    (x0, y0), (x1, y1) = frame
    where = f'x="{_n(x0)}" y="{_n(y0)}" width="{_n(x1 - x0)}" height="{_n(y1 - y0)}"'
    yield f'<clipPath id="trays"><rect {where}/></clipPath>'
    yield from ('<g clip-path="url(#trays)">', *parts, "</g>")


def _text(at: Iterable[float], words: str, anchor: str = "start", size: float = 3.0, halo: bool = False) -> str:
    x, y = at
    around = ' stroke="#ffffff" stroke-width="0.7" paint-order="stroke"' if halo else ""
    return f'<text x="{_n(x)}" y="{_n(y)}" text-anchor="{anchor}" font-size="{size:g}"{around}>{escape(words)}</text>'


def _n(value: float) -> str:
    """Return a coordinate of the drawing; no negative zero."""
    return f"{round(float(value), 1) + 0.0:g}"
