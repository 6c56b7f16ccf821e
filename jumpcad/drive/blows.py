"""Blows along the drive after a release: the cam hits its gear, both hit the gear motor's rotor, with rebounds (SI).

Cam, gear and rotor have a moment of inertia each, at the cam. Between them lie gaps, the dog's and the gearhead's;
beyond its gap each pair is a spring with a damper that only push. What hits hardest hangs on who meets whom when, so
the three are followed in time: exactly while they fly, in steps while something touches. At the other end of its play
the dog is left out: a cam that is thrown back has lost most of its energy.
"""

import math

STEP_SHARE = 0.01
"""Step in time, in radians of the fastest swing; with a fourth of it the torques change by 0.5 %."""
STEPS_MAX = 50_000
DAMPING_MAX = 0.5
"""Of the critical damping. A parallel damper with more pushes hardest at first touch, which no jaw does; it gives a
rebound of 0.3, and less rebound counts as that."""
HALVINGS = 40


def damping_share(rebound: float) -> float:
    """Return the share of the critical damping with which a spring and damper that only push have a rebound.

    Until the force is zero, e = exp(-2·z·acos(z)/√(1 - z²)): the free swing, ended where it would have to pull.
    """
    low, high = 0.0, DAMPING_MAX
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        gives = math.exp(-2.0 * middle * math.acos(middle) / math.sqrt(1.0 - middle**2))
        low, high = (middle, high) if gives > rebound else (low, middle)
    return low


def largest_torques_nm(
    masses_kg_m2: tuple[float, float, float],
    speed_rad_s: float,
    motor_rad_s: float,
    backlash_rad: float,
    stiffness_nm_per_rad: float,
    rebound: float,
) -> tuple[float, float]:
    """Return the largest torque between cam and gear, and between gear and rotor.

    Parameters
    ----------
    masses_kg_m2
        Moments of inertia of cam, gear and rotor.
    speed_rad_s, motor_rad_s
        Of the cam, which meets the gear, and of the motor, which turns the gear at first and goes on.
    backlash_rad
        By which the gear can run ahead of the rotor.
    stiffness_nm_per_rad
        Of either pair in contact.
    rebound
        Coefficient of restitution of either pair.
    """
    cam_kg_m2, gear_kg_m2, rotor_kg_m2 = masses_kg_m2
    k, share = stiffness_nm_per_rad, 2.0 * damping_share(rebound)
    dog_damping = share * math.sqrt(k * cam_kg_m2 * gear_kg_m2 / (cam_kg_m2 + gear_kg_m2))
    head_damping = share * math.sqrt(k * gear_kg_m2 * rotor_kg_m2 / (gear_kg_m2 + rotor_kg_m2))
    shortest = STEP_SHARE * math.sqrt(min(cam_kg_m2, gear_kg_m2) / k)
    cam, gear, rotor = speed_rad_s, motor_rad_s, motor_rad_s
    dog = 0.0  # how far the cam is pressed into the gear, below 0 the gap between them
    head = -backlash_rad  # the same of gear and rotor
    blow = kick = 0.0
    for _ in range(STEPS_MAX):
        step = shortest
        if dog <= 0.0 and head <= 0.0:
            moving_j = 0.5 * (cam_kg_m2 * (cam - motor_rad_s) ** 2 + gear_kg_m2 * (gear - motor_rad_s) ** 2)
            step += _flight_s(dog, cam - gear, head, gear - rotor, backlash_rad)
            if math.isinf(step) or moving_j < 0.5 * kick**2 / k:  # nothing hits harder any more
                break
        at_dog = max(k * dog + dog_damping * (cam - gear), 0.0) if dog > 0.0 else 0.0
        at_head = max(k * head + head_damping * (gear - rotor), 0.0) if head > 0.0 else 0.0
        blow, kick = max(blow, at_dog), max(kick, at_head)
        cam -= step * at_dog / cam_kg_m2
        gear += step * (at_dog - at_head) / gear_kg_m2
        rotor = max(rotor + step * at_head / rotor_kg_m2, motor_rad_s)
        dog, head = dog + step * (cam - gear), head + step * (gear - rotor)
        if head < -backlash_rad:  # the rotor's other flank, which throws it back
            head, gear = -backlash_rad, rotor + rebound * abs(gear - rotor)
    return blow, kick


def _flight_s(dog: float, closing: float, head: float, ahead: float, backlash_rad: float) -> float:
    """Return the time until something touches: cam and gear, or gear and rotor at either flank; infinite if never."""
    times = [-dog / closing] if closing > 0.0 else []
    if ahead:
        times.append(-head / ahead if ahead > 0.0 else -(head + backlash_rad) / ahead)
    return min(times, default=math.inf)
