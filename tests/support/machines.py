"""Capsule robots with what printed ones have, set by hand: one-sided springs, stop, cam, friction of their own."""

import math
from dataclasses import replace

from jumpcad.mechanism.model import Friction, Mechanism, RollerOff, Stop

STOP_RAD = math.radians(5.0)
PAD_NM_PER_RAD = 40.0
"""100 N/mm at 20 mm from the hub."""
PINS_M = (0.0015,) * 4


def one_sided(robot: Mechanism, preload_rad: float = 0.0) -> Mechanism:
    """Return a robot whose springs only push."""
    return replace(robot, springs=(replace(robot.spring, one_sided=True, preload_rad=preload_rad),))


def stopped(robot: Mechanism, angle_rad: float = STOP_RAD, stiffness: float = PAD_NM_PER_RAD) -> Mechanism:
    """Return a robot with a stop."""
    return replace(robot, stop=Stop("leg", angle_rad, stiffness))


def let_go(robot: Mechanism, share: float = 0.93, leg_rad_s: float = 4.0) -> Mechanism:
    """Return a robot whose roller leaves the cam at a share of the springs' travel, the leg turning."""
    return replace(robot, roller_off=RollerOff(-share * robot.spring.wind_rad, leg_rad_s, 0.9))


def rubbing(
    robot: Mechanism, foot: float = 1.5, pin: float = 0.0, pin_radius_m: tuple[float, float, float, float] = PINS_M
) -> Mechanism:
    """Return a robot with friction of its own."""
    return replace(robot, friction=Friction(foot, 0.35, pin, pin_radius_m))


def machine(robot: Mechanism) -> Mechanism:
    """Return a robot with one-sided springs that are preloaded, a stop, and a roller that has left the cam."""
    return let_go(stopped(one_sided(robot, math.radians(3.0))))
