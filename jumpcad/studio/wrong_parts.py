"""Which parts a violated limit is about: the studio shows them in red."""

from collections.abc import Iterable

from jumpcad.findings import Finding, errors

PLATES = ("body_plate_left", "body_plate_right")
SPRINGS = ("spring_left", "spring_left_leg_arm", "spring_right", "spring_right_leg_arm")
AXLES = ("leg_axle", "front_axle", "cam_axle")
LIMITS_OF: dict[tuple[str, ...], tuple[str, ...]] = {
    ("main_leg",): ("leg_strength", "lever_strength", "hub_strength", "leg_flex", "leg_sideways", "stop_leg",
                    "leg_bar_strength", "leg_socket_strength", "leg_bar_bond", "leg_bar_flex"),
    ("front_link",): ("front_link_strength", "front_link_buckling", "front_bar_buckling"),
    ("main_leg", "front_link"): ("eye_strength",),
    ("foot",): ("foot_lug_strength", "toe_strength", "rail_strength", "rail_twist", "toe_landing",
                "toe_bar_strength",
                "toe_joint_strength", "foot_clearance", "ground_clearance", "sideways_tipping"),
    ("leg_axle",): ("leg_axle_strength",),
    ("front_axle",): ("front_axle_strength",),
    ("idler_axle",): ("idler_axle_strength",),
    ("cam_axle",): ("cam_axle_strength",),
    ("spring_pin",): ("spring_pin_strength",),
    ("leg_spring_pin",): ("leg_pin_strength",),
    ("ankle_pin", "front_eye_pin"): ("foot_pin_strength",),
    ("ankle_pin", "front_eye_pin", "leg_spring_pin"): ("pin_retention",),
    ("roller_screw",): ("roller_screw_strength",),
    ("roller",): ("cam_roller_load",),
    ("hub_bearing_1", "hub_bearing_2"): ("hub_bearing_load",),
    AXLES: ("axle_retention", "axle_fatigue"),
    PLATES: ("plate_seat", "stop_plates", "stop_creep"),
    ("stop_bar",): ("stop_strength",),
    ("stop_pad",): ("stop_pad", "stop_clearance"),
    SPRINGS: ("spring_stress", "spring_fatigue", "spring_rate"),
    ("cam",): ("cam_dog_strength", "cam_dog_blocked", "cam_pressure_angle", "cam_undercut", "cam_contact", "cam_core",
               "cam_hub", "cam_drop", "cam_next_lift", "cam_overshoot", "cam_place", "release_window",
               "release_energy"),
    ("motor",): ("motor_torque", "cam_speed", "gearbox_torque", "release_kick", "motor_current_driver"),
    ("cam_gear", "motor_pinion"): ("gear_strength_1", "gear_mesh_1", "gear_blocked", "cam_gear_room"),
    ("battery",): ("motor_current_battery", "charging_current"),
    ("sensor",): ("sensor_press", "sensor_overtravel", "sensor_free", "sensor_ready", "sensor_open"),
}  # fmt: skip
"""Parts, by their names in pictures and scenes, and the limits that are about them."""


def wrong_parts(findings: Iterable[Finding]) -> frozenset[str]:
    """Return the names of the parts that the errors among findings are about."""
    violated = {one.name for one in errors(findings)}
    return frozenset(part for parts, limits in LIMITS_OF.items() if violated & set(limits) for part in parts)
