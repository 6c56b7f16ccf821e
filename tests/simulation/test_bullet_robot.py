"""A robot in PyBullet, read back: bodies, joints, friction and loop are those of the mechanism as it is released."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.machines import let_go

from jumpcad.design import load_design
from jumpcad.mechanism.model import BODY, FOOT, Friction, release_pose
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation.bullet_robot import LINKS, BulletRobot
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics
from jumpcad.strength.loads import pin_torque_nm

bullet = needs.package("pybullet")


@pytest.fixture
def client() -> Iterator[int]:
    """A client that is not the first, which PyBullet's functions take where none is named; the first stays empty."""
    first = bullet.connect(bullet.DIRECT)
    second = bullet.connect(bullet.DIRECT)
    before = bullet.getNumBodies(physicsClientId=0)
    assert second != 0
    yield second
    assert bullet.getNumBodies(physicsClientId=0) == before
    assert bullet.getNumBodies(physicsClientId=second) == 1
    for number in (second, first):
        bullet.disconnect(physicsClientId=number)


def test_all_joints_have_their_angles_and_rates_of_the_release(client: int) -> None:
    """Of a robot whose roller has just left the cam; no two of the three are alike."""
    mechanism = let_go(capsule_robot(load_design("best-ga")))
    release, robot = release_pose(mechanism), BulletRobot(bullet, client, mechanism, Settings())
    assert len({round(rate, 3) for rate in release.joint_rad_s.values()} - {0.0}) == 3
    for link, name in enumerate(("leg", "ankle", "front")):
        angle, rate, *_ = bullet.getJointState(robot.number, link, physicsClientId=client)
        assert (angle, rate) == pytest.approx((release.joint_rad[name], release.joint_rad_s[name]))


def test_joints_turn_faster_than_bullets_own_limit_of_100_rad_s(client: int) -> None:
    """Let go with the leg at 150 rad/s, without weight or ground, it goes on so."""
    mechanism = let_go(capsule_robot(load_design("best-ga")), leg_rad_s=150.0)
    robot, step = BulletRobot(bullet, client, mechanism, Settings()), 5e-5
    bullet.setPhysicsEngineParameter(fixedTimeStep=step, numSubSteps=0, physicsClientId=client)
    before, *_ = bullet.getJointState(robot.number, 0, physicsClientId=client)
    for _ in range(10):
        bullet.stepSimulation(physicsClientId=client)
    after, *_ = bullet.getJointState(robot.number, 0, physicsClientId=client)
    assert after - before == pytest.approx(150.0 * 10 * step, rel=0.1)


def test_pybullet_has_the_robots_inertia(lopsided: Robot) -> None:
    """Masses, centres and tensors read back from PyBullet (createMultiBody alone takes them from the colliders)."""
    with engine_named("pybullet").world(lopsided, Settings()) as world:
        for link, name in enumerate((BODY, *LINKS), start=-1):
            info = bullet.getDynamicsInfo(world.robot_id, link, physicsClientId=world._client)
            axes = np.array(bullet.getMatrixFromQuaternion(info[4])).reshape(3, 3)
            body = lopsided.bodies[name]
            assert info[0] == pytest.approx(body.mass_kg, rel=1e-12)
            np.testing.assert_allclose(info[3], body.com_m, rtol=1e-9)
            np.testing.assert_allclose(axes @ np.diag(info[2]) @ axes.T, body.inertia_kg_m2, rtol=1e-9, atol=1e-15)


def test_the_body_moves_as_the_roller_leaves_the_cam() -> None:
    """Bullet is given the velocity of the centre of mass: that of the frame's origin, and the turn about y with it.

    Of a robot whose links are not parallel: else the body does not turn.
    """
    uneven = capsule_robot(load_design("best-ga"))
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


def test_pybullet_has_every_contact_sphere_where_it_is_and_as_large(lopsided: Robot) -> None:
    """Read back in the principal axes at the centre of mass, where Bullet has them."""
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
