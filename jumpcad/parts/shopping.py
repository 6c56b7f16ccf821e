"""The bought parts of a robot: what they are, where they sit, what they weigh (mm, g; drawn like printed parts)."""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from jumpcad.catalogue import Bearing, Catalogue, Screw
from jumpcad.dimensions import ROLLER_WASHER_MM, TRAY_MM
from jumpcad.electronics.chosen import COMPONENTS
from jumpcad.layout.drive_places import arm_line
from jumpcad.layout.electronics import BOARDS_APART_MM
from jumpcad.layout.lateral import Interval
from jumpcad.layout.layout import Layout
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG
from jumpcad.parts import axles, toes
from jumpcad.parts.body_plate import ear_places
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.spring_wire import coil_with_arm, leg_arm_wire, spring_article
from jumpcad.parts.train import gear_turns
from jumpcad.solids.outline import Region, disc, hexagon, hole, rectangle, ring, stadium
from jumpcad.transforms import Array
from jumpcad.workshop import BoughtParts

TOE_THREAD_MM = 4.0
"""Least length of thread of a toe's screw in the foot's stub."""
SCREW_END_MM = 6.0
"""Length of thread of a standoff's screw inside the standoff."""


def bought_parts(layout: Layout, holes: HoleSizes, catalogue: Catalogue, chosen: BoughtParts) -> list[BoughtPart]:
    """Return every bought part at its place, in the assembled pose."""
    return [
        *axles.axles(layout, catalogue, chosen),
        *_leg_things(layout, holes, catalogue, chosen),
        *axles.pins(layout, catalogue, chosen),
        *_springs(layout, catalogue),
        *_motor_things(layout, catalogue),
        *_standoffs(layout, catalogue),
        *_electronics(layout, catalogue, chosen),
        *_toe_screws(layout, holes, catalogue),
    ]


@lru_cache(maxsize=64)
def _round(outer_mm: float, bore_mm: float = 0.0) -> Region:
    """Return a disc, or a ring, about the origin."""
    return ring(outer_mm, bore_mm) if bore_mm else disc(outer_mm)


@lru_cache(maxsize=64)
def _box_of(width_mm: float, height_mm: float) -> Region:
    return rectangle((width_mm, height_mm))


@lru_cache(maxsize=64)
def _hexagon(across_flats_mm: float, bore_mm: float) -> Region:
    return hexagon(across_flats_mm) - hole(bore_mm)


@lru_cache(maxsize=64)
def _d_shaft(diameter_mm: float, across_flat_mm: float) -> Region:
    flat = rectangle((diameter_mm, 2.0 * diameter_mm)).translate((across_flat_mm, 0.0))
    return disc(diameter_mm) - flat


def _leg_things(layout: Layout, holes: HoleSizes, catalogue: Catalogue, chosen: BoughtParts) -> Iterator[BoughtPart]:
    """Yield the bought parts on the main leg: hub bearings, the roller with its screw."""
    lateral, cam = layout.lateral, layout.drive.cam
    low, high = lateral.leg
    if holes.bearing is not None:
        seats = [(low, low + holes.bearing.width_mm), (high - holes.bearing.width_mm, high)]
        for number, seat in enumerate(seats, start=1):
            yield _bearing(f"hub_bearing_{number}", np.zeros(2), seat, holes.bearing)
    angle = cam.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    end = cam.lever_length_mm * np.array([math.cos(angle), math.sin(angle)])
    roller = catalogue.bearings[chosen.roller]
    yield _bearing("roller", end, lateral.cam, roller)
    washer, nut, screw = catalogue.washers["M3"], catalogue.nuts["M3 nyloc"], catalogue.screws["M3"]
    slabs = [(0.0, ROLLER_WASHER_MM, _round(washer.outer_mm, washer.bore_mm))]
    yield bought("roller_washer", "washer M3 ISO 7089", MAIN_LEG, washer.mass_g, slabs, (end[0], high, end[1]))
    head = lateral.cam[1]
    length = screw.length_for(head - low + nut.height_mm, "choose a narrower bought.leg_bearing or bought.roller")
    shank = (head - length, head)
    yield _screw("roller_screw", MAIN_LEG, end, shank, 1.0, screw, catalogue)
    slabs = [(-nut.height_mm, 0.0, _hexagon(nut.across_flats_mm, screw.diameter_mm))]
    yield bought("roller_nut", "lock nut M3 DIN 985", MAIN_LEG, nut.mass_g, slabs, (end[0], low, end[1]))


def _springs(layout: Layout, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield both springs, each as coil with body arm and as leg arm.

    Each shape is the room that wire takes, a ring and a bar; what is seen is the wire.
    """
    spring, lateral, d = layout.drive.spring, layout.lateral, layout.drive.spring.wire_mm
    coil = ring(spring.outer_diameter_mm, spring.inside_diameter_mm, layout.hub_mm)
    body_arm = stadium(*arm_line(layout.hub_mm, spring, "plate"), d)
    leg_arm = stadium(*arm_line(np.zeros(2), spring, "leg"), d)
    arm_mass = math.pi / 4.0 * d**2 * spring.arm_length_mm * catalogue.wire.density_g_cm3 / 1000.0
    for side, sign, hand in zip(("left", "right"), (1.0, -1.0), spring.hands, strict=True):
        inner, outer = lateral.spring_left if side == "left" else lateral.spring_right[::-1]
        order = spring_article(spring, hand)
        slabs = [(*_sorted(inner, outer), coil), (*_sorted(outer - sign * d, outer), body_arm)]
        middles = (outer - sign * d / 2.0, inner + sign * d / 2.0)
        wire = coil_with_arm(layout.hub_mm, spring, middles)
        yield bought(f"spring_{side}", order, BODY, spring.mass_g - arm_mass, slabs).seen_as(wire)
        leg_slabs = [(*_sorted(inner, inner + sign * d), leg_arm)]
        leg = bought(f"spring_{side}_leg_arm", order, MAIN_LEG, arm_mass, leg_slabs, units=0)
        yield leg.seen_as(leg_arm_wire(spring, middles))


def _sorted(a: float, b: float) -> Interval:
    return (a, b) if a < b else (b, a)


def _motor_things(layout: Layout, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield the gear motor and the screws of its cap; the shaft is turned to fit the pinion."""
    motor, (x, z) = layout.drive.train.motor, layout.motor_mm
    low, front = layout.lateral.motor
    shaft_mass = catalogue.rod_mass_g(motor.shaft_mm, motor.shaft_length_mm)
    body = [(0.0, front - low, _box_of(motor.width_mm, motor.height_mm))]
    shaft = [(0.0, motor.shaft_length_mm, _d_shaft(motor.shaft_mm, motor.shaft_flat_mm))]
    article, turn = f"gear motor {motor.name}", gear_turns(layout)["motor_pinion"]
    article += f" ({motor.article})" if motor.article else ""
    yield bought("motor", article, BODY, motor.mass_g - shaft_mass, body, (x, low, z), layout.motor_angle_rad)
    yield bought("motor_shaft", article, BODY, shaft_mass, shaft, (x, front, z), turn, units=0)
    screw = catalogue.screws["M2"]
    for number, ear in enumerate(ear_places(layout), start=1):
        top = layout.lateral.motor_cap[1] - screw.button_head_height_mm
        yield _screw(f"cap_screw_{number}", BODY, ear, (top - 8.0, top), 1.0, screw, catalogue)


def _standoffs(layout: Layout, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield the standoffs between the plates and their screws from outside."""
    standoff, screw = catalogue.standoffs["M3"], catalogue.screws["M3"]
    low, high = layout.lateral.inside
    length = high - low
    plate = layout.lateral.left_plate[1] - high
    region = _hexagon(standoff.across_flats_mm, standoff.bore_mm)
    mass = standoff.density_g_cm3 * region.area() * length / 1000.0
    article = f"standoff M3 x {length:.1f} mm, hexagon {standoff.across_flats_mm:g} mm, polyamide"
    for number, place in enumerate(layout.standoffs_mm, start=1):
        at = (place[0], low, place[1])
        yield bought(f"standoff_{number}", article, BODY, mass, [(0.0, length, region)], at)
        shank = screw.length_for(plate + SCREW_END_MM, "lower body.plate_mm")
        left = (high + plate - shank, high + plate)
        right = (low - plate, low - plate + shank)
        yield _screw(f"standoff_{number}_screw_left", BODY, place, left, 1.0, screw, catalogue)
        yield _screw(f"standoff_{number}_screw_right", BODY, place, right, -1.0, screw, catalogue)


def _toe_screws(layout: Layout, holes: HoleSizes, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield the screws of separate toes, from outside into the foot's stubs."""
    if not layout.toes_apart:
        return
    screw, height = (
        catalogue.screws["M3"],
        toes.joint_height_mm(layout, holes) / 2.0 - layout.sections.foot_depth_mm,
    )
    outer = toes.beside_mm(layout, holes) + layout.sections.toe_width_mm / 2.0
    length = screw.length_for(layout.sections.toe_width_mm + TOE_THREAD_MM)
    for toe in toes.toes(layout):
        pose = toe.pose_mm
        shank = _sorted(toe.outside * outer, toe.outside * (outer - length))
        for number, x in enumerate(toes.SCREWS_MM, start=1):
            name = f"{toe.name}_screw_{number}"
            yield _screw(name, FOOT, np.array([x, height]), shank, toe.outside, screw, catalogue).moved(pose)


def _electronics(layout: Layout, catalogue: Catalogue, chosen: BoughtParts) -> Iterator[BoughtPart]:
    """Yield battery and boards on their trays, in the middle across the robot, and the small parts between."""
    electronics = layout.electronics
    middle = (layout.lateral.inside[0] + layout.lateral.inside[1]) / 2.0
    x, z = layout.tray_mm
    battery = electronics.battery
    yield _box("battery", battery.description, x, middle, z + TRAY_MM, battery.length_mm, battery.width_mm,
               battery.height_mm, battery.mass_g)  # fmt: skip
    top = z + electronics.upper_tray_mm + TRAY_MM
    start = x - electronics.boards_mm / 2.0
    for name, board in electronics.boards.items():
        yield _box(name, board.description, start + board.width_mm / 2.0, middle, top, board.width_mm, board.length_mm,
                   board.height_mm, board.mass_g)  # fmt: skip
        start += board.width_mm + BOARDS_APART_MM
    # Until they have places of their own: flat in the gap above the battery, where their mass is about right.
    small = [(role, getattr(chosen, role)) for role in COMPONENTS if getattr(chosen, role)]
    size, above = battery.length_mm / max(1, len(small)), z + TRAY_MM + battery.height_mm
    for number, (role, name) in enumerate(small):
        component = catalogue.components[name]
        at = x - battery.length_mm / 2.0 + (number + 0.5) * size
        yield _box(f"wiring_{role}", component.description, at, middle, above + 0.25 * BOARDS_APART_MM, 0.8 * size,
                   battery.width_mm / 2.0, 0.5 * BOARDS_APART_MM, component.mass_g)  # fmt: skip


def _box(
    name: str, article: str, x: float, y: float, z: float, size_x: float, size_y: float, size_z: float, mass_g: float
) -> BoughtPart:
    slabs = [(-size_y / 2.0, size_y / 2.0, _box_of(size_x, size_z))]
    return bought(name, article, BODY, mass_g, slabs, (x, y, z + size_z / 2.0))


def _bearing(name: str, centre: Array, y: Interval, bearing: Bearing) -> BoughtPart:
    slabs = [(0.0, bearing.width_mm, _round(bearing.outer_mm, bearing.bore_mm))]
    at = (centre[0], y[0], centre[1])
    return bought(name, f"ball bearing {bearing.name}", MAIN_LEG, bearing.mass_g, slabs, at)


def _screw(
    name: str, body: str, centre: Array, shank: Interval, side: float, screw: Screw, catalogue: Catalogue
) -> BoughtPart:
    """Return a screw whose shank fills an interval of y; its head sits at the left end (side +1) or the right (-1)."""
    height, width = screw.button_head_height_mm, screw.button_head_mm
    length = round(shank[1] - shank[0], 6)
    seat = length if side > 0 else -height
    volume_mass = catalogue.rod_mass_g(screw.diameter_mm, length) + catalogue.rod_mass_g(width, 0.7 * height)
    slabs = [(0.0, length, _round(screw.diameter_mm)), (seat, seat + height, _round(width))]
    at = (centre[0], shank[0], centre[1])
    return bought(name, f"screw {screw.name} x {length:g} ISO 7380-1", body, volume_mass, slabs, at)
