"""Main leg with its lever, and front link: flat bars with eyes, drawn in their own link frames (mm)."""

import math

import numpy as np

from jumpcad.dimensions import LEVER_EYE_RADIUS_MM, STOP_PAD_MM
from jumpcad.layout.layout import Layout
from jumpcad.mechanism.model import FRONT_LINK, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, laid
from jumpcad.solids.outline import disc, filleted, hole, rectangle, stadium, tapered_bar, union

HEEL_MORE_MM = 0.5
"""By how much the heel that meets the stop is longer than its pad, at either end; judgement: the bar's play."""
FILLET_MM = 3.0
"""Radius between eyes and beam; judgement: half of the least height."""


def main_leg(layout: Layout, holes: HoleSizes) -> Drawing:
    """Return the main leg: hub on the leg axle, beam to the ankle, lever with the roller's screw, springs' pin, heel.

    The heel is a flat behind the beam that meets the rest stop's pad.
    """
    sections, cam = layout.sections, layout.drive.cam
    half = sections.thickness_mm / 2.0
    ankle = (layout.design.l2_mm, 0.0)
    # the leg's x axis points rest_angle below the body's, so directions grow by it
    lever_angle = cam.lever_start_rad + math.radians(layout.design.rest_angle_deg)
    lever = cam.lever_length_mm * np.array([math.cos(lever_angle), math.sin(lever_angle)])
    pin = (layout.leg_pin_mm, 0.0)
    hub_radius, stop = holes.hub_radius_mm, layout.stop
    outline = union(
        [
            disc(2.0 * hub_radius),
            tapered_bar((0.0, 0.0), ankle, sections.leg_root_mm, sections.leg_tip_mm),
            disc(2.0 * sections.eye_radius_mm, ankle),
            disc(max(sections.leg_root_mm, 2.0 * sections.eye_radius_mm), pin),
            tapered_bar((0.0, 0.0), lever, sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM),
            rectangle((STOP_PAD_MM + 2.0 * HEEL_MORE_MM, stop.heel_mm), (stop.radius_mm, -stop.heel_mm / 2.0)),
        ]
    )
    beam = filleted(outline, FILLET_MM) - union(
        [
            hole(holes.eye(layout.axle_mm), ankle),
            hole(holes.m3_clearance_mm, lever),
            hole(holes.press(layout.axle_mm), pin),
        ]
    )
    stack, pose = laid((y0, y1, beam - region) for y0, y1, region in holes.hub_slabs(-half, half))
    return Drawing("main_leg", "links", holes.chamfered(stack), (Placement(MAIN_LEG, pose),))


def front_link(layout: Layout, holes: HoleSizes) -> Drawing:
    """Return the front link: two eyes and a beam."""
    sections = layout.sections
    half = sections.thickness_mm / 2.0
    eye = (layout.design.l3_mm, 0.0)
    outline = union(
        [
            stadium((0.0, 0.0), eye, sections.front_mm),
            disc(2.0 * sections.eye_radius_mm),
            disc(2.0 * sections.eye_radius_mm, eye),
        ]
    )
    bore = holes.eye(layout.axle_mm)
    region = filleted(outline, FILLET_MM) - union([hole(bore), hole(bore, eye)])
    stack, pose = laid([(-half, half, region)])
    return Drawing("front_link", "links", holes.chamfered(stack), (Placement(FRONT_LINK, pose),))
