"""What links, springs, cam and axles take of the room between the plates (mm, x-z in the body frame)."""

from jumpcad.dimensions import CLEAR_MM, SPACER_RADIUS_MM
from jumpcad.drive import Drive
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot.sizing import Sections
from jumpcad.robot.space.lateral import Lateral
from jumpcad.robot.space.room import Obstacle, disc
from jumpcad.robot.space.sweep import link_obstacles
from jumpcad.transforms import Array

LEVER_HEAD_MM = 1.7
"""Left of the roller: the screw's head, 1.65 mm (ISO 7380-1 M3), rounded up."""


def swept_obstacles(
    linkage: Linkage, sections: Sections, drive: Drive, lateral: Lateral, reach_rad: float, gap_mm: float = CLEAR_MM
) -> list[Obstacle]:
    """Return the room that the links sweep, with a clearance."""
    lever_y = (lateral.roller_screw[0], lateral.roller_screw[1] + LEVER_HEAD_MM)
    cam = drive.cam
    return link_obstacles(linkage, sections, cam.lever_length_mm, cam.lever_start_rad, lever_y, gap_mm, reach_rad)


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
