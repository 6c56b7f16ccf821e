"""The socket on the right body plate in which the motor stands: its walls, and the ears for its cap's screws (mm)."""

from functools import lru_cache

import numpy as np

from jumpcad.dimensions import SOCKET_WALL_MM
from jumpcad.robot.layout import Layout
from jumpcad.solids.outline import Region, disc, filleted, hull, rectangle


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
