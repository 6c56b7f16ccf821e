"""What is bought for the legs: hub bearings, the roller with its screw, bars (mm, g)."""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import ROLLER_WASHER_MM
from jumpcad.mechanism.model import FRONT_LINK, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import bearing_part, hexagon_outline, placed_screw, round_outline
from jumpcad.robot.layout import Layout
from jumpcad.robot.leg.drawing import front_bar_place, leg_bar_place
from jumpcad.solids.outline import rectangle
from jumpcad.strength.bearings import roller_washer
from jumpcad.workshop import Workshop


def leg_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield what is bought for main leg and front link."""
    yield from hub_and_roller(layout, workshop)
    yield from bars(layout, workshop)


def hub_and_roller(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the bought parts on the main leg: hub bearings, the roller with its screw."""
    holes, catalogue = HoleSizes.of(workshop, layout.hub_bearing), workshop.catalogue
    lateral, cam = layout.lateral, layout.drive.cam
    low, high = lateral.leg
    if holes.bearing is not None:
        for number, right in enumerate((low, high - holes.bearing.width_mm), start=1):
            yield bearing_part(f"hub_bearing_{number}", np.zeros(2), right, holes.bearing)
    angle = cam.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    end = cam.lever_length_mm * np.array([math.cos(angle), math.sin(angle)])
    roller = catalogue.bearings[workshop.bought.roller]
    yield bearing_part("roller", end, lateral.cam[0], roller)
    washer, nut, screw = roller_washer(roller, catalogue), catalogue.nuts["M3 nyloc"], catalogue.screws["M3"]
    slabs = [(0.0, ROLLER_WASHER_MM, round_outline(washer.outer_mm, washer.bore_mm))]
    yield bought("roller_washer", washer.article, MAIN_LEG, washer.mass_g, slabs, (end[0], high, end[1]))
    yield placed_screw("roller_screw", MAIN_LEG, end, lateral.roller_screw, 1.0, screw, catalogue)
    slabs = [(-nut.height_mm, 0.0, hexagon_outline(nut.across_flats_mm, screw.diameter_mm))]
    yield bought("roller_nut", "lock nut M3 DIN 985", MAIN_LEG, nut.mass_g, slabs, (end[0], low, end[1]))


def bars(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the bars of main leg and front link, with the length to cut."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    places = {MAIN_LEG: leg_bar_place(layout, holes), FRONT_LINK: front_bar_place(layout, holes)}
    for body, place in places.items():
        if place is None:
            continue
        bar, length = place.bar, place.length_mm
        slabs = [(y0, y1, rectangle((length, height))) for y0, y1, height in bar.slabs_mm()]
        article = f"{bar.description}, cut {length:.1f} mm long"
        yield bought(f"{body}_bar", article, body, bar.mass_g(length), slabs, (place.middle_mm, 0.0, 0.0))
