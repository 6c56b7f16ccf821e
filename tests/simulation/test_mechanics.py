"""Poses and energies against independent facts."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built
from support.flights import Flight
from support.machines import let_go

from jumpcad.exporters.mjcf import SUBSTEPS
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, release_pose
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics, State, ballistics, drag_per_m, loaded_state
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


STILL = np.zeros(3)


def test_ballistics_against_integration() -> None:
    """The flight integrated numerically until it falls through its height at release."""
    start, takeoff, velocity, gravity = (
        np.array([0.1, 0, 0.05]),
        np.array([0.13, 0, 0.08]),
        np.array([1.4, 0, 2.1]),
        9.81,
    )

    def landed(_: float, y: Array) -> float:
        return float(y[1] - start[2])

    landed.terminal, landed.direction = True, -1  # type: ignore[attr-defined]
    path = solve_ivp(
        lambda _, y: [y[2], y[3], 0.0, -gravity], (0, 5), [takeoff[0], takeoff[2], velocity[0], velocity[2]],
        events=landed, rtol=1e-10, atol=1e-12, max_step=0.01, dense_output=True,
    )  # fmt: skip
    flight = ballistics(start, takeoff, velocity, gravity)
    assert flight.range_m == pytest.approx(path.y_events[0][0][0] - start[0], rel=1e-8)
    heights = path.sol(np.linspace(0, path.t[-1], 100_001))[1]
    assert flight.rise_m == pytest.approx(heights.max() - start[2], rel=1e-8)
    assert flight.angle_deg == pytest.approx(math.degrees(math.atan(1.5)))


def test_ballistics_from_level_ground_is_the_textbook_range() -> None:
    """v²·sin(2θ)/g."""
    speed, angle = 3.0, math.radians(40)
    velocity = speed * np.array([math.cos(angle), 0.0, math.sin(angle)])
    flight = ballistics(np.zeros(3), np.zeros(3), velocity, 9.81)
    assert flight.range_m == pytest.approx(speed**2 * math.sin(2 * angle) / 9.81)


@pytest.mark.parametrize(("up_m_s", "lift_m"), [(0.5, -0.1), (1.4, -0.1), (1.4007142, -0.1), (0.5, -0.02), (2.0, -0.1)])
def test_who_leaves_lower_than_it_started_flies_to_that_height_or_to_its_highest_point(
    up_m_s: float, lift_m: float
) -> None:
    """√(2·g·0.1 m) = 1.4007 m/s are needed to come back to it."""
    gravity, start = 9.81, np.array([0.1, 0.2, 0.3])
    flight = ballistics(start, start + np.array([0.05, 0.0, lift_m]), np.array([1.2, 0.0, up_m_s]), gravity)
    apex_s, fallen_m = up_m_s / gravity, lift_m + up_m_s**2 / (2.0 * gravity)
    assert flight.rise_m == pytest.approx(fallen_m)
    falls_s = math.sqrt(2.0 * fallen_m / gravity) if fallen_m > 0.0 else 0.0
    assert flight.range_m == pytest.approx(0.05 + 1.2 * (apex_s + falls_s))
    assert flight.speed_m_s == pytest.approx(math.hypot(1.2, up_m_s))


def test_a_stone_thrown_up_through_air_rises_as_the_textbook_says() -> None:
    """ln(1 + k·v²/g)/(2·k) high, with k of the square of speed (Timoshenko and Young, Advanced Dynamics, ch. 1)."""
    per_m, speed = 0.08, 5.0
    flight = ballistics(STILL, STILL, np.array([0.0, 0.0, speed]), 9.81, per_m)
    assert flight.rise_m == pytest.approx(math.log(1.0 + per_m * speed**2 / 9.81) / (2.0 * per_m), rel=1e-6)
    assert flight.place_m(np.array([math.atan(speed * math.sqrt(per_m / 9.81)) / math.sqrt(per_m * 9.81)]))[
        0
    ].imag == pytest.approx(flight.rise_m, rel=1e-6)


def test_seven_grams_with_15_square_centimetres_lose_a_fifth_of_their_height() -> None:
    """5.96 m/s at 75°: 1.69 m without air, 1.38 m through it, in small steps and here; and the way along."""
    per_m, angle = drag_per_m(15.6e-4, 0.007), math.radians(75.0)
    velocity = 5.96 * np.array([math.cos(angle), 0.0, math.sin(angle)])
    free, braked = (ballistics(STILL, STILL, velocity, 9.81, k) for k in (0.0, per_m))
    place, speed, step, top = np.zeros(2), velocity[[0, 2]].copy(), 1e-5, 0.0
    while speed[1] > 0.0 or place[1] > 0.0:
        speed -= step * (per_m * math.hypot(*speed) * speed + np.array([0.0, 9.81]))
        place += step * speed
        top = max(top, place[1])
    assert free.rise_m == pytest.approx(1.69, abs=0.005)
    assert braked.rise_m == pytest.approx(1.38, abs=0.005)
    assert braked.rise_m == pytest.approx(top, rel=1e-3)
    assert braked.range_m == pytest.approx(place[0], rel=1e-3)


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_air_acts_on_range_time_and_touchdown_in_every_engine(engine: str) -> None:
    """A tenth of a square metre: the simulated flight lands when and where the path does, nearer than without air."""
    if engine != "planar":
        needs.package(engine)
    robot = built("best-bo")
    free, braked = (simulate(robot, Settings(flight="simulated", drag_area_m2=area), engine) for area in (0.0, 0.1))
    assert braked.air_time_s is not None
    assert braked.ballistic_range_m < 0.85 * free.ballistic_range_m
    assert braked.air_time_s < free.air_time_s
    assert braked.touchdown_distance_m < 0.85 * free.touchdown_distance_m
    assert braked.takeoff_speed_m_s == free.takeoff_speed_m_s
    assert braked.turn_rate_deg_s == free.turn_rate_deg_s


BEYOND_RAD = 0.5
"""Past the stop: so far that a pad would push much more than is needed to halt the leg."""


@pytest.mark.parametrize(("engine", "substeps"), [("pybullet", 1), ("mujoco", SUBSTEPS)])
@pytest.mark.parametrize("dt_s", [0.0005, 0.0001])
def test_the_leg_is_halted_within_one_of_the_engines_own_steps(engine: str, substeps: int, dt_s: float) -> None:
    """By the leg's inertia times its rate over the step."""
    needs.package(engine)
    robot, rate = built("kenan-2.0"), 1e-3
    assert robot.stop is not None
    with engine_named(engine).world(robot, Settings(dt_s=dt_s)) as world:
        held = world._pad.torque_nm(robot.stop.angle_rad + BEYOND_RAD, rate)
    inertia = leg_inertia_kg_m2(robot, robot.stop.angle_rad)
    assert held == pytest.approx(inertia * rate * substeps / dt_s)
