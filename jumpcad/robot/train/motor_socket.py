"""The socket on the right body plate in which the motor stands: its walls, and the ears for its cap's screws (mm)."""

from functools import lru_cache

import numpy as np

from jumpcad.dimensions import CAP_HEAD_MM, SOCKET_WALL_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.robot.layout import Layout
from jumpcad.solids.outline import Region, disc, filleted, hole, hull, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import pose_about_z
from jumpcad.workshop import Workshop


def ear_places(layout: Layout) -> list[np.ndarray]:
    """Return the two screws (2,) that hold the motor's cap on its socket."""
    across = np.array([-np.sin(layout.motor_angle_rad), np.cos(layout.motor_angle_rad)])
    reach = ear_reach_mm(layout.drive.train.motor.height_mm, layout.cap_ear_mm)
    return [layout.motor_mm + sign * reach * across for sign in (-1.0, 1.0)]


def ear_reach_mm(height_mm: float, ear_mm: float) -> float:
    """Return how far the cap's screws, in the middle of the ears, are from the axis of a motor of some height."""
    return height_mm / 2.0 + SOCKET_WALL_MM + ear_mm / 2.0


def socket_outline(layout: Layout) -> Region:
    """Return the outside of the motor's socket, which its cap shares."""
    motor = layout.drive.train.motor
    turn = float(np.degrees(layout.motor_angle_rad))
    outline = socket_about_axis(motor.width_mm, motor.height_mm, layout.cap_ear_mm)
    return outline.rotate(turn).translate(tuple(layout.motor_mm))


@lru_cache(maxsize=32)
def socket_about_axis(width_mm: float, height_mm: float, ear_mm: float) -> Region:
    """Return the outside of the socket for a motor of some width and height about its axis, ears along y."""
    wall = 2.0 * (SOCKET_WALL_MM + 0.2)
    ears = hull(disc(ear_mm, (0.0, sign * ear_reach_mm(height_mm, ear_mm))) for sign in (-1.0, 1.0))
    return filleted(rectangle((width_mm + wall, height_mm + wall)) + ears, 1.0)


def motor_box(layout: Layout, width_mm: float, height_mm: float) -> Region:
    """Return a rectangle about the motor's axis, turned as the motor is."""
    turn = float(np.degrees(layout.motor_angle_rad))
    return rectangle((width_mm, height_mm)).rotate(turn).translate(tuple(layout.motor_mm))


CAP_HEAD_DEPTH_MM = 1.6


def motor_cap(layout: Layout, workshop: Workshop) -> Drawing:
    """Return the cap that closes the motor's socket in front of the gearbox."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    y0, y1 = layout.lateral.motor_cap
    motor = layout.drive.train.motor
    pose = lying_on_right(y0, *layout.motor_mm) @ pose_about_z(-layout.motor_angle_rad)
    boss_mm, screw_mm = holes.running(motor.boss_mm), holes.fits.m2_clearance_mm
    stack = _cap(motor.width_mm, motor.height_mm, layout.cap_ear_mm, boss_mm, y1 - y0, screw_mm)
    return Drawing("motor_cap", "body", stack, (Placement(BODY, pose),))


@lru_cache(maxsize=32)
def _cap(
    width_mm: float, height_mm: float, ear_mm: float, boss_mm: float, thickness_mm: float, screw_mm: float
) -> Stack:
    """Return the cap of a motor about its axis, ears along y, with a hole for its boss and seats for screws' heads."""
    ears = [(0.0, sign * ear_reach_mm(height_mm, ear_mm)) for sign in (-1.0, 1.0)]
    outline = socket_about_axis(width_mm, height_mm, ear_mm) - hole(boss_mm)
    seat = thickness_mm - CAP_HEAD_DEPTH_MM
    screws, heads = (union(hole(diameter, ear) for ear in ears) for diameter in (screw_mm, CAP_HEAD_MM))
    return Stack.of([(0.0, seat, outline - screws), (seat, thickness_mm, outline - heads)])
