"""The room that the moving links sweep in the body's frame, as obstacles (numpy only, mm).

Bodies move through the whole travel from loaded springs to rest, and on to the rest stop, as far as its pad gives.
"""

import math

import numpy as np

from jumpcad.dimensions import CLEAR_MM, SPACER_RADIUS_MM, TOE_TIP_WIDTH_MM
from jumpcad.drive import Drive
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.robot.sizing import Sections
from jumpcad.robot.space.lateral import Lateral
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, bar, disc
from jumpcad.transforms import Array, direction

POSITIONS = 15
"""Number of leg angles of the travel; judgement: the notches between bars at so many are less than the gaps."""
FOOT_POSITIONS = 57
"""Leg angles at which the foot is drawn: its toes are thin, and what fits between two positions would be hit."""
FOOT_SPACING_MM = 2.0
"""Distance between the points of toes and rails: notches of 0.2 mm between discs of 3 mm radius."""
ALONG = 41
"""Points along a link at which its gap to another is computed."""


def link_obstacles(
    linkage: Linkage, sections: Sections, lever_mm: float, lever_start_rad: float, lever_y: tuple[float, float],
    gap_mm: float, reach_rad: float,
) -> list[Obstacle]:  # fmt: skip
    """Return the room that main leg, lever, front link and foot sweep up to an angle past rest, with a gap all around.

    `lever_start_rad` is the lever's direction at rest, counter-clockwise from the body's x axis, `lever_y` the interval
    of y that it occupies with its roller, screw and nut.
    """
    travel = np.linspace(linkage.travel_rad[0], reach_rad, POSITIONS)
    pose = linkage.pose(travel)
    half_y = sections.thickness_mm / 2.0
    leg_y = (-half_y, half_y)
    hub = np.broadcast_to(linkage.back_pivot_mm, pose.ankle_mm.shape)
    tips = linkage.back_pivot_mm + lever_mm * direction(-lever_start_rad + travel)
    front = np.broadcast_to(linkage.front_pivot_mm, pose.front_eye_mm.shape)
    leg = Obstacle(
        "main leg", bar(hub, pose.ankle_mm), max(sections.leg_root_mm / 2.0, sections.eye_radius_mm) + gap_mm, leg_y
    )
    lever = Obstacle("lever", bar(hub, tips), sections.lever_root_mm / 2.0 + gap_mm, lever_y)
    link = Obstacle("front link", bar(front, pose.front_eye_mm), sections.eye_radius_mm + gap_mm, leg_y)
    finer = linkage.pose(np.linspace(linkage.travel_rad[0], reach_rad, FOOT_POSITIONS))
    return [leg, lever, link, foot_obstacle(linkage, sections, finer.ankle_mm, finer.foot_rad, gap_mm)]


def legs_apart_mm(linkage: Linkage, sections: Sections, reach_rad: float = 0.0) -> float:
    """Return the smallest gap between main leg and front link, which move in one plane, as far as past rest."""
    travel = np.linspace(linkage.travel_rad[0], reach_rad, POSITIONS)
    pose = linkage.pose(travel)
    share = np.linspace(0.0, 1.0, ALONG)
    leg = linkage.back_pivot_mm + share[:, None] * (pose.ankle_mm - linkage.back_pivot_mm)[:, None]
    front = linkage.front_pivot_mm + share[:, None] * (pose.front_eye_mm - linkage.front_pivot_mm)[:, None]
    leg_half = (sections.leg_root_mm + share * (sections.leg_tip_mm - sections.leg_root_mm)) / 2.0
    leg_half[-1] = max(leg_half[-1], sections.eye_radius_mm)
    front_half = np.full(ALONG, sections.front_mm / 2.0)
    front_half[[0, -1]] = sections.eye_radius_mm
    x, z = (leg[..., axis, None] - front[:, None, :, axis] for axis in (0, 1))  # in place: half the time
    x *= x
    z *= z
    x += z
    gap = np.sqrt(x, out=x)
    gap -= leg_half[:, None]
    gap -= front_half
    return float(gap.min())


def foot_obstacle(
    linkage: Linkage, sections: Sections, ankle_mm: Array, foot_rad: Array, gap_mm: float, toes: float = 1.0
) -> Obstacle:
    """Return the foot from toe tips, or a share of the way to them, to nose: lugs, and toes and rails on the sole."""
    along, up = direction(foot_rad), direction(foot_rad - math.pi / 2.0)
    reach_mm, depth = toes * (toe_tip_mm(linkage.design)[0] - TOE_TIP_WIDTH_MM / 2.0), sections.foot_depth_mm
    eyes = np.concatenate([ankle_mm, ankle_mm + linkage.l4 * along])
    points, radii = [eyes], [np.full(len(eyes), depth + gap_mm)]
    ends = (
        (reach_mm, sections.toe_root_mm, sections.toe_tip_height_mm),
        (linkage.l4, sections.rail_root_mm, sections.rail_tip_mm),
    )
    for reach, root, tip in ends:
        start, end = ankle_mm + (root / 2.0 - depth) * up, ankle_mm + reach * along + (tip / 2.0 - depth) * up
        points.append(bar(start, end, FOOT_SPACING_MM))
        radii.append(np.tile(np.linspace(root, tip, len(points[-1]) // len(start)) / 2.0 + gap_mm, len(start)))
    return Obstacle("foot", np.concatenate(points), np.concatenate(radii), EVERYWHERE)


LEVER_HEAD_MM = 1.7
"""Left of the roller: the screw's head, 1.65 mm (ISO 7380-1 M3), rounded up."""


def swept_obstacles(
    linkage: Linkage, sections: Sections, drive: Drive, lateral: Lateral, reach_rad: float, gap_mm: float = CLEAR_MM
) -> list[Obstacle]:
    """Return the room that the links sweep, with a clearance."""
    lever_y = (lateral.roller_screw[0], lateral.roller_screw[1] + LEVER_HEAD_MM)
    cam = drive.cam
    return link_obstacles(
        linkage, sections, cam.geometry.lever_mm, cam.geometry.lever_start_rad, lever_y, gap_mm, reach_rad
    )


def hub_obstacles(hub: Array, drive: Drive, lateral: Lateral, gap_mm: float = CLEAR_MM) -> list[Obstacle]:
    """Return both springs, with a gap all around, and the axle that they are on."""
    coil = drive.spring.outer_diameter_mm / 2.0 + gap_mm
    return [
        disc("left spring", hub, coil, lateral.spring_left),
        disc("right spring", hub, coil, lateral.spring_right),
        axle_obstacle("leg axle", hub, lateral),
    ]


def cam_obstacles(axis: Array, drive: Drive, lateral: Lateral) -> list[Obstacle]:
    """Return cam, cam gear, the dog between them and their axle."""
    wheel = drive.train.stages[-1].wheel
    return [
        disc("cam", axis, drive.cam.outer_radius_mm + CLEAR_MM, lateral.cam),
        disc("cam's dog", axis, drive.dog.outer_mm / 2.0 + CLEAR_MM, (lateral.cam[1], lateral.gears[0][0])),
        disc("cam gear", axis, wheel.tip_radius_mm + CLEAR_MM, lateral.gears[0]),
        axle_obstacle("cam axle", axis, lateral),
    ]


def axle_obstacle(name: str, place: Array, lateral: Lateral) -> Obstacle:
    """Return an axle with its spacers, from plate to plate."""
    return disc(name, place, SPACER_RADIUS_MM + CLEAR_MM, lateral.inside)
