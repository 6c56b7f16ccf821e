"""The room that the moving links sweep in the body's frame, as obstacles (numpy only, mm).

Bodies move through the whole travel from loaded springs to rest; leg and lever swing a little past rest after take-off.
"""

import math

import numpy as np

from jumpcad.layout.room import EVERYWHERE, Obstacle, bar
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.strength.sizing import Sections
from jumpcad.transforms import Array, direction

POSITIONS = 13
"""Number of leg angles of the travel; judgement: the notches between bars at so many are less than the gaps."""
ALONG = 41
"""Points along a link at which its gap to another is computed."""
OVERSHOOT_RAD = math.radians(8.0)
"""Swing past rest that stays free, judgement; the cam leaves its own room for the roller's overshoot."""


def link_obstacles(
    linkage: Linkage,
    sections: Sections,
    lever_mm: float,
    lever_start_rad: float,
    lever_y: tuple[float, float],
    gap_mm: float,
) -> list[Obstacle]:
    """Return the room that main leg, lever, front link and foot sweep.

    Parameters
    ----------
    linkage, sections
        The mechanism and its dimensions.
    lever_mm, lever_start_rad
        Length of the lever and its direction at rest, counter-clockwise from the body's x axis.
    lever_y
        Interval of y that the lever occupies with its roller, screw and nut.
    gap_mm
        Added all around.
    """
    travel = np.linspace(*linkage.travel_rad, POSITIONS)
    pose = linkage.pose(travel)
    half_y = sections.thickness_mm / 2.0
    leg_y = (-half_y, half_y)
    swing = np.append(travel, OVERSHOOT_RAD)
    ankles = linkage.back_pivot_mm + linkage.l2 * direction(linkage.rest_rad + swing)
    hub = np.broadcast_to(linkage.back_pivot_mm, ankles.shape)
    tips = linkage.back_pivot_mm + lever_mm * direction(-lever_start_rad + swing)
    front = np.broadcast_to(linkage.front_pivot_mm, pose.front_eye_mm.shape)
    leg = Obstacle(
        "main leg", bar(hub, ankles), max(sections.leg_root_mm / 2.0, sections.eye_radius_mm) + gap_mm, leg_y
    )
    lever = Obstacle("lever", bar(hub, tips), sections.lever_root_mm / 2.0 + gap_mm, lever_y)
    link = Obstacle("front link", bar(front, pose.front_eye_mm), sections.eye_radius_mm + gap_mm, leg_y)
    return [leg, lever, link, _foot(linkage, sections, pose.ankle_mm, pose.foot_rad, gap_mm)]


def legs_apart_mm(linkage: Linkage, sections: Sections) -> float:
    """Return the smallest gap over the travel between main leg and front link, which move in one plane."""
    travel = np.linspace(*linkage.travel_rad, POSITIONS)
    pose = linkage.pose(travel)
    share = np.linspace(0.0, 1.0, ALONG)
    leg = linkage.back_pivot_mm + share[:, None] * (pose.ankle_mm - linkage.back_pivot_mm)[:, None]
    front = linkage.front_pivot_mm + share[:, None] * (pose.front_eye_mm - linkage.front_pivot_mm)[:, None]
    leg_half = (sections.leg_root_mm + share * (sections.leg_tip_mm - sections.leg_root_mm)) / 2.0
    leg_half[-1] = max(leg_half[-1], sections.eye_radius_mm)
    front_half = np.full(ALONG, sections.front_mm / 2.0)
    front_half[[0, -1]] = sections.eye_radius_mm
    distance = np.linalg.norm(leg[:, :, None] - front[:, None, :], axis=-1)
    return float((distance - leg_half[:, None] - front_half).min())


def _foot(linkage: Linkage, sections: Sections, ankle_mm: Array, foot_rad: Array, gap_mm: float) -> Obstacle:
    """Return the foot from toe tips to nose, as high as its highest part."""
    along = direction(foot_rad)
    toes = toe_tip_mm(linkage.design)[0]
    points = bar(ankle_mm + toes * along, ankle_mm + linkage.l4 * along)
    height = max(max(sections.toe_root_mm, sections.rail_root_mm) - sections.foot_depth_mm, sections.eye_radius_mm)
    return Obstacle("foot", points, height + gap_mm, EVERYWHERE)
