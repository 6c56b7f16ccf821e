"""Which springs are accepted: torques, angles, stresses and energies of the stiffest and the weakest."""

import math

from jumpcad.robot.robot import Robot

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
