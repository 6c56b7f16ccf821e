"""Poses and energies against independent facts."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.flights import Flight
from support.machines import let_go

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT
from jumpcad.mechanism.poses import release_pose
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics, State, loaded_state
from jumpcad.transforms import Array


def frames(robot: Robot) -> dict[str, Array]:
    """Chain the joints' transforms from the body's frame at release; each (4, 4)."""
    release = release_pose(robot)

    def placed(angle: float, position: Array) -> Array:
        transform = np.eye(4)
        transform[:3, :3] = Rotation.from_euler("y", angle).as_matrix()
        transform[:3, 3] = position
        return transform

    poses = {BODY: placed(release.body_pitch_rad, release.body_position_m)}
    for joint in robot.joints:
        turn = joint.rest_angle_rad + release.joint_rad[joint.name]
        poses[joint.child] = poses[joint.parent] @ placed(turn, joint.origin_m)
    return poses


def test_release_closes_the_loop_with_a_flat_foot_on_the_ground(jumping: list[Flight]) -> None:
    for flight in jumping:
        robot = flight.robot
        poses, loop = frames(robot), robot.loop
        a = poses[loop.body_a] @ np.append(loop.point_a_m, 1)
        b = poses[loop.body_b] @ np.append(loop.point_b_m, 1)
        np.testing.assert_allclose(a, b, atol=1e-12)
        np.testing.assert_allclose(poses[FOOT][:3, :3], np.eye(3), atol=1e-12)
        np.testing.assert_allclose(poses[FOOT][:3, 3], [0, 0, robot.foot_depth_m], atol=1e-12)


@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
def test_engine_puts_every_body_where_the_joints_say(lopsided: Robot, engine: str) -> None:
    needs.package(engine)
    poses = frames(lopsided)
    with engine_named(engine).world(lopsided, Settings()) as world:
        state = world.state()
    mechanics = Mechanics(lopsided, 9.81)
    for name, origin, rotation in zip(BODY_NAMES, mechanics.frame_positions_m(state), state.rotation, strict=True):
        np.testing.assert_allclose(rotation, poses[name][:3, :3], atol=1e-9)
        np.testing.assert_allclose(origin, poses[name][:3, 3], atol=1e-9)
    assert mechanics.loop_gap_m(state) < 1e-9


def test_energy_of_a_known_motion(lopsided: Robot) -> None:
    """A robot that moves and turns as one rigid body has the energy of its total mass and total inertia."""
    rng = np.random.default_rng(4)
    rotation = Rotation.random(4, rng=rng).as_matrix()
    com = rng.normal(size=(4, 3))
    spin, drift = np.array([1.0, -2.0, 3.0]), np.array([0.4, 0.5, -0.6])
    state = State(com, rotation, drift + np.cross(spin, com), np.tile(spin, (4, 1)), (-0.2,))
    total = 0.0
    for name, turn, place in zip(BODY_NAMES, rotation, com, strict=True):
        body = lopsided.bodies[name]
        moments, axes = np.linalg.eigh(body.inertia_kg_m2)
        about_axes = (turn @ axes).T @ spin
        total += 0.5 * float(moments @ about_axes**2)
        total += 0.5 * body.mass_kg * float(np.sum((drift + np.cross(spin, place)) ** 2))
    masses = [lopsided.bodies[name].mass_kg for name in BODY_NAMES]
    mean = np.average(state.velocity_m_s, axis=0, weights=masses)
    assert Mechanics(lopsided, 9.81).velocity_m_s(state) == pytest.approx(mean)
    energies = Mechanics(lopsided, 9.81).energies(state)
    assert energies.kinetic_j == pytest.approx(total, rel=1e-12)
    height = sum(lopsided.bodies[name].mass_kg * place[2] for name, place in zip(BODY_NAMES, com, strict=True))
    assert energies.potential_j == pytest.approx(9.81 * height, rel=1e-12)
    assert energies.spring_j == pytest.approx(0.5 * lopsided.spring.stiffness_nm_per_rad * 0.04, rel=1e-12)


def test_loop_gap_is_the_distance_of_its_ends(kenan: Robot) -> None:
    with engine_named("mujoco").world(kenan, Settings()) as world:
        state = world.state()
    moved = replace(state, com_m=state.com_m + np.outer([name == FOOT for name in BODY_NAMES], [3e-3, 0, 4e-3]))
    assert Mechanics(kenan, 9.81).loop_gap_m(moved) == pytest.approx(5e-3, rel=1e-6)


def test_the_loaded_state_is_that_of_an_engine_before_anything_moves(lopsided: Robot) -> None:
    """Centres of mass, turns, no velocity; whichever state the cam leaves the robot in."""
    with engine_named("planar").world(lopsided, Settings()) as world:
        there = world.state()
    for robot in (lopsided, let_go(lopsided)):
        here = loaded_state(robot)
        for key in ("com_m", "rotation", "velocity_m_s", "angular_rad_s"):
            np.testing.assert_allclose(getattr(here, key), getattr(there, key), atol=1e-12, err_msg=key)
        assert here.leg_rad == pytest.approx(there.leg_rad)
    mechanics = Mechanics(lopsided, 9.81)
    assert mechanics.energies(here).spring_j == pytest.approx(lopsided.spring.energy_j)
    assert mechanics.energies(here).kinetic_j == 0.0


@pytest.mark.parametrize("turn_deg", [-70.0, 25.0, 160.0])
def test_a_robot_that_lies_is_as_far_from_the_ground_as_its_lowest_sphere(lopsided: Robot, turn_deg: float) -> None:
    """Turned about y as a whole: whichever body's sphere is lowest then, centre less radius."""
    with engine_named("planar").world(lopsided, Settings()) as world:
        state = world.state()
    turn, mechanics = Rotation.from_euler("y", turn_deg, degrees=True).as_matrix(), Mechanics(lopsided, 9.81)
    lying = replace(state, com_m=state.com_m @ turn.T + [0.0, 0.0, 0.3], rotation=turn @ state.rotation)
    origins = dict(zip(BODY_NAMES, mechanics.frame_positions_m(state), strict=True))
    poses, low = frames(lopsided), []
    for name, body in lopsided.bodies.items():
        np.testing.assert_allclose(origins[name], poses[name][:3, 3], atol=1e-9)
        for contact in body.contacts:
            centre = poses[name] @ [*contact.centre_m, 1.0]
            low.append(0.3 + float((turn @ centre[:3])[2]) - contact.radius_m)
    assert mechanics.clearance_m(lying) == pytest.approx(min(low))
