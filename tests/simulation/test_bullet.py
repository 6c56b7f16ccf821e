"""The PyBullet back end: it holds the robot that it was given."""

import math
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support import needs
from support.machines import let_go

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT
from jumpcad.robot import Robot
from jumpcad.settings import coefficients
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.bullet import BulletEngine, BulletWorld
from jumpcad.simulation.bullet_robot import LINKS
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import loaded_state
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


@pytest.mark.parametrize("key", ["com_m", "velocity_m_s"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_one_number_that_is_none_is_a_robot_blown_up(kenan: Robot, key: str, value: float) -> None:
    whole = loaded_state(kenan)
    broken = getattr(whole, key).copy()
    broken[2, 1] = value
    for state, blown in ((whole, False), (replace(whole, **{key: broken}), True)):
        assert BulletWorld.blown_up(SimpleNamespace(state=lambda state=state: state)) == blown  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("forces", "loaded"), [((), False), ((0.0,), False), ((0.0, 0.0), False), ((0.0, 1e-6), True), ((2.0, 0.0), True)]
)
def test_the_ground_carries_what_a_contact_presses_on_it(forces: tuple[float, ...], loaded: bool) -> None:
    """A sphere that is only near is a contact without a force."""
    world = object.__new__(BulletWorld)
    contacts = [[None] * 9 + [force] for force in forces]
    world._bullet = SimpleNamespace(getContactPoints=lambda *_, **__: contacts)
    world.robot_id, world._ground, world._client = 0, 1, 0
    assert world.loaded() == loaded


def test_slip_takes_the_contacts_force_times_the_foots_velocity_there() -> None:
    """v + w x r by numpy's cross product; the mean of before and after, against the force, for a time step."""
    rng = np.random.default_rng(5)
    before, after = ([rng.normal(size=3) for _ in range(3)] for _ in range(2))
    contacts = [
        [None] * 5
        + [rng.normal(size=3)]
        + [None] * 4
        + [0.7, np.array([0.6, 0.8, 0.0]), -0.4, np.array([-0.8, 0.6, 0.0])]
        for _ in range(2)
    ]
    world = object.__new__(BulletWorld)
    world._bullet = SimpleNamespace(getContactPoints=lambda *_, **__: contacts)
    world._dt_s, world._foot, world.robot_id, world._ground, world._client = 0.01, tuple(before), 0, 1, 0
    world._foot_motion = lambda: tuple(after)
    lost = 0.0
    for contact in contacts:
        force = 0.7 * contact[11] - 0.4 * contact[13]
        for com, velocity, spin in (before, after):
            lost -= 0.5 * force @ (velocity + np.cross(spin, contact[5] - com)) * 0.01
    assert world._slip_work_j() == pytest.approx(lost)
    assert world._foot == tuple(after)


def test_every_step_pushes_with_springs_and_pad_and_counts_what_the_joints_take() -> None:
    """On the leg alone; c·w²·dt and the dry torque times |w|·dt, over all three joints and steps."""
    rates = np.array([[0.5, -2.0, 3.0], [-1.0, 4.0, 0.25]])
    states = iter([((0.3, a), (7.0, b), (8.0, c)) for a, b, c in rates])
    pushes: list[tuple[int, int, int, float]] = []
    world = object.__new__(BulletWorld)
    world._bullet = SimpleNamespace(
        TORQUE_CONTROL=2,
        stepSimulation=lambda _client: None,
        getJointStates=lambda *_: next(states),
        setJointMotorControl2=lambda robot, joint, mode, *, force, physicsClientId: pushes.append(
            (robot, joint, mode, force)
        ),
    )
    world.robot_id, world._client, world._slides, world.joint_damping_j = 5, 0, False, 0.1
    world._spring = SimpleNamespace(torque_nm=lambda angle: 10.0 * angle)  # type: ignore[assignment]
    world._pad = SimpleNamespace(torque_nm=lambda angle, rate: angle + rate)  # type: ignore[assignment]
    world._dry_nm, world._damping_dt, world._dt_s = [0.1, 0.2, 0.4], 0.002, 0.01
    assert world.advance(2) == 0.3
    assert pushes == [(5, 0, 2, pytest.approx(3.0 - 0.3 - rate)) for rate in rates[:, 0]]
    lost = 0.002 * (rates**2).sum() + 0.01 * (np.abs(rates) @ [0.1, 0.2, 0.4]).sum()
    assert world.joint_damping_j == pytest.approx(0.1 + lost)


@pytest.mark.parametrize("friction", [0.37, 1.1])
def test_pybullets_ground_has_the_settings_friction_and_leaves_bounces_to_the_robot(
    kenan: Robot, friction: float
) -> None:
    """Bullet multiplies the restitutions of both sides: that of the ground is 1."""
    bullet = needs.package("pybullet")
    with engine_named("pybullet").world(kenan, Settings(ground_friction=friction)) as world:
        info = bullet.getDynamicsInfo(world._ground, -1, physicsClientId=world._client)
        assert bullet.getPhysicsEngineParameters(physicsClientId=world._client)["gravityAccelerationZ"] == -9.81
    assert (info[0], info[1], info[5]) == (0.0, friction, 1.0)


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
        foot_friction=0.8, body_friction=0.3, gravity_m_s2=1.62,
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
        assert bullet.getNumBodies(physicsClientId=client) == 2
        assert world.loaded() or world.advance(3) < 0.0
    assert bullet.getNumBodies(physicsClientId=client) == 1  # the ground


def test_the_foots_motion_is_that_of_the_state(kenan: Robot) -> None:
    """Centre of mass, its velocity, and the spin, of a robot that has just been let go."""
    robot = let_go(kenan)
    with engine_named("pybullet").world(robot, Settings()) as world:
        world.advance(20)
        (com, velocity, spin), state = world._foot_motion(), world.state()
    foot = BODY_NAMES.index(FOOT)
    # without the kinematics of the step's end, for which `state` asks
    np.testing.assert_allclose(com, state.com_m[foot], atol=5e-5)
    np.testing.assert_allclose(velocity, state.velocity_m_s[foot], atol=5e-5)
    np.testing.assert_allclose(spin, state.angular_rad_s[foot], atol=0.01)
    assert np.abs(velocity).max() > 1e-3


def test_pybullet_is_told_how_long_steps_are_and_when_its_solver_may_end(
    kenan: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """PyBullet does not give all of it back."""
    bullet = needs.package("pybullet")
    told: dict[str, float] = {}
    set_parameters = bullet.setPhysicsEngineParameter
    monkeypatch.setattr(
        bullet, "setPhysicsEngineParameter", lambda **given: told.update(given) or set_parameters(**given)
    )
    settings = Settings(dt_s=0.0004, solver_iterations=77, solver_residual=3e-6)
    with engine_named("pybullet").world(kenan, settings) as world:
        client = world._client
    assert told == {
        "fixedTimeStep": 0.0004, "numSolverIterations": 77, "solverResidualThreshold": 3e-6, "numSubSteps": 0,
        "physicsClientId": client,
    }  # fmt: skip


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
