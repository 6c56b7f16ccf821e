"""The two body plates: bores, sockets, bosses, and the robot's name engraved (mm).

Drawn in the body frame and printed outside down, so that the motor's socket stands on the inside of the right one.
"""

import itertools

from jumpcad.dimensions import MOTOR_CLAMP_MM, TAB_MM, TRAY_MM
from jumpcad.drive.socket import window_mm
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Face, Placement, lying_stack
from jumpcad.robot.cage.drawing import horn_openings, horns
from jumpcad.robot.cage.place import HORN_MORE_MM, Cage
from jumpcad.robot.electronics.fittings import fitting_openings
from jumpcad.robot.layout import Layout
from jumpcad.robot.plates.engraving import ENGRAVING_MM, letters_on
from jumpcad.robot.plates.outline import blank_of, outline, pin_hole, tray_slots
from jumpcad.robot.sensor.drawing import plate_opening, plate_pad
from jumpcad.robot.steering.drawing import tail_slot
from jumpcad.robot.steering.place import Steering
from jumpcad.robot.stop.drawing import stop_slot
from jumpcad.robot.train.motor_socket import ear_places, motor_box, socket_outline
from jumpcad.solids.outline import Region, hole, rectangle, ring, union
from jumpcad.solids.text import engravable
from jumpcad.workshop import Workshop


def plates(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return the left plate, at the side of the gears, and the right one with the socket that holds the motor.

    The socket has a floor at the motor's rear end, open in the middle for terminals and wires, and ends a little below
    the motor's front: the cap clamps the motor between the floor and itself. What closes the bores outside, and bosses,
    have no thickness in a robot without them.

    Without a label nothing is engraved; letters that the engraving's font lacks are left out.
    """
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    label = engravable(layout.label).strip()
    motor, lateral = layout.drive.train.motor, layout.lateral
    floor = layout.floor_mm
    blank, pins = blank_of(layout, holes.fits.wall_min_mm), (*layout.axles.values(), layout.spring_pin_mm)
    bores = union(hole(holes.running(layout.axle_mm), place) for place in pins)
    whole, through = outline(layout, blank, "left"), _openings(layout, holes, "left")
    y0, y1 = lateral.left_plate
    shaft = hole(holes.loose(motor.shaft_mm), layout.motor_mm)
    covered = union([])
    if layout.sensor is not None:
        shaft, covered = shaft + plate_opening(layout.sensor, holes), plate_pad(layout.sensor)
    slabs = [(y0, y1 - floor, whole - union([through, shaft, bores])), (y1 - floor, y1, whole - (through + shaft))]
    slabs.append(_boss(layout, holes, y0 - layout.boss_mm, y0))
    thicker = horns(layout, blank.hull) if layout.of(Cage) else None
    slabs += [(y0 - HORN_MORE_MM, y0, thicker)] if thicker else []
    words = layout.label and f"{label} L".strip()
    left = _drawing("body_plate_left", holes, slabs, (y1 - ENGRAVING_MM, y1), words, "left", covered)
    y0, y1 = lateral.right_plate
    whole, through = outline(layout, blank, "right"), _openings(layout, holes, "right")
    play = 2.0 * holes.fits.sliding_mm
    cavity = motor_box(layout, motor.width_mm + play, motor.height_mm + play)
    window = motor_box(layout, *window_mm(motor))
    taps = union(hole(holes.fits.m2_tap_mm, place) for place in ear_places(layout))
    around = socket_outline(layout) - taps
    seat, rim = lateral.motor[0], lateral.motor[1] - MOTOR_CLAMP_MM
    slabs = [(y0 + floor, y1, whole - union([through, window, bores])), (y0, y0 + floor, whole - (through + window))]
    bosses = [_boss(layout, holes, y1, y1 + layout.boss_mm), _spring_boss(layout, holes, y1, cavity + taps)]
    levels = sorted({y1, seat, rim, *(top for _, top, _ in bosses)})
    for low, high in itertools.pairwise(levels):
        socket = around - (window if high <= seat else cavity)
        slabs.append((low, high, union([socket, *(region for _, top, region in bosses if top >= high)])))
    slabs += [(y1, y1 + HORN_MORE_MM, thicker)] if thicker else []
    right = _drawing(
        "body_plate_right", holes, slabs, (y0, y0 + ENGRAVING_MM), layout.label and f"{label} R".strip(), "right"
    )
    return [left, right]


def _openings(layout: Layout, holes: HoleSizes, side: Face) -> Region:
    """Return the holes that pass a plate: standoff screws, tray and stop slots, the leg's pin, people and wires."""
    play = 2.0 * holes.fits.sliding_mm
    cut = [hole(holes.m3_clearance_mm, place) for place in layout.standoffs_mm]
    size = (TAB_MM + play, TRAY_MM + play)
    cut += [rectangle(size, slot) for level in tray_slots(layout, side) for slot in level]
    cut += fitting_openings(layout.fittings, holes, side)
    cut.append(stop_slot(layout, 2.0 * holes.fits.press_mm))
    cut += [pin_hole(layout, layout.pin_hole.diameter_mm)] if side == "left" else []
    cut += [horn_openings(layout, holes)] if layout.of(Cage) else []
    cut += [tail_slot(layout, play)] if layout.of(Steering) else []
    return union(cut)


def _boss(layout: Layout, holes: HoleSizes, y0: float, y1: float) -> tuple[float, float, Region]:
    """Return the longer seat of the leg's axle, inside."""
    return y0, y1, ring(layout.spring_bore_room_mm, holes.running(layout.axle_mm), layout.hub_mm)


def _spring_boss(layout: Layout, holes: HoleSizes, y0: float, socket: Region) -> tuple[float, float, Region]:
    """Return the right plate's boss in which the springs' pin stands, inside, beside a socket."""
    region = ring(layout.spring_boss_outer_mm, holes.running(layout.axle_mm), tuple(layout.spring_pin_mm))
    return y0, y0 + layout.spring_boss_mm, region - socket


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
    stack, pose = lying_stack(slabs, face)
    if label:
        bare = slabs[0][2] if covered is None else slabs[0][2] - covered
        letters = letters_on(label, bare, mirrored=face == "left")
        if letters is not None:
            cut, _ = lying_stack([(*engraved_y, letters)], face)
            stack = stack.minus(cut)
    return Drawing(name, "body", holes.chamfered(stack), (Placement(BODY, pose),))
