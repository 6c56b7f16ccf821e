"""The leads as leads.svg draws them: lines that do not cover each other, numbered as in the wiring table."""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from jumpcad.electronics.nets import Terminal
from jumpcad.robot.electronics.leads import OWN_LEGS, battery_way, corners, lead_lengths, outer_way, plate_of
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.transforms import Array

LANE_MM, PLATE_LANE_MM, GAP_LANE_MM, EDGE_MM = 1.0, 2.5, 0.35, 1.5
"""Between leads that are drawn side by side at a part, outside a plate, and in the gap between boards; from
a part's edge to leads."""


APART_MM = 3.0
"""Between small parts at the controller."""
PAD_PITCH_MM, PAD_EDGE_MM = 2.54, 1.3
"""Between the pads of a board that plugs into a breadboard, and from its edge to them."""


@dataclass(frozen=True)
class Lead:
    """A lead: its number in the wiring table, its colour, both terminals, the corners (n, 3) of its way."""

    number: int
    colour: str
    ends: tuple[Terminal, Terminal]
    points_mm: Array

    @property
    def parts(self) -> tuple[str, str]:
        """Return the parts at its ends."""
        return self.ends[0].part, self.ends[1].part


def pads_of(robot: Robot) -> dict[Terminal, Array]:
    """Return the middles (3,) of the controller's pads whose places are known: in rows, USB at its plate."""
    layout, board = robot.layout, robot.layout.electronics.controller
    seat, (x, z) = layout.electronics.seats(layout.lateral.inside)["controller"], layout.tray_mm
    pads: dict[Terminal, Array] = {}
    if layout.fittings.usb_mm is None:
        return pads
    # from above with USB ahead the rows are left and right: where USB points to the right, left is in front
    turned = layout.electronics.inwards("controller")
    for sign, names in ((turned, board.left), (-turned, board.right)):
        for row, name in enumerate(names):
            along = seat.y_mm + turned * PAD_PITCH_MM * (row - (len(names) - 1) / 2.0)
            across = x + seat.x_mm + sign * (seat.size_mm[0] / 2.0 - PAD_EDGE_MM)
            pads[Terminal("controller", name)] = np.array([across, along, z + seat.bottom_mm + seat.size_mm[2]])
    return pads


def leads_of(robot: Robot) -> list[Lead]:
    """Return every lead that is no part's own leg: to its pads, or side by side with the others at its parts."""
    layout, wiring, pads = robot.layout, robot.wiring, pads_of(robot)
    rows = [
        (number, colour, (start, end))
        for number, (_, start, end, colour, length) in enumerate(lead_lengths(layout, wiring), start=1)
        if length or {start.part, end.part} == {"battery", "plug"}
    ]
    counts, taken = Counter(end.part for *_, ends in rows for end in ends), Counter[str]()
    at_plates = Counter[str]()
    leads = []
    for index, (number, colour, ends) in enumerate(rows):
        parts = (ends[0].part, ends[1].part)
        lane = [taken[part] - (counts[part] - 1) / 2.0 for part in parts]
        taken.update(parts)
        plate = next(filter(None, (plate_of(layout, part) for part in parts)), "")
        at_plates[plate] += 1
        if set(parts) == {"battery", "plug"}:
            points = battery_way(layout) + np.array([0.0, LANE_MM * lane[parts.index("battery")], 0.0])
        else:
            start, end = (
                _from_pad(robot, pads[terminal])
                if terminal in pads
                else _outer(layout, terminal.part, one, counts[terminal.part], at_plates[plate])
                for terminal, one in zip(ends, lane, strict=True)
            )
            inside = np.stack(corners(layout, *parts, start[-1], end[-1]))
            if not plate:
                inside[:, 0] += GAP_LANE_MM * (index - len(rows) / 2.0)
            points = np.concatenate([start, inside, end[::-1]])
        leads.append(Lead(number, colour, ends, points))
    return leads


def _from_pad(robot: Robot, pad: Array) -> Array:
    """Return the corners (n, 3) from a pad until its lead can run along: from the row behind, between two pads."""
    layout = robot.layout
    behind = pad[0] < layout.tray_mm[0] + layout.electronics.seats(layout.lateral.inside)["controller"].x_mm
    return np.stack([pad, pad + np.array([0.0, PAD_PITCH_MM / 2.0, 0.0])]) if behind else pad[None]


def _outer(layout: Layout, part: str, lane: float, count: int, at_plate: int) -> Array:
    """Return the corners (n, 3) from a part's middle, beside it by a lane, until the lead is inside.

    `count` leads end at the part; at a plate this is the lead of number `at_plate`, and so far away from it inside.
    """
    way = np.stack(outer_way(layout, part))
    if part == "steering motor":
        return way + lane * np.array([LANE_MM, 0.0, -LANE_MM])  # across the strut, and the way round the spring
    if plate := plate_of(layout, part):
        way += PLATE_LANE_MM * lane
        way[-1, 1] += LANE_MM * at_plate * (-1.0 if plate == "left" else 1.0) - PLATE_LANE_MM * lane
        return way
    seats = layout.electronics.seats(layout.lateral.inside)
    size = np.array(seats.get(part, seats["controller"]).size_mm[:2])
    way[:, :2] += lane * np.minimum(LANE_MM, (size - 2.0 * EDGE_MM) / max(1, count - 1))
    if part in OWN_LEGS:  # at the controller: apart, and between two pads of a row
        way[:, 0] += APART_MM * (OWN_LEGS.index(part) - (len(OWN_LEGS) - 1) / 2.0)
        gap = (way[:, 1] - seats["controller"].y_mm) / PAD_PITCH_MM
        way[:, 1] = seats["controller"].y_mm + PAD_PITCH_MM * (np.floor(gap) + 0.5)
    return way
