"""The planar model: what the plane takes of a robot."""

from dataclasses import replace

import numpy as np
import pytest
from support import needs

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, ContactSphere
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.planar_model import planar_model


def test_friction_is_the_grounds_times_the_foots(kenan: Robot) -> None:
    pairs = [
        Settings(ground_friction=ground, foot_friction=foot) for ground, foot in ((0.3, 1.0), (0.6, 0.5), (0.6, 1.0))
    ]
    ranges = [simulate(kenan, settings, "planar").ballistic_range_m for settings in pairs]
    assert ranges[0] == ranges[1]
    assert ranges[2] > 1.5 * ranges[0]


@pytest.mark.parametrize("preload_rad", [0.0, 0.2])
def test_a_preload_gives_the_energy_of_its_winding(kenan: Robot, preload_rad: float) -> None:
    """½·k·((w + p)² - p²), as in Bullet, whose jump is as far."""
    needs.package("pybullet")
    robot = replace(kenan, springs=(replace(kenan.spring, preload_rad=preload_rad),))
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


def test_spheres_of_both_sides_are_one_and_those_of_another_place_or_radius_are_not(kenan: Robot) -> None:
    """Toes on the left and the right; a larger sphere about the same centre is there too."""

    def sphere(x: float, y: float, radius: float) -> ContactSphere:
        return ContactSphere(f"{x} {y} {radius}", np.array([x, y, -0.01]), radius, "foot")

    toes = (sphere(-0.05, 0.02, 0.002), sphere(-0.05, -0.02, 0.002), sphere(0.04, 0.0, 0.002), sphere(0.04, 0.0, 0.003))
    bodies = {name: replace(kenan.bodies[name], contacts=()) for name in BODY_NAMES}
    bodies |= {
        FOOT: replace(kenan.bodies[FOOT], contacts=toes),
        BODY: replace(kenan.bodies[BODY], contacts=(sphere(0.1, 0.0, 0.005),)),
    }
    model = planar_model(replace(kenan, bodies=bodies), Settings())
    assert model.sole_m == (-0.05 - 0.01j, 0.04 - 0.01j, 0.04 - 0.01j)
    assert model.sole_radius_m == (0.002, 0.002, 0.003)
    assert (model.belly_m, model.belly_radius_m) == ((0.1 - 0.01j,), (0.005,))
