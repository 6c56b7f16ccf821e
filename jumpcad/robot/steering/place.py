"""The steering wheel's place: behind the toes, its axle along the ground on which the loaded robot crouches (mm).

Its rim reaches below the feet's plane in the loaded pose alone: the robot then rests on the front eye, the wheel and
one toe, and the turning wheel walks the tail sideways round the front eye. In the axle's frame x points forwards along
the ground, y to the left, z up; its origin is the wheel's middle.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from jumpcad.catalogue import Motor, ORing
from jumpcad.dimensions import GAP_MM, TOE_TIP_WIDTH_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose, higher
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.robot.cage.place import LAP_HEIGHT_MM, Cage
from jumpcad.robot.layout import Layout, moving_obstacles
from jumpcad.robot.sizing import beside_leg_mm
from jumpcad.robot.space.inside import FOOT_POSITIONS, foot_obstacle, hub_obstacles
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, clearance, disc
from jumpcad.robot.stop.place import stop_obstacles
from jumpcad.transforms import Array, ByValue, direction, pose_about_y
from jumpcad.workshop import Workshop

LEAST_MM = 0.5
"""How much farther below the feet's plane the wheel must reach than cam and print can miss it: at this depth it turned
the robot on every floor but the softest (simulated)."""
RADIUS_MM = 10.0
"""Of a wheel that is found; judgement: smaller ones turn slowly, larger ones need more torque."""
TREAD_MM, FLANGE_MM, GROOVE_PLAY_MM = 0.85, 0.8, 0.3
"""How high the flanges beside the ring are, their thickness, and the groove's width beyond the ring's; judgement: no
higher than prints without support."""
STRETCH = 0.01
"""Least stretch of the ring in its groove; judgement: its sizes are 5 % apart, so that it is at most 7 %."""
FRONT_MM = 0.6
"""Between wheel and mount; judgement."""
WALL_MM, PLAY_MM = 1.6, 0.15
"""Walls of the mount around the motor, and play beside it, which its tie takes up; judgement."""
TAB_MM = 10.0
"""Length of its tab in either plate; judgement: it bears the wheel's moment."""
SLOT_EDGE_MM = 2.7
"""Material of the plates around the tab; judgement: a little more than around the trays'."""
LEADS_MM = 1.5
"""Ahead of the mount for the motor's leads, 1.2 mm thick and flat on its front; judgement."""
TIE_MM = 1.1
"""Thickness of the cable tie below the motor."""
FREE_MM = 1.0
"""Least distance of wheel, motor and mount from what moves, and of the motor's tie from the ground; judgement."""
STEP_MM, FARTHEST_MM = 0.5, 100.0
"""Steps in which room is looked for, and how far behind the leg's axle; judgement."""


@dataclass(frozen=True, eq=False)
class Steering(ByValue):
    """Where the wheel is, what turns it, and what its height depends on.

    Attributes
    ----------
    motor, ring
        Its gear motor, and the rubber ring on it.
    T_body_axle
        Pose (4, 4) of the axle's frame in the body's.
    radius_mm, dip_mm
        Of the wheel with its ring, and how far that reaches below the feet's plane with loaded springs.
    miss_mm
        How much less that may be where the motor stops at its earliest, the lever bends and parts are printed too high.
    behind_mm, lever_mm
        From the leg's axle and from the front eye back to the wheel, along the ground.
    base_mm
        Thickness of the mount's base.
    """

    motor: Motor
    ring: ORing
    T_body_axle: Array
    radius_mm: float
    dip_mm: float
    miss_mm: float
    behind_mm: float
    lever_mm: float
    base_mm: float

    @property
    def groove_mm(self) -> float:
        return 2.0 * (self.radius_mm - self.ring.section_mm)

    @property
    def half_width_mm(self) -> float:
        return (self.ring.section_mm + GROOVE_PLAY_MM) / 2.0 + FLANGE_MM

    @property
    def front_mm(self) -> float:
        """Where the gearhead's front is, ahead of the wheel's middle."""
        return self.half_width_mm + FRONT_MM + max(WALL_MM, self.motor.boss_length_mm)

    @property
    def shaft_mm(self) -> float:
        """How far the motor's shaft reaches behind the wheel's middle."""
        return self.motor.shaft_length_mm - self.front_mm

    @property
    def half_motor_mm(self) -> tuple[float, float]:
        """Half sizes of the motor, across and up: it lies on its broad side."""
        low, broad = sorted((self.motor.width_mm, self.motor.height_mm))
        return broad / 2.0, low / 2.0

    @property
    def half_mount_mm(self) -> float:
        """Half of the mount's width around the motor."""
        return self.half_motor_mm[0] + PLAY_MM + WALL_MM

    @property
    def base_z_mm(self) -> tuple[float, float]:
        """Lower and upper face of the mount's base."""
        low = self.half_motor_mm[1] + PLAY_MM
        return low, low + self.base_mm

    @property
    def cradle_x_mm(self) -> tuple[float, float]:
        """Where the mount begins and ends, along the axle."""
        return self.front_mm - WALL_MM - PLAY_MM, self.front_mm + self.motor.body_length_mm + PLAY_MM + WALL_MM

    @property
    def tab_mm(self) -> Array:
        """Middle (2,) of its tabs, x and z in the body's frame."""
        return self.at(sum(self.cradle_x_mm) / 2.0, sum(self.base_z_mm) / 2.0)

    @property
    def turn_deg(self) -> float:
        """Turn of the axle in the body's x-z plane, counter-clockwise."""
        return math.degrees(math.atan2(self.T_body_axle[2, 0], self.T_body_axle[0, 0]))

    @property
    def turn_per_rev_deg(self) -> float:
        """How far one turn of the wheel turns the robot round its front eye: 360·R/lever (°)."""
        return 360.0 * self.radius_mm / self.lever_mm

    def at(self, x_mm: float, z_mm: float) -> Array:
        """Return a place (2,) of the axle's x-z plane in the body's."""
        return np.asarray(self.T_body_axle[[0, 2], 3] + x_mm * self.T_body_axle[[0, 2], 0]
                          + z_mm * self.T_body_axle[[0, 2], 2])  # fmt: skip


def steering_place(layout: Layout, workshop: Workshop) -> Steering | None:
    """Return the place of a workshop's wheel, the nearest to the leg's axle that is free; None without one."""
    table = workshop.steering
    if table.wheel == "none":
        return None
    motor = workshop.catalogue.steering_motors[table.motor]
    if layout.sensor is None:
        raise CannotBuildError(
            "steering.wheel needs to know when the robot is loaded, and it has no sensor: name one in bought.sensor",
            "steering_sensor", -1.0, ways=choose("a", "bought.sensor"),
        )  # fmt: skip
    pose = layout.linkage.pose([layout.linkage.travel_rad[0]])
    foot = float(pose.foot_rad[0])
    along, up = direction(foot), direction(foot - math.pi / 2.0)
    below = layout.hub_mm - _height_mm(layout, layout.hub_mm, layout.linkage.travel_rad[0]) * up  # the leg's axle
    toes = float((pose.ankle_mm[0] - below) @ along + toe_tip_mm(layout.design)[0]) - TOE_TIP_WIDTH_MM / 2.0
    in_the_way, free = _in_the_way(layout), -math.inf
    half = min(motor.width_mm, motor.height_mm) / 2.0 + TIE_MM
    for behind in [table.behind_mm] if table.behind_mm else np.arange(0.0, FARTHEST_MM, STEP_MM).tolist():
        ground = below - behind * along
        miss = _miss_mm(layout, workshop, ground)
        dip = table.dip_mm or math.ceil(10.0 * (miss + LEAST_MM)) / 10.0
        radius = table.radius_mm or max(RADIUS_MM, math.ceil(dip + half + FREE_MM))
        frame = pose_about_y(foot, ground + (radius - dip) * up)
        frame[1, 3] = sum(layout.lateral.inside) / 2.0 - table.aside_mm
        lever = float((pose.front_eye_mm[0] - ground) @ along)
        place = Steering(motor, _ring(workshop, radius), frame, radius, dip, miss, behind, lever, table.base_mm)
        beyond = toes + behind - place.half_width_mm
        room = min(beyond, radius - dip - half, _free_mm(layout, place, in_the_way) if beyond > 0.0 else beyond)
        if room >= FREE_MM:
            return place
        free = max(free, room)
    where = f"{table.behind_mm:g} mm" if table.behind_mm else f"up to {FARTHEST_MM:g} mm"
    raise CannotBuildError(
        f"steering.wheel finds no room behind the toes, {where} behind the leg's axle: wheel, motor and mount come as "
        f"near as {free:.1f} mm to what moves, the rest stop, the cage or the ground, and {FREE_MM:g} mm are needed",
        "steering_room", free - FREE_MM,
        ways=(*choose("a smaller", "steering.motor"), *higher("compression_ratio"), "leave [steering]'s sizes 0"),
    )  # fmt: skip


def _miss_mm(layout: Layout, workshop: Workshop, point_mm: Array) -> float:
    """Return how much higher a point (2,) of the body may be than with loaded springs.

    The sensor stops the motor early, the lever, a cantilever, bends by F·L²/(3·E·I) (Shigley, table A-9), and prints
    are thicker than drawn.
    """
    assert layout.sensor is not None
    cam, sections, design = layout.drive.cam, layout.sections, layout.design
    early = cam.law.lift_rad - layout.sensor.ready_rad - layout.sensor.scatter_rad
    torque = 1000.0 * design.stiffness_nm_per_rad * (design.compression_rad + layout.drive.spring.preload_rad)
    section = sections.thickness_mm * sections.lever_root_mm**3 / 12.0
    bent = torque * cam.geometry.lever_mm / (3.0 * workshop.material("links").modulus_mpa * section)
    high = _height_mm(layout, point_mm, bent - float(cam.wind_rad(np.array([early]))[0]))
    low = _height_mm(layout, point_mm, layout.linkage.travel_rad[0])
    return high - low + workshop.safety.room_reserve_mm


def _height_mm(layout: Layout, point_mm: Array, leg_rad: float) -> float:
    """Return the height above the ground of a point (2,) of the body."""
    pose = layout.linkage.pose([leg_rad])
    up = direction(float(pose.foot_rad[0]) - math.pi / 2.0)
    return float((point_mm - pose.ankle_mm[0]) @ up) + layout.sections.ground_mm


def _ring(workshop: Workshop, radius_mm: float) -> ORing:
    """Return the largest ring that is stretched enough on a wheel of a radius."""
    rings = workshop.catalogue.o_rings.values()
    fitting = [one for one in rings if (1.0 + STRETCH) * one.inside_mm <= 2.0 * (radius_mm - one.section_mm)]
    if not fitting:
        least = min((1.0 + STRETCH) * one.inside_mm / 2.0 + one.section_mm for one in rings)
        raise CannotBuildError(
            f"steering.radius_mm = {radius_mm:g}: the smallest ring needs {least:.1f}",
            "steering_ring", radius_mm - least, ways=higher("steering.radius_mm"),
        )  # fmt: skip
    return max(fitting, key=lambda one: one.inside_mm)


def _in_the_way(layout: Layout) -> Callable[[float], list[Obstacle]]:
    """Return what moves, at any time, and what is fixed near the tail, as far as it is near enough to the middle."""
    linkage, tip = layout.linkage, float(toe_tip_mm(layout.design)[1])
    others = [one for one in moving_obstacles(layout) if one.name != "foot"]
    others += [*hub_obstacles(layout.hub_mm, layout.drive, layout.lateral, GAP_MM)]
    others += stop_obstacles(layout.stop, layout.lateral.inside)
    if (cage := layout.of(Cage)) is not None:
        half = max(LAP_HEIGHT_MM, cage.socket_mm) / 2.0
        others += [disc(bar.name, bar.place_mm, half, EVERYWHERE) for bar in cage.bars]
    inner = beside_leg_mm(layout.sections.thickness_mm)
    pose = linkage.pose(np.linspace(linkage.travel_rad[0], layout.stop.reach_rad, FOOT_POSITIONS))

    @cache
    def within(beside_mm: float) -> list[Obstacle]:
        # the toes spread backwards
        share = (beside_mm + TOE_TIP_WIDTH_MM / 2.0 + FREE_MM - inner) / max(tip - inner, FREE_MM)
        toes = float(np.clip(share, 0.1, 1.0))
        return [*others, foot_obstacle(linkage, layout.sections, pose.ankle_mm, pose.foot_rad, 0.0, toes)]

    return within


def _free_mm(layout: Layout, place: Steering, in_the_way: Callable[[float], list[Obstacle]]) -> float:
    """Return the least distance of wheel, motor, its leads, mount and the plates' tabs from what is in their way."""
    across, up = place.half_motor_mm
    begin, end = place.cradle_x_mm
    middle, beside = float(place.T_body_axle[1, 3]), place.half_mount_mm
    low, high = place.base_z_mm
    tab, slot, wheel = (begin + end) / 2.0, TAB_MM / 2.0 + SLOT_EDGE_MM, place.radius_mm
    boxes = [
        (-max(place.shaft_mm, place.half_width_mm), place.half_width_mm, -wheel, wheel,
         (middle - wheel, middle + wheel)),
        (begin, end, -up - TIE_MM, high, (middle - beside, middle + beside)),
        (end, end + LEADS_MM - FREE_MM, -up, up, (middle - beside, middle + across)),
        (tab - TAB_MM / 2.0, tab + TAB_MM / 2.0, low, high, layout.lateral.inside),
        (tab - slot, tab + slot, low - SLOT_EDGE_MM, high + SLOT_EDGE_MM, layout.lateral.outside),
    ]  # fmt: skip
    free = math.inf
    for x0, x1, z0, z1, reach in boxes:
        centre = place.at((x0 + x1) / 2.0, (z0 + z1) / 2.0)[None]
        half, met = ((x1 - x0) / 2.0, (z1 - z0) / 2.0), in_the_way(max(map(abs, reach)))
        turn = math.radians(place.turn_deg)
        free = min(free, float(clearance(met, centre, half, turn, reach, within_mm=2.0 * FREE_MM)[0]))
    return free
