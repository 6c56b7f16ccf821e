"""Sections, hub bearing and drive settled together: each follows from the others.

A bearing sets the hub's width and with it the sections; these set the drive's limits; the drive's forces load the
bearing. The lightest bearing is tried first, then the next that carries those forces, until one carries its own.
"""

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from jumpcad.building.limits import drive_limits
from jumpcad.catalogue import Bearing
from jumpcad.design import Design
from jumpcad.dimensions import GAP_MM, SPACER_RADIUS_MM
from jumpcad.drive import Drive, DriveLimits, synthesise
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FRONT_LINK, MAIN_LEG, Body, Spring
from jumpcad.mechanism.planar import reflected_mass
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sizing import RESERVE, TYPICAL_BODY, Sections, sections
from jumpcad.robot.springs.place import PLATE_PINS_RAD
from jumpcad.robot.stop.place import GIVE_ROOM_RAD
from jumpcad.strength.bearings import (
    allowed_n,
    bearing_load_n,
    first_guess,
    hub_bearings,
    hub_width_mm,
    loaded_forces_n,
    roller_bearing,
)
from jumpcad.strength.growth import Growth
from jumpcad.workshop import Workshop


@dataclass(frozen=True)
class Settled:
    """The quantities of a robot that depend on each other; `holes` has the hub's bearing."""

    linkage: Linkage
    sections: Sections
    holes: HoleSizes
    drive: Drive
    roller: Bearing


def solve_bearing_and_drive(
    design: Design, workshop: Workshop, growth: Growth, plate_pins_rad: tuple[float, ...] = PLATE_PINS_RAD
) -> Settled:
    """Return linkage, sections, holes and drive with the lightest hub bearing that carries its load.

    Where none does, it is the strongest one, of which `jumpcad.checks` then warns. `plate_pins_rad` are the directions
    of the plates' pin that the springs may have, the preferred one first.
    """
    linkage, roller = Linkage(design), roller_bearing(workshop)
    bearings = hub_bearings(workshop)
    springs = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    falls_s = fall_s(linkage, springs, math.radians(workshop.body.stop_deg) + GIVE_ROOM_RAD)

    @cache
    def drive_within(limits: DriveLimits) -> Drive:
        return synthesise(design, limits, workshop.catalogue)

    def with_bearing(bearing: Bearing | None) -> Settled:
        sizes = sections(linkage, workshop, hub_width_mm(bearing), growth)
        holes = HoleSizes.of(workshop, bearing)
        limits = drive_limits(workshop, roller, sizes, holes, plate_pins_rad)
        drive = drive_within(replace(limits, fall_s=falls_s))
        return Settled(linkage, sizes, holes, drive, roller)

    number = first_guess(bearings, design, workshop)
    while True:
        settled = with_bearing(bearings[number])
        stronger = next(
            (index for index in range(number, len(bearings)) if _carries(bearings[index], settled, workshop)),
            len(bearings) - 1,
        )
        if stronger == number:
            _require_hub_room(settled)
            return settled
        number = stronger


def fall_s(linkage: Linkage, spring: Spring, past_rad: float) -> float:
    """Return the time from release to an angle past rest, with a typical mass of the body and a reserve (s)."""
    body, still = TYPICAL_BODY, np.zeros((3, 3))
    inertia = still.copy()
    inertia[1, 1] = body.mass_kg * (body.gyration_mm / 1000.0) ** 2
    com = np.array([body.com_mm[0], 0.0, body.com_mm[1]]) / 1000.0
    bodies = {BODY: Body(BODY, body.mass_kg, com, inertia)}
    bodies |= {name: Body(name, 0.0, np.zeros(3), still) for name in (MAIN_LEG, FRONT_LINK)}
    return RESERVE * reflected_mass(bodies, linkage).push_off_s(spring, past_rad)


def _carries(bearing: Bearing | None, settled: Settled, workshop: Workshop) -> bool:
    """Tell whether a hub bearing carries the forces of springs and cam; a plain hub is not checked."""
    if bearing is None:
        return True
    forces = loaded_forces_n(settled.linkage.design, settled.drive)
    load = bearing_load_n(forces, settled.sections.thickness_mm, settled.roller.width_mm, bearing)
    return load <= allowed_n(bearing, workshop)


def _require_hub_room(settled: Settled) -> None:
    """Reject bearings whose seat cuts the roller's screw in the lever, or whose hub touches the cam axle's spacer."""
    holes, cam = settled.holes, settled.drive.cam
    if holes.bearing is None:
        return
    wall = holes.hub_radius_mm - holes.hub_bore_mm / 2.0
    to_screw = cam.lever_length_mm - holes.m3_clearance_mm / 2.0 - holes.fits.wall_min_mm
    to_spacer = math.hypot(*cam.cam_axis_mm) - SPACER_RADIUS_MM - GAP_MM - wall
    largest = 2.0 * (min(to_screw, to_spacer) - holes.fits.press_mm)
    if holes.bearing.outer_mm > largest:
        raise CannotBuildError(
            f"the leg's bearing {holes.bearing.name} has {holes.bearing.outer_mm:g} mm diameter; {largest:.1f} mm fit "
            "beside the roller's screw and the cam's axle",
            "leg_bearing", largest - holes.bearing.outer_mm, ways=choose("a smaller", "bought.leg_bearing"),
        )  # fmt: skip
