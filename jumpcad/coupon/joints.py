"""The coupon's joints: one of each kind in a robot, each with several fits (mm).

The offsets are engraved as in the gauge: per side, or a hole's diameter for screws. Dog, socket and trays have the
offsets of a running fit.
"""

import math
from collections.abc import Sequence

import numpy as np

from jumpcad.catalogue import Bearing, Motor
from jumpcad.coupon.pieces import (
    FACE_MM,
    GAUGE_MM,
    LABEL_GAP_MM,
    LETTERS_MM,
    MARGIN_MM,
    STEP_MM,
    centred,
    engraved,
    engraving,
)
from jumpcad.dimensions import AXLE_FLOOR_MM, SOCKET_WALL_MM, TAB_MM, TRAY_MM
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Piece
from jumpcad.robot.foot.toes import lying_hole
from jumpcad.robot.train.drawing import ribbed_d_bore, sectors
from jumpcad.solids.blocks import Bar, Blocks
from jumpcad.solids.outline import Region, disc, hole, polygon, rectangle, ring, union
from jumpcad.solids.stack import Stack
from jumpcad.strength.bearings import hub_bearings
from jumpcad.workshop import Fits, Workshop

THREE = (-1, 0, 1)
"""A workshop's fit, and a step below and above it."""
TAP_STEP_MM, TAP_MM = 0.1, 8.0
"""Difference of diameter between holes for a self-tapping screw, and their depth: that of an M2 x 8."""
SOCKET_MM = 6.0
"""Height of the socket's rings."""
JAW_DEG, JAW_PLAY_DEG = 40.0, 15.0
"""Angle of each of the dog's two jaws, and its free play; judgement: within those of robots."""
DOG_OUTER_MM, DOG_INNER_MM, DOG_RIM_MM = 14.0, 8.0, 2.0
"""Outside and inside of the jaws, and the wall around their pockets; judgement: as in robots."""
LYING_MM = 10.0
"""Height of the bar with lying holes (axis parallel to the bed), and their distance."""


def joint_pieces(workshop: Workshop, holes: HoleSizes) -> list[Piece]:
    """Return the pieces of a workshop's joints, each in the material of the robot's parts with this joint."""
    links, body, gears = (workshop.material_name(role) for role in ("links", "body", "gears"))
    motor, fits = _motor(workshop), holes.fits
    sliding, ribs, taps = steps_mm(fits.sliding_mm), rib_steps_mm(fits), steps_mm(fits.m2_tap_mm, TAP_STEP_MM)
    labels = [engraved(step) for step in sliding]
    bores = [ribbed_d_bore(motor.shaft_mm, motor.shaft_flat_mm, holes, rib_mm=step) for step in ribs]
    sockets = [rectangle((motor.width_mm + 2.0 * step, motor.height_mm + 2.0 * step)) for step in sliding]
    slots = [rectangle((TAB_MM + 2.0 * step, TRAY_MM + 2.0 * step)) for step in sliding]
    made = [
        Piece("taps", body, holes.chamfered(_row(list(map(hole, taps)), [f"{size:.1f}" for size in taps], TAP_MM))),
        Piece("shaft_bores", gears, holes.chamfered(_row(bores, [engraved(step) for step in ribs], FACE_MM))),
        Piece("dog_jaws", gears, holes.chamfered(_jaws(holes))),
        *(Piece(f"dog_pockets_{_number(step)}", gears, holes.chamfered(_pockets(holes, step))) for step in sliding),
        Piece("motor_sockets", body, holes.chamfered(_row(sockets, labels, SOCKET_MM))),
        Piece("tray_slots", body, holes.chamfered(_row(slots, labels, GAUGE_MM))),
        Piece("tray_tab", body, Stack.of([(0.0, TRAY_MM, rectangle((TAB_MM, 3.0 * TAB_MM)))])),
        Piece("lying_holes", links, _lying(holes, steps_mm(fits.lying_mm))),
        Piece("axle_floor", body, holes.chamfered(_floor(holes))),
    ]
    return made + [Piece("seat", links, holes.chamfered(_seats(bearing, holes))) for bearing in seats(workshop)]


def seats(workshop: Workshop) -> list[Bearing]:
    """Return the second lightest bearing of the workshop's hubs, if any; the gauge has the lightest."""
    return [bearing for bearing in hub_bearings(workshop)[1:2] if bearing is not None]


def steps_mm(fit_mm: float, step_mm: float = STEP_MM) -> tuple[float, ...]:
    """Return a fit, and the offsets one step below and above it."""
    return tuple(round(fit_mm + number * step_mm, 3) for number in THREE)


def rib_steps_mm(fits: Fits) -> tuple[float, ...]:
    """Return the overlaps of ribs and shaft in the three bores; none is negative.

    Where the bore itself is smaller than the shaft, the first has ribs that just vanish in it.
    """
    return steps_mm(max(fits.rib_mm, STEP_MM, STEP_MM - fits.press_mm))


def _motor(workshop: Workshop) -> Motor:
    """Return the motor for which bores and sockets are made: the first that the workshop allows."""
    motors = workshop.catalogue.motors
    return motors[next(iter(workshop.bought.motors or motors))]


def _number(step_mm: float) -> str:
    return f"{round(100.0 * step_mm):02d}".replace("-", "m")


def _row(cuts: Sequence[Region], labels: Sequence[str], height_mm: float) -> Stack:
    """Return a plate with openings side by side, each with its label engraved in front of it (towards -y)."""
    sizes = [np.array(cut.bounds()) for cut in cuts]
    across = max(size[2] - size[0] for size in sizes) + 2.0 * MARGIN_MM
    across = max(across, 4.0 * LETTERS_MM)
    deep = max(size[3] - size[1] for size in sizes)
    front = -deep / 2.0 - LABEL_GAP_MM - LETTERS_MM - MARGIN_MM
    back = deep / 2.0 + MARGIN_MM
    plate = rectangle((across * len(cuts), back - front), (across * (len(cuts) - 1) / 2.0, (back + front) / 2.0), 2.0)
    moved, letters = [], []
    for number, (cut, label, size) in enumerate(zip(cuts, labels, sizes, strict=True)):
        middle = ((size[0] + size[2]) / 2.0, (size[1] + size[3]) / 2.0)
        moved.append(cut.translate((number * across - middle[0], -middle[1])))
        letters.append(centred(label, LETTERS_MM).translate((number * across, front + MARGIN_MM)))
    return Stack.of([(0.0, height_mm, plate - union(moved))]).minus([engraving(height_mm, union(letters))])


def _seats(bearing: Bearing, holes: HoleSizes) -> Stack:
    steps = steps_mm(holes.fits.press_mm)
    cuts = [hole(bearing.outer_mm + 2.0 * step) for step in steps]
    return _row(cuts, [engraved(step) for step in steps], max(GAUGE_MM, bearing.width_mm))


def _floor(holes: HoleSizes) -> Stack:
    """Return a disc with a blind bore for the axle, whose floor is as thick as in a plate."""
    around = disc(holes.axle_mm + 4.0 * SOCKET_WALL_MM)
    bore = hole(holes.running(holes.axle_mm))
    return Stack.of([(0.0, AXLE_FLOOR_MM, around), (AXLE_FLOOR_MM, FACE_MM, around - bore)])


def _jaws(holes: HoleSizes) -> Stack:
    """Return a disc with two jaws on it."""
    bore = hole(holes.running(holes.axle_mm))
    base = disc(DOG_OUTER_MM + 2.0 * DOG_RIM_MM) - bore
    jaws = ring(DOG_OUTER_MM, DOG_INNER_MM) ^ _sectors(JAW_DEG)
    return Stack.of([(0.0, DOG_RIM_MM, base), (DOG_RIM_MM, DOG_RIM_MM + FACE_MM, jaws)])


def _pockets(holes: HoleSizes, step_mm: float) -> Stack:
    """Return a disc with the jaws' pockets, a step wider per side."""
    bore = hole(holes.running(holes.axle_mm))
    around = hole(DOG_OUTER_MM + 2.0 * step_mm) - disc(DOG_INNER_MM - 2.0 * step_mm)
    disc_region = disc(DOG_OUTER_MM + 2.0 * (MARGIN_MM + LETTERS_MM + DOG_RIM_MM)) - bore
    region = disc_region - (around ^ _sectors(JAW_DEG + JAW_PLAY_DEG))
    label = centred(engraved(step_mm), LETTERS_MM).translate((0.0, -DOG_OUTER_MM / 2.0 - MARGIN_MM - LETTERS_MM))
    return Stack.of([(0.0, FACE_MM, region)]).minus([engraving(FACE_MM, label)])


def _sectors(angle_deg: float) -> Region:
    """Return two opposite sectors of an angle about the x axis."""
    half = math.radians(angle_deg) / 2.0
    return sectors([(middle - half, middle + half) for middle in (0.0, math.pi)], 2.0 * DOG_OUTER_MM)


def _lying(holes: HoleSizes, steps: Sequence[float]) -> Blocks:
    """Return a bar with lying holes that get larger towards its cut corner."""
    length = LYING_MM * (len(steps) + 0.5)
    corner = 0.3 * LYING_MM
    outline = polygon(
        [(0.0, 0.0), (length, 0.0), (length, LYING_MM - corner), (length - corner, LYING_MM), (0.0, LYING_MM)]
    )
    places = [(LYING_MM * (number + 0.6), LYING_MM / 2.0) for number in range(len(steps))]
    cut = union(lying_hole(holes.axle_mm + 2.0 * step, place) for step, place in zip(steps, places, strict=True))
    return Blocks((Bar(outline - cut, ((0.0, LYING_MM / 2.0),)),), ())
