"""Main leg with its lever, and front link: flat bars with eyes, drawn in their own link frames (mm).

Printed whole, or as ends with sockets into which a bought bar is glued. The two ends of the front link are equal.
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import LEVER_EYE_RADIUS_MM, OVERHANG_LINES, ROLLER_WASHER_MM, STOP_PAD_MM
from jumpcad.mechanism.model import FRONT_LINK, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_stack
from jumpcad.parts.purchased import BoughtPart, bearing_part, bought, hexagon_outline, placed_screw, round_outline
from jumpcad.robot.layout import Layout
from jumpcad.robot.leg.place import BarPlace, bar_place
from jumpcad.solids.outline import Region, disc, filleted, hole, rectangle, stadium, tapered_bar, union
from jumpcad.solids.stack import Stack
from jumpcad.strength.bearings import roller_washer
from jumpcad.workshop import Workshop

HEEL_MORE_MM = 0.5
"""By how much the heel that touches the stop is longer than its pad, at each end; judgement: the bar's play."""
FAR_MM = 1000.0
"""Farther than any leg reaches."""
FILLET_MM = 3.0
"""Radius between eyes and beam; judgement: half of the least height."""


def legs(layout: Layout, workshop: Workshop) -> list[Drawing]:
    return [*main_leg(layout, workshop), front_link(layout, workshop)]


def main_leg(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return the main leg: hub on the leg axle, beam to the ankle, lever with the roller's screw, springs' pin, heel.

    The heel is a flat face behind the beam that touches the rest stop's pad. With a bar the leg ends in a socket, and
    the end with the ankle's eye is a separate part.
    """
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    sections, cam = layout.sections, layout.drive.cam
    half = sections.thickness_mm / 2.0
    ankle = (layout.design.l2_mm, 0.0)
    # the leg's x axis points rest_angle below the body's, so directions grow by it
    lever_angle = cam.geometry.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    lever = cam.geometry.lever_mm * np.array([math.cos(lever_angle), math.sin(lever_angle)])
    pin = (layout.leg_pin_mm, 0.0)
    stop = layout.stop
    place = leg_bar_place(layout, holes)
    beam = tapered_bar((0.0, 0.0), ankle, sections.leg_root_mm, sections.leg_tip_mm)
    outer = union([beam, disc(2.0 * sections.eye_radius_mm, ankle)])
    hub = [disc(2.0 * holes.hub_radius_mm), beam if place is None else beam ^ _before(place.mouth_mm)]
    around_pin = disc(max(sections.leg_root_mm, 2.0 * sections.eye_radius_mm), pin)
    arm = tapered_bar((0.0, 0.0), lever, sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM)
    heel = rectangle((STOP_PAD_MM + 2.0 * HEEL_MORE_MM, stop.heel_mm), (stop.radius_mm, -stop.heel_mm / 2.0))
    inner = union([*hub, around_pin, arm, heel])
    holed = [hole(holes.fits.m3_clearance_mm, lever), hole(holes.press(layout.axle_mm), pin)]
    eye = hole(holes.eye(layout.axle_mm), ankle)
    bore = holes.hub_slabs(-half, half)
    if place is None:
        whole = filleted(union([inner, outer]), FILLET_MM) - union([eye, *holed])
        stack, pose = lying_stack((y0, y1, whole - region) for y0, y1, region in bore)
        return [Drawing("main_leg", "links", holes.chamfered(stack), (Placement(MAIN_LEG, pose),))]
    lever_end = filleted(inner, FILLET_MM) - union(holed)
    stack, pose = lying_stack((y0, y1, lever_end - region) for y0, y1, region in bore)
    first = _socketed(stack, place, holes, half)
    far = filleted(outer, FILLET_MM) - eye - _before(place.far_mouth_mm)
    stack, end_pose = lying_stack([(-half, half, far)])
    last = _socketed(stack, place, holes, half)
    return [
        Drawing("main_leg", "links", holes.chamfered(first), (Placement(MAIN_LEG, pose),)),
        Drawing("main_leg_end", "links", holes.chamfered(last), (Placement(MAIN_LEG, end_pose),)),
    ]


def front_link(layout: Layout, workshop: Workshop) -> Drawing:
    """Return the front link: two eyes and a beam; with a bar, two equal ends."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    sections = layout.sections
    half, length = sections.thickness_mm / 2.0, layout.design.l3_mm
    eye = (length, 0.0)
    eyes = [disc(2.0 * sections.eye_radius_mm, place) for place in ((0.0, 0.0), eye)]
    outline = union([stadium((0.0, 0.0), eye, sections.front_mm), *eyes])
    bore, place = holes.eye(layout.axle_mm), front_bar_place(layout, holes)
    region = filleted(outline, FILLET_MM) - union([hole(bore), hole(bore, eye)])
    if place is None:
        stack, pose = lying_stack([(-half, half, region)])
        return Drawing("front_link", "links", holes.chamfered(stack), (Placement(FRONT_LINK, pose),))
    stack, pose = lying_stack([(-half, half, region ^ _before(place.mouth_mm))])
    turned = np.diag([-1.0, 1.0, -1.0, 1.0])
    turned[0, 3] = length
    places = (Placement(FRONT_LINK, pose), Placement(FRONT_LINK, turned @ pose))
    return Drawing("front_link", "links", holes.chamfered(_socketed(stack, place, holes, half)), places)


def leg_bar_place(layout: Layout, holes: HoleSizes) -> BarPlace | None:
    """Return where the main leg's bar is, from beyond the springs' pin and the heel to the ankle; None without one."""
    if layout.leg_bar is None:
        return None
    wall, heel_end = 2.0 * holes.fits.wall_mm, layout.stop.radius_mm + STOP_PAD_MM / 2.0 + HEEL_MORE_MM
    first = layout.leg_pin_mm + holes.press(layout.axle_mm) / 2.0 + wall
    last = layout.design.l2_mm - holes.eye(layout.axle_mm) / 2.0 - wall
    return bar_place("main leg", layout.leg_bar, first, heel_end, last, bends=True)


def front_bar_place(layout: Layout, holes: HoleSizes) -> BarPlace | None:
    """Return where the front link's bar is, from eye to eye; None without one."""
    if layout.leg_bar is None:
        return None
    first = holes.eye(layout.axle_mm) / 2.0 + 2.0 * holes.fits.wall_mm
    return bar_place("front link", layout.leg_bar, first, 0.0, layout.design.l3_mm - first, bends=False)


def _before(x_mm: float) -> Region:
    """Return everything of a leg up to a distance from its first eye."""
    return rectangle((2.0 * FAR_MM, 2.0 * FAR_MM), (x_mm - FAR_MM, 0.0))


def _socketed(stack: Stack, place: BarPlace, holes: HoleSizes, half_mm: float) -> Stack:
    """Return a leg's end, as it lies on the bed, with the socket of the bar cut out."""
    length, middle = place.far_floor_mm - place.floor_mm, place.middle_mm
    return stack.minus(
        (half_mm + y0, half_mm + y1, rectangle((length, height), (middle, 0.0)))
        for y0, y1, height in place.bar.slabs_mm(holes.fits.lying_mm, OVERHANG_LINES * holes.process.line_width_mm)
    )


def leg_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield hub bearings, the roller with its screw, and the bars of main leg and front link."""
    holes, catalogue = HoleSizes.of(workshop, layout.hub_bearing), workshop.catalogue
    lateral, cam = layout.lateral, layout.drive.cam
    low, high = lateral.leg
    if holes.bearing is not None:
        for number, right in enumerate((low, high - holes.bearing.width_mm), start=1):
            yield bearing_part(f"hub_bearing_{number}", np.zeros(2), right, holes.bearing)
    angle = cam.geometry.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    end = cam.geometry.lever_mm * np.array([math.cos(angle), math.sin(angle)])
    roller = catalogue.bearings[workshop.bought.roller]
    yield bearing_part("roller", end, lateral.cam[0], roller)
    washer, nut, screw = roller_washer(roller, catalogue), catalogue.nuts["M3 nyloc"], catalogue.screws["M3"]
    slabs = [(0.0, ROLLER_WASHER_MM, round_outline(washer.outer_mm, washer.bore_mm))]
    yield bought("roller_washer", washer.article, MAIN_LEG, washer.mass_g, slabs, (end[0], high, end[1]))
    yield placed_screw("roller_screw", MAIN_LEG, end, lateral.roller_screw, 1.0, screw, catalogue)
    slabs = [(-nut.height_mm, 0.0, hexagon_outline(nut.across_flats_mm, screw.diameter_mm))]
    yield bought("roller_nut", "lock nut M3 DIN 985", MAIN_LEG, nut.mass_g, slabs, (end[0], low, end[1]))
    places = {MAIN_LEG: leg_bar_place(layout, holes), FRONT_LINK: front_bar_place(layout, holes)}
    for body, place in places.items():
        if place is None:
            continue
        bar, length = place.bar, place.length_mm
        slabs = [(y0, y1, rectangle((length, height))) for y0, y1, height in bar.slabs_mm()]
        article = f"{bar.description}, cut {length:.1f} mm long"
        yield bought(f"{body}_bar", article, body, bar.mass_g(length), slabs, (place.middle_mm, 0.0, 0.0))
