"""Wires along the trays and through the plates' holes: their ways and lengths (mm, body frame)."""

import itertools
import math
from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from jumpcad.dimensions import TRAY_MM
from jumpcad.electronics.nets import AT, Terminal, Wiring
from jumpcad.robot.layout import Layout
from jumpcad.robot.steering.place import Steering
from jumpcad.transforms import Array

SLACK_MM = 30.0
"""Added to a wire's way for bends and two soldered ends; judgement."""
OWN_LEGS = ("upper resistor", "lower resistor", "pull-up resistor", "diode")
"""Parts whose own legs, 25 mm or more, reach every terminal of the board beside them: no wire is cut for those."""
APART = ("sensor", "switch")
APART_MM = 40.0
"""Added to the leads of what is soldered beside the robot and then put in its place; judgement: room for both hands."""
STEP_MM = 10.0
"""Lengths are rounded up to whole steps."""
BESIDE_MM = 2.0
"""From a plate's face to a lead's middle; judgement."""


def lead_lengths(layout: Layout, wiring: Wiring) -> list[tuple[str, Terminal, Terminal, str, float]]:
    """Return every wire: its net, both ends, colour and length to cut."""
    parts = {terminal.part for net in wiring.nets for wire in net.wires for terminal in wire}
    ways = {part: way_in(layout, part) for part in parts}
    return [
        (net.name, start, end, net.colour, _lead_mm(ways, start.part, end.part))
        for net in wiring.nets
        for start, end in net.wires
    ]


def metres_by_colour(layout: Layout, wiring: Wiring) -> dict[str, float]:
    """Return the length of all wires of a colour (m)."""
    lengths: dict[str, float] = defaultdict(float)
    for *_, colour, length in lead_lengths(layout, wiring):
        lengths[colour] += length / 1000.0
    return {colour: metres for colour, metres in lengths.items() if metres}


def _lead_mm(ways: Mapping[str, list[Array]], one: str, other: str) -> float:
    """Return the length to cut between two parts: outside straight, inside along the trays, with slack; 0 for none.

    `ways` are those of the parts' leads, by their names.
    """
    if has_own_legs(one, other) or {one, other} == {"battery", "plug"}:
        return 0.0
    way, length = (ways[one], ways[other]), SLACK_MM
    for outside in way:
        length += sum(math.dist(a, b) for a, b in itertools.pairwise(outside))
    length += float(np.abs(way[0][-1] - way[1][-1]).sum())
    length += APART_MM if one in APART or other in APART else 0.0
    return STEP_MM * math.ceil(length / STEP_MM - 1e-6)


def has_own_legs(one: str, other: str) -> bool:
    """Tell whether one of two parts is soldered to the other by its own legs."""
    return any(part in OWN_LEGS and board == AT[part] for part, board in ((one, other), (other, one)))


def way_in(layout: Layout, role: str) -> list[Array]:
    """Return the points (3,) that a part's leads pass from its terminals until they are at the trays.

    Sensor and motor have theirs outside the plates, through whose holes they come in.
    """
    inside, outside = layout.lateral.inside, layout.lateral.outside
    if role == "sensor" and layout.sensor is not None:
        (x, z), hole = layout.sensor.place_mm, layout.fittings.left_mm
        far = outside[1] + BESIDE_MM
        start = np.array([x, outside[1] + layout.sensor.base_mm + BESIDE_MM, z])
        return [start, np.array([hole[0], far, hole[1]]), np.array([hole[0], inside[1] - BESIDE_MM, hole[1]])]
    if role == "motor":
        (x, z), hole = layout.motor_mm, layout.fittings.right_mm
        far = outside[0] - BESIDE_MM
        start = np.array([x, far, z])
        return [start, np.array([hole[0], far, hole[1]]), np.array([hole[0], inside[0] + BESIDE_MM, hole[1]])]
    if role == "switch" and layout.fittings.switch_mm is not None:
        x, z = layout.fittings.switch_mm
        return [np.array([x, inside[0] + BESIDE_MM, z])]
    if role == "steering motor" and (place := layout.of(Steering)) is not None:
        x, z = place.at(place.cradle_x_mm[1], 0.0)
        return [np.array([x, float(place.T_body_axle[1, 3]), z])]
    seats = layout.electronics.seats(inside)
    seat = seats.get(role, seats["controller"])  # what is soldered into a wire lies at the controller
    x, z = layout.tray_mm
    return [np.array([x + seat.x_mm, seat.y_mm, z + seat.bottom_mm + TRAY_MM])]
