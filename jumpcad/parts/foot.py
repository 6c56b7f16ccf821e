"""The foot: two rails with lugs for ankle and front eye, and its toes or their stubs; prints flat on its sole.

Drawn in the foot's frame: origin at the ankle, x towards the front eye, the ground at z = -foot_depth (mm).
"""

import math
from collections.abc import Sequence

import numpy as np

from jumpcad.dimensions import GAP_MM, TOE_TIP_WIDTH_MM
from jumpcad.layout.layout import Layout
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, upright
from jumpcad.parts.toes import lying_hole, on_the_foot, toe_tip_mm
from jumpcad.printing.bed import fit_to_bed
from jumpcad.solids.blocks import Bar, Block, Blocks
from jumpcad.solids.outline import Region, circle_points, disc, hull, polygon, rectangle, union

WEB_MM = 10.0
"""Length along x of the web that joins the rails in front of the ankle."""
NOSE_AHEAD = 0.42
"""How far the sole reaches ahead of the front eye, in depths: up to there a round nose would overhang beyond 45°."""


def foot(layout: Layout, holes: HoleSizes) -> Drawing:
    """Return the foot."""
    sections, l4 = layout.sections, layout.design.l4_mm
    depth, lug = sections.foot_depth_mm, sections.lug_thickness_mm
    inner = sections.thickness_mm / 2.0 + GAP_MM
    height = sections.rail_root_mm
    rail = polygon([(0.0, -depth), (l4, -depth), (l4, sections.rail_tip_mm - depth), (0.0, height - depth)])
    lugs = [_lug(depth, 0.0, 1.6 * depth), _lug(depth, l4, NOSE_AHEAD * depth)]
    pins = union(lying_hole(holes.press(layout.axle_mm), (x, 0.0)) for x in (0.0, l4))
    side = union([rail, *lugs]) ^ rectangle((4.0 * l4, 4.0 * depth), (0.0, depth))
    webs = [
        rectangle((end - start, web_height), ((start + end) / 2.0, web_height / 2.0 - depth))
        for start, end, web_height in _webs(layout, height)
    ]
    reach = inner + max(lug, sections.toe_width_mm) + 1.0
    toes, cuts = on_the_foot(layout, holes)
    added: tuple[Block, ...] = (
        Bar(_on_bed(layout, side), ((inner, inner + lug), (-inner - lug, -inner))),
        Bar(_on_bed(layout, union(webs)), ((-inner - lug / 2.0, inner + lug / 2.0),)),
        *toes,
    )
    shape = Blocks(added, (Bar(_on_bed(layout, pins), ((-reach, reach),)), *cuts))
    return Drawing("foot", "links", shape, (Placement(FOOT, upright(-depth)),))


def in_one_piece(layout: Layout, bed_mm: Sequence[float]) -> bool:
    """Tell whether a foot with its toes fits the bed."""
    sections = layout.sections
    half = sections.thickness_mm / 2.0 + GAP_MM + sections.lug_thickness_mm
    nose = np.array([layout.design.l4_mm, half - sections.foot_depth_mm])
    ends = [(toe_tip_mm(layout), TOE_TIP_WIDTH_MM), (nose, 2.0 * sections.foot_depth_mm)]
    outline = np.concatenate(
        [circle_points(diameter, place * (1.0, sign)) for place, diameter in ends for sign in (-1.0, 1.0)]
    )
    top = max(2.0 * sections.foot_depth_mm, sections.toe_root_mm, sections.rail_root_mm)
    bounds = np.array([[*outline.min(axis=0), 0.0], [*outline.max(axis=0), top]])
    return fit_to_bed(bounds, lambda: outline, bed_mm).margin_mm >= 0.0


def _webs(layout: Layout, height_mm: float) -> list[tuple[float, float, float]]:
    """Return the webs between the rails (start x, end x, height): in front of the ankle, and further on if free.

    The front link folds down between the rails; a web stays below it by the gap that moving parts keep.
    """
    sections, l4 = layout.sections, layout.design.l4_mm
    start = sections.foot_depth_mm
    webs = [(start, start + WEB_MM, height_mm)]
    linkage = Linkage(layout.design)
    wound = linkage.pose([-layout.design.compression_rad])
    slope = float(linkage.rest_rad + wound.front_rad[0] - wound.foot_rad[0])
    middle = 0.5 * l4
    below_link = (l4 - middle - 6.0) * math.tan(slope) - sections.eye_radius_mm / math.cos(slope) - 1.0
    # lower than the rails over all its length: surfaces that only meet in a line leave slivers
    rail_there = sections.rail_root_mm + 0.6 * (sections.rail_tip_mm - sections.rail_root_mm)
    low = min(rail_there - 0.2, sections.foot_depth_mm + below_link)
    if low >= 2.0:
        webs.append((middle, middle + 6.0, low))
    return webs


def _lug(depth_mm: float, x_mm: float, ahead_mm: float) -> Region:
    """Return a lug around an eye, round like the contact sphere there, widened at the sole behind and ahead."""
    behind = 1.6 * depth_mm
    sole = rectangle((behind + ahead_mm, 1.0), (x_mm + (ahead_mm - behind) / 2.0, 0.5 - depth_mm))
    return hull([disc(2.0 * depth_mm, (x_mm, 0.0)), sole])


def _on_bed(layout: Layout, region: Region) -> Region:
    """Return a region of the foot's x-z plane as it stands on the bed."""
    return region.translate((0.0, layout.sections.foot_depth_mm))
