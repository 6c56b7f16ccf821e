"""The bought parts of a robot: what they are, where they sit, what they weigh (mm, g; drawn like printed parts)."""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from jumpcad.catalogue import Bearing, Catalogue
from jumpcad.dimensions import ROLLER_WASHER_MM
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import box_outline, placed_screw, round_outline
from jumpcad.robot.axles import axles
from jumpcad.robot.electronics import wired
from jumpcad.robot.foot import toes
from jumpcad.robot.layout import Layout
from jumpcad.robot.sensor import drawing as sensor
from jumpcad.robot.space.lateral import Interval
from jumpcad.robot.springs.wire import coil_with_arm, leg_arm_wire, spring_article
from jumpcad.robot.train.drawing import gear_turns
from jumpcad.robot.train.motor_socket import ear_places
from jumpcad.robot.train.place import arm_line
from jumpcad.solids.outline import Region, disc, hexagon, hole, rectangle, ring, stadium
from jumpcad.strength.bearings import roller_washer
from jumpcad.transforms import Array
from jumpcad.workshop import BoughtParts, Workshop

TOE_THREAD_MM = 4.0
"""Least length of thread of a toe's screw in the foot's stub."""
CAP_SCREW_MM = 8.0
"""Length of the M2 screws that hold the motor's cap on the ears of its socket, a stock length; judgement: more thread
in plastic than twice their diameter, through a cap of 2.4 mm."""
SCREW_END_MM = 4.0
"""Least length of thread of a standoff's screw inside the standoff, M3 in polyamide; judgement: as in a toe. Stock
lengths are 2 mm apart, so that it stays below the 6 mm that are tapped."""


def bought_parts(layout: Layout, workshop: Workshop) -> list[BoughtPart]:
    """Return every bought part at its place, in the assembled pose."""
    holes, catalogue, chosen = HoleSizes.of(workshop, layout.hub_bearing), workshop.catalogue, workshop.bought
    return [
        *axles.axles(layout, catalogue, chosen),
        *_leg_things(layout, holes, catalogue, chosen),
        *axles.pins(layout, catalogue, chosen),
        *_springs(layout, catalogue),
        *_motor_things(layout, catalogue),
        *_standoffs(layout, catalogue),
        *_sensor(layout, catalogue),
        *wired.electronics(layout, catalogue, chosen),
        *_toe_screws(layout, holes, catalogue),
    ]


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
        for number, right in enumerate((low, high - holes.bearing.width_mm), start=1):
            yield _bearing(f"hub_bearing_{number}", np.zeros(2), right, holes.bearing)
    angle = cam.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    end = cam.lever_length_mm * np.array([math.cos(angle), math.sin(angle)])
    roller = catalogue.bearings[chosen.roller]
    yield _bearing("roller", end, lateral.cam[0], roller)
    washer, nut, screw = roller_washer(roller, catalogue), catalogue.nuts["M3 nyloc"], catalogue.screws["M3"]
    slabs = [(0.0, ROLLER_WASHER_MM, round_outline(washer.outer_mm, washer.bore_mm))]
    yield bought("roller_washer", washer.article, MAIN_LEG, washer.mass_g, slabs, (end[0], high, end[1]))
    yield placed_screw("roller_screw", MAIN_LEG, end, lateral.roller_screw, 1.0, screw, catalogue)
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
        order = spring_article(spring, hand, catalogue.springs)
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
    body = [(0.0, front - low, box_outline(motor.width_mm, motor.height_mm))]
    shaft = [(0.0, motor.shaft_length_mm, _d_shaft(motor.shaft_mm, motor.shaft_flat_mm))]
    article, turn = f"gear motor {motor.name}", gear_turns(layout)["motor_pinion"]
    article += f" ({motor.article})" if motor.article else ""
    yield bought("motor", article, BODY, motor.mass_g - shaft_mass, body, (x, low, z), layout.motor_angle_rad)
    yield bought("motor_shaft", article, BODY, shaft_mass, shaft, (x, front, z), turn, units=0)
    screw = catalogue.screws["M2"]
    for number, ear in enumerate(ear_places(layout), start=1):
        top = layout.lateral.motor_cap[1] - screw.button_head_height_mm
        yield placed_screw(f"cap_screw_{number}", BODY, ear, (top - CAP_SCREW_MM, top), 1.0, screw, catalogue)


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
        yield placed_screw(f"standoff_{number}_screw_left", BODY, place, left, 1.0, screw, catalogue)
        yield placed_screw(f"standoff_{number}_screw_right", BODY, place, right, -1.0, screw, catalogue)


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
            yield placed_screw(name, FOOT, np.array([x, height]), shank, toe.outside, screw, catalogue).moved(pose)


def _sensor(layout: Layout, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield the switch over the cam gear's track and the screws of its mount."""
    felt, outside = layout.sensor, layout.lateral.left_plate[1]
    if felt is None:
        return
    part, at = felt.needs.part, (felt.place_mm[0], outside + felt.base_mm, felt.place_mm[1])
    slabs = sensor.sensor_slabs(part, felt.needs.travel)
    yield bought("sensor", part.description, BODY, part.mass_g, slabs, at, felt.turn_rad)
    head = outside + sensor.ear_height_mm(layout)
    for number, place in enumerate(sensor.screw_places(felt), start=1):
        shank = (head - sensor.screw_mm(), head)
        yield placed_screw(f"sensor_screw_{number}", BODY, place, shank, 1.0, catalogue.screws["M2"], catalogue)


def _bearing(name: str, centre: Array, right_mm: float, bearing: Bearing) -> BoughtPart:
    """Return a bearing whose right side is at `right_mm` along y."""
    slabs = [(0.0, bearing.width_mm, round_outline(bearing.outer_mm, bearing.bore_mm))]
    at = (centre[0], right_mm, centre[1])
    size = f"{bearing.bore_mm:g} x {bearing.outer_mm:g} x {bearing.width_mm:g} mm"
    return bought(name, f"ball bearing {bearing.name} ZZ, {size}", MAIN_LEG, bearing.mass_g, slabs, at)
