"""The PyBullet back end: it holds the robot that it was given."""

from collections.abc import Iterator

import numpy as np
import pytest
from support import needs
from support.machines import let_go

from jumpcad.mechanism.model import BODY
from jumpcad.robot.robot import Robot
from jumpcad.settings import coefficients
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.bullet import BulletEngine
from jumpcad.simulation.bullet_robot import LINKS
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.run import Run

needs.package("pybullet")


@pytest.mark.filterwarnings("error")
def test_a_run_that_blows_up_is_rejected_and_leaves_no_trace(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """By a damping that settings refuse."""
    before = simulate(kenan)
    monkeypatch.setattr(Settings, "revalidated", lambda settings: settings)
    jump = simulate(
        kenan, Settings.model_construct(**vars(Settings()) | {"joint_damping_nms_per_rad": 1e300, "trajectory": True})
    )
    assert (jump.verdict, jump.ballistic_range_m) == ("audit_energy", None)
    assert jump.trajectory is not None
    assert np.isfinite(jump.trajectory.position_m).all()
    assert simulate(kenan).ballistic_range_m == before.ballistic_range_m


def test_a_foot_that_slides_loses_energy_also_without_pads_of_its_own(kenan: Robot) -> None:
    """On ice; on the study's floor, on which no foot slides, nothing is looked up."""
    icy, dry = (simulate(kenan, Settings(ground_friction=ground)).energy for ground in (0.1, None))
    assert icy is not None
    assert dry is not None
    assert icy.slip_j > 0.001 * kenan.spring.energy_j
    assert dry.slip_j == 0.0


def test_pybullet_has_the_settings_of_bodies_and_steps(kenan: Robot) -> None:
    """Read back: friction, bounce and rolling of every link, axes of joints, steps, iterations."""
    bullet = needs.package("pybullet")
    settings = Settings(
        dt_s=0.0004, solver_iterations=77, restitution=0.25, rolling_friction_m=0.001, spinning_friction_m=0.002,
        foot_friction=0.8, body_friction=0.3, gravity_m_s2=1.62, ground_friction=1.1,
    )  # fmt: skip
    rubs = coefficients(kenan, settings)
    with engine_named("pybullet").world(kenan, settings) as world:
        client = world._client
        for link, name in enumerate((BODY, *LINKS), start=-1):
            info = bullet.getDynamicsInfo(world.robot_id, link, physicsClientId=client)
            assert info[1] == pytest.approx(rubs.of(kenan.bodies[name].surface)), name
            assert info[5:8] == pytest.approx((0.25, 0.001, 0.002)), name
        for link in range(3):
            joint = bullet.getJointInfo(world.robot_id, link, physicsClientId=client)
            assert joint[13] == (0.0, 1.0, 0.0)
        asked = bullet.getPhysicsEngineParameters(physicsClientId=client)
        assert (asked["fixedTimeStep"], asked["numSolverIterations"], asked["numSubSteps"]) == (0.0004, 77, 0)
        assert [asked[f"gravityAcceleration{axis}"] for axis in "XYZ"] == [0.0, 0.0, -1.62]
        assert bullet.getDynamicsInfo(world._ground, -1, physicsClientId=client)[1] == settings.ground_friction
        assert bullet.getNumBodies(physicsClientId=client) == 2
        assert world.loaded() or world.advance(3) < 0.0
    assert bullet.getNumBodies(physicsClientId=client) == 1  # the ground


@pytest.fixture
def other() -> Iterator[BulletEngine]:
    """An engine whose client is not the first, which PyBullet's functions take where none is named."""
    bullet = needs.package("pybullet")
    first, engine = bullet.connect(bullet.DIRECT), BulletEngine()
    yield engine
    for client in (engine._client, first):
        bullet.disconnect(physicsClientId=client)


def test_bullet_runs_alike_in_another_client_and_leaves_the_first_alone(kenan: Robot, other: BulletEngine) -> None:
    """A robot that slips on the way: friction, bounce, drag, damping and contacts all have a part."""
    bullet, robot = needs.package("pybullet"), let_go(kenan)
    settings = Settings(
        ground_friction=0.35, restitution=0.3, joint_damping_nms_per_rad=1e-4, joint_friction_nm=0.002,
        gravity_m_s2=8.0, dt_s=0.0005,
    )  # fmt: skip

    def run(engine: BulletEngine) -> Run:
        with engine.world(robot, settings) as world:
            run = Run(world, robot, settings)
            run.go()
        return run

    usual, first = run(engine_named("pybullet")), bullet.getNumBodies(physicsClientId=0)
    elsewhere = run(other)
    assert other._client != 0
    assert bullet.getNumBodies(physicsClientId=0) == first
    assert bullet.getNumBodies(physicsClientId=other._client) == 1  # the ground
    assert elsewhere.takeoff == usual.takeoff
    assert usual.takeoff is not None
    assert usual.takeoff.energy.slip_j > 0.0
