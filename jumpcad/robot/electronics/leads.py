"""Wires along the trays and through the plates' holes: their ways and lengths (mm, body frame)."""

import itertools
import math
from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from jumpcad.dimensions import STOP_PAD_MM, TRAY_MM
from jumpcad.electronics.nets import AT, Terminal, Wiring
from jumpcad.robot.electronics.fittings import wire_hole_mm
from jumpcad.robot.layout import Layout
from jumpcad.robot.steering.place import LEADS_MM, SLOT_EDGE_MM, TAB_MM, Steering
from jumpcad.robot.stop.place import EAR_MM
from jumpcad.transforms import Array, direction

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
    way = ways[one], ways[other]
    length = SLACK_MM + sum(math.dist(a, b) for outside in way for a, b in itertools.pairwise(outside))
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
        return _wheels_way(layout, place)
    seats = layout.electronics.seats(inside)
    seat = seats.get(role, seats["controller"])  # what is soldered into a wire lies at the controller
    x, z = layout.tray_mm
    return [np.array([x + seat.x_mm, seat.y_mm, z + seat.bottom_mm + TRAY_MM])]


SPRING_MM, STOP_MM = 3.5, 1.5
"""From a spring's coil, and from the rest stop, to the middle of the wheel's leads; judgement."""


def _wheels_way(layout: Layout, place: Steering) -> list[Array]:
    """Return the points (3,) of the leads of the wheel's motor: on its mount's front to the right, and up the plate.

    There they pass ahead of the rest stop and below the spring to the strut between the axles, and along it.
    """
    stop, hub, (begin, end) = layout.stop, layout.hub_mm, place.cradle_x_mm
    front, high = place.at(end + LEADS_MM / 2.0, 0.0), stop.seat_mm - STOP_MM * stop.behind
    tail = place.at((begin + end) / 2.0 + TAB_MM / 2.0 + LEADS_MM, place.base_z_mm[1] + SLOT_EDGE_MM)
    below = (layout.drive.spring.outer_diameter_mm / 2.0 + SPRING_MM) * direction(math.pi / 4.0)
    back = float(layout.tray_mm[0]) - layout.electronics.length_mm / 2.0 - AHEAD_MM
    up = float(layout.tray_mm[1]) + layout.electronics.upper_tray_mm + TRAY_MM
    flat = [front, front, tail, high + STOP_PAD_MM / 2.0 * stop.along, high, hub + below]
    flat += [np.array(at) for at in ((hub[0] + EAR_MM, hub[1]), (back, hub[1]), (back, up))]
    middle = float(place.T_body_axle[1, 3])
    aside = [middle, middle - place.half_mount_mm - BESIDE_MM, *[layout.lateral.inside[0] + BESIDE_MM] * 7]
    return [np.array([x, y, z]) for (x, z), y in zip(flat, aside, strict=True)]


BELOW_SCREW_MM = 5.0
"""From a standoff's hole down to a lead outside the plate; judgement: its screw's head has a radius of 2.9 mm."""
OPENING_EDGE_MM = 2.0
"""From the opening for the USB plug to a lead; judgement."""
AHEAD_MM = 3.0
"""From the trays' front end to the battery's own leads, and behind them to the wheel's; judgement."""


def plate_of(layout: Layout, part: str) -> str:
    """Return at which plate a part is: `left`, `right`, or empty where it lies on the trays."""
    if part == "sensor" and layout.sensor is not None:
        return "left"
    there = part == "switch" and layout.fittings.switch_mm is not None
    return "right" if there or part in ("motor", "steering motor") else ""


def battery_way(layout: Layout) -> Array:
    """Return the corners (5, 3) of the way of the battery's own leads: ahead of the trays up to the plug."""
    seats, (x, z) = layout.electronics.seats(layout.lateral.inside), layout.tray_mm
    battery, plug = (
        np.array([x + seat.x_mm + seat.size_mm[0] / 2.0, seat.y_mm, z + seat.bottom_mm + seat.size_mm[2] / 2.0])
        for seat in (seats["battery"], seats.get("plug", seats["controller"]))
    )
    ahead = x + layout.electronics.length_mm / 2.0 + AHEAD_MM
    low, high = np.array([ahead, *battery[1:]]), np.array([ahead, *plug[1:]])
    return np.stack([battery, low, [ahead, battery[1], plug[2]], high, plug])


def outer_way(layout: Layout, part: str) -> list[Array]:
    """Return the points (3,) that a part's leads pass until they are inside, at the trays: through the wire hole."""
    way = way_in(layout, part)
    if len(way) == 1 or part == "steering motor":
        return way
    place = layout.fittings.left_mm if plate_of(layout, part) == "left" else layout.fittings.right_mm
    x, z = wire_hole_mm(place)
    start, *through = way
    outside, inside = (np.array([x, point[1], z]) for point in through)
    return [start, *_beside(layout, part, start, outside), outside, inside]


def corners(layout: Layout, one: str, other: str, start: Array, end: Array) -> list[Array]:
    """Return the corners (3,) between two points inside.

    At a plate a lead runs along it at the height of hole or switch, and down beside it; to the steering wheel's motor
    it crosses behind the trays; from board to board in the gap between them.
    """
    (x0, y0, z0), (x1, y1, z1) = start, end
    if other == "steering motor":
        return [np.array([x1, y0, z0]), np.array([x1, y1, z0])]
    if plate_of(layout, one):
        return [np.array([x1, y0, z0]), np.array([x1, y0, z1])]
    if plate_of(layout, other):
        return [np.array([x0, y1, z0]), np.array([x0, y1, z1])]
    x = gap_mm(layout, float(x0), float(x1))
    return [np.array([x, y0, z0]), np.array([x, y1, z1])]


def gap_mm(layout: Layout, start_mm: float, end_mm: float) -> float:
    """Return where a lead crosses between two places along the robot: in the first gap between boards, or half way."""
    (low, high), gaps = sorted((start_mm, end_mm)), []
    seats = layout.electronics.seats(layout.lateral.inside)
    for behind, ahead in itertools.pairwise(layout.electronics.boards):
        edges = (seats[behind].x_mm + seats[behind].size_mm[0] / 2.0, seats[ahead].x_mm - seats[ahead].size_mm[0] / 2.0)
        gaps.append(float(layout.tray_mm[0]) + sum(edges) / 2.0)
    return min((x for x in gaps if low < x < high), key=lambda x: abs(x - start_mm), default=(low + high) / 2.0)


def _beside(layout: Layout, part: str, start: Array, end: Array) -> list[Array]:
    """Return the points (3,) by which a lead outside passes below standoffs' screws, and beside the opening for USB."""
    fittings, reach = layout.fittings, math.inf
    kept = [(float(x), float(z), BELOW_SCREW_MM, 2.0 * reach) for x, z in layout.standoffs_mm]
    if fittings.usb_mm is not None and plate_of(layout, part) == fittings.usb_side:
        half = fittings.usb_size_mm[1] / 2.0 + OPENING_EDGE_MM
        kept.append((float(fittings.usb_mm[0]), float(fittings.usb_mm[1]), half, half))
    points = []
    for x, z, below, above in kept:
        share = (x - start[0]) / (end[0] - start[0]) if end[0] != start[0] else -1.0
        at = start[2] + share * (end[2] - start[2])
        if 0.0 < share < 1.0 and z - below < at < z + min(above, below):
            over = above < reach and at > z
            points.append(np.array([x, end[1], z + above if over else z - below]))
    return sorted(points, key=lambda point: abs(float(point[0] - start[0])))
