"""The cap that closes the motor's socket (mm)."""

from functools import lru_cache

from jumpcad.dimensions import CAP_HEAD_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.robot.layout import Layout
from jumpcad.robot.train.motor_socket import ear_reach_mm, socket_about_axis
from jumpcad.solids.outline import hole, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import pose_about_z
from jumpcad.workshop import Workshop

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
