"""What the manifest says of a robot: springs, release, stop, electronics, joints, cage, flight; which springs pass."""

import math
from typing import Any

from jumpcad.collision.hulls import CAGE
from jumpcad.drive.release import Release
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.electronics.limits import jumps_per_charge, links
from jumpcad.robot.foot.thing import play_rad, rolls
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump

DIGITS, ROLL_DIGITS = 6, 3
ASSUMED = (
    "cam_kg_m2", "gear_kg_m2", "rotor_kg_m2", "backlash_deg", "cam_rad_s", "rebound", "friction_mm", "train_nm_per_rad",
    "lever_nm_per_rad", "contact_nm_per_rad", "roller_kg_m2",
)  # fmt: skip
FLIGHT = "turn_deg", "touchdown_pitch_deg", "lateral_offset_mm"


def spring_facts(robot: Robot) -> list[dict[str, Any]]:
    """Return the manifest's entries of the left and the right spring.

    Pins are (x, z) from the hub in the rest pose (mm); `turns` are those of the relaxed body; `arm_length_mm` is from
    the tangent point to the arm's end.
    """
    spring = robot.layout.drive.spring
    plate, leg = (
        [round(spring.arms.pin_radius_mm * along, DIGITS) for along in (math.cos(angle), math.sin(angle))]
        for angle in (spring.plate_pin_rad, spring.leg_pin_rad)
    )
    return [
        {
            "side": side, "hand": hand, "wire_mm": spring.wire_mm,
            "inside_diameter_mm": round(spring.inside_diameter_mm, DIGITS), "turns": round(spring.turns, DIGITS),
            "arm_length_mm": round(spring.arm_length_mm, DIGITS),
            "rate_nmm_per_deg": round(spring.rate_nmm_per_deg, DIGITS),
            "preload_deg": round(math.degrees(spring.preload_rad), DIGITS), "plate_pin_mm": plate, "leg_pin_mm": leg,
            "pin_diameter_mm": spring.arms.pin_mm,
        }
        for side, hand in zip(("left", "right"), spring.hands, strict=True)
    ]  # fmt: skip


def release_facts(release: Release) -> dict[str, Any]:
    """Return plain data: angles in degrees, torques at the gear motor's output or, if named so, at the cam.

    `energy_ratio` and `energy_ratio_rounded` (with the workshop's corner radius) neglect the bending of the lever;
    simulated jumps start with `energy_ratio_with_bending`. Torques are the largest of both corners and of the two
    motors in `assumed`, which are at the ends of the workshop's ranges; the second one is computed at low speed too.
    """
    assumed = [{**vars(parts), "backlash_deg": math.degrees(parts.backlash_rad)} for parts in release.parts]
    return {
        "energy_ratio": round(release.energy_ratio, 6), "energy_ratio_rounded": round(release.rounded_ratio, 6),
        "energy_ratio_with_bending": round(release.off.energy_ratio, 6),
        "bending_ratio": round(release.bending_ratio, 6), "leg_deg": round(math.degrees(release.off.leg_rad), 6),
        "leg_rad_s": round(release.off.leg_rad_s, 6), "kick_nm": round(release.kick_nm, 6),
        "kick_limit_nm": round(release.kick_limit_nm, 6), "blow_at_cam_nm": round(release.blow_nm, 6),
        "gear_ratio": round(release.gear_ratio, 9), "push_off_s": round(release.push_off_s, 6),
        "free_play_deg": round(math.degrees(release.free_play_rad), 6),
        "roll_over_deg": round(math.degrees(release.roll_over_rad), 6),
        "window_deg": [round(math.degrees(angle), 6) for angle in release.window_rad],
        "assumed": [{name: float(f"{values[name]:.9g}") for name in ASSUMED} for values in assumed],
    }  # fmt: skip


def stop_facts(robot: Robot) -> dict[str, Any]:
    """Return the stop's angle past rest, energy and torque of the leg's impact, and the pad with its compression."""
    stop, blow = robot.layout.stop, robot.stop_blow
    return {
        "angle_deg": round(math.degrees(stop.angle_rad), DIGITS), "blow_j": blow.energy_j, "torque_nm": blow.torque_nm,
        "pad": stop.pad.name, "give_mm": blow.give_mm, "give_deg": round(math.degrees(blow.give_rad), DIGITS),
        "radius_mm": stop.radius_mm,
    }  # fmt: skip


def electronics_facts(robot: Robot) -> dict[str, Any]:
    """Return the battery's voltages (empty, full), and for each part the supplied and the permitted voltages."""
    chosen, train = robot.layout.electronics, robot.layout.drive.train
    supply = robot.supply
    empty, full = chosen.battery.range_v
    chained = [
        {
            "role": link.role, "name": link.name, "pin": link.pin, "gets_v": _rounded(link.gets_v),
            "bears_v": None if link.bears_v is None else _rounded(link.bears_v),
        }
        for link in links(robot)
    ]  # fmt: skip
    return {
        "kit": robot.workshop.bought.kit,
        "battery": chosen.battery.name,
        "battery_v": [empty, full],
        "boards": [item for item in chained if item["role"] in chosen.boards],
        "motor": next(item for item in chained if item["role"] == "motor"),
        "pwm_cap": round(supply.pwm(train.motor, robot.workshop.safety.motor_torque_max_nm), DIGITS),
        "energy_j": {"motor": round(train.motor_j, DIGITS), "boards": round(train.boards_j, DIGITS)},
        "jumps_per_charge": jumps_per_charge(robot),
    }


def _rounded(volts: tuple[float, float]) -> list[float]:
    return [round(value, DIGITS) for value in volts]


def joint_facts(robot: Robot) -> dict[str, Any]:
    """Return the retention of axles and pins, the pinion's fit, and the roll in every state (mm, °).

    `play_deg` is the roll of the body on its foot to either side, as drawn. `pinion_rib_mm` is the overlap of the ribs
    in the pinion's bore with the motor's shaft (a press fit without play).
    """
    layout, workshop = robot.layout, robot.workshop
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    return {
        "retention": layout.retention, "axle": workshop.bought.axle, "axle_mm": layout.axle_mm,
        "pinion_rib_mm": workshop.fits.rib_mm, "play_deg": round(math.degrees(play_rad(layout, holes)), ROLL_DIGITS),
        "toe_half_width_mm": round(layout.toe_half_width_mm, ROLL_DIGITS),
        "roll_deg": {
            roll.state: {"stance": round(roll.stance_deg, ROLL_DIGITS), "play": round(roll.play_deg, ROLL_DIGITS)}
            for roll in rolls(robot)
        },
    }  # fmt: skip


def cage_facts(robot: Robot) -> dict[str, Any] | None:
    """Return the cage's rods, from end to end, and the mass of rods, bars and ties; None without a cage.

    The horns belong to the body plates, and their mass to that of these.
    """
    cage = robot.layout.of(Cage)
    if cage is None:
        return None
    pieces: list[Part | BoughtPart] = [*robot.parts, *robot.hardware]
    return {
        "rods": [
            {
                "name": arc.name, "material": cage.rod.name, "diameter_mm": cage.rod.diameter_mm,
                "length_mm": round(arc.length_mm, 1), "radius_mm": round(arc.radius_mm, 1),
            }
            for arc in cage.arcs
        ],
        "mass_kg": sum(piece.mass_kg for piece in pieces if piece.name.startswith(CAGE)),
    }  # fmt: skip


def flight_facts(jump: Jump) -> dict[str, float] | None:
    """Return turn and touchdown of a jump, and how far its centre of mass is beside the leg; None if there is none."""
    if jump.verdict != "jump":
        return None
    return {name: round(getattr(jump, name), ROLL_DIGITS) for name in FLIGHT}


ARMS_OFF_DEG = 10.0
"""By which relaxed arms may be off at most; makers of stock springs allow 10 to 15 either way."""
PAIR_PERCENT = 5
"""By which the torques of the chosen pair may differ; judgement: the leg's hub tilts in its play."""


def torque_shares(robot: Robot) -> tuple[float, float]:
    """Return the least and the largest loaded torque of an accepted spring over the computed one, in whole percent.

    Rate and arms scatter together. The most is what the parts' reserve for stiff springs and the wire's allowed stress
    both bear; the least has the lowest rate and the narrowest arms.
    """
    spring, scatter = robot.layout.drive.spring, robot.workshop.safety.spring_rate_scatter
    wound = math.degrees(spring.wound_rad)
    most = min(1.0 + scatter, allowable_mpa(robot) / spring.stress_mpa)
    least = (1.0 - scatter) * max(0.0, 1.0 - ARMS_OFF_DEG / wound)
    return math.ceil(100.0 * least - 1e-9) / 100.0, max(1.0, math.floor(100.0 * most + 1e-9) / 100.0)


def allowable_mpa(robot: Robot) -> float:
    """Return the stress that the wire may have with the largest torque accepted, the reserve of loads used up."""
    return robot.layout.drive.spring.allowable_mpa * (1.0 + robot.workshop.safety.stress_reserve)


def arms_off_deg(robot: Robot) -> tuple[float, float]:
    """Return by how much relaxed arms of accepted springs may be narrower, and wider, than ordered (°).

    Wider by what the reserve for stiff springs would cover at the end of the lift, in whole degrees: more would load
    the motor too much at its beginning (`early_torque_share`).
    """
    wound = math.degrees(robot.layout.drive.spring.wound_rad)
    reserve = robot.workshop.safety.spring_rate_scatter * wound
    return ARMS_OFF_DEG, math.floor(min(ARMS_OFF_DEG, reserve) + 1e-9)


def early_torque_share(robot: Robot) -> float:
    """Return the largest torque at the cam over the computed one, with the widest arms and the largest torque accepted.

    The cam needs a constant torque T beyond its ramp, which computed springs loaded by q give; springs loaded by w more
    take T·(q + w)/q, most at the ramp's end.
    """
    law, wider = robot.layout.drive.cam.law, math.radians(arms_off_deg(robot)[1])
    loaded = float(law.wind_rad(law.ramp_rad)) + law.preload_rad
    rate = torque_shares(robot)[1] / (1.0 + wider / robot.layout.drive.spring.wound_rad)
    return rate * (loaded + wider) / loaded


def least_energy_share(robot: Robot) -> float:
    """Return the energy that springs of the lowest rate and the narrowest arms give, over the computed one."""
    spring, narrower = robot.layout.drive.spring, math.radians(ARMS_OFF_DEG)
    wound, preload = spring.wound_rad, spring.preload_rad
    weak = max(0.0, wound - narrower) ** 2 - max(0.0, preload - narrower) ** 2
    return (1.0 - robot.workshop.safety.spring_rate_scatter) * weak / (wound**2 - preload**2)


def loaded_arms(robot: Robot) -> str:
    """Return where the arms of a spring stand to each other at the end of the lift."""
    spring = robot.layout.drive.spring
    angle = math.degrees(spring.free_arm_angle_rad - spring.wound_rad)
    return f"{angle:.1f}° apart" if angle >= 0.0 else f"crossed by {-angle:.1f}°"
