"""The electronics' trays between the plates, the battery's below the boards', and what is bought (mm, g).

Both print as they stand on the robot. The battery lies between two stops. Boards lie on foam tape between a plate and a
rim, each under a cable tie. The rest lies behind the right plate and in the wires.
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.catalogue import Battery, Board, Catalogue, Component
from jumpcad.dimensions import STRAP_SLOT_MM, TAB_MM, TIE_SLOT_MM, TRAY_MM
from jumpcad.electronics.nets import Wiring, wiring_of
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, upright
from jumpcad.parts.purchased import TIE, TIE_G, TIE_MM, BoughtPart, bought, box_outline, placed_box, placed_screw
from jumpcad.robot.electronics import limits
from jumpcad.robot.electronics.fittings import HOLE_HALF_MM, HOLE_MM, RELIEF_APART_MM, RELIEF_UP_MM, SWITCH_SCREWS_MM
from jumpcad.robot.electronics.leads import metres_by_colour
from jumpcad.robot.electronics.place import (
    BALANCE_MM,
    RIM_HEIGHT_MM,
    SEAT_PLAY_MM,
    STOP_HEIGHT_MM,
    TAPE_MM,
    Electronics,
)
from jumpcad.robot.layout import Layout
from jumpcad.robot.plates.outline import tray_slots
from jumpcad.robot.robot import Check, Thing
from jumpcad.solids.outline import Region, hexagon, hole, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.workshop import Workshop

EDGE_MM, LEDGE_MM = 5.0, 2.0
"""Of the battery's window: distance from the tray's ends, and width left under the battery; judgement."""
CORNER_MM = 1.5
"""Radius of a floor's corners; judgement: none is sharp in the hand or lifts from the bed."""
STOP_FOOT_MM = 1.0
"""Floor left before a stop of the battery; judgement: two lines of a 0.4 mm nozzle."""
STOP_MIN_MM = 4.0
"""Least length of a stop across; judgement."""
BOARD_LEDGE_MM = 4.0
"""Width left under a board for its tape; judgement."""
WINDOW_MIN_MM = 4.0
"""Least width of a window: that of its round ends."""
RIM_SHARE = 0.6
"""Length of a rim over the board's width; judgement: wires leave beside it."""
SWITCH_EAR_MM, SWITCH_BODY_MM = 0.5, 10.0
"""Thickness of the ears of a slide switch (usual), and length of the body between them (SS-12F15)."""
STRAP = "hook-and-loop strap 10 x 150 mm (VELCRO ONE-WRAP or equal), 1.2 mm thick at most"
STRAP_MM, STRAP_G = (10.0, 1.0), 0.8
BALANCE_HEIGHT_MM = 6.0
"""Of a balance lead's plug, which lies under its tie; judgement."""
TAPE, TAPE_G_CM3 = "double-sided foam tape 1 mm", 0.5
SMALL = ("resistor", "diode")
"""What lies between the boards, by the beginnings of its names."""
HEAT_SHRINK, HEAT_SHRINK_G, RESISTOR_G, WIRE_LENGTH_MM = "heat-shrink tube 2 mm, 0.5 m", 0.4, 0.2, 500.0
"""What holds battery and boards: order text, width and thickness, mass or density; what is soldered; from memory."""


def trays(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return the lower and the upper tray."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    electronics, inside = layout.electronics, layout.lateral.inside
    battery, middle, rim = electronics.battery, sum(inside) / 2.0, electronics.rim_mm
    strap_y, seat = battery.width_mm / 2.0 + STRAP_SLOT_MM[0], electronics.seats(inside)["battery"]
    x, at = seat.x_mm, seat.y_mm - middle
    straps = [rectangle(STRAP_SLOT_MM[::-1], (x, at + side * strap_y)) for side in (-1.0, 1.0)]
    between = 2.0 * (electronics.stop_mm - rim / 2.0 - STOP_FOOT_MM)
    window = _window(min(electronics.length_mm - 2.0 * (EDGE_MM - x), between), battery.width_mm - 2.0 * LEDGE_MM)
    if electronics.balanced:
        reach = (BALANCE_MM + TIE_SLOT_MM[0]) / 2.0
        straps += [
            rectangle(TIE_SLOT_MM[::-1], (x + electronics.balance_mm, at + side * reach)) for side in (-1.0, 1.0)
        ]
    lower = _floor(layout, holes, 0) - union([*straps, *(region.translate((x, at)) for region in window)])
    stops = [
        rectangle((rim, max(RIM_SHARE * battery.width_mm, STOP_MIN_MM)), (x + end * electronics.stop_mm, at))
        for end in (-1.0, 1.0)
    ]
    floor = _floor(layout, holes, 1)
    cuts, rims = [], []
    for slots in electronics.tie_slots(inside).values():
        cuts += [rectangle(size, (x, y - middle)) for x, y, size in slots]
    for role, seat in electronics.seats(inside).items():
        if role not in electronics.boards:
            continue
        x, y = seat.x_mm, seat.y_mm - middle
        width, length, _ = seat.size_mm
        under = _window(width - 2.0 * BOARD_LEDGE_MM, length - 2.0 * BOARD_LEDGE_MM)
        cuts += [window.translate((x, y)) for window in under]
        # at its other end the plate keeps it
        end, inwards = length / 2.0 + SEAT_PLAY_MM + rim / 2.0, electronics.inwards(role)
        rims.append(rectangle((RIM_SHARE * width, rim), (x, y + inwards * end)))
    upper = floor - union(cuts)
    low = [(0.0, TRAY_MM, lower), (TRAY_MM, TRAY_MM + STOP_HEIGHT_MM, union(stops) ^ lower)]
    slabs = [(0.0, TRAY_MM, upper), (TRAY_MM, TRAY_MM + RIM_HEIGHT_MM, union(rims) ^ upper)]
    return [
        _drawing(layout, "electronics_tray_lower", low, 0.0),
        _drawing(layout, "electronics_tray_upper", slabs, electronics.upper_tray_mm),
    ]


def _drawing(layout: Layout, name: str, slabs: list[tuple[float, float, Region]], level_mm: float) -> Drawing:
    x, z = layout.tray_mm
    pose = upright(z + level_mm, x, sum(layout.lateral.inside) / 2.0)
    return Drawing(name, "body", Stack.of(slabs), (Placement(BODY, pose),))


def _floor(layout: Layout, holes: HoleSizes, level: int) -> Region:
    """Return a tray's floor with its tabs, about the middle between the plates."""
    low, high = layout.lateral.inside
    middle = (low + high) / 2.0
    width = high - low - 2.0 * holes.fits.sliding_mm
    floor = rectangle((layout.electronics.length_mm, width), corner_radius_mm=CORNER_MM)
    tabs = []
    for side, face in (("left", layout.lateral.outside[1]), ("right", layout.lateral.outside[0])):
        reach = face - middle
        for x, _ in tray_slots(layout, side)[level]:  # type: ignore[arg-type]
            tabs.append(rectangle((TAB_MM, abs(reach)), (x - layout.tray_mm[0], reach / 2.0)))
    return union([floor, *tabs])


def _window(length_mm: float, width_mm: float) -> list[Region]:
    if min(length_mm, width_mm) < WINDOW_MIN_MM:
        return []
    return [rectangle((length_mm, width_mm), corner_radius_mm=WINDOW_MIN_MM / 2.0)]


def electronics(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield battery, boards, plug and capacitor on their seats, what holds them, and the small parts in the wires."""
    electronics, inside = layout.electronics, layout.lateral.inside
    x, z = layout.tray_mm
    items: dict[str, Battery | Board | Component] = {"battery": electronics.battery}
    items |= {**electronics.boards, **electronics.tied}
    for role, seat in electronics.seats(inside).items():
        item, (length, width, height) = items[role], seat.size_mm
        at, top = (x + seat.x_mm, seat.y_mm), z + seat.bottom_mm + height
        yield placed_box(role, item.description, *at, z + seat.bottom_mm, length, width, height, item.mass_g)
        if role == "battery":
            yield placed_box("strap_battery", STRAP, *at, top, STRAP_MM[0], width, STRAP_MM[1], STRAP_G)
            if electronics.balanced:
                ahead, above = at[0] + electronics.balance_mm, z + seat.bottom_mm + BALANCE_HEIGHT_MM
                yield placed_box("tie_balance_lead", TIE, ahead, at[1], above, TIE_MM[0], BALANCE_MM, TIE_MM[1], TIE_G)
        elif role in electronics.boards:
            yield placed_box(f"tie_{role}", TIE, *at, top, length, TIE_MM[0], TIE_MM[1], TIE_G)
            mass = TAPE_G_CM3 * length * width * TAPE_MM / 1000.0
            yield placed_box(f"tape_{role}", TAPE, *at, z + seat.bottom_mm - TAPE_MM, length, width, TAPE_MM, mass)
        else:
            yield placed_box(f"tie_{role}", TIE, *at, top, TIE_MM[0], width, TIE_MM[1], TIE_G)
    yield from _switch(layout, workshop.catalogue)
    wiring = wiring_of(electronics, workshop.bought.pins, workshop.steering.wheel != "none")
    placed = {*items, "sensor" if layout.sensor else "", "switch" if layout.fittings.switch_mm is not None else ""}
    found = list(_soldered(layout, wiring, placed))
    small = [name for name, *_ in found if name.startswith(SMALL)]
    # along the row of pads beside them, so that their legs do not cross
    inwards, row = electronics.inwards("controller"), _along_the_row(electronics, wiring)
    seats = sorted(electronics.small_seats(inside)[: len(small)], key=lambda seat: inwards * seat.y_mm)
    at_seat = dict(zip(sorted(small, key=lambda name: row.get(name, 0)), seats, strict=False))
    soldered = []
    for name, article, mass_g in found:
        if name in at_seat:
            seat = at_seat[name]
            yield placed_box(
                f"wiring_{name}", article, x + seat.x_mm, seat.y_mm, z + seat.bottom_mm, *seat.size_mm, mass_g
            )
        else:
            soldered.append((name, article, mass_g))
    # Wire is everywhere: flat in the gap above the battery its mass is about right.
    size = electronics.battery.length_mm / max(1, len(soldered))
    above = z + electronics.upper_tray_mm - 0.5
    for number, (name, article, mass_g) in enumerate(soldered):
        at = x - electronics.battery.length_mm / 2.0 + (number + 0.5) * size
        yield placed_box(f"wiring_{name}", article, at, sum(inside) / 2.0, above, 0.8 * size,
                   electronics.battery.width_mm / 2.0, 0.4, mass_g)  # fmt: skip
    for role, place, y in (
        ("sensor", layout.fittings.left_mm, layout.lateral.outside[1]),
        ("motor", layout.fittings.right_mm, layout.lateral.outside[0] - TIE_MM[1]),
    ):
        slabs = [(0.0, TIE_MM[1], box_outline(RELIEF_APART_MM, TIE_MM[0]))]
        at_mm = (place[0], y, place[1] - HOLE_HALF_MM[1] + HOLE_MM + RELIEF_UP_MM)
        yield bought(f"tie_{role}_leads", TIE, BODY, TIE_G, slabs, at_mm)


def _along_the_row(electronics: Electronics, wiring: Wiring) -> dict[str, int]:
    """Return the place of each small part's pad in the controller's row that faces them, USB first."""
    board = electronics.controller
    row = board.left if electronics.inwards("controller") > 0.0 else board.right
    return {
        "_".join(reversed(part.part.replace("-", "_").split())): row.index(pad.pin)
        for net in wiring.nets
        for part in net.terminals
        for pad in net.terminals
        if part.part.endswith(SMALL) and pad.part == "controller" and pad.pin in row
    }


def _soldered(layout: Layout, wiring: Wiring, placed: set[str]) -> Iterator[tuple[str, str, float]]:
    """Yield name, article and mass (g) of what has no seat: wire by its colour, and what is soldered into it."""
    for role, part in layout.electronics.components.items():
        if role == "wire":
            per_m = 1000.0 * part.mass_g / (part.length_mm or WIRE_LENGTH_MM)
            for colour, metres in metres_by_colour(layout, wiring).items():
                article = f"{part.description}, {colour}, {math.ceil(10.0 * metres - 1e-6) / 10.0:g} m"
                yield f"wire_{colour}", article, per_m * metres
            yield "heat_shrink", HEAT_SHRINK, HEAT_SHRINK_G
        elif role not in placed and (role != "diode" or layout.electronics.regulator is not None):
            yield role, part.description, part.mass_g
    for name, ohm in wiring.resistors.items():
        which = name.removesuffix(" resistor").replace("-", "_")
        yield f"resistor_{which}", f"resistor {ohm / 1000:g} kOhm 0.25 W, 1 %", RESISTOR_G


def _switch(layout: Layout, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield the switch behind the right plate, the screws through its ears and their nuts."""
    place, switch, low = layout.fittings.switch_mm, layout.fittings.switch, layout.lateral.inside[0]
    if place is None or switch is None:
        return
    long, width, high = switch.length_mm or 0.0, switch.width_mm or 0.0, switch.height_mm or 1.0
    body = (SWITCH_EAR_MM, high, box_outline(SWITCH_BODY_MM, width))
    slabs = [(0.0, SWITCH_EAR_MM, box_outline(long, width)), body]
    yield bought("switch", switch.description, BODY, switch.mass_g, slabs, (place[0], low, place[1]))
    screw, nut, outer = catalogue.screws["M2"], catalogue.nuts["M2"], layout.lateral.outside[0]
    length = screw.length_for(low - outer + SWITCH_EAR_MM + nut.height_mm)
    slabs = [(0.0, nut.height_mm, hexagon(nut.across_flats_mm) - hole(screw.diameter_mm))]
    for number, sign in enumerate((-1.0, 1.0), start=1):
        at = np.array([place[0] + sign * SWITCH_SCREWS_MM, place[1]])
        yield placed_screw(f"switch_screw_{number}", BODY, at, (outer, outer + length), -1.0, screw, catalogue)
        ear = (at[0], low + SWITCH_EAR_MM, at[1])
        yield bought(f"switch_nut_{number}", "nut M2 ISO 4032", BODY, nut.mass_g, slabs, ear, math.pi / 6.0)


SUPPLIED, HELD = Check(limits.electronics_findings, limits.BASIS), Check(limits.holding_findings, limits.HOLDING_BASIS)
LEADS = Check(limits.lead_findings, limits.LEADS_BASIS, cheap=False)
ELECTRONICS = Thing(trays, electronics, (SUPPLIED, HELD, LEADS))
