"""What is bought for foot and stop: screws of separate toes, pads cut from strip, or printed, and glued on (mm, g)."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Pad
from jumpcad.dimensions import STOP_PAD_MM, TOE_TIP_WIDTH_MM
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Piece
from jumpcad.parts.purchased import BoughtPart, bought, interval, placed_screw
from jumpcad.robot.foot import toes
from jumpcad.robot.foot.drawing import nose_outline
from jumpcad.robot.layout import Layout
from jumpcad.robot.sizing import beside_leg_mm
from jumpcad.solids.outline import Region, grown, rectangle
from jumpcad.workshop import Workshop

NOSE_BEHIND_SHARE, NOSE_UP_SHARE = 0.9, 0.7
"""How far the nose's pad reaches behind the front eye and, around the nose, up to below it, in depths of the foot;
judgement: the robot leaves the ground and lands over the nose, which rolls on the ground."""
TOE_BACK_MM, TOE_AHEAD_MM = 8.0, 1.5
"""How far a toe's pad reaches from the tip's middle towards the root, and beyond; judgement."""


@dataclass(frozen=True, kw_only=True)
class PrintedPad(Piece):
    """A pad that is printed, lying on its side: its material is named as its kind of pad."""

    item: BoughtPart
    pad: Pad


def printed_pads(hardware: Iterable[BoughtPart], workshop: Workshop) -> list[PrintedPad]:
    """Return the pads among bought parts that are printed."""
    foot, stop = workshop.foot_pad, workshop.stop_pad
    pads = ((item, stop if item.name == "stop_pad" else foot) for item in hardware if "_pad" in item.name)
    return [
        PrintedPad(item.name, pad.name, item.shape, item.units, item=item, pad=pad)
        for item, pad in pads
        if pad is not None and pad.printed
    ]


def stop_pad(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the stop's pad: as wide as the leg, in its seat."""
    stop, width = layout.stop, layout.sections.thickness_mm
    box = rectangle((STOP_PAD_MM, stop.pad.thickness_mm)).rotate(float(np.degrees(stop.turn_rad)))
    middle = stop.face_mm + stop.pad.thickness_mm / 2.0 * stop.behind
    slabs = [(-width / 2.0, width / 2.0, box)]
    yield _pad("stop_pad", stop.pad, BODY, slabs, (width, STOP_PAD_MM), (middle[0], 0.0, middle[1]))


def _nose_pads(layout: Layout, pad: Pad) -> Iterator[BoughtPart]:
    """Yield the pads around both lugs of the nose, from the sole up the round front."""
    sections = layout.sections
    depth, lug = sections.foot_depth_mm, sections.lug_thickness_mm
    nose, inner = nose_outline(depth), beside_leg_mm(sections.thickness_mm)
    reach = 2.0 * depth + pad.thickness_mm
    low, high, back = -depth - pad.thickness_mm, -NOSE_UP_SHARE * depth, -NOSE_BEHIND_SHARE * depth
    around = rectangle((reach - back, high - low), ((reach + back) / 2.0, (high + low) / 2.0))
    region = (grown(nose, pad.thickness_mm) - nose) ^ around
    length = region.area() / pad.thickness_mm
    for side, sign in (("left", 1.0), ("right", -1.0)):
        y = sorted((sign * inner, sign * (inner + lug)))
        at = (layout.eye_x_mm, 0.0, 0.0)
        yield _pad(f"nose_pad_{side}", pad, FOOT, [(y[0], y[1], region)], (lug, length), at)


def _toe_pads(layout: Layout, pad: Pad) -> Iterator[BoughtPart]:
    """Yield the pads under the toes' tips, or under the bars that make them wider."""
    length, width = TOE_BACK_MM + TOE_AHEAD_MM, TOE_TIP_WIDTH_MM
    bottom = -layout.sections.foot_depth_mm - pad.thickness_mm / 2.0
    tip_x, tip_y = toe_tip_mm(layout.design)
    for toe in toes.toes(layout):
        name = f"{toe.name}_pad"
        if layout.toe_bar_mm > 0.0:
            y = sorted((toe.sign * float(tip_y), toe.sign * (layout.toe_half_width_mm + TOE_AHEAD_MM)))
            slabs = [(y[0], y[1], rectangle((width, pad.thickness_mm)))]
            yield _pad(name, pad, FOOT, slabs, (width, y[1] - y[0]), (float(tip_x), 0.0, bottom))
            continue
        slabs = [(-width / 2.0, width / 2.0, rectangle((length, pad.thickness_mm)))]
        x = toe.length_mm + (TOE_AHEAD_MM - TOE_BACK_MM) / 2.0
        yield _pad(name, pad, FOOT, slabs, (width, length), (x, 0.0, bottom)).moved(toe.pose_mm)


def _pad(
    name: str, pad: Pad, body: str, slabs: list[tuple[float, float, Region]], size_mm: tuple[float, float],
    at_mm: tuple[float, float, float],
) -> BoughtPart:  # fmt: skip
    """Return a pad with the size to cut, its mass from its volume."""
    volume = sum((y1 - y0) * region.area() for y0, y1, region in slabs)
    size = f"{size_mm[0]:.1f} x {size_mm[1]:.1f}"
    article = name if pad.printed else f"{pad.description}, cut {size} mm"
    return bought(name, article, body, pad.density_g_cm3 * volume / 1000.0, slabs, at_mm)


TOE_THREAD_MM = 4.0
"""Least length of thread of a toe's screw in the foot's stub."""


def foot_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield what is bought for the foot: screws of separate toes, and pads under nose and toes that are not bare."""
    yield from _toe_screws(layout, workshop)
    if workshop.foot_pad is not None:
        yield from _nose_pads(layout, workshop.foot_pad)
        yield from _toe_pads(layout, workshop.foot_pad)


def _toe_screws(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the screws of separate toes, from outside into the foot's stubs."""
    if not layout.toes_apart:
        return
    holes, screw = HoleSizes.of(workshop, layout.hub_bearing), workshop.catalogue.screws["M3"]
    height = toes.joint_height_mm(layout, holes) / 2.0 - layout.sections.foot_depth_mm
    outer = toes.beside_mm(layout, holes) + layout.sections.toe_width_mm / 2.0
    length = screw.length_for(layout.sections.toe_width_mm + TOE_THREAD_MM)
    for toe in toes.toes(layout):
        shank = interval(toe.outside * outer, toe.outside * (outer - length))
        for number, x in enumerate(toes.SCREWS_MM, start=1):
            name, at = f"{toe.name}_screw_{number}", np.array([x, height])
            placed = placed_screw(name, FOOT, at, shank, toe.outside, screw, workshop.catalogue)
            yield placed.moved(toe.pose_mm)
