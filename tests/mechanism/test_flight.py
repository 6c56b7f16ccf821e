"""The blow on the rest stop, against the planar engine without damping, and against momenta of simple bodies."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad.mechanism.flight import leg_blow
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.settings import load_settings
from jumpcad.simulation.planar import PlanarEngine
from jumpcad.transforms import turned_about_y


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_the_leg_is_as_fast_as_in_an_engine_without_losses(name: str) -> None:
    """The engine integrates another model at another step: no damping, and friction that holds."""
    robot = replace(built(name), roller_off=None)
    lossless = {"joint_damping_nms_per_rad": 0.0, "pin_friction": 0.0, "foot_friction": 50.0}
    settings = load_settings("default").model_copy(update=lossless)
    with PlanarEngine().world(robot, settings) as world:
        while world.moment.leg_rad <= 0.0:
            world.advance(1)
        leg, rate = world.moment.leg_rad, world.moment.speed.leg
    blow = leg_blow(robot.bodies, robot.linkage, robot.spring, leg)
    assert blow.stop_rad_s == pytest.approx(rate, rel=5e-3)


def test_damping_only_takes_from_the_blow() -> None:
    robot = built("best-bo")
    with PlanarEngine().world(robot, load_settings("default")) as world:
        while world.moment.leg_rad <= 0.0:
            world.advance(1)
        leg, rate = world.moment.leg_rad, world.moment.speed.leg
    assert leg_blow(robot.bodies, robot.linkage, robot.spring, leg).stop_rad_s > rate


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_inertia_in_flight_is_what_is_left_without_momenta(name: str) -> None:
    """Least squares: of all motions of the body's frame, free flight takes the one with the least energy."""
    robot = built(name)
    stop, step = math.radians(3.0), 1e-5
    pose = robot.linkage.pose([stop - step, stop, stop + step])
    turns = {
        "body": np.zeros(3), "main_leg": robot.linkage.rest_rad + pose.leg_rad,
        "front_link": robot.linkage.rest_rad + pose.front_rad, "foot": pose.foot_rad,
    }  # fmt: skip
    starts = {
        "body": np.zeros((3, 2)), "main_leg": np.tile(robot.linkage.back_pivot_mm, (3, 1)),
        "front_link": np.tile(robot.linkage.front_pivot_mm, (3, 1)), "foot": pose.ankle_mm,
    }  # fmt: skip
    rows, right = [], []
    for body in BODY_NAMES:
        mass, inertia = robot.bodies[body].mass_kg, robot.bodies[body].inertia_kg_m2[1, 1]
        centre = starts[body] / 1000.0 + turned_about_y(robot.bodies[body].com_m[[0, 2]], turns[body])
        rate, turning = (centre[2] - centre[0]) / (2.0 * step), (turns[body][2] - turns[body][0]) / (2.0 * step)
        x, z = centre[1]
        weigh = math.sqrt(mass)
        rows += [[weigh, 0.0, weigh * z], [0.0, weigh, -weigh * x], [0.0, 0.0, math.sqrt(inertia)]]
        right += [-weigh * rate[0], -weigh * rate[1], -math.sqrt(inertia) * turning]
    solved = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    blow = leg_blow(robot.bodies, robot.linkage, robot.spring, stop)
    assert blow.inertia_kg_m2 == pytest.approx(float(solved[1][0]), rel=2e-3)
