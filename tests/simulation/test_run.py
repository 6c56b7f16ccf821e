"""The run: gate, audit, flight, trajectory, published quantities."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.flights import Flight, make_lopsided

from jumpcad.design import Design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.mechanism.poses import release_pose
from jumpcad.robot import Robot
from jumpcad.simulation import Settings, simulate

pytest.importorskip("pybullet")


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


def test_a_robot_that_only_stands_up_does_not_take_off() -> None:
    """1.4 times the work of standing up passes the gate, and is lost before the feet leave the ground."""
    design = Design.from_vector([171.289, 1.139, 0.66, 1.043, 0.436, 67.926, 12.932, 38.146])
    jump = simulate(capsule_robot(design))
    assert jump.verdict == "no_takeoff"
    assert jump.fitness == 0.0
    assert jump.ballistic_range_m is None


def test_audit_rejects_a_loop_that_comes_apart(jumping: list[Flight]) -> None:
    """One iteration of the solver at a coarse step cannot hold the loop of a strong robot together."""
    best = next(flight.robot for flight in jumping if flight.name == "ga-c")
    jump = simulate(best, Settings(dt_s=1 / 240, solver_iterations=1))
    assert jump.verdict == "audit_loop"
    assert jump.fitness == 0.0
    assert jump.ballistic_range_m is None
    finding = jump.findings[-1]
    assert (finding.name, finding.severity) == ("audit_loop", "error")
    assert "dt_s" in finding.remedy


def test_audit_rejects_energy_from_nowhere(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine whose spring pushes twice as hard as the robot's."""
    from jumpcad.simulation.bullet import BulletWorld

    born = BulletWorld.__init__

    def stronger(world: BulletWorld, *arguments: object) -> None:
        born(world, *arguments)  # type: ignore[arg-type]
        world._stiffness *= 2

    monkeypatch.setattr(BulletWorld, "__init__", stronger)
    jump = simulate(kenan)
    assert jump.verdict == "audit_energy"
    assert jump.findings[-2].margin < 0


@pytest.mark.filterwarnings("error")
def test_a_run_that_blows_up_is_rejected_and_leaves_no_trace(kenan: Robot) -> None:
    before = simulate(kenan)
    jump = simulate(
        kenan, Settings.model_construct(**vars(Settings()) | {"joint_damping_nms_per_rad": 1e300, "trajectory": True})
    )
    assert (jump.verdict, jump.ballistic_range_m) == ("audit_energy", None)
    assert jump.trajectory is not None
    assert np.isfinite(jump.trajectory.position_m).all()
    assert simulate(kenan).ballistic_range_m == before.ballistic_range_m


def test_time_runs_out(kenan: Robot) -> None:
    assert simulate(kenan, Settings(max_time_s=0.01)).verdict == "no_takeoff"


def test_heavier_gravity_makes_it_too_weak(kenan: Robot) -> None:
    """At 9.81 m/s² the springs hold 6.8 times the work of standing up."""
    assert simulate(kenan, Settings(gravity_m_s2=9.81 * 4)).verdict != "too_weak"
    assert simulate(kenan, Settings(gravity_m_s2=9.81 * 6)).verdict == "too_weak"


def test_trajectory(kenan: Robot) -> None:
    settings = Settings(flight="simulated", trajectory=True, trajectory_rate_hz=500)
    jump = simulate(kenan, settings)
    path = jump.trajectory
    assert path is not None
    start = release_pose(kenan)
    body, foot = path.body_names.index(BODY), path.body_names.index(FOOT)
    np.testing.assert_allclose(np.diff(path.time_s)[:-1], 1 / 500)
    np.testing.assert_allclose(path.position_m[0, body], start.body_position_m, atol=1e-12)
    np.testing.assert_allclose(path.position_m[0, foot], [0, 0, kenan.foot_depth_m], atol=1e-9)
    assert path.position_m[-1, body, 0] - path.position_m[0, body, 0] == pytest.approx(jump.touchdown_distance_m)
    assert path.spring_j[0] == pytest.approx(jump.spring_energy_j)
    total = path.kinetic_j + path.potential_j + path.spring_j
    assert np.all(np.diff(total) < 1e-4 * total[0]), "energy only falls"
    loop = kenan.loop
    ends = []
    for name, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
        index = path.body_names.index(name)
        ends.append(path.position_m[:, index] + Rotation.from_quat(path.quaternion_xyzw[:, index]).apply(point))
    np.testing.assert_allclose(ends[0], ends[1], atol=5e-5)
    assert len(list(path.rows())) == len(path.time_s)
    assert list(next(path.rows()))[:2] == ["time_s", "body_x_m"]


def test_recording_and_flying_do_not_change_the_jump(kenan: Robot) -> None:
    plain = simulate(kenan)
    recorded = simulate(kenan, Settings(flight="simulated", trajectory=True, trajectory_rate_hz=300))
    assert recorded.ballistic_range_m == plain.ballistic_range_m
    assert plain.trajectory is None
    assert plain.touchdown_distance_m is None


def test_published_quantities_are_apart_and_larger(kenan: Robot) -> None:
    """Tumbling after touchdown is counted as distance, and standing height as height."""
    jump = simulate(kenan, Settings(published_quantities=True))
    assert jump.published is not None
    assert jump.published.base_distance_m is not None
    assert jump.touchdown_distance_m is not None
    assert jump.com_rise_m is not None
    assert jump.published.base_distance_m > 1.2 * jump.touchdown_distance_m
    assert jump.published.base_height_m > jump.com_rise_m + 0.9 * release_pose(kenan).body_position_m[2]
    assert simulate(kenan).published is None


def test_lateral_symmetry(kenan: Robot) -> None:
    """A robot mirrored left to right jumps as far: its tensors' and centres' y components change sign."""
    flip = np.diag([1.0, -1.0, 1.0])
    right = make_lopsided(kenan)
    left = replace(
        right,
        bodies={
            name: replace(
                body,
                com_m=flip @ body.com_m,
                inertia_kg_m2=flip @ body.inertia_kg_m2 @ flip,
                contacts=tuple(replace(contact, centre_m=flip @ contact.centre_m) for contact in body.contacts),
            )
            for name, body in right.bodies.items()
        },
    )
    fine = Settings(dt_s=1 / 8000, solver_iterations=200)
    assert simulate(left, fine).ballistic_range_m == pytest.approx(simulate(right, fine).ballistic_range_m, rel=1e-3)
