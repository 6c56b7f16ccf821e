"""A robot in PyBullet, read back: bodies, joints, friction and loop are those of the mechanism as it is released."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.machines import let_go

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG, Friction
from jumpcad.mechanism.poses import body_poses, release_pose
from jumpcad.robot import Robot
from jumpcad.settings import coefficients
from jumpcad.simulation import Settings
from jumpcad.simulation.bullet_robot import LINKS, BulletRobot, _joints, _xyzw_about_y
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


def dynamics(robot: BulletRobot, link: int) -> tuple[Any, ...]:
    """Return what PyBullet tells of a link: mass, friction, moments, its centre and its axes in the frame."""
    info: tuple[Any, ...] = bullet.getDynamicsInfo(robot.number, link, physicsClientId=robot.client)
    return info


@pytest.mark.parametrize("angle", [0.0, 0.3, -1.2, 3.0])
def test_quaternions_have_their_scalar_last(angle: float) -> None:
    turn = Rotation.from_quat(_xyzw_about_y(angle)).as_matrix()
    forward, up = turn @ [1.0, 0.0, 0.0], turn @ [0.0, 0.0, 1.0]
    assert forward == pytest.approx([math.cos(angle), 0.0, -math.sin(angle)])  # y is to the left: the nose goes down
    assert up == pytest.approx([math.sin(angle), 0.0, math.cos(angle)])


def test_joints_are_in_the_order_of_the_links_that_hang_on_them(kenan: Robot) -> None:
    """Depth first: the foot hangs on the leg, the front link on the body. In whatever order the robot has them."""
    for joints in (kenan.joints, kenan.joints[::-1]):
        found = _joints(replace(kenan, joints=joints))
        assert [joint.child for joint in found] == [MAIN_LEG, FOOT, FRONT_LINK]
        assert [joint.parent for joint in found] == [BODY, MAIN_LEG, BODY]


def test_links_hang_on_each_other_by_hinges_about_y(lopsided: Robot, client: int) -> None:
    """PyBullet tells places from the parent's centre of mass, in its principal axes; directions in the link's."""
    robot = BulletRobot(bullet, client, lopsided, Settings())
    assert bullet.getNumJoints(robot.number, physicsClientId=client) == 3
    for link, (joint, parent) in enumerate(zip(_joints(lopsided), (-1, 0, -1), strict=True)):
        info = bullet.getJointInfo(robot.number, link, physicsClientId=client)
        assert (info[2], info[16]) == (bullet.JOINT_REVOLUTE, parent)
        np.testing.assert_allclose(robot.axes[1 + link] @ info[13], [0.0, 1.0, 0.0], atol=1e-9)
        axes = Rotation.from_quat(dynamics(robot, parent)[4]).as_matrix()
        origin = lopsided.bodies[joint.parent].com_m + axes @ info[14]
        np.testing.assert_allclose(origin, joint.origin_m, atol=1e-9)


def test_all_joints_have_their_angles_and_rates_of_the_release(client: int) -> None:
    """Of a robot whose roller has just left the cam; no two of the three are alike."""
    mechanism = let_go(capsule_robot(load_design("best-ga")))
    release, robot = release_pose(mechanism), BulletRobot(bullet, client, mechanism, Settings())
    assert len({round(rate, 3) for rate in release.joint_rad_s.values()} - {0.0}) == 3
    for link, name in enumerate(("leg", "ankle", "front")):
        angle, rate, *_ = bullet.getJointState(robot.number, link, physicsClientId=client)
        assert (angle, rate) == pytest.approx((release.joint_rad[name], release.joint_rad_s[name]))


@pytest.mark.parametrize("moving", [False, True])
def test_the_base_stands_where_the_body_does_and_moves_only_once_the_roller_is_off(
    lopsided: Robot, client: int, moving: bool
) -> None:
    """Bullet has the base at its centre of mass, in its principal axes."""
    mechanism = let_go(lopsided) if moving else lopsided
    release, robot, body = release_pose(mechanism), BulletRobot(bullet, client, mechanism, Settings()), BODY
    place, quaternion = bullet.getBasePositionAndOrientation(robot.number, physicsClientId=client)
    turn = Rotation.from_rotvec([0.0, release.body_pitch_rad, 0.0]).as_matrix()
    np.testing.assert_allclose(place, release.body_position_m + turn @ lopsided.bodies[body].com_m, atol=1e-9)
    np.testing.assert_allclose(Rotation.from_quat(quaternion).as_matrix(), turn @ robot.axes[0], atol=1e-9)
    velocity, spin = bullet.getBaseVelocity(robot.number, physicsClientId=client)
    assert (np.abs([*velocity, *spin]).max() > 1e-3) == moving


def test_axes_turn_bodies_into_their_frames(lopsided: Robot, client: int) -> None:
    """In the order of Bullet's links, the base first: diagonal tensors, right-handed, and those that Bullet tells."""
    robot = BulletRobot(bullet, client, lopsided, Settings())
    assert robot.axes.shape == (4, 3, 3)
    for link, name in enumerate((BODY, *LINKS), start=-1):
        axes = robot.axes[1 + link]
        assert np.linalg.det(axes) == pytest.approx(1.0)
        told = Rotation.from_quat(dynamics(robot, link)[4]).as_matrix()
        np.testing.assert_allclose(told, axes, atol=1e-9)
        turned = axes.T @ lopsided.bodies[name].inertia_kg_m2 @ axes
        assert np.abs(turned - np.diag(np.diag(turned))).max() < 1e-9 * np.abs(turned).max()


def test_every_body_has_the_friction_of_its_surface_and_what_the_settings_say(
    lopsided: Robot, client: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As PyBullet tells, except for the joints' damping, which it does not give back."""
    told: list[tuple[int, dict[str, Any]]] = []
    change = bullet.changeDynamics
    monkeypatch.setattr(
        bullet,
        "changeDynamics",
        lambda number, link, **named: told.append((link, named)) or change(number, link, **named),
    )
    settings = Settings(
        foot_friction=0.8, body_friction=0.3, restitution=0.25, rolling_friction_m=0.001, spinning_friction_m=0.002,
        joint_damping_nms_per_rad=3e-4,
    )  # fmt: skip
    robot, rubs = BulletRobot(bullet, client, lopsided, settings), coefficients(lopsided, settings)
    seen = {}
    for link, name in enumerate((BODY, *LINKS), start=-1):
        _, seen[name], _, _, _, restitution, rolling, spinning, *_ = dynamics(robot, link)
        assert (restitution, rolling, spinning) == pytest.approx((0.25, 0.001, 0.002))
    assert seen == pytest.approx({name: rubs.of(lopsided.bodies[name].surface) for name in seen})
    assert seen[FOOT] > seen[BODY]
    assert robot.joint_damping_nms_per_rad == 3e-4
    assert {link: named["jointDamping"] for link, named in told if "jointDamping" in named and link >= 0} == {
        0: 3e-4, 1: 3e-4, 2: 3e-4,
    }  # fmt: skip


def test_motors_hold_joints_with_their_dry_friction_alone(client: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """A motor to a speed of 0 with a largest torque is dry friction; without one, nothing holds a joint."""
    plain = capsule_robot(load_design("kenan-2.0"))
    mechanism = replace(plain, friction=Friction(0.7, 0.5, 0.2, (0.0015, 0.002, 0.002, 0.002)))
    told: list[tuple[tuple[Any, ...], dict[str, Any]]] = []
    control = bullet.setJointMotorControlArray
    monkeypatch.setattr(
        bullet,
        "setJointMotorControlArray",
        lambda *given, **named: told.append((given, named)) or control(*given, **named),
    )
    robot = BulletRobot(bullet, client, mechanism, Settings(joint_friction_nm=0.003))
    (((number, joints, mode), named),) = told
    assert (number, joints, mode) == (robot.number, [0, 1, 2], bullet.VELOCITY_CONTROL)
    assert named == {"forces": robot.dry_nm, "physicsClientId": client}
    assert robot.dry_nm == pytest.approx([0.003 + pin_torque_nm(mechanism, 0.2), 0.003, 0.003])


@pytest.mark.parametrize("swapped", [False, True])
def test_one_constraint_holds_the_loops_points_together(lopsided: Robot, client: int, swapped: bool) -> None:
    """Front link and foot, whichever is named first; as Bullet wants them, in principal axes from the centres."""
    loop = lopsided.loop
    other = replace(loop, body_a=loop.body_b, body_b=loop.body_a, point_a_m=loop.point_b_m, point_b_m=loop.point_a_m)
    robot = BulletRobot(bullet, client, replace(lopsided, loop=other if swapped else loop), Settings())
    assert bullet.getNumConstraints(physicsClientId=client) == 1
    number = bullet.getConstraintUniqueId(0, physicsClientId=client)
    parent, parent_link, child, child_link, kind, _, on_parent, on_child, *_ = bullet.getConstraintInfo(
        number, physicsClientId=client
    )
    assert (parent, child, kind) == (robot.number, robot.number, bullet.JOINT_POINT2POINT)
    points = {loop.body_a: loop.point_a_m, loop.body_b: loop.point_b_m}
    found = {}
    for link, pivot in ((parent_link, on_parent), (child_link, on_child)):
        name = LINKS[link]
        found[name] = lopsided.bodies[name].com_m + Rotation.from_quat(dynamics(robot, link)[4]).as_matrix() @ pivot
    assert found.keys() == {FRONT_LINK, FOOT}
    for name, point in found.items():
        np.testing.assert_allclose(point, points[name], atol=1e-9)


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


def test_every_link_is_seen_as_one_small_box(kenan: Robot, client: int) -> None:
    """One that Bullet makes of the contacts' spheres costs more than the whole robot."""
    robot = BulletRobot(bullet, client, kenan, Settings())
    seen = bullet.getVisualShapeData(robot.number, physicsClientId=client)
    assert [shape[1] for shape in seen] == [-1, 0, 1, 2]
    assert {shape[2] for shape in seen} == {bullet.GEOM_BOX}
    assert np.array([shape[3] for shape in seen]) == pytest.approx(0.002)


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
