"""The body plates with label and motor socket, the standoffs between them, their seats' strength (mm, g, N, MPa)."""

import itertools
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from numpy.lib.stride_tricks import sliding_window_view

from jumpcad.dimensions import MOTOR_CLAMP_MM, SPRING_BOSS_WALL_MM, TAB_MM, TRAY_MM
from jumpcad.drive.motor import window_mm
from jumpcad.findings import Basis, Finding, at_most, higher
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Face, Placement, lying_stack
from jumpcad.parts.purchased import BoughtPart, bought, hexagon_outline, placed_screw
from jumpcad.robot.cage.place import Cage, horn_mm
from jumpcad.robot.cage.thing import horn_openings, horns
from jumpcad.robot.electronics.fittings import fitting_openings
from jumpcad.robot.layout import Layout
from jumpcad.robot.load_case import IN_PLANE, load_case, stress_finding
from jumpcad.robot.plates.outline import blank_of, outline, pin_hole, tray_slots
from jumpcad.robot.robot import Check, Robot, Thing
from jumpcad.robot.sensor.thing import plate_opening, plate_pad
from jumpcad.robot.steering.drawing import tail_slot
from jumpcad.robot.steering.place import Steering
from jumpcad.robot.stop.thing import stop_slot
from jumpcad.robot.train.thing import ear_places, motor_box, socket_outline
from jumpcad.solids.outline import Region, contained, engravable, hole, middle_of, rectangle, ring, text, union
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
    slabs += [(y0 - horn_mm(layout)[1], y0, thicker)] if thicker else []
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
    boss_mm = layout.axle_mm + 2.0 * SPRING_BOSS_WALL_MM
    around_pin = ring(boss_mm, holes.running(layout.axle_mm), tuple(layout.spring_pin_mm))
    pin_boss = (y1, y1 + layout.spring_boss_mm, around_pin - (cavity + taps))
    bosses = [_boss(layout, holes, y1, y1 + layout.boss_mm), pin_boss]
    levels = sorted({y1, seat, rim, *(top for _, top, _ in bosses)})
    for low, high in itertools.pairwise(levels):
        socket = around - (window if high <= seat else cavity)
        slabs.append((low, high, union([socket, *(region for _, top, region in bosses if top >= high)])))
    slabs += [(y1, y1 + horn_mm(layout)[1], thicker)] if thicker else []
    right = _drawing(
        "body_plate_right", holes, slabs, (y0, y0 + ENGRAVING_MM), layout.label and f"{label} R".strip(), "right"
    )
    return [left, right]


def _openings(layout: Layout, holes: HoleSizes, side: Face) -> Region:
    """Return the holes that pass a plate: standoff screws, tray and stop slots, the leg's pin, people and wires."""
    play = 2.0 * holes.fits.sliding_mm
    cut = [hole(holes.fits.m3_clearance_mm, place) for place in layout.standoffs_mm]
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


def _drawing(
    name: str, holes: HoleSizes, slabs: list[tuple[float, float, Region]], engraved_y: tuple[float, float], label: str,
    face: Face, covered: Region | None = None,
) -> Drawing:  # fmt: skip
    """Lay a plate outside down and engrave its label where its face, the first slab, has room and nothing covers it."""
    stack, pose = lying_stack(slabs, face)
    if label:
        bare = slabs[0][2] if covered is None else slabs[0][2] - covered
        letters = letters_on(label, bare, mirrored=face == "left")
        if letters is not None:
            cut, _ = lying_stack([(*engraved_y, letters)], face)
            stack = stack.minus(cut.slabs)
    return Drawing(name, "body", holes.chamfered(stack), (Placement(BODY, pose),))


ENGRAVING_MM = 0.5
TEXT_HEIGHTS_MM = (4.5, 3.5)
TEXT_EDGE_MM = 0.8
"""Least margin around a label: two printed lines."""
TEXT_STEP_MM = 1.0


def letters_on(label: str, face: Region, mirrored: bool) -> Region | None:
    """Return a plate's label, or its last letter alone, at the place nearest to the pivots' line that has room for it.

    Seen from the left, x points to the left. Where nothing fits there are no letters.
    """
    low_x, low_z, high_x, high_z = face.bounds()
    x, z = np.meshgrid(np.arange(low_x, high_x, TEXT_STEP_MM), np.arange(low_z, high_z, TEXT_STEP_MM))
    places = np.column_stack([x.ravel(), z.ravel()])
    outside = ~contained(face, places).reshape(x.shape)
    order = np.lexsort((np.abs(places[:, 0]), np.abs(places[:, 1])))
    for words, height in itertools.product((label, label[-1]), TEXT_HEIGHTS_MM):
        letters = text(words, height)
        letters = letters.translate(tuple(-middle_of(letters)))
        letters = letters.mirror((1.0, 0.0)) if mirrored else letters
        low_x, low_z, high_x, high_z = letters.bounds()
        size = (high_x - low_x + 2.0 * TEXT_EDGE_MM, high_z - low_z + 2.0 * TEXT_EDGE_MM)
        box, possible = rectangle(size), _possible(outside, size)
        for place in places[order[possible[order]]]:
            if (box.translate(tuple(place)) - face).area() < 1e-6:
                return letters.translate(tuple(place))
    return None


def _possible(outside: npt.NDArray[np.bool_], size_mm: tuple[float, float]) -> npt.NDArray[np.bool_]:
    """Return around which places (n,) of a grid a box covers none that is outside; the box may still cross an edge."""
    reach_x, reach_z = (int((side / 2.0 - 1e-3) / TEXT_STEP_MM) for side in size_mm)
    padded = np.pad(outside, ((reach_z, reach_z), (reach_x, reach_x)), constant_values=True)
    covered = sliding_window_view(padded, (2 * reach_z + 1, 2 * reach_x + 1))
    return ~covered.any(axis=(2, 3)).ravel()


BASIS = {
    "plate_seat": Basis(
        f"F/(d·t) ≤ the body's {IN_PLANE}; F what the more loaded plate carries of an axle or the springs' pin, a "
        "simple beam loaded as for `leg_axle_strength` and its like, d axle, t depth of its seat in one plate",
        "statics of two supports; bearing pressure (Shigley 8-12)",
    )
}


def seat_finding(robot: Robot) -> Iterator[Finding]:
    """Yield `plate_seat`, of the plate that an axle or pin loads most."""
    case = load_case(robot)
    plate = case.layout.lateral.left_plate
    seat, longer = plate[1] - plate[0] - case.layout.floor_mm, {"leg_axle": case.layout.boss_mm}
    worst = max(beam.plate_load_n / (seat + longer.get(name, 0.0)) for name, beam in case.beams.items())
    allowable = case.workshop.material("body").strength_in_plane_mpa / case.workshop.safety.printed_factor
    what, stress = "plates under axles and pins", worst / case.layout.axle_mm
    yield stress_finding("plate_seat", what, stress, allowable, higher("body.plate_mm"), "plate")


ENGRAVING_BASIS = {"engraving": Basis("letters of the name that the font lacks = 0", "character map of the font")}


def engraving_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `engraving` for a name with letters that cannot be engraved; they are left out."""
    lacking = "".join(dict.fromkeys(letter for letter in robot.name if not engravable(letter)))
    if not lacking:
        return
    yield at_most(
        "engraving", len(lacking), 0, "letters",
        f"the engraving's font lacks {len(lacking)} of the letters, {lacking!r}: left out on the plates of "
        f"{robot.name!r}",
        "use Latin, Greek or Cyrillic letters if the plates must show the whole name", "warning",
    )  # fmt: skip


SCREW_END_MM = 4.0
"""Least length of thread of a standoff's screw inside the standoff, M3 in polyamide; judgement: as in a toe. Stock
lengths are 2 mm apart, so that it stays below the 6 mm that are tapped."""


def standoffs(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the standoffs between the plates and their screws from outside."""
    catalogue = workshop.catalogue
    standoff, screw = catalogue.standoffs["M3"], catalogue.screws["M3"]
    low, high = layout.lateral.inside
    length = high - low
    plate = layout.lateral.left_plate[1] - high
    region = hexagon_outline(standoff.across_flats_mm, standoff.bore_mm)
    mass = standoff.density_g_cm3 * region.area() * length / 1000.0
    article = f"standoff M3 x {length:.1f} mm, hexagon {standoff.across_flats_mm:g} mm, polyamide"
    for number, place in enumerate(layout.standoffs_mm, start=1):
        at = (place[0], low, place[1])
        yield bought(f"standoff_{number}", article, BODY, mass, [(0.0, length, region)], at)
        shank = screw.length_for(plate + SCREW_END_MM, "lower body.plate_mm")
        left = (high + plate - shank, high + plate)
        right = (low - plate, low - plate + shank)
        yield placed_screw(f"standoff_{number}_screw_left", BODY, place, left, 1.0, screw, catalogue)
        yield placed_screw(f"standoff_{number}_screw_right", BODY, place, right, -1.0, screw, catalogue)


PLATES = Thing(plates, standoffs, (Check(seat_finding, BASIS), Check(engraving_findings, ENGRAVING_BASIS, cheap=False)))
