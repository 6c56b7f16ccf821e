"""The leads as leads.svg draws them: lines that do not cover each other, numbered as in the wiring table."""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from jumpcad.layout.layout import Layout
from jumpcad.parts.lead_ways import battery_way, corners, outer_way, plate_of
from jumpcad.parts.leads import lead_lengths
from jumpcad.robot import Robot
from jumpcad.transforms import Array

LANE_MM, GAP_LANE_MM, EDGE_MM = 1.0, 0.35, 1.5
"""Between leads that are drawn side by side at a part, and in the gap between boards; from a part's edge to leads."""


@dataclass(frozen=True)
class Lead:
    """A lead: its number in the wiring table, its colour, its parts, the corners (n, 3) of its way."""

    number: int
    colour: str
    parts: tuple[str, str]
    points_mm: Array


def leads_of(robot: Robot) -> list[Lead]:
    """Return every lead that is no part's own leg, side by side with the others at its parts."""
    layout, wiring = robot.layout, robot.wiring
    rows = [
        (number, colour, (start.part, end.part))
        for number, (_, start, end, colour, length) in enumerate(lead_lengths(layout, wiring), start=1)
        if length or {start.part, end.part} == {"battery", "plug"}
    ]
    counts, taken = Counter(part for *_, parts in rows for part in parts), Counter[str]()
    at_plates = Counter[str]()
    leads = []
    for index, (number, colour, parts) in enumerate(rows):
        lane = [taken[part] - (counts[part] - 1) / 2.0 for part in parts]
        taken.update(parts)
        plate = next(filter(None, (plate_of(layout, part) for part in parts)), "")
        at_plates[plate] += 1
        if set(parts) == {"battery", "plug"}:
            points = battery_way(layout) + np.array([0.0, LANE_MM * lane[parts.index("battery")], 0.0])
        else:
            start, end = (
                _outer(layout, part, one, counts[part], at_plates[plate]) for part, one in zip(parts, lane, strict=True)
            )
            inside = np.stack(corners(layout, *parts, start[-1], end[-1]))
            if not plate:
                inside[:, 0] += GAP_LANE_MM * (index - len(rows) / 2.0)
            points = np.concatenate([start, inside, end[::-1]])
        leads.append(Lead(number, colour, parts, points))
    return leads


def _outer(layout: Layout, part: str, lane: float, count: int, at_plate: int) -> Array:
    """Return the corners (n, 3) from a part's middle, beside it by a lane, until the lead is inside.

    `count` leads end at the part; at a plate this is the lead of number `at_plate`, and so far away from it inside.
    """
    way = np.stack(outer_way(layout, part))
    if plate := plate_of(layout, part):
        way += LANE_MM * lane
        way[-1, 1] += LANE_MM * (at_plate * (-1.0 if plate == "left" else 1.0) - lane)
        return way
    seats = layout.electronics.seats(layout.lateral.inside)
    size = np.array(seats.get(part, seats["controller"]).size_mm[:2])
    way[:, :2] += lane * np.minimum(LANE_MM, (size - 2.0 * EDGE_MM) / max(1, count - 1))
    return way
