"""The limits of the drive, from a workshop and from the parts around the drive."""

import math

from jumpcad.catalogue import Bearing
from jumpcad.dimensions import CLEAR_MM, GAP_MM, LEVER_EYE_RADIUS_MM, SPACER_RADIUS_MM
from jumpcad.drive import CamLimits, DriveLimits, SpringLimits, TrainLimits
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sensor.place import track_mm
from jumpcad.robot.sizing import Sections
from jumpcad.robot.springs.place import PLATE_PINS_RAD
from jumpcad.robot.stop.place import GIVE_ROOM_RAD
from jumpcad.strength.fatigue import spring_share
from jumpcad.workshop import Workshop


def drive_limits(
    workshop: Workshop,
    roller: Bearing,
    sections: Sections,
    holes: HoleSizes,
    plate_pins_rad: tuple[float, ...] = PLATE_PINS_RAD,
) -> DriveLimits:
    """Return the limits of the drive in a workshop, with a roller of the catalogue, beside a main leg of some size.

    `plate_pins_rad` are the directions of the plates' pin that the springs may have, the preferred one first.
    """
    return DriveLimits(
        spring=_spring_limits(workshop, sections, holes, plate_pins_rad),
        cam=_cam_limits(workshop, roller, sections),
        train=_train_limits(workshop, sections),
        motors=workshop.bought.motors,
        dog_mm=sections.dog_mm,
        stock_spring=workshop.stock_spring,
        preload_rad=math.radians(workshop.spring.preload_deg),
    )


def _spring_limits(
    workshop: Workshop, sections: Sections, holes: HoleSizes, plate_pins_rad: tuple[float, ...]
) -> SpringLimits:
    """Return the limits of the springs: a bushing around the leg's axle, and a pin that passes hub and leg."""
    fits, safety, axle = workshop.fits.drawn, workshop.safety, workshop.bought.axle_mm
    hub_radius = max(holes.hub_radius_mm, sections.leg_root_mm / 2.0)
    return SpringLimits(
        mandrel_min_mm=2.0 * (axle / 2.0 + fits.sliding_mm + fits.wall_min_mm),
        pin_radius_min_mm=hub_radius + CLEAR_MM + axle / math.sqrt(2.0),
        pin_mm=axle,
        plate_pins_rad=plate_pins_rad,
        stress_share=min(safety.spring_stress_share, spring_share(safety.jumps)) / (1.0 + safety.stress_reserve),
    )


def _cam_limits(workshop: Workshop, roller: Bearing, sections: Sections) -> CamLimits:
    """Return the limits of the cam: its roller, the lever's eye beside its axle, and its dog."""
    lever_eye, safety = max(LEVER_EYE_RADIUS_MM, sections.lever_root_mm / 2.0), workshop.safety
    return CamLimits(
        roller_radius_mm=roller.outer_mm / 2.0,
        roller_load_n=roller.static_load_n / safety.load_factor,
        cam_width_mm=roller.width_mm,
        gap_min_mm=lever_eye + SPACER_RADIUS_MM + CLEAR_MM,
        core_radius_mm=sections.dog_mm / 2.0,
        modulus_mpa=workshop.material("gears").modulus_mpa,
        play_rad=workshop.release.play_rad,
        overshoot_rad=math.radians(workshop.body.stop_deg) + GIVE_ROOM_RAD,
        pressure_mpa=CamLimits.pressure_mpa
        / math.sqrt(safety.load_factor),  # of a line contact, with the root of force
        shakedown_mpa=4.0 / math.sqrt(3.0) * workshop.material("gears").strength_in_plane_mpa,
        clearance_mm=GAP_MM + safety.gap_reserve_mm,
        pressure_angle_rad=CamLimits.pressure_angle_rad - math.radians(safety.pressure_angle_reserve_deg),
        undercut_margin_mm=CamLimits.undercut_margin_mm + safety.gap_reserve_mm,
    )


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
