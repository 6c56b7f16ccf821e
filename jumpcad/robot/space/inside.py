"""What occupies the robot's inside: intervals of y, and the room that moving links sweep in the body's frame (mm).

The lateral stack: y to the left, 0 in the middle of the main leg. From the leg to the left: roller and cam, the screw
head that holds the roller; beyond the spring the cam gear; with two stages, the first wheel; the left plate. To the
right: the spring alone, the motor's body, the right plate. The motor lies across, its shaft to the left. Bodies move
through the whole travel from loaded springs to rest, and on to the rest stop, as far as its pad gives.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Motor
from jumpcad.dimensions import (
    BUSHING_PLAY_MM,
    CLEAR_MM,
    GAP_MM,
    MOTOR_CAP_MM,
    ROLLER_HEAD_MM,
    ROLLER_WASHER_MM,
    SPACER_RADIUS_MM,
    TERMINALS_MM,
    TOE_TIP_WIDTH_MM,
)
from jumpcad.drive import Drive
from jumpcad.drive.motor import front_length_mm
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.robot.sizing import Sections
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, bar, disc
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array, direction

HEAD_GAP_MM = GAP_MM + 2.0 * BUSHING_PLAY_MM + 0.2
"""From the roller's screw to the cam gear: the play of cam and gear, each half a gap, towards the leg, half of the
leg's, and what is left then; judgement."""
SCREW_GAP_MM = GAP_MM + 2.0 * BUSHING_PLAY_MM
"""From the end of the roller's screw to the right plate: the leg may stand nearer by half of its play; judgement."""
POSITIONS = 15
"""Number of leg angles of the travel; judgement: the notches between bars at so many are less than the gaps."""
FOOT_POSITIONS = 57
"""Leg angles at which the foot is drawn: its toes are thin, and what fits between two positions would be hit."""
FOOT_SPACING_MM = 2.0
"""Distance between the points of toes and rails: notches of 0.2 mm between discs of 3 mm radius."""
ALONG = 41
"""Points along a link at which its gap to another is computed."""
LEVER_HEAD_MM = 1.7
"""Left of the roller: the screw's head, 1.65 mm (ISO 7380-1 M3), rounded up."""


@dataclass(frozen=True)
class Lateral:
    """Intervals of y (mm), each (lower, upper); the roller shares the cam's."""

    leg: Interval
    lug_left: Interval
    lug_right: Interval
    cam: Interval
    roller_screw: Interval
    gears: tuple[Interval, ...]
    motor: Interval
    motor_cap: Interval
    left_plate: Interval
    right_plate: Interval
    spring_left: Interval
    spring_right: Interval

    @property
    def inside(self) -> Interval:
        """Interval between the plates."""
        return self.right_plate[1], self.left_plate[0]

    @property
    def outside(self) -> Interval:
        """Interval over both plates."""
        return self.right_plate[0], self.left_plate[1]

    @property
    def plates_mm(self) -> tuple[float, float]:
        """Middles of the left and of the right plate: the supports of axles."""
        return sum(self.left_plate) / 2.0, sum(self.right_plate) / 2.0


def lateral_stack(
    leg_mm: float, lug_mm: float, roller_width_mm: float, spring_length_mm: float, gear_widths_mm: tuple[float, ...],
    motor: Motor, plate_mm: float, tray_width_mm: float, roller_screw_mm: float, right_mm: float = 0.0,
) -> Lateral:  # fmt: skip
    """Stack everything across the robot, with the loaded coils of springs and the gears from the cam's to the motor's.

    `tray_width_mm` is the least that the electronics need between the plates; `roller_screw_mm` the length of the
    roller's screw below its head, which lies on the roller: its end moves past the right plate, which stands `right_mm`
    further out than it must.
    """
    half = leg_mm / 2.0
    cam = (half + ROLLER_WASHER_MM, half + ROLLER_WASHER_MM + roller_width_mm)
    spring_left = (half + GAP_MM, half + GAP_MM + spring_length_mm)
    y = max(cam[1] + ROLLER_HEAD_MM + HEAD_GAP_MM, spring_left[1] + GAP_MM)
    gears = []
    for width in gear_widths_mm:
        gears.append((y, y + width))
        y += width + GAP_MM
    left = y
    front = gears[-1][0] - GAP_MM - front_length_mm(motor)
    cap = (front, front + MOTOR_CAP_MM)
    body = (front - motor.body_length_mm, front)
    spring_right = (-spring_left[1], -spring_left[0])
    screw = (cam[1] - roller_screw_mm, cam[1])
    beside_leg = min(spring_right[0] - GAP_MM, screw[0] - SCREW_GAP_MM)
    right = min(body[0] - TERMINALS_MM, beside_leg, left - tray_width_mm) - right_mm
    lug = (half + GAP_MM, half + GAP_MM + lug_mm)
    return Lateral(
        leg=(-half, half), lug_left=lug, lug_right=(-lug[1], -lug[0]), cam=cam, roller_screw=screw, gears=tuple(gears),
        motor=body, motor_cap=cap, left_plate=(left, left + plate_mm), right_plate=(right - plate_mm, right),
        spring_left=spring_left, spring_right=spring_right,
    )  # fmt: skip


def swept_obstacles(
    linkage: Linkage, sections: Sections, drive: Drive, lateral: Lateral, reach_rad: float, gap_mm: float = CLEAR_MM
) -> list[Obstacle]:
    """Return the room that main leg, lever, front link and foot sweep up to an angle past rest, with a gap all around.

    The lever sweeps with its roller, their screw and its nut.
    """
    travel, cam = np.linspace(linkage.travel_rad[0], reach_rad, POSITIONS), drive.cam.geometry
    pose = linkage.pose(travel)
    screw = lateral.roller_screw
    hub = np.broadcast_to(linkage.back_pivot_mm, pose.ankle_mm.shape)
    tips = linkage.back_pivot_mm + cam.lever_mm * direction(-cam.lever_start_rad + travel)
    front = np.broadcast_to(linkage.front_pivot_mm, pose.front_eye_mm.shape)
    wide, eye = max(sections.leg_root_mm / 2.0, sections.eye_radius_mm) + gap_mm, sections.eye_radius_mm + gap_mm
    finer = linkage.pose(np.linspace(linkage.travel_rad[0], reach_rad, FOOT_POSITIONS))
    lever_y = (screw[0], screw[1] + LEVER_HEAD_MM)
    return [
        Obstacle("main leg", bar(hub, pose.ankle_mm), wide, lateral.leg),
        Obstacle("lever", bar(hub, tips), sections.lever_root_mm / 2.0 + gap_mm, lever_y),
        Obstacle("front link", bar(front, pose.front_eye_mm), eye, lateral.leg),
        foot_obstacle(linkage, sections, finer.ankle_mm, finer.foot_rad, gap_mm),
    ]


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
