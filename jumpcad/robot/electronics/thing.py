"""The electronics' trays between the plates: the battery's below, that of the boards above it (mm).

Both print as they stand on the robot. The battery lies between two stops. Boards lie on foam tape between a plate and a
rim, each under a cable tie.
"""

from jumpcad.dimensions import STRAP_SLOT_MM, TAB_MM, TIE_SLOT_MM, TRAY_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, upright
from jumpcad.robot.electronics import limits
from jumpcad.robot.electronics.place import BALANCE_MM, RIM_HEIGHT_MM, SEAT_PLAY_MM, STOP_HEIGHT_MM
from jumpcad.robot.electronics.wired import electronics
from jumpcad.robot.layout import Layout
from jumpcad.robot.plates.outline import tray_slots
from jumpcad.robot.robot import Check, Thing
from jumpcad.solids.outline import Region, rectangle, union
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


SUPPLIED, HELD = Check(limits.electronics_findings, limits.BASIS), Check(limits.holding_findings, limits.HOLDING_BASIS)
LEADS = Check(limits.lead_findings, limits.LEADS_BASIS, cheap=False)
ELECTRONICS = Thing(trays, electronics, (SUPPLIED, HELD, LEADS))
