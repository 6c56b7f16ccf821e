"""The PyBullet back end: it holds the robot that it was given."""

import math
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.machines import let_go

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Friction
from jumpcad.mechanism.poses import body_poses, release_pose
from jumpcad.robot import Robot
from jumpcad.settings import coefficients
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.bullet import BulletEngine, BulletWorld
from jumpcad.simulation.bullet_robot import LINKS
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics, loaded_state
from jumpcad.simulation.run import Run
from jumpcad.strength.pin_friction import pin_torque_nm

pytest.importorskip("pybullet")


def test_pybullet_has_the_robots_inertia(lopsided: Robot) -> None:
    """Masses, centres and tensors read back from PyBullet (createMultiBody alone takes them from the colliders)."""
    bullet = pytest.importorskip("pybullet")
    with engine_named("pybullet").world(lopsided, Settings()) as world:
        for link, name in enumerate((BODY, *LINKS), start=-1):
            info = bullet.getDynamicsInfo(world.robot_id, link, physicsClientId=world._client)
            axes = np.array(bullet.getMatrixFromQuaternion(info[4])).reshape(3, 3)
            body = lopsided.bodies[name]
            assert info[0] == pytest.approx(body.mass_kg, rel=1e-12)
            np.testing.assert_allclose(info[3], body.com_m, rtol=1e-9)
            np.testing.assert_allclose(axes @ np.diag(info[2]) @ axes.T, body.inertia_kg_m2, rtol=1e-9, atol=1e-15)


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


def test_the_body_moves_as_the_roller_leaves_the_cam() -> None:
    """Bullet is given the velocity of the centre of mass: that of the frame's origin, and the turn about y with it.

    Of a robot whose links are not parallel: else the body does not turn.
    """
    bullet, uneven = pytest.importorskip("pybullet"), capsule_robot(load_design("best-ga"))
    body = replace(uneven.bodies[BODY], com_m=np.array([0.012, 0.0, -0.007]))  # the links' are elsewhere
    robot = let_go(replace(uneven, bodies={**uneven.bodies, BODY: body}))
    release = release_pose(robot)
    assert abs(release.body_rad_s) > 0.05
    with engine_named("pybullet").world(robot, Settings()) as world:
        velocity, spin = bullet.getBaseVelocity(world.robot_id, physicsClientId=world._client)
        place, _ = bullet.getBasePositionAndOrientation(world.robot_id, physicsClientId=world._client)
    np.testing.assert_allclose(spin, [0.0, release.body_rad_s, 0.0], atol=1e-9)
    arm = np.array(place) - release.body_position_m
    assert np.abs(arm[[0, 2]]).min() > 1e-3
    expected = np.array(release.body_m_s) + release.body_rad_s * np.array([arm[2], 0.0, -arm[0]])
    np.testing.assert_allclose(velocity, expected, atol=1e-6)


@pytest.mark.parametrize("friction", [0.37, 1.1])
def test_pybullets_ground_has_the_settings_friction_and_leaves_bounces_to_the_robot(
    kenan: Robot, friction: float
) -> None:
    """Bullet multiplies the restitutions of both sides: that of the ground is 1."""
    bullet = pytest.importorskip("pybullet")
    with engine_named("pybullet").world(kenan, Settings(ground_friction=friction)) as world:
        info = bullet.getDynamicsInfo(world._ground, -1, physicsClientId=world._client)
        assert bullet.getPhysicsEngineParameters(physicsClientId=world._client)["gravityAccelerationZ"] == -9.81
    assert (info[0], info[1], info[5]) == (0.0, friction, 1.0)


def test_the_pins_rub_once_and_at_the_leg() -> None:
    """Their torque is that of the leg's joint (`pin_torque_nm`), beside what the settings ask of every joint."""
    plain = capsule_robot(load_design("kenan-2.0"))
    robot = replace(plain, friction=Friction(0.7, 0.5, 0.2, (0.0015, 0.002, 0.002, 0.002)))
    pins = pin_torque_nm(robot, 0.2)
    assert pins > 1e-4
    with engine_named("pybullet").world(robot, Settings(joint_friction_nm=0.003)) as world:
        assert world._dry_nm == pytest.approx([0.003 + pins, 0.003, 0.003])
    with engine_named("pybullet").world(plain, Settings()) as world:
        assert world._dry_nm == [0.0, 0.0, 0.0]


def test_a_foot_that_slides_loses_energy_also_without_pads_of_its_own(kenan: Robot) -> None:
    """On ice; on the study's floor, on which no foot slides, nothing is looked up."""
    icy, dry = (simulate(kenan, Settings(ground_friction=ground)).energy for ground in (0.1, None))
    assert icy is not None
    assert dry is not None
    assert icy.slip_j > 0.001 * kenan.spring.energy_j
    assert dry.slip_j == 0.0


def test_pybullet_has_the_settings_of_bodies_and_steps(kenan: Robot) -> None:
    """Read back: friction, bounce and rolling of every link, axes of joints, steps, iterations."""
    bullet = pytest.importorskip("pybullet")
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


def test_the_loop_and_the_joints_are_closed_in_pybullet_at_release(lopsided: Robot) -> None:
    """Bodies stand where the release pose has them, and the loop's two points are one."""
    with engine_named("pybullet").world(lopsided, Settings()) as world:
        state = world.state()
    mechanics = Mechanics(lopsided, 9.81)
    assert mechanics.loop_gap_m(state) < 1e-6
    assert state.leg_rad == pytest.approx(-lopsided.spring.wind_rad)
    for index, (name, pose) in enumerate(body_poses(lopsided, 1.0).items()):
        at = BODY_NAMES.index(name)
        np.testing.assert_allclose(mechanics.frame_positions_m(state)[at], pose[:3, 3], atol=1e-6, err_msg=str(index))
        np.testing.assert_allclose(state.rotation[at], pose[:3, :3], atol=1e-6)
    assert np.abs(state.velocity_m_s).max() == 0.0


def test_the_loop_stays_closed_in_pybullet_while_the_leg_turns(lopsided: Robot) -> None:
    """Its two points are those of front link and foot, however the axes of their inertia are turned."""
    turn = Rotation.from_rotvec([-0.9, 0.2, 0.4]).as_matrix()
    foot = lopsided.bodies[FOOT]
    other = replace(foot, inertia_kg_m2=turn @ foot.inertia_kg_m2 @ turn.T)
    robot = replace(lopsided, bodies={**lopsided.bodies, FOOT: other})
    with engine_named("pybullet").world(robot, Settings()) as world:
        world.advance(60)
        state = world.state()
    assert state.leg_rad > -lopsided.spring.wind_rad + 0.05
    assert Mechanics(lopsided, 9.81).loop_gap_m(state) < 2e-4


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


def test_pybullet_has_every_contact_sphere_where_it_is_and_as_large(lopsided: Robot) -> None:
    """Read back in the principal axes at the centre of mass, where Bullet has them."""
    bullet = pytest.importorskip("pybullet")
    bodies = {
        name: replace(
            body,
            contacts=tuple(
                replace(contact, radius_m=0.003 + 0.001 * number) for number, contact in enumerate(body.contacts)
            ),
        )
        for name, body in lopsided.bodies.items()
    }
    robot, seen = replace(lopsided, bodies=bodies), 0
    with engine_named("pybullet").world(robot, Settings()) as world:
        for link, name in enumerate((BODY, *LINKS), start=-1):
            client, body = world._client, bodies[name]
            axes = bullet.getDynamicsInfo(world.robot_id, link, physicsClientId=client)[4]
            turn = np.array(bullet.getMatrixFromQuaternion(axes)).reshape(3, 3)
            shapes = bullet.getCollisionShapeData(world.robot_id, link, physicsClientId=client)
            assert len(shapes) == len(body.contacts)
            for shape, contact in zip(shapes, body.contacts, strict=True):
                assert shape[2] == bullet.GEOM_SPHERE
                assert shape[3][0] == pytest.approx(contact.radius_m)
                np.testing.assert_allclose(turn @ shape[5], contact.centre_m - body.com_m, atol=1e-7)
                seen += 1
    assert seen == 5


def test_drag_slows_travel_and_turning() -> None:
    """In the air, about the upright axis, about which nothing of the robot pushes."""
    bullet, robot = pytest.importorskip("pybullet"), capsule_robot(load_design("kenan-2.0"))
    left = []
    for drag in (0.0, 20.0):
        with engine_named("pybullet").world(robot, Settings(drag_per_s=drag)) as world:
            client = world._client
            bullet.resetBasePositionAndOrientation(world.robot_id, [0, 0, 1], [0, 0, 0, 1], physicsClientId=client)
            bullet.resetBaseVelocity(world.robot_id, [0, 1, 0], [0, 0, 5], physicsClientId=client)
            world.advance(round(0.005 / Settings().dt_s))
            velocity, spin = bullet.getBaseVelocity(world.robot_id, physicsClientId=client)
            left.append((velocity[1], spin[2] / 5.0))
    (free_m_s, free_spin), (slowed_m_s, slowed_spin) = left
    assert free_m_s == pytest.approx(1.0, abs=0.02)
    assert free_spin == pytest.approx(1.0, abs=0.02)
    assert slowed_m_s < math.exp(-0.1) + 0.02  # 20/s for 5 ms
    assert slowed_spin < math.exp(-0.1)


def test_pybullet_is_told_how_long_steps_are_and_when_its_solver_may_end(
    kenan: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """PyBullet does not give all of it back."""
    bullet = pytest.importorskip("pybullet")
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
    bullet = pytest.importorskip("pybullet")
    first, engine = bullet.connect(bullet.DIRECT), BulletEngine()
    yield engine
    for client in (engine._client, first):
        bullet.disconnect(physicsClientId=client)


def test_bullet_runs_alike_in_another_client_and_leaves_the_first_alone(kenan: Robot, other: BulletEngine) -> None:
    """A robot that slips on the way: friction, bounce, drag, damping and contacts all have a part."""
    bullet, robot = pytest.importorskip("pybullet"), let_go(kenan)
    settings = Settings(
        ground_friction=0.35, restitution=0.3, drag_per_s=0.5, joint_damping_nms_per_rad=1e-4, joint_friction_nm=0.002,
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


def test_joints_turn_faster_than_bullets_own_limit_of_100_rad_s(other: BulletEngine) -> None:
    """Let go with the leg at 150 rad/s, it goes on so."""
    robot = let_go(capsule_robot(load_design("best-ga")), leg_rad_s=150.0)
    with other.world(robot, Settings()) as world:
        before = world.state()
        world.advance(5)
        after = world.state()
    assert after.leg_rad - before.leg_rad == pytest.approx(150.0 * 5 * Settings().dt_s, rel=0.1)


def test_every_link_is_seen_as_one_small_box(kenan: Robot, other: BulletEngine) -> None:
    """One that Bullet makes of the contacts' spheres costs more than the whole robot."""
    bullet = pytest.importorskip("pybullet")
    with other.world(kenan, Settings()) as world:
        seen = bullet.getVisualShapeData(world.robot_id, physicsClientId=other._client)
    assert [shape[1] for shape in seen] == [-1, 0, 1, 2]
    assert {shape[2] for shape in seen} == {bullet.GEOM_BOX}
    assert np.array([shape[3] for shape in seen]) == pytest.approx(0.002)
