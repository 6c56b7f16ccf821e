"""Pin friction as one torque at the leg joint."""

from dataclasses import replace

import numpy as np
import pytest
from support.decimals import decimals
from support.machines import PINS_M, rubbing
from support.masses import in_plane

from jumpcad.design import Design, load_design
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.strength.loads import TILTING, pin_torque_nm, push_off


def test_it_grows_with_coefficient_and_radius_and_each_pin_adds_its_own() -> None:
    robot = rubbing(capsule_robot(load_design("best-bo")), pin=0.25)
    whole = pin_torque_nm(robot, 0.25)
    assert decimals([pin_torque_nm(robot, coefficient) for coefficient in (0.1, 0.2, 0.25)]) == 6  # micronewton metres
    for times in (2.0, 4.0):
        assert pin_torque_nm(robot, times * 0.25) == pytest.approx(times * whole, abs=1e-6 * times)
    alone = []
    for pin in range(4):
        radii = tuple(radius if index == pin else 0.0 for index, radius in enumerate(PINS_M))
        alone.append(pin_torque_nm(rubbing(robot, pin=0.25, pin_radius_m=radii), 0.25))
    assert min(alone) > 0.0
    assert sum(alone) == pytest.approx(whole, abs=4e-6)


def test_capsules_have_no_pins() -> None:
    robot = capsule_robot(load_design("best-bo"))
    assert pin_torque_nm(robot, 0.25) == 0.0
    assert pin_torque_nm(replace(rubbing(robot)), 0.0) == 0.0


def test_each_pin_rubs_by_its_force_along_its_own_turn() -> None:
    """Turns of the pins between neighbouring positions, from poses alone; both links meet in the eye."""
    uneven = Design.from_vector([189.773, 1.18, 0.864, 0.748, 0.4, 60.869, 14.361, 10.146])
    robot = replace(rubbing(capsule_robot(uneven), pin=0.25), foot_depth_m=0.03)
    body = replace(robot.bodies["body"], com_m=np.array([0.02, 0.005, 0.03]))  # x and height count, not its side
    robot = replace(robot, bodies={**robot.bodies, "body": body})
    gyration = 1000.0 * (body.inertia_kg_m2[1, 1] / body.mass_kg) ** 0.5
    mass = in_plane(body.mass_kg, (20.0, 30.0), gyration)
    loads = push_off(robot.linkage, mass, robot.spring)
    pose = robot.linkage.pose(loads.leg_rad)
    leg, front, foot = robot.linkage.rest_rad + pose.leg_rad, robot.linkage.rest_rad + pose.front_rad, pose.foot_rad
    on_leg, on_front = np.hypot(*loads.ankle_n.T), np.abs(loads.front_n)
    turns = {0: (leg, on_leg), 1: (front, on_front), 2: (foot - leg, on_leg), 3: (foot - front, on_front)}
    for pin, (turn, force) in turns.items():
        radii = tuple(radius if index == pin else 0.0 for index, radius in enumerate(PINS_M))
        way = np.abs(np.diff(turn)) * (force[1:] + force[:-1]) / 2.0
        expected = TILTING * 0.25 * PINS_M[pin] * way.sum() / robot.spring.wind_rad
        assert pin_torque_nm(rubbing(robot, pin=0.25, pin_radius_m=radii), 0.25) == pytest.approx(
            expected, rel=1e-3, abs=1e-6
        )


def test_a_body_beside_the_plane_of_motion_rubs_alike_and_a_higher_one_does_not() -> None:
    robot = rubbing(capsule_robot(load_design("best-bo")), pin=0.25)

    def moved(way: int) -> float:
        body = robot.bodies["body"]
        place = body.com_m + 0.02 * np.eye(3)[way]
        return pin_torque_nm(replace(robot, bodies=robot.bodies | {"body": replace(body, com_m=place)}), 0.25)

    still = pin_torque_nm(robot, 0.25)
    assert moved(1) == still
    assert abs(moved(2) / still - 1.0) > 0.01
