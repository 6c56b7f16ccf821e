"""Feasibility and verdict of a simulated jump."""

import math

import pytest
from support import needs

from jumpcad.design import Design, load_design
from jumpcad.mechanism.variants import capsule_robot, with_spring_factor
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, load_settings, simulate
from jumpcad.simulation.simulator import divided

needs.package("pybullet")


def test_springs_that_give_less_than_they_hold_jump_as_weaker_ones(kenan: Robot) -> None:
    """Efficiency 0.8: as with 0.8 of the stiffness; with 0.1 they are too weak to try."""
    jump = simulate(kenan, Settings(spring_efficiency=0.8), "planar")
    weaker = simulate(with_spring_factor(kenan, 0.8), engine="planar")
    assert jump.spring_energy_j == pytest.approx(0.8 * kenan.spring.energy_j)
    assert jump.ballistic_range_m == weaker.ballistic_range_m
    assert jump.energy == weaker.energy
    assert simulate(kenan, Settings(spring_efficiency=0.1), "planar").verdict == "too_weak"


@pytest.mark.parametrize(
    ("vector", "verdict"),
    [
        ([100, 1.1596, 0.6455, 0.6, 0.8, 70, 30, 10], "loop"),
        ([144.04, 1.18, 0.7, 0.94, 0.53, 69.75, 28.72, 42.2], "below_ground"),
        ([100, 1.0, 0.833, 0.2, 0.755, 70, 29.5, 40], "tips"),
        ([100, 1.0, 0.833, 0.934, 0.2, 70, 5, 40], "too_weak"),
    ],
)
def test_refused_designs_are_not_simulated(vector: list[float], verdict: str) -> None:
    jump = simulate(capsule_robot(Design.from_vector(vector)))
    assert jump.verdict == verdict
    assert jump.fitness == 0.0
    assert jump.ballistic_range_m is jump.com_rise_m is jump.takeoff_energy_ratio is jump.touchdown_distance_m is None
    refusal = next(finding for finding in jump.findings if finding.name == verdict)
    assert refusal.severity == "error"
    assert refusal.margin < 0
    assert refusal.remedy


def test_heavier_gravity_makes_it_too_weak(kenan: Robot) -> None:
    """At 9.81 m/s² the springs hold 6.8 times the work of standing up."""
    assert simulate(kenan, Settings(gravity_m_s2=9.81 * 4)).verdict != "too_weak"
    assert simulate(kenan, Settings(gravity_m_s2=9.81 * 6)).verdict == "too_weak"


@pytest.mark.parametrize("change", [{"c_coef": 1.05}, {"e_coef": 1.15}])
def test_a_jumps_fitness_is_its_range_in_lengths_of_the_longest_of_legs_and_toes(change: dict[str, float]) -> None:
    design = load_design("kenan-2.0").model_copy(update=change)
    longest = max(design.l2_mm, design.l3_mm, design.l5_mm)
    assert longest > 1.01 * design.l2_mm
    jump = simulate(capsule_robot(design), engine="planar")
    assert jump.ballistic_range_m is not None
    assert jump.fitness == pytest.approx(1000.0 * jump.ballistic_range_m / longest)


def test_a_robot_that_stays_on_the_ground_has_a_trajectory_and_the_audit_too() -> None:
    """What it did is there to be looked at; figures of a jump are none."""
    design = Design.from_vector([171.289, 1.139, 0.66, 1.043, 0.436, 67.926, 12.932, 38.146])
    robot = capsule_robot(design)
    jump = simulate(robot, Settings(trajectory=True), "planar")
    assert jump.verdict == "no_takeoff"
    assert (jump.mass_kg, jump.spring_energy_j, jump.engine) == (robot.mass_kg, robot.spring.energy_j, "planar")
    assert jump.trajectory is not None
    assert jump.trajectory.time_s[-1] > 0.05
    names = [finding.name for finding in jump.findings]
    assert {"loop", "below_ground", "tips", "too_weak", "audit_energy", "audit_loop"} < set(names)
    assert names[-1] == "no_takeoff"
    assert jump.energy is jump.takeoff_time_s is None


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
