"""The two body plates: outlines around what they carry, pockets in between, the robot's name engraved (mm).

Drawn in the body frame and printed outside down, so that the motor's socket stands on the inside of the right one.
"""

import itertools
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from manifold3d import JoinType
from scipy.spatial import Delaunay

from jumpcad.dimensions import (
    CAP_EAR_MM,
    MOTOR_CLAMP_MM,
    PAD_WALL_MM,
    SOCKET_WALL_MM,
    STANDOFF_PAD_MM,
    STOP_EDGE_MM,
    TAB_MM,
    TRAY_MM,
)
from jumpcad.drive.socket import window_mm
from jumpcad.layout.layout import Layout
from jumpcad.layout.stop import EAR_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.engraving import ENGRAVING_MM, letters_on
from jumpcad.parts.fittings import fitting_openings, fitting_pads
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Face, Placement, laid
from jumpcad.parts.sensor import plate_opening, plate_pad
from jumpcad.parts.stop import stop_slot
from jumpcad.solids.outline import (
    SAGITTA_MM,
    Region,
    boxes_apart,
    disc,
    filleted,
    grown,
    hole,
    hull,
    middle_of,
    rectangle,
    ring,
    rounded,
    stadium,
    strips,
    union,
)
from jumpcad.solids.text import engravable

RIB_MM = 3.2
EDGE_MM = 3.2
POCKET_RADIUS_MM = 1.5


def plates(layout: Layout, holes: HoleSizes, name: str) -> list[Drawing]:
    """Return the left plate, at the side of the gears, and the right one with the socket that holds the motor.

    The socket has a floor at the motor's rear end, open in the middle for terminals and wires, and ends a little below
    the motor's front: the cap clamps the motor between the floor and itself.

    Without a name nothing is engraved; letters that the engraving's font lacks are left out.
    """
    label = engravable(name).strip() if name else ""
    motor, lateral = layout.drive.train.motor, layout.lateral
    floor = layout.floor_mm
    covers, bores = _covers(layout, holes.fits.wall_min_mm), _bores(layout, holes)
    closed = _outline(layout, covers, "left") - _openings(layout, holes, "left")
    common = closed - bores
    y0, y1 = lateral.left_plate
    shaft = hole(holes.loose(motor.shaft_mm), layout.motor_mm)
    covered = union([])
    if layout.sensor is not None:
        shaft, covered = shaft + plate_opening(layout.sensor, holes), plate_pad(layout.sensor)
    slabs = [(y0, y1 - floor, common - shaft), *_floor(y1 - floor, y1, closed - shaft)]
    slabs += _boss(layout, holes, y0 - layout.boss_mm, y0)
    words = name and f"{label} L".strip()
    left = _drawing("body_plate_left", holes, slabs, (y1 - ENGRAVING_MM, y1), words, "left", covered)
    y0, y1 = lateral.right_plate
    closed = _outline(layout, covers, "right") - _openings(layout, holes, "right")
    common = closed - bores
    play = 2.0 * holes.fits.sliding_mm
    cavity = _motor_box(layout, motor.width_mm + play, motor.height_mm + play)
    window = _motor_box(layout, *window_mm(motor))
    taps = union(hole(holes.fits.m2_tap_mm, place) for place in ear_places(layout))
    around = socket_outline(layout) - taps
    seat, rim = lateral.motor[0], lateral.motor[1] - MOTOR_CLAMP_MM
    slabs = [(y0 + floor, y1, common - window), *_floor(y0, y0 + floor, closed - window)]
    bosses = _boss(layout, holes, y1, y1 + layout.boss_mm) + _spring_boss(layout, holes, y1, cavity + taps)
    levels = sorted({y1, seat, rim, *(top for _, top, _ in bosses)})
    for low, high in itertools.pairwise(levels):
        socket = around - (window if high <= seat else cavity)
        slabs.append((low, high, union([socket, *(region for _, top, region in bosses if top >= high)])))
    right = _drawing("body_plate_right", holes, slabs, (y0, y0 + ENGRAVING_MM), name and f"{label} R".strip(), "right")
    return [left, right]


def ear_places(layout: Layout) -> list[np.ndarray]:
    """Return the two screws (2,) that hold the motor's cap on its socket."""
    across = np.array([-np.sin(layout.motor_angle_rad), np.cos(layout.motor_angle_rad)])
    reach = ear_reach_mm(layout.drive.train.motor.height_mm)
    return [layout.motor_mm + sign * reach * across for sign in (-1.0, 1.0)]


def ear_reach_mm(height_mm: float) -> float:
    """Return how far the cap's screws are from the axis of a motor of some height across."""
    return height_mm / 2.0 + SOCKET_WALL_MM + CAP_EAR_MM / 2.0


def socket_outline(layout: Layout) -> Region:
    """Return the outside of the motor's socket, which its cap shares."""
    motor = layout.drive.train.motor
    turn = float(np.degrees(layout.motor_angle_rad))
    return socket_about_axis(motor.width_mm, motor.height_mm).rotate(turn).translate(tuple(layout.motor_mm))


@lru_cache(maxsize=32)
def socket_about_axis(width_mm: float, height_mm: float) -> Region:
    """Return the outside of the socket for a motor of some width and height about its axis, ears along y."""
    wall = 2.0 * (SOCKET_WALL_MM + 0.2)
    ears = hull(disc(CAP_EAR_MM, (0.0, sign * ear_reach_mm(height_mm))) for sign in (-1.0, 1.0))
    return filleted(rectangle((width_mm + wall, height_mm + wall)) + ears, 1.0)


def tray_slots(layout: Layout, side: Face) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Return the middles (x, z) of a plate's slots for the tabs of the lower and of the upper tray.

    Where the right plate has the opening for a USB plug, above the upper tray's back end, it has no slot.
    """
    middle, reach = layout.tray_mm, layout.electronics.length_mm / 2.0 - TAB_MM / 2.0 - 1.0
    levels = (TRAY_MM / 2.0, layout.electronics.upper_tray_mm + TRAY_MM / 2.0)
    lower, upper = (
        [(float(middle[0] + sign * reach), float(middle[1] + level)) for sign in (-1.0, 1.0)] for level in levels
    )
    return lower, upper[1:] if side == "right" and layout.fittings.usb_mm is not None else upper


def _motor_box(layout: Layout, width_mm: float, height_mm: float) -> Region:
    turn = float(np.degrees(layout.motor_angle_rad))
    return rectangle((width_mm, height_mm)).rotate(turn).translate(tuple(layout.motor_mm))


def _pads(layout: Layout, more_mm: float = 0.0) -> list[Region]:
    """Return the regions in which the plate needs material, each grown by a margin."""
    more = 2.0 * more_mm
    pads = [disc(layout.axle_mm + 2.0 * PAD_WALL_MM + more, place) for place in layout.axles.values()]
    pads += [disc(STANDOFF_PAD_MM + more, place) for place in layout.standoffs_mm]
    pads.append(disc(8.0 + more, layout.spring_pin_mm))
    slot = (TAB_MM + 5.0 + more, TRAY_MM + 5.0 + more)
    pads += [rectangle(slot, place, 1.0 + more_mm) for level in tray_slots(layout, "left") for place in level]
    pads += fitting_pads(layout.fittings, more_mm)
    pads.append(grown(socket_outline(layout), more_mm))
    pads += [plate_pad(layout.sensor, more_mm)] if layout.sensor is not None else []
    return pads


class _Covers(NamedTuple):
    """What both plates' outlines have in common: the hull of all pads, and its pockets."""

    whole: Region
    pockets: Region


def _covers(layout: Layout, wall_mm: float) -> _Covers:
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
    return _Covers(rounded(around, 2.0), _apart(grown(pockets, POCKET_RADIUS_MM), wall_mm))


def _apart(pockets: Region, wall_mm: float) -> Region:
    """Return pockets set back from each other where less than a wall is between two of them."""
    half = wall_mm / 2.0 + SAGITTA_MM
    wider = grown(pockets, half)
    if wider.num_contour() == pockets.num_contour():
        return pockets
    each = pockets.decompose()
    between = (wider.offset(-half, JoinType.Miter) - pockets).decompose()
    thin = [piece for piece in between if _touched(grown(piece, SAGITTA_MM), each) > 1]
    return pockets - grown(union(thin), wall_mm / 2.0) if thin else pockets


def _touched(piece: Region, regions: Sequence[Region]) -> int:
    """Return how many of some regions a piece overlaps."""
    return sum(not (piece ^ region).is_empty() for region in regions if not boxes_apart(piece, region))


def _outline(layout: Layout, covers: _Covers, side: Face) -> Region:
    """Return a plate's outline, with its pockets.

    Ears below the hull of the pads hold the rest stop; the left one has material around the hole for the leg's pin too.
    """
    axle = layout.axle_mm + 2.0 * PAD_WALL_MM
    base = strips(layout.hub_mm, layout.hub_mm + np.array([EAR_MM, 0.0]), axle)
    around_pin = [_pin_hole(layout, layout.pin_hole.pad_mm)] if side == "left" else []
    slot = rounded(stop_slot(layout, 0.0, STOP_EDGE_MM), 2.0)
    stop = hull([disc(axle, layout.hub_mm), base, slot, *around_pin])
    return covers.whole - (covers.pockets - stop) + stop


def _openings(layout: Layout, holes: HoleSizes, side: Face) -> Region:
    """Return the holes that pass a plate: standoff screws, tray and stop slots, the leg's pin, people and wires."""
    play = 2.0 * holes.fits.sliding_mm
    cut = [hole(holes.m3_clearance_mm, place) for place in layout.standoffs_mm]
    size = (TAB_MM + play, TRAY_MM + play)
    cut += [rectangle(size, slot) for level in tray_slots(layout, side) for slot in level]
    cut += fitting_openings(layout.fittings, holes, side)
    cut.append(stop_slot(layout, 2.0 * holes.fits.press_mm))
    cut += [_pin_hole(layout, layout.pin_hole.diameter_mm)] if side == "left" else []
    return union(cut)


def _pin_hole(layout: Layout, width_mm: float) -> Region:
    """Return the hole through which the leg's pin goes in, or what is around it, of some width."""
    ends = layout.pin_hole
    return stadium(tuple(ends.rest_mm), tuple(ends.stop_mm), width_mm)


def _bores(layout: Layout, holes: HoleSizes) -> Region:
    """Return the plates' bores for the axles and the springs' pin."""
    return union(hole(holes.running(layout.axle_mm), place) for place in (*layout.axles.values(), layout.spring_pin_mm))


def _floor(y0: float, y1: float, region: Region) -> list[tuple[float, float, Region]]:
    """Return the layers that close the bores on the outside, if there are any."""
    return [(y0, y1, region)] if y1 > y0 else []


def _boss(layout: Layout, holes: HoleSizes, y0: float, y1: float) -> list[tuple[float, float, Region]]:
    """Return the longer seat of the leg's axle, inside, if there is one."""
    bore = holes.running(layout.axle_mm)
    return [(y0, y1, ring(layout.spring_bore_room_mm, bore, layout.hub_mm))] if y1 > y0 else []


def _spring_boss(layout: Layout, holes: HoleSizes, y0: float, socket: Region) -> list[tuple[float, float, Region]]:
    """Return the right plate's boss in which the springs' pin stands, inside, if there is one: beside a socket."""
    if layout.spring_boss_mm == 0.0:
        return []
    region = ring(layout.spring_boss_outer_mm, holes.running(layout.axle_mm), tuple(layout.spring_pin_mm))
    return [(y0, y0 + layout.spring_boss_mm, region - socket)]


def _drawing(
    name: str,
    holes: HoleSizes,
    slabs: list[tuple[float, float, Region]],
    engraved_y: tuple[float, float],
    label: str,
    face: Face,
    covered: Region | None = None,
) -> Drawing:
    """Lay a plate outside down and engrave its label where its face, the first slab, has room and nothing covers it."""
    stack, pose = laid(slabs, face)
    if label:
        bare = slabs[0][2] if covered is None else slabs[0][2] - covered
        letters = letters_on(label, bare, mirrored=face == "left")
        if letters is not None:
            cut, _ = laid([(*engraved_y, letters)], face)
            stack = stack.minus(cut)
    return Drawing(name, "body", holes.chamfered(stack), (Placement(BODY, pose),))
