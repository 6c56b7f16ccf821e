"""Sections, hub bearing and drive settled together: each follows from the others.

A bearing sets the hub's width and with it the sections; these set the drive's limits; the drive's forces load the
bearing. The lightest bearing is tried first, then the next that carries those forces, until one carries its own.
"""

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from jumpcad.catalogue import Bearing
from jumpcad.design import Design
from jumpcad.dimensions import CLEAR_MM, GAP_MM, LEVER_EYE_RADIUS_MM, SPACER_RADIUS_MM
from jumpcad.drive import CamLimits, Drive, DriveLimits, SpringLimits, TrainLimits, synthesise
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.electronics.supply import chosen_parts, supply_of
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FRONT_LINK, MAIN_LEG, Body, Spring
from jumpcad.mechanism.planar import reflected_mass
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sensor.place import track_mm
from jumpcad.robot.sizing import RESERVE, TYPICAL_BODY, Sections, sections
from jumpcad.robot.springs.place import PLATE_PINS_RAD
from jumpcad.robot.stop.place import GIVE_ROOM_RAD
from jumpcad.strength import bearings as strength_bearings
from jumpcad.strength.growth import Growth
from jumpcad.strength.stress import spring_share
from jumpcad.workshop import Workshop


def drive_limits(
    workshop: Workshop, roller: Bearing, sections: Sections, holes: HoleSizes,
    plate_pins_rad: tuple[float, ...] = PLATE_PINS_RAD,
) -> DriveLimits:  # fmt: skip
    """Return the limits of the drive in a workshop, with a roller of the catalogue, beside a main leg of some size.

    `plate_pins_rad` are the directions of the plates' pin that the springs may have, the preferred one first.
    """
    return DriveLimits(
        spring=_spring_limits(workshop, sections, holes, plate_pins_rad), cam=_cam_limits(workshop, roller, sections),
        train=_train_limits(workshop, sections), motors=workshop.bought.motors, dog_mm=sections.dog_mm,
        stock_spring=workshop.stock_spring, preload_rad=math.radians(workshop.spring.preload_deg),
    )  # fmt: skip


def _spring_limits(
    workshop: Workshop, sections: Sections, holes: HoleSizes, plate_pins_rad: tuple[float, ...]
) -> SpringLimits:
    """Return the limits of the springs: a bushing around the leg's axle, and a pin that passes hub and leg."""
    fits, safety, axle = workshop.fits.drawn, workshop.safety, workshop.bought.axle_mm
    hub_radius = max(holes.hub_radius_mm, sections.leg_root_mm / 2.0)
    share = min(safety.spring_stress_share, spring_share(safety.jumps)) / (1.0 + safety.stress_reserve)
    mandrel, pin = axle / 2.0 + fits.sliding_mm + fits.wall_min_mm, hub_radius + CLEAR_MM + axle / math.sqrt(2.0)
    return SpringLimits(
        mandrel_min_mm=2.0 * mandrel, pin_radius_min_mm=pin, pin_mm=axle, stress_share=share,
        plate_pins_rad=plate_pins_rad,
    )  # fmt: skip


def _cam_limits(workshop: Workshop, roller: Bearing, sections: Sections) -> CamLimits:
    """Return the limits of the cam: its roller, the lever's eye beside its axle, and its dog."""
    lever_eye, safety = max(LEVER_EYE_RADIUS_MM, sections.lever_root_mm / 2.0), workshop.safety
    gears = workshop.material("gears")
    return CamLimits(
        roller_radius_mm=roller.outer_mm / 2.0, roller_load_n=roller.static_load_n / safety.load_factor,
        cam_width_mm=roller.width_mm, gap_min_mm=lever_eye + SPACER_RADIUS_MM + CLEAR_MM,
        core_radius_mm=sections.dog_mm / 2.0, modulus_mpa=gears.modulus_mpa, play_rad=workshop.release.play_rad,
        lift_rad=CamLimits.lift_rad + math.radians(workshop.release.ease_deg) / 2.0,  # at the same torque
        ease_rad=math.radians(workshop.release.ease_deg),
        overshoot_rad=math.radians(workshop.body.stop_deg) + GIVE_ROOM_RAD,
        pressure_mpa=CamLimits.pressure_mpa / math.sqrt(safety.load_factor),  # of a line contact, with the force's root
        shakedown_mpa=4.0 / math.sqrt(3.0) * gears.strength_in_plane_mpa, clearance_mm=GAP_MM + safety.gap_reserve_mm,
        pressure_angle_rad=CamLimits.pressure_angle_rad - math.radians(safety.pressure_angle_reserve_deg),
        undercut_margin_mm=CamLimits.undercut_margin_mm + safety.gap_reserve_mm,
    )  # fmt: skip


def _train_limits(workshop: Workshop, sections: Sections) -> TrainLimits:
    """Return the limits of motor and gears: the motor maker's, and the strength of the printed material."""
    fits, safety = workshop.fits.drawn, workshop.safety
    return TrainLimits(
        stall_share=safety.motor_share * safety.motor_stall_share,
        torque_max_nm=safety.motor_share * safety.motor_torque_max_nm,
        supply=supply_of(chosen_parts(workshop)),
        blocked_nm=safety.motor_torque_max_nm,
        pair_efficiency=safety.gear_efficiency,
        backlash_circumferential_mm=fits.backlash_circumferential_mm,
        stress_mpa=workshop.material("gears").strength_in_plane_mpa / safety.printed_factor,
        tip_min_mm=workshop.process.line_width_mm,
        pinion_root_min_mm=workshop.bought.axle_mm / 2.0 + fits.sliding_mm + fits.wall_mm,
        shaft_wall_mm=fits.press_mm + fits.wall_mm,
        cam_gear_root_min_mm=sections.dog_mm / 2.0 + max(fits.sliding_mm + fits.wall_mm, _track_mm(workshop)),
    )


def _track_mm(workshop: Workshop) -> float:
    """Return the room that the sensor's track needs between the dog and the cam gear's teeth; 0 without."""
    sensor = chosen_parts(workshop).components.get("sensor")
    return track_mm(sensor.travel, workshop.seats.sensor_along_mm) if sensor and sensor.travel else 0.0


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
    linkage, roller = Linkage(design), strength_bearings.roller_bearing(workshop)
    bearings = strength_bearings.hub_bearings(workshop)
    springs = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    falls_s = fall_s(linkage, springs, math.radians(workshop.body.stop_deg) + GIVE_ROOM_RAD)
    drive_within = cache(lambda limits: synthesise(design, limits, workshop.catalogue))

    def with_bearing(bearing: Bearing | None) -> Settled:
        sizes = sections(linkage, workshop, strength_bearings.hub_width_mm(bearing), growth)
        holes = HoleSizes.of(workshop, bearing)
        limits = drive_limits(workshop, roller, sizes, holes, plate_pins_rad)
        return Settled(linkage, sizes, holes, drive_within(replace(limits, fall_s=falls_s)), roller)

    number = strength_bearings.first_guess(bearings, design, workshop)
    while True:
        settled = with_bearing(bearings[number])
        enough = (index for index in range(number, len(bearings)) if _carries(bearings[index], settled, workshop))
        if (stronger := next(enough, len(bearings) - 1)) == number:
            _require_hub_room(settled)
            return settled
        number = stronger


def fall_s(linkage: Linkage, spring: Spring, past_rad: float) -> float:
    """Return the time from release to an angle past rest, with a typical mass of the body and a reserve (s)."""
    bodies = {BODY: Body.of(BODY, TYPICAL_BODY)}
    bodies |= {name: Body(0.0, np.zeros(3), np.zeros((3, 3)), name) for name in (MAIN_LEG, FRONT_LINK)}
    return RESERVE * reflected_mass(bodies, linkage).push_off_s(spring, past_rad)


def _carries(bearing: Bearing | None, settled: Settled, workshop: Workshop) -> bool:
    """Tell whether a hub bearing carries the forces of springs and cam; a plain hub is not checked."""
    if bearing is None:
        return True
    forces = strength_bearings.loaded_forces_n(settled.linkage.design, settled.drive)
    load = strength_bearings.bearing_load_n(forces, settled.sections.thickness_mm, settled.roller.width_mm, bearing)
    return load <= strength_bearings.allowed_n(bearing, workshop)


def _require_hub_room(settled: Settled) -> None:
    """Reject bearings whose seat cuts the roller's screw in the lever, or whose hub touches the cam axle's spacer."""
    holes, cam = settled.holes, settled.drive.cam
    if holes.bearing is None:
        return
    wall = holes.hub_radius_mm - holes.hub_bore_mm / 2.0
    to_screw = cam.geometry.lever_mm - holes.fits.m3_clearance_mm / 2.0 - holes.fits.wall_min_mm
    to_spacer = math.hypot(*cam.geometry.axis_mm) - SPACER_RADIUS_MM - GAP_MM - wall
    largest = 2.0 * (min(to_screw, to_spacer) - holes.fits.press_mm)
    if holes.bearing.outer_mm > largest:
        raise CannotBuildError(
            f"the leg's bearing {holes.bearing.name} has {holes.bearing.outer_mm:g} mm diameter; {largest:.1f} mm fit "
            "beside the roller's screw and the cam's axle",
            "leg_bearing", largest - holes.bearing.outer_mm, ways=choose("a smaller", "bought.leg_bearing"),
        )  # fmt: skip
