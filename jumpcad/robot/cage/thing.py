"""The cage's printed cross bars, its rods and ties, and the horns of the body plates that carry the bars (mm).

A bar prints flat in its hoop's plane, so that its layers lie in the plane in which the rod bends it. Bar and horn cross
in a lap joint: the bar's notch is open downwards, the horn's upwards, and a cable tie holds both together.
"""

import itertools
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import TIE_SLOT_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement
from jumpcad.parts.purchased import TIE, TIE_G, TIE_MM, BoughtPart
from jumpcad.robot.cage.limits import BASIS, cage_findings
from jumpcad.robot.cage.place import (
    BAR_MM,
    END_MM,
    HORN_BELOW_MM,
    HORN_MM,
    HORN_SIZE_MM,
    LAP_HEIGHT_MM,
    LAP_MM,
    LAP_WALL_MM,
    SOCKET_MM,
    SWAY_MM,
    Cage,
    CageArc,
    CageBar,
    cage_place,
    horn_mm,
    plate_ends_mm,
)
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Check, Thing
from jumpcad.solids.outline import Region, disc, hull, polygon, rectangle, stadium, strips, union
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array, chained, in_metres, pose_at
from jumpcad.workshop import Workshop

SEAT_MM = LAP_MM - LAP_HEIGHT_MM / 2.0
"""Height of the lap joint's seat over the bar's middle: its notch is as deep as the horn's."""
TIE_LEFT = 0.5
"""Of a tie once its end is cut off; judgement."""
SLOT_BELOW_MM = 4.5
"""From the seat down to the middle of the tie's slot in the horn, below the bar."""


def cage_bars(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    cage, holes = layout.of(Cage), HoleSizes.of(workshop, layout.hub_bearing)
    if cage is None:
        return
    for bar in cage.bars:
        shape = holes.chamfered(_bar(cage, bar, layout, holes))
        pose = chained(bar.T_body_bar, pose_at(np.eye(3), (0.0, 0.0, -BAR_MM / 2.0)))
        yield Drawing(bar.name, "links", shape, (Placement(BODY, pose),))


def _bar(cage: Cage, bar: CageBar, layout: Layout, holes: HoleSizes) -> Stack:
    """Return a bar in printing orientation: its frame is that of the bar, on the bed."""
    height, width = cage.bar_mm, cage.socket_mm
    bore = cage.rod.diameter_mm + 2.0 * holes.fits.lying_mm
    whole = [stadium((-bar.half_mm, 0.0), (bar.half_mm, 0.0), height)]
    sockets, bores = [], []
    for side in (-1.0, 1.0):
        out = np.array([side * np.cos(bar.tilt_rad), np.sin(bar.tilt_rad)])
        middle = np.array([side * bar.half_mm, 0.0])
        floor, mouth = middle - SOCKET_MM / 2.0 * out, middle + SOCKET_MM / 2.0 * out
        corner = mouth + width / 2.0 * np.array([side * np.sin(bar.tilt_rad), -np.cos(bar.tilt_rad)])
        tip = disc(2.0 * END_MM, corner)
        sockets.append(hull([disc(width, floor), strips(floor, mouth, width), tip]))
        bores.append(strips(floor, mouth + 2.0 * END_MM * out, bore))
    if bar.post_mm:
        top, floor = np.array([0.0, bar.post_mm]), np.array([0.0, bar.post_mm - SOCKET_MM])
        sockets.append(hull([disc(width, floor), strips(floor, top, width)]))
        bores.append(strips(floor, np.array([0.0, bar.post_mm + 1.0]), bore))
        whole.append(strips((0.0, 0.0), top, width))
    play = 2.0 * holes.fits.press_mm
    notches: list[list[Region]] = [[], [], []]
    for low, high in (layout.lateral.left_plate, layout.lateral.right_plate):
        x, thickness = (low + high) / 2.0 - float(bar.T_body_bar[1, 3]), high - low
        whole.append(rectangle((thickness + 2.0 * LAP_WALL_MM, max(height, LAP_HEIGHT_MM)), (x, 0.0), 1.0))
        for wider, found in enumerate(notches):
            notch = (thickness + play + wider * SWAY_MM, LAP_HEIGHT_MM)
            found.append(rectangle(notch, (x, SEAT_MM - LAP_HEIGHT_MM / 2.0)))
    shape = Stack.of([(0.0, BAR_MM, union([*whole, *sockets])), (BAR_MM, width, union(sockets))])
    level = width / 2.0
    cut = [(level - bore / 2.0, level + bore / 2.0, union(bores))]
    for notch, share in zip(map(union, notches), (1.0, 0.8, 0.4), strict=True):  # narrow in the middle
        deep = share * BAR_MM / 2.0
        cut += [(0.0, deep, notch), (BAR_MM - deep, BAR_MM, notch)]
    return shape.minus(cut)


def horns(layout: Layout, blank: Region | None = None) -> Region:
    """Return what the cage adds to the outline of both body plates: a strip from an axle to each bar, with its end.

    With a blank of the plates it is what is thicker, between that and the ends.
    """
    if (cage := layout.of(Cage)) is None:
        return union([])
    regions = []
    axles, wider = (layout.hub_mm, layout.front_mm), (cage.rear_tip_mm, 0.0)
    for bar, axle, x, more in zip(cage.bars, axles, plate_ends_mm(layout), wider, strict=True):
        end, low, (high, _) = bar.horn_end_mm, HORN_MM[0], horn_mm(layout)
        root = axle + (end - axle) * (x - axle[0]) / (end[0] - axle[0])
        strip = hull([disc(high, root), disc(low, end)])
        size = HORN_SIZE_MM[0] + more, HORN_SIZE_MM[1]
        tip = _leaning(rectangle(size, (more / 2.0, -HORN_BELOW_MM), 2.0), bar)
        regions += [strip - tip - blank] if blank else [strip, stadium(axle, root, high), tip]
    return union(regions)


def horn_openings(layout: Layout, holes: HoleSizes) -> Region:
    """Return the notches of the horns, open upwards, and the slots for their ties below them."""
    width = BAR_MM + 2.0 * holes.fits.press_mm
    notch = rectangle((width, 4.0 * LAP_MM), (0.0, SEAT_MM + 2.0 * LAP_MM))
    slot = rectangle((TIE_SLOT_MM[1], TIE_SLOT_MM[0]), (0.0, SEAT_MM - SLOT_BELOW_MM))
    cage = layout.of(Cage)
    return union(_leaning(cut, bar) for bar in (cage.bars if cage else ()) for cut in (notch, slot))


def _leaning(region: Region, bar: CageBar) -> Region:
    """Return a region of a bar's cross-section (z forwards, y up in its frame) in the body's x-z plane."""
    up, place = bar.up, bar.place_mm
    corners = [np.asarray(contour) for contour in region.to_polygons()]
    forwards = np.array([up[1], -up[0]])
    return polygon(*(place + flat[:, :1] * forwards + flat[:, 1:] * up for flat in corners))


def cage_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the rods, each with the length to cut, and the ties of the bars."""
    cage = layout.of(Cage)
    if cage is None:
        return
    for arc in cage.arcs:
        yield _rod(cage, arc)
    plates = (layout.lateral.left_plate, layout.lateral.right_plate)
    for number, (bar, (low, high)) in enumerate(itertools.product(cage.bars, plates), start=1):
        yield _tie(f"cage_tie_{number}", bar, max(cage.bar_mm, LAP_HEIGHT_MM) / 2.0, (low + high) / 2.0, high - low)


def _rod(cage: Cage, arc: CageArc) -> BoughtPart:
    """Return a rod: as seen, round; the room that it takes is a bent strip as wide and thick as its diameter."""
    rod, line = cage.rod, arc.line_mm
    along = np.gradient(line, axis=0)
    across = (
        rod.diameter_mm / 2.0 * np.column_stack([-along[:, 1], along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    )
    region = polygon(np.vstack([line + across, (line - across)[::-1]]))
    shape = Stack.of([(-rod.diameter_mm / 2.0, rod.diameter_mm / 2.0, region)])
    mass = shape.mass_properties(1.0).scaled_to(rod.mass_g(arc.length_mm) / 1000.0)
    article = f"{rod.description}, cut {arc.length_mm:.0f} mm long"
    placed = mass.placed(in_metres(arc.T_body_arc))
    part = BoughtPart(arc.name, article, BODY, shape, arc.T_body_arc, placed)
    return part.seen_as(DrawnWire(arc.points_mm, rod.diameter_mm))


def _tie(name: str, bar: CageBar, top: float, y_mm: float, plate_mm: float) -> BoughtPart:
    """Return the tie around a crossing: through the horn's slot, up before the bar, over it and down behind."""
    thick = TIE_MM[1]
    shape = Stack.of([(-BAR_MM / 2.0, BAR_MM / 2.0, rectangle((plate_mm, thick), (0.0, top + thick / 2.0)))])
    pose = chained(bar.T_body_bar, pose_at(np.eye(3), (y_mm - bar.T_body_bar[1, 3], 0.0, 0.0)))
    mass = shape.mass_properties(1.0).scaled_to(TIE_LEFT * TIE_G / 1000.0).placed(in_metres(pose))
    part = BoughtPart(name, TIE, BODY, shape, pose, mass)
    x, z, below = plate_mm / 2.0 + thick, BAR_MM / 2.0 + thick, SEAT_MM - SLOT_BELOW_MM
    half: Array = np.array(
        [(0.0, below, 0.0), (x, below, 0.4), (x, below + 1.5, z), (x, top, z), (0.0, top + 1.0, 0.0)]
    )
    loop = np.vstack([half, half[-2::-1] * (-1.0, 1.0, -1.0)])
    return part.seen_as(DrawnWire(loop @ pose[:3, :3].T + pose[:3, 3], thick))


CAGE = Thing(cage_bars, cage_hardware, (Check(cage_findings, BASIS),), cage_place)
