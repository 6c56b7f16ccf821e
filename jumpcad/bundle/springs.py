"""The springs of a robot: the guide's section on ordering them, and the manifest's entries."""

import math
from collections.abc import Iterator
from typing import Any

from jumpcad.drive import TorsionSpring
from jumpcad.parts.spring_wire import ORDERED
from jumpcad.robot import Robot

DIGITS = 6
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


def torque_requirement(robot: Robot) -> str:
    """Return what is asked of every spring: its torque where the robot loads it, whatever its rate and its arms."""
    least, most = torque_shares(robot)
    return (
        f"{robot.layout.drive.spring.torque_nmm:.0f} N·mm, +{100.0 * (most - 1.0):.0f} % / "
        f"-{100.0 * (1.0 - least):.0f} %, with the arms {loaded_arms(robot)}; a pair within {PAIR_PERCENT} %"
    )


def spring_facts(robot: Robot) -> list[dict[str, Any]]:
    """Return the manifest's entries of the left and the right spring.

    Pins are (x, z) from the hub in the rest pose (mm); `turns` are those of the relaxed body; `arm_length_mm` is from
    the tangent point to the arm's end.
    """
    spring = robot.layout.drive.spring
    plate, leg = (
        [round(spring.pin_radius_mm * math.cos(angle), DIGITS), round(spring.pin_radius_mm * math.sin(angle), DIGITS)]
        for angle in (spring.plate_pin_rad, spring.leg_pin_rad)
    )
    return [
        {
            "side": side,
            "hand": hand,
            "wire_mm": spring.wire_mm,
            "inside_diameter_mm": round(spring.inside_diameter_mm, DIGITS),
            "turns": round(spring.turns, DIGITS),
            "arm_length_mm": round(spring.arm_length_mm, DIGITS),
            "rate_nmm_per_deg": round(spring.rate_nmm_per_deg, DIGITS),
            "preload_deg": round(math.degrees(spring.preload_rad), DIGITS),
            "plate_pin_mm": plate,
            "leg_pin_mm": leg,
            "pin_diameter_mm": spring.arms.pin_mm,
        }
        for side, hand in zip(("left", "right"), spring.hands, strict=True)
    ]


def spring_order(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on the springs: what to order, and on which side each one belongs."""
    spring = robot.layout.drive.spring
    yield from ("", "## Springs to order" if not spring.stock else "## Springs", "")
    yield from (_stock_lines if spring.stock else _made_lines)(robot, spring)
    most = torque_shares(robot)[1]
    yield (
        f"- what counts is the loaded torque: {torque_requirement(robot)}. Rate and arms may be off as said above as "
        f"long as it is met. Order {ORDERED} of each hand (judgement) and choose as under When things arrive"
    )
    yield (
        f"- loaded from {math.degrees(spring.preload_rad):.1f}° to {math.degrees(spring.wound_rad):.1f}°, closing, to "
        f"{spring.torque_nmm:.0f} N·mm each; {spring.stress_mpa:.0f} MPa ({spring.allowable_mpa:.0f} MPa allowed; "
        f"EN 13906-3, inner fibre), {most * spring.stress_mpa:.0f} MPa with the largest torque accepted "
        f"({allowable_mpa(robot):.0f} MPa allowed, the reserve for loads used up)"
    )
    if spring.preload_rad > 0.0:
        without = 1000.0 * spring.stiffness_nm_per_rad * (spring.wound_rad - spring.preload_rad)
        yield f"- the preload adds {spring.torque_nmm - without:.0f} N·mm to the loaded torque of each"
    yield (
        "- the right-hand one goes on the robot's left, the left-hand one on its right: wound the other way, a spring "
        "would be bent open"
    )
    sheets = " and ".join(f"order/spring-{hand}-hand.svg" for hand in spring.hands)
    yield f"- a drawing of each for its maker: {sheets}, and the same as DXF"


def _made_lines(robot: Robot, spring: TorsionSpring) -> Iterator[str]:
    narrower, wider = arms_off_deg(robot)
    yield from (
        "Two torsion springs, mirror images, one wound right-hand and one left-hand, close-coiled, of patented spring "
        "steel wire EN 10270-1 SM. Let the maker change the diameter to meet rate and torque, not the turns or the "
        "arms.",
        "",
        f"- rate {spring.rate_nmm_per_deg:.2f} N·mm/° each, ±{100.0 * robot.workshop.safety.spring_rate_scatter:.0f} %",
        f"- wire {spring.wire_mm:g} mm, inside diameter {spring.inside_diameter_mm:.2f} mm, {spring.turns:.2f} turns, "
        f"body at most {spring.body_length_mm:.1f} mm long when loaded",
        f"- two straight arms, tangents of the coil, {spring.arm_length_mm:.1f} mm from the coil to their ends, "
        f"{math.degrees(spring.free_arm_angle_rad):.0f}° +{wider:.0f}° / -{narrower:.0f}° apart when relaxed (180° is "
        "opposite directions, as after whole turns); loading lowers the angle",
        f"- for {robot.workshop.safety.jumps:g} loadings, each closing; stress-relieved, oiled, not plated (a plating "
        "can "
        "make hard wire brittle)",
    )


def _stock_lines(robot: Robot, spring: TorsionSpring) -> Iterator[str]:
    narrower, wider = arms_off_deg(robot)
    yield from (
        f"Two torsion springs {spring.stock}, one of each hand, from stock:",
        "",
        f"- {spring.rate_nmm_per_deg:.2f} N·mm/° each, ±{100.0 * robot.workshop.safety.spring_rate_scatter:.0f} %; the "
        f"design asks for {robot.design.stiffness_nmm_per_deg / 2.0:.2f} N·mm/°, and the robot is computed with what "
        "the springs have",
        f"- cut both arms to {spring.arm_length_mm:.1f} mm from the coil; they are "
        f"{math.degrees(spring.free_arm_angle_rad):.0f}° +{wider:.0f}° / -{narrower:.0f}° apart when relaxed: makers "
        "allow 10 to 15° to either side",
    )
