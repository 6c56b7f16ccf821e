"""Light robots that push off within a few milliseconds: the time step follows."""

import math

import pytest

from jumpcad.design import Design, load_design
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Settings, load_settings, simulate
from jumpcad.simulation.simulator import divided

LIGHT = [
    [21.5234, 0.87594, 0.61326, 0.51893, 0.70789, 70.2814, 167.2311, 20.3303],  # 2.5 ms, near its dead point
    [30.0, 1.0, 0.8, 0.9, 0.6, 75.0, 60.0, 30.0],
]
"""In the order of `Design.from_vector`; the first ended in an overflow."""


def test_a_coarse_step_leaves_engines_apart_and_the_divided_one_brings_them_together() -> None:
    pytest.importorskip("mujoco")
    robot = capsule_robot(Design.from_vector(LIGHT[1]))
    planar, mujoco = (simulate(robot, engine=engine).ballistic_range_m for engine in ("planar", "mujoco"))
    assert planar == pytest.approx(mujoco, rel=0.01)
    coarse = simulate(robot, Settings(push_off_steps=0), "mujoco").ballistic_range_m
    assert abs((coarse or 0.0) / planar - 1.0) > 0.02


def test_a_robot_near_its_dead_point_jumps_or_is_refused_in_words() -> None:
    robot = capsule_robot(Design.from_vector(LIGHT[0]))
    assert simulate(robot, engine="planar").verdict == "jump"
    blown = simulate(robot, Settings(push_off_steps=0), "planar")
    assert blown.verdict == "audit_energy"
    assert robot.spring.stored_j(1e200) == math.inf


def test_templates_keep_their_step_and_half_the_time_means_four_times_the_steps() -> None:
    robot = capsule_robot(load_design("best-printable"))
    assert divided(robot, Settings()) == Settings()
    assert divided(robot, load_settings("screening")).dt_s == 0.001
    twice = divided(robot, Settings(push_off_steps=120))
    assert twice.dt_s == pytest.approx(divided(robot, Settings(push_off_steps=240)).dt_s * 4.0)
