"""The planar model: what the plane takes of a robot."""

import math
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.mechanism.model import Stop
from jumpcad.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.planar_model import planar_model


def test_friction_is_the_grounds_times_the_foots(kenan: Robot) -> None:
    pairs = [
        Settings(ground_friction=ground, foot_friction=foot) for ground, foot in ((0.3, 1.0), (0.6, 0.5), (0.6, 1.0))
    ]
    ranges = [simulate(kenan, settings, "planar").ballistic_range_m for settings in pairs]
    assert ranges[0] == ranges[1]
    assert ranges[2] > 1.5 * ranges[0]


def test_gravity_and_stop_are_those_of_the_settings_and_the_robot(kenan: Robot) -> None:
    """Capsules have no stop."""
    moon = Settings(gravity_m_s2=1.62)
    free = planar_model(kenan, moon)
    held = planar_model(replace(kenan, stop=Stop("leg", 0.11, 25.0)), moon)
    assert (free.gravity_m_s2, free.stop_rad, free.stop_nm_per_rad) == (1.62, math.inf, 0.0)
    assert (held.gravity_m_s2, held.stop_rad, held.stop_nm_per_rad) == (1.62, 0.11, 25.0)


@pytest.mark.parametrize("preload_rad", [0.0, 0.2])
def test_a_preload_gives_the_energy_of_its_winding(kenan: Robot, preload_rad: float) -> None:
    """½·k·((w + p)² - p²), as in Bullet, whose jump is as far."""
    robot = replace(kenan, spring=replace(kenan.spring, preload_rad=preload_rad))
    jumps = [simulate(robot, engine=engine) for engine in ("planar", "pybullet")]
    wound = kenan.spring.wind_rad + preload_rad
    energy = 0.5 * kenan.spring.stiffness_nm_per_rad * (wound**2 - preload_rad**2)
    assert jumps[0].spring_energy_j == pytest.approx(energy)
    assert jumps[0].ballistic_range_m == pytest.approx(jumps[1].ballistic_range_m, rel=0.01)


def test_left_and_right_do_not_count(lopsided: Robot) -> None:
    """What is moved aside or turned about x or z changes nothing."""
    bodies = {
        name: replace(body, com_m=body.com_m * [1.0, 3.0, 1.0], inertia_kg_m2=np.diag(np.diag(body.inertia_kg_m2)))
        for name, body in lopsided.bodies.items()
    }
    ranges = [
        simulate(robot, engine="planar").ballistic_range_m for robot in (lopsided, replace(lopsided, bodies=bodies))
    ]
    assert ranges[0] == ranges[1]
