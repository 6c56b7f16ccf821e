"""Small printed parts: motor cap, spring bushings, spacers (mm)."""

from functools import lru_cache

import numpy as np

from jumpcad.dimensions import BUSHING_PLAY_MM, CAP_HEAD_MM, SPACER_RADIUS_MM
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_left, lying_on_right
from jumpcad.robot.layout import Layout
from jumpcad.robot.train.motor_socket import ear_reach_mm, socket_about_axis
from jumpcad.solids.outline import disc, hole, ring, union
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


def spring_bushing(layout: Layout, workshop: Workshop, side: str) -> Drawing:
    """Return the bushing inside one spring: a mandrel from the leg under the coil, then a spacer out to the plate."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    lateral, spring = layout.lateral, layout.drive.spring
    inner, outer = lateral.leg[1] + BUSHING_PLAY_MM, lateral.spring_left[1]
    wall = (lateral.inside[1] if side == "left" else -lateral.inside[0]) - layout.boss_mm
    mandrel, spacer = disc(spring.mandrel_mm), disc(layout.spring_bore_room_mm)
    bore = hole(holes.running(layout.axle_mm))
    end = wall - BUSHING_PLAY_MM
    slabs = [(0.0, min(outer, end) - inner, mandrel - bore)]
    slabs += [(outer - inner, end - inner, spacer - bore)] if end > outer else []
    x, z = layout.hub_mm
    # printed mandrel down; on the left the mandrel lies to the right, on the right to the left
    pose = lying_on_right(inner, x, z) if side == "left" else lying_on_left(-inner, x, z)
    return Drawing(f"spring_bushing_{side}", "body", Stack.of(slabs), (Placement(BODY, pose),))


def require_axle(workshop: Workshop) -> None:
    """Reject axles around which the spacers' tubes would have no wall.

    Raises
    ------
    JumpcadError
        Naming the thickest axle that they hold.
    """
    axle, fits = workshop.bought.axle_mm, workshop.fits.drawn
    thickest = 2.0 * (SPACER_RADIUS_MM - fits.sliding_mm - fits.wall_min_mm)
    if axle > thickest:
        raise JumpcadError(
            f"bought.axle_mm = {axle:g} is more than {thickest:g}, the most with which spacers of "
            f"{2.0 * SPACER_RADIUS_MM:g} mm keep a wall of fits.wall_min_mm = {fits.wall_min_mm:g}: use a thinner axle"
        )


def spacer(layout: Layout, workshop: Workshop, name: str, places: list[tuple[np.ndarray, float, float]]) -> Drawing:
    """Return tubes on axles: copies of one length, each at a place (2,) from y0 to y1."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    length = places[0][2] - places[0][1]
    tube = _tube(2.0 * SPACER_RADIUS_MM, holes.running(layout.axle_mm), length)
    placements = tuple(Placement(BODY, lying_on_right(y0, place[0], place[1])) for place, y0, _ in places)
    return Drawing(name, "body", tube, placements)


@lru_cache(maxsize=32)
def _tube(outer_mm: float, bore_mm: float, length_mm: float) -> Stack:
    return Stack.of([(0.0, length_mm, ring(outer_mm, bore_mm))])
