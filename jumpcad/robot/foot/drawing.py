"""The foot: two rails with lugs for ankle and front eye, and its toes or their stubs; prints flat on its sole.

Drawn in the foot's frame: origin at the ankle, x towards the front eye, the printed sole at z = -foot_depth (mm).
"""

import math
from collections.abc import Sequence

import numpy as np

from jumpcad.design import Design
from jumpcad.dimensions import TOE_TIP_WIDTH_MM
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, fit_to_bed, upright
from jumpcad.robot.foot.toes import PIN_END_MM, lying_hole, on_the_foot, toes_apart
from jumpcad.robot.layout import Layout
from jumpcad.robot.sizing import Sections, beside_leg_mm
from jumpcad.solids.blocks import Bar, Block, Blocks
from jumpcad.solids.outline import Region, circle_points, disc, hull, polygon, rectangle, union
from jumpcad.workshop import Workshop

WEB_MM = 10.0
"""Length along x of the web that joins the rails in front of the ankle; judgement."""
LOW_WEB_MM = 6.0
"""Length along x of the lower web in the middle of the foot; judgement."""
LOW_WEB_MIN_MM = 2.0
"""Least height of the lower web; judgement: ten layers of 0.2 mm, less would not stiffen the foot."""
LOW_WEB_AT = 0.6
"""Where the height of the rails is taken beside that web, as a share of their length; judgement: near its end."""
WEB_BELOW_RAIL_MM = 0.2
"""By how much that web is lower than the rails beside it: surfaces that only touch in a line leave slivers."""
LEG_GAP_MM = 0.5
"""Gap between the web and the leg with the stop's pad pressed; judgement."""
LINK_GAP_MM = 1.0
"""Gap below the folded front link; judgement: the usual gap, and the flexing of the link."""
SOLE_LENGTH, NOSE_AHEAD = 1.6, 0.42
"""How far a lug's sole reaches behind (and ahead of the ankle) and ahead of the front eye, in depths of the foot.
Judgement for the first; a flank of 45° that touches the round nose reaches the sole 0.42 depths ahead."""
SOLE_HEIGHT_MM = 1.0
"""Height of a lug's straight sole; judgement."""


def foot_and_toes(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return the foot, and the toes where they are separate parts."""
    return [foot(layout, workshop), *toes_apart(layout, workshop)]


def foot(layout: Layout, workshop: Workshop) -> Drawing:
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    sections, l4 = layout.sections, layout.design.l4_mm
    depth, lug = sections.foot_depth_mm, sections.lug_thickness_mm
    inner = beside_leg_mm(sections.thickness_mm)
    height = sections.rail_root_mm
    rail = polygon([(0.0, -depth), (l4, -depth), (l4, sections.rail_tip_mm - depth), (0.0, height - depth)])
    lugs = [_lug(depth, 0.0, SOLE_LENGTH * depth), _lug(depth, l4, NOSE_AHEAD * depth)]
    pins = union(lying_hole(holes.lying(layout.axle_mm), (x, 0.0)) for x in (0.0, l4))
    side = union([rail, *lugs]) ^ rectangle((4.0 * l4, 4.0 * depth), (0.0, depth))
    webs = [
        rectangle((end - start, web_height), ((start + end) / 2.0, web_height / 2.0 - depth))
        for start, end, web_height in _webs(layout, height, holes.fits.hole_min_mm)
    ]
    face = layout.ankle_face_mm
    reach = face + 2.0 * sections.toe_width_mm
    ends = Bar(_on_bed(layout, lying_hole(PIN_END_MM, (0.0, 0.0))), ((face, reach), (-reach, -face)))
    toes, cuts = on_the_foot(layout, holes)
    added: tuple[Block, ...] = (
        Bar(_on_bed(layout, side), ((inner, inner + lug), (-inner - lug, -inner))),
        Bar(_on_bed(layout, union(webs)), ((-inner - lug / 2.0, inner + lug / 2.0),)),
        Bar(_on_bed(layout, _ankle_boss(layout, holes)), ((inner, face), (-face, -inner))),
        *toes,
    )
    shape = Blocks(added, (Bar(_on_bed(layout, pins), ((-reach, reach),)), ends, *cuts))
    return Drawing("foot", "links", shape, (Placement(FOOT, upright(-depth)),))


def nose_outline(depth_mm: float) -> Region:
    """Return the outline of a lug of the nose about the front eye."""
    return _lug(depth_mm, 0.0, NOSE_AHEAD * depth_mm)


def in_one_piece(design: Design, sections: Sections, bed_mm: Sequence[float], toe_half_width_mm: float = 0.0) -> bool:
    """Tell whether a foot with its toes, which reach from the middle as far as said at least, fits the bed."""
    half = beside_leg_mm(sections.thickness_mm) + sections.lug_thickness_mm
    nose = np.array([design.l4_mm, half - sections.foot_depth_mm])
    tip = toe_tip_mm(design)
    tip = np.array([tip[0], max(tip[1], toe_half_width_mm)])
    ends = [(tip, TOE_TIP_WIDTH_MM), (nose, 2.0 * sections.foot_depth_mm)]
    outline = np.concatenate(
        [circle_points(diameter, place * (1.0, sign)) for place, diameter in ends for sign in (-1.0, 1.0)]
    )
    top = max(2.0 * sections.foot_depth_mm, sections.toe_root_mm, sections.rail_root_mm)
    bounds = np.array([[*outline.min(axis=0), 0.0], [*outline.max(axis=0), top]])
    return fit_to_bed(bounds, lambda: outline, bed_mm).margin_mm >= 0.0


def _webs(layout: Layout, height_mm: float, opening_min_mm: float) -> list[tuple[float, float, float]]:
    """Return the webs between the rails (start x, end x, height): in front of the ankle, and further on if free.

    The front link folds down between the rails when the springs are loaded; both webs stay below it. The first begins
    where the leg, which leans towards it on its stop, leaves it free. In a short foot they join where the opening
    between them would be narrower than a printable hole.
    """
    sections, l4 = layout.sections, layout.design.l4_mm
    linkage = layout.linkage
    loaded = linkage.pose([-layout.design.compression_rad])
    slope = float(linkage.rest_rad + loaded.front_rad[0] - loaded.foot_rad[0])

    def below_link(x_mm: float) -> float:
        above_eye = (l4 - x_mm) * math.tan(slope) - sections.eye_radius_mm / math.cos(slope) - LINK_GAP_MM
        return sections.foot_depth_mm + above_eye

    def height_at(start_mm: float) -> float:
        return max(LOW_WEB_MIN_MM, min(height_mm, below_link(start_mm + WEB_MM)))

    start, middle = sections.foot_depth_mm, 0.5 * l4
    start = _ahead_of_leg_mm(layout, start, height_at(start))
    webs = [(start, start + WEB_MM, height_at(start))]
    rail_there = sections.rail_root_mm + LOW_WEB_AT * (sections.rail_tip_mm - sections.rail_root_mm)
    low = min(rail_there - WEB_BELOW_RAIL_MM, below_link(middle + LOW_WEB_MM))
    if low >= LOW_WEB_MIN_MM:
        ahead = start + WEB_MM
        webs.append((ahead if 0.0 < middle - ahead < opening_min_mm else middle, middle + LOW_WEB_MM, low))
    return webs


def _ahead_of_leg_mm(layout: Layout, start_mm: float, height_mm: float) -> float:
    """Return where a web of some height begins that is clear of the leg on its stop, where it leans farthest ahead.

    The web's upper edge is what the leg, a bar from the ankle up, comes near; below the ankle there is only its eye.
    """
    sections, linkage = layout.sections, layout.linkage
    pose = linkage.pose([layout.stop.reach_rad])
    to_hub = math.pi - linkage.rest_rad - layout.stop.reach_rad + float(pose.foot_rad[0])  # up from the foot's x axis
    half = max(sections.leg_tip_mm / 2.0, sections.eye_radius_mm) + LEG_GAP_MM
    top = height_mm - sections.foot_depth_mm
    if start_mm * math.cos(to_hub) + top * math.sin(to_hub) <= 0.0:
        return start_mm
    return max(start_mm, (half + top * math.cos(to_hub)) / math.sin(to_hub))


def _lug(depth_mm: float, x_mm: float, ahead_mm: float) -> Region:
    """Return a lug around an eye, round like the contact sphere there, widened at the sole behind and ahead."""
    behind = SOLE_LENGTH * depth_mm
    middle = (x_mm + (ahead_mm - behind) / 2.0, SOLE_HEIGHT_MM / 2.0 - depth_mm)
    sole = rectangle((behind + ahead_mm, SOLE_HEIGHT_MM), middle)
    return hull([disc(2.0 * depth_mm, (x_mm, 0.0)), sole])


def _ankle_boss(layout: Layout, holes: HoleSizes) -> Region:
    """Return the boss of the ankle's pin, out to the toes' outer sides, and down to the bed to be printable."""
    outer = max(PIN_END_MM + 1.0, holes.lying(layout.axle_mm) + 4.0 * holes.fits.wall_mm)
    middle = SOLE_HEIGHT_MM / 2.0 - layout.sections.foot_depth_mm
    return hull([disc(outer), rectangle((outer, SOLE_HEIGHT_MM), (0.0, middle))])


def _on_bed(layout: Layout, region: Region) -> Region:
    """Return a region of the foot's x-z plane as it stands on the bed."""
    return region.translate((0.0, layout.sections.foot_depth_mm))
