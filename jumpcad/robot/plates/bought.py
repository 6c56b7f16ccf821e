"""The standoffs between the plates, and their screws (mm, g)."""

from collections.abc import Iterator

from jumpcad.mechanism.model import BODY
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import hexagon_outline, placed_screw
from jumpcad.robot.layout import Layout
from jumpcad.workshop import Workshop

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
