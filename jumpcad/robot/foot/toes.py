"""The foot's toes: fingers from the ankle to their tips, one piece with the foot where the bed is large enough.

Where it is not, each toe is a separate part, screwed to a stub of the foot from outside. Stub and toe lie side by
side, so that both keep their height where the push-off bends them, and two cross screws carry the moment.

A toe's own frame has its origin at the root and x towards the tip; its printing frame is the same, on the ground.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import TOE_TIP_WIDTH_MM
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, upright
from jumpcad.robot.layout import Layout
from jumpcad.robot.sizing import beside_leg_mm
from jumpcad.solids.blocks import Bar, Block, Blocks, Finger, Turned
from jumpcad.solids.outline import Region, hole, polygon, rectangle, union
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

JOINT_MM = (12.0, 34.0)
"""Where a separate toe and its stub overlap, from the root; judgement."""
SCREWS_MM = (16.0, 30.0)
"""Where the cross screws are, from the root; judgement: as far apart as the overlap allows."""
GRIP_MM, GRIP_WIDTH_MM, GRIP_PITCH_MM = 0.4, 0.8, 2.4
"""Depth, width and distance of the grooves in the sole, across the toe; judgement: two layers, two printed lines.
"""
GRIP_EDGE_MM = 1.0
"""Distance from a groove's end to the edge of the toe's tip; judgement: two printed lines."""
PIN_END_MM = 7.0
"""Diameter cut out of the toes around the ends of the ankle's pin: a clip of 6.3 mm (DIN 6799), or a head of 5 mm."""
NOTCH_MM = 4.0
"""Along the pin, beyond the boss, over which that may cut into a toe; judgement: bending there is at most 1.3 times
that of the whole toe (Kenan 1.0, measured on the mesh), and the pin can be pushed in past the toe."""
ROOF = 1.15
"""Height of a lying hole's flat roof over its radius: it leaves a flat of a quarter of the width."""


@dataclass(frozen=True)
class Toe:
    """Where one toe is: its root (2,) in the foot's frame, its direction, and its length to the tip's middle.

    `sign` is +1 for the left one; `outside` is the side of its frame's x axis on which a separate toe lies.
    """

    name: str
    sign: float
    root_mm: Array
    angle_rad: float
    length_mm: float

    @property
    def outside(self) -> float:
        """-1 for the left toe, whose y axis points inwards."""
        return -self.sign

    @property
    def pose_mm(self) -> Array:
        """Pose (4, 4) of the toe's frame, at the height of the ankle, in the foot's frame."""
        pose = np.eye(4)
        cos, sin = math.cos(self.angle_rad), math.sin(self.angle_rad)
        pose[:2, :2] = [[cos, -sin], [sin, cos]]
        pose[:2, 3] = self.root_mm
        return pose


def toes(layout: Layout) -> tuple[Toe, Toe]:
    left, right = (_toe(layout, name, sign) for name, sign in (("toe_left", 1.0), ("toe_right", -1.0)))
    return left, right


def joint_height_mm(layout: Layout, holes: HoleSizes) -> float:
    """Return the height of stub and toe where they are screwed: the screw's hole with two walls above and below."""
    return max(layout.sections.toe_root_mm, holes.fits.m3_clearance_mm + 4.0 * holes.fits.wall_mm)


def beside_mm(layout: Layout, holes: HoleSizes) -> float:
    """Return how far beside its stub a separate toe lies, from middle to middle."""
    return layout.sections.toe_width_mm + holes.fits.sliding_mm


def on_the_foot(layout: Layout, holes: HoleSizes) -> tuple[list[Block], list[Block]]:
    """Return the foot's share of its toes, standing on the bed, and the cuts in it."""
    added: list[Block] = []
    removed: list[Block] = []
    width, height = layout.sections.toe_width_mm, joint_height_mm(layout, holes)
    stub = Finger(np.zeros(2), width, height, np.array([JOINT_MM[1] - width / 2.0, 0.0]), width, height)
    for toe in toes(layout):
        if layout.toes_apart:
            added.append(Turned(stub, toe.angle_rad, toe.root_mm))
            removed.append(Turned(_holes(layout, holes, holes.fits.m3_tap_mm, 0.0), toe.angle_rad, toe.root_mm))
        else:
            blocks = (_finger(layout, np.zeros(2), toe.length_mm), *_bar(layout, toe))
            added += [Turned(block, toe.angle_rad, toe.root_mm) for block in blocks]
            removed += [Turned(cut, toe.angle_rad, toe.root_mm) for cut in _grip(layout, toe)]
    return added, removed


def toes_apart(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return the toes that are separate parts."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    return [_drawing(layout, holes, toe) for toe in toes(layout)] if layout.toes_apart else []


def lying_hole(diameter_mm: float, place_mm: tuple[float, float]) -> Region:
    """Return a hole that prints lying: round, with a 45° roof to a flat of a quarter of its width."""
    radius = diameter_mm / 2.0
    side, top = radius * math.sqrt(0.5), ROOF * radius
    flat = radius * math.sqrt(2.0) - top
    roof = polygon([(-side, side), (-flat, top), (flat, top), (side, side)])
    return hole(diameter_mm, place_mm) + roof.translate(place_mm)


def _toe(layout: Layout, name: str, sign: float) -> Toe:
    """Return a toe whose root is beside the ankle, or as far behind as it takes to leave the ankle's pin its way."""
    sections, tip = layout.sections, toe_tip_mm(layout.design)
    beside = beside_leg_mm(sections.thickness_mm) + sections.toe_width_mm / 2.0
    sideways = math.atan2(tip[1] - beside, -tip[0])
    root = np.array([-_behind_mm(sideways, sections.toe_width_mm), beside]) * (1.0, sign)
    along = tip * (1.0, sign) - root
    return Toe(name, sign, root, math.atan2(along[1], along[0]), float(np.hypot(*along)))


def _behind_mm(sideways_rad: float, width_mm: float) -> float:
    """Return how far behind the ankle the root of a toe is that points sideways by an angle from straight back.

    With the root at a distance b, its front edge is w/2·tan(a/2) - b before the ankle at the boss's face, and goes back
    by 1/tan(a) along the pin: `NOTCH_MM` beyond the face it is to be half of `PIN_END_MM` behind.
    """
    sin, cos = math.sin(sideways_rad), math.cos(sideways_rad)
    missing = PIN_END_MM / 2.0 * sin + width_mm / 2.0 * (1.0 - cos) - NOTCH_MM * cos
    return missing / sin if missing > 0.0 else 0.0


def _drawing(layout: Layout, holes: HoleSizes, toe: Toe) -> Drawing:
    """Return a separate toe: beside the stub, then on to the tip."""
    width, height = layout.sections.toe_width_mm, joint_height_mm(layout, holes)
    y = toe.outside * beside_mm(layout, holes)
    start, end = np.array([JOINT_MM[0] + width / 2.0, y]), np.array([JOINT_MM[1], y])
    joint = Finger(start, width, height, end, width, height)
    cut = _holes(layout, holes, holes.fits.m3_clearance_mm, y)
    shape = Blocks((joint, _finger(layout, end, toe.length_mm), *_bar(layout, toe)), (cut, *_grip(layout, toe)))
    pose = toe.pose_mm @ upright(-layout.sections.foot_depth_mm)
    return Drawing(toe.name, "links", shape, (Placement(FOOT, pose),))


def _finger(layout: Layout, start_mm: Array, length_mm: float) -> Finger:
    """Return a toe from somewhere near its root to its tip: flat below, higher at the root."""
    sections = layout.sections
    tip = np.array([length_mm, 0.0])
    return Finger(
        start_mm, sections.toe_width_mm, sections.toe_root_mm, tip, TOE_TIP_WIDTH_MM, sections.toe_tip_height_mm
    )


def _bar(layout: Layout, toe: Toe) -> list[Finger]:
    """Return the bar from a toe's tip outwards, across the robot, where toes are to reach further than the design's."""
    if layout.toe_bar_mm <= 0.0:
        return []
    height, along = layout.sections.toe_tip_height_mm, np.array([math.sin(toe.angle_rad), math.cos(toe.angle_rad)])
    tip = np.array([toe.length_mm, 0.0])
    end = tip + toe.sign * layout.toe_bar_mm * along
    return [Finger(tip, TOE_TIP_WIDTH_MM, height, end, TOE_TIP_WIDTH_MM, height)]


def _holes(layout: Layout, holes: HoleSizes, diameter_mm: float, y_mm: float) -> Bar:
    """Return the screws' holes through stub or toe, whose middle is at y."""
    half = layout.sections.toe_width_mm / 2.0 + 1.0
    middle = joint_height_mm(layout, holes) / 2.0
    return Bar(union(lying_hole(diameter_mm, (x, middle)) for x in SCREWS_MM), ((y_mm - half, y_mm + half),))


def _grip(layout: Layout, toe: Toe) -> list[Block]:
    """Return grooves across the sole under a toe's tip, where no pad is glued on."""
    if layout.sections.pad_mm:
        return []
    places = [(toe.length_mm + step * GRIP_PITCH_MM, 0.0) for step in (-0.5, 0.5)]
    half = TOE_TIP_WIDTH_MM / 2.0 - GRIP_EDGE_MM
    return [Bar(union(rectangle((GRIP_WIDTH_MM, 2.0 * GRIP_MM), place) for place in places), ((-half, half),))]
