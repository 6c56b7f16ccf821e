"""What is bought for the foot: the screws of toes that are separate parts, and pads (mm, g)."""

from collections.abc import Iterator

import numpy as np

from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.purchased import BoughtPart
from jumpcad.parts.simple import interval, placed_screw
from jumpcad.robot.foot import toes
from jumpcad.robot.foot.pads import foot_pads
from jumpcad.robot.layout import Layout
from jumpcad.workshop import Workshop

TOE_THREAD_MM = 4.0
"""Least length of thread of a toe's screw in the foot's stub."""


def foot_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield what is bought for the foot: screws, and pads."""
    yield from toe_screws(layout, workshop)
    yield from foot_pads(layout, workshop)


def toe_screws(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the screws of separate toes, from outside into the foot's stubs."""
    if not layout.toes_apart:
        return
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    screw, height = (
        workshop.catalogue.screws["M3"],
        toes.joint_height_mm(layout, holes) / 2.0 - layout.sections.foot_depth_mm,
    )
    outer = toes.beside_mm(layout, holes) + layout.sections.toe_width_mm / 2.0
    length = screw.length_for(layout.sections.toe_width_mm + TOE_THREAD_MM)
    for toe in toes.toes(layout):
        pose = toe.pose_mm
        shank = interval(toe.outside * outer, toe.outside * (outer - length))
        for number, x in enumerate(toes.SCREWS_MM, start=1):
            name = f"{toe.name}_screw_{number}"
            yield placed_screw(name, FOOT, np.array([x, height]), shank, toe.outside, screw, workshop.catalogue).moved(
                pose
            )
