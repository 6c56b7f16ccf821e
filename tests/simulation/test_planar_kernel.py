"""The planar mechanism against rigid bodies that pins hold together, and against the laws of motion."""

import importlib.util
import math
import sys
from dataclasses import replace

import numpy as np
import pytest
from support.flights import make_lopsided
from support.machines import PAD_NM_PER_RAD, STOP_RAD, let_go, one_sided, rubbing, stopped

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.reflected import leg_inertia_kg_m2
from jumpcad.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.mechanics import Mechanics, State
from jumpcad.simulation.planar import PlanarWorld
from jumpcad.simulation.planar_model import PlanarModel, planar_model
from jumpcad.simulation.planar_state import Contact, Inertia, Losses, PlanarMotion, Stance, StepState
from jumpcad.transforms import Array

NO_CONTACT = Contact(-1, -1, kernel.SEPARATE, 0.0, 0.0, 0.0)
NO_LOSSES = Losses(0.0, 0.0, 0.0, 0.0, 0.0)
FINE = Settings(dt_s=1 / 16000)
PINS = ((BODY, MAIN_LEG), (BODY, FRONT_LINK), (MAIN_LEG, FOOT), (FRONT_LINK, FOOT))
"""The bodies of the pins leg, front, ankle and eye."""


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def either(request: pytest.FixtureRequest) -> Robot:
    """A robot whose bodies have no symmetry, with equal links and with others."""
    return make_lopsided(capsule_robot(load_design(request.param)))


def moving(model: PlanarModel, leg_rad: float, height_m: float = 0.5) -> StepState:
    """Return a moment in the air in which everything moves."""
    speed = PlanarMotion(0.4 + 1.3j, 2.1, 9.0)
    return StepState(0.02 + 1j * height_m, 0.3, leg_rad, speed, NO_CONTACT, 0.0, NO_LOSSES, math.inf, True)


def world_at(robot: Robot, moment: StepState, settings: Settings = FINE) -> PlanarWorld:
    """Return a planar world at a moment of its own."""
    world = PlanarWorld(robot, settings)
    world.go_to(moment)
    return world


def model_of(robot: Robot, settings: Settings = FINE) -> PlanarModel:
    return planar_model(robot, settings)


def turn_of(moment: StepState) -> complex:
    return complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))


@pytest.mark.parametrize("leg_deg", [-40.0, -20.0, 0.0, 8.0])
def test_the_loop_is_that_of_the_linkage(either: Robot, leg_deg: float) -> None:
    """Joint rates by the velocity analysis of `Linkage`, places by its poses."""
    leg_rad, linkage = math.radians(leg_deg), Linkage(either.design)
    links, pose = kernel.links_at(model_of(either), leg_rad), linkage.pose(leg_rad)
    assert links.closed
    assert np.angle(links.pitch) == pytest.approx(pose.foot_rad[0], abs=1e-12)
    assert links.turn1[0] == pytest.approx(-linkage.jacobian(leg_rad)[0, 2], rel=1e-9)
    step = 1e-6
    near = linkage.pose([leg_rad - step, leg_rad + step])
    for rate, angle in zip(links.pin1, (near.leg_rad, near.front_rad, near.ankle_rad), strict=False):
        assert rate == pytest.approx((angle[1] - angle[0]) / (2 * step), rel=1e-7)
    assert links.pin1[3] == pytest.approx(links.pin1[1] - links.pin1[0] - links.pin1[2])


def test_derivatives_are_those_of_the_places(either: Robot) -> None:
    model, step = model_of(either), 1e-5
    low, here, high = (kernel.links_at(model, -0.4 + shift) for shift in (-step, 0.0, step))
    for one, two in (("place", "place1"), ("place1", "place2"), ("turn1", "turn2")):
        slope = (np.array(getattr(high, one)) - np.array(getattr(low, one))) / (2 * step)
        np.testing.assert_allclose(getattr(here, two), slope, rtol=1e-7, atol=1e-9)


def test_state_and_energy_are_those_of_the_robot(lopsided: Robot) -> None:
    """Energies summed body by body in space; a loop without gap; velocities that are the change of the places."""
    moment, settings = moving(model_of(lopsided), -0.35), replace_damping(FINE)
    world = world_at(lopsided, moment, settings)
    mechanics, state = Mechanics(lopsided, 9.81), world.state()
    assert mechanics.energies(state).total_j == pytest.approx(kernel.energy(world.model, moment), rel=1e-12)
    assert mechanics.loop_gap_m(state) < 1e-15
    later = world_at(lopsided, kernel.advance(world.model, moment, 1e-6, 1), settings).state()
    np.testing.assert_allclose((later.com_m - state.com_m) / 1e-6, state.velocity_m_s, atol=2e-3)
    turned = later.rotation @ state.rotation.transpose(0, 2, 1)
    np.testing.assert_allclose(turned[:, 0, 2] / 1e-6, state.angular_rad_s[:, 1], atol=2e-3)


def replace_damping(settings: Settings, damping: float = 0.0) -> Settings:
    return settings.model_copy(update={"joint_damping_nms_per_rad": damping})


def pinned_bodies(
    robot: Robot, state: State, settings: Settings, ground: tuple[tuple[float, complex], ...] = ()
) -> tuple[Array, Array]:
    """Return accelerations (4, 3: x, z, turn) of four free bodies and forces (4, 2) of the pins that join them.

    Newton's and Euler's equations of each body and the pins' conditions in one linear system (Lagrange multipliers).
    `ground` has the forces (x + iz) of the ground on the foot, each with the place x where it acts; there z is 0.
    """
    joints = {(joint.parent, joint.child): joint for joint in robot.joints}
    matrix, right = np.zeros((20, 20)), np.zeros(20)
    for index, name in enumerate(BODY_NAMES):
        body = robot.bodies[name]
        rows = slice(3 * index, 3 * index + 3)
        matrix[rows, rows] = np.diag([body.mass_kg, body.mass_kg, body.inertia_kg_m2[1, 1]])
        right[3 * index + 1] = -settings.gravity_m_s2 * body.mass_kg
    for pin, (first, second) in enumerate(PINS):
        joint = joints.get((first, second))
        points = (joint.origin_m, np.zeros(3)) if joint else (robot.loop.point_a_m, robot.loop.point_b_m)
        rows = slice(12 + 2 * pin, 14 + 2 * pin)
        for sign, name, point in ((1.0, first, points[0]), (-1.0, second, points[1])):
            index = BODY_NAMES.index(name)
            arm = (state.rotation[index] @ (point - robot.bodies[name].com_m))[[0, 2]]
            columns = slice(3 * index, 3 * index + 3)
            condition = sign * np.array([[1.0, 0.0, arm[1]], [0.0, 1.0, -arm[0]]])
            matrix[rows, columns], matrix[columns, rows] = condition, condition.T
            right[rows] += sign * state.angular_rad_s[index, 1] ** 2 * arm
        if joint:
            one, two = 3 * BODY_NAMES.index(first) + 2, 3 * BODY_NAMES.index(second) + 2
            rate = state.angular_rad_s[two // 3, 1] - state.angular_rad_s[one // 3, 1]
            torque = -settings.joint_damping_nms_per_rad * rate
            if joint.name == robot.spring.joint:
                torque -= robot.spring.stiffness_nm_per_rad * state.leg_rad
            right[one] -= torque
            right[two] += torque
    foot = BODY_NAMES.index(FOOT)
    for place_m, force in ground:
        arm = complex(place_m, 0.0) - complex(*state.com_m[foot, [0, 2]])
        right[3 * foot : 3 * foot + 3] += (force.real, force.imag, arm.imag * force.real - arm.real * force.imag)
    solution = np.linalg.solve(matrix, right)
    return solution[:12].reshape(4, 3), solution[12:].reshape(4, 2)


@pytest.mark.parametrize("pushes", [(), (1.9,), (1.9, 0.4)])
@pytest.mark.parametrize("leg_rad", [-0.6, -0.2, 0.1])
def test_accelerations_and_pin_forces_are_those_of_pinned_bodies(
    either: Robot, leg_rad: float, pushes: tuple[float, ...]
) -> None:
    """In the air, and with the ground's forces (N) on one or two spheres of the sole."""
    settings = Settings(joint_damping_nms_per_rad=0.001)
    moment, dt = moving(model_of(either), leg_rad), 1e-4
    state, along = world_at(either, moment).state(), -0.7 if pushes else 0.0
    body, place = either.bodies[FOOT], BODY_NAMES.index(FOOT)
    spheres = [contact for contact in body.contacts if contact.surface == "foot"][:: len(body.contacts) - 1]
    places = [float(state.com_m[place, 0] + state.rotation[place, 0] @ (one.centre_m - body.com_m)) for one in spheres]
    ground_n = ((0.0, complex(along)), *((x, 1j * push) for x, push in zip(places, pushes, strict=False)))
    accelerations, pin_n = pinned_bodies(either, state, settings, ground_n)
    model, turn, speed = model_of(either, settings), turn_of(moment), moment.speed
    ground = Stance(moment.ankle_m, turn, dt / 2)
    seen = [(ground.ankle_m + one * turn).real for one in model.sole_m]
    numbers = [int(np.argmin([abs(x - other) for other in seen])) for x in places]
    up = [dt * push for push in pushes] + [0.0] * (2 - len(pushes))
    touching = [number if index < len(pushes) else -1 for index, number in enumerate(numbers)]
    contact = Contact(*touching, kernel.STICK, *up, dt * along) if pushes else NO_CONTACT
    links = kernel.links_at(model, leg_rad)
    inertia = kernel.inertia_at(model, links, turn)
    change = kernel.response(inertia, *kernel.forces(model, links, inertia, turn, leg_rad, speed))
    pushed = complex(along, sum(pushes)), kernel.turning_impulse(model, ground, contact) / dt, 0.0
    change = kernel.plus(change, kernel.response(inertia, *pushed), 1.0)
    foot, body = accelerations[BODY_NAMES.index(FOOT)], accelerations[0]
    assert change.foot == pytest.approx(foot[2], rel=1e-9)
    pitch_rate2 = links.turn2[0] * speed.leg**2
    assert change.foot + links.turn1[0] * change.leg + pitch_rate2 == pytest.approx(body[2], rel=1e-9)
    for pin in range(4):
        radii = [0.0] * 4
        radii[pin] = 0.0015
        rubbed = planar_model(rubbing(either, pin=0.2, pin_radius_m=tuple(radii)), settings, pin_forces=True)
        gained = PlanarMotion(*(dt * part for part in change))
        torque = kernel.pin_torque(rubbed, links, ground, speed, gained, contact)
        expected = 0.2 * 0.0015 * np.linalg.norm(pin_n[pin]) * abs(links.pin1[pin])
        assert torque == pytest.approx(expected, rel=1e-9)


def test_flight_keeps_momenta_and_energy(lopsided: Robot) -> None:
    """Springs and inertia at work inside: a parabola, a constant spin about the centre of mass, no energy lost."""
    world = world_at(lopsided, moving(model_of(lopsided), -0.5), replace_damping(FINE))
    mechanics, before = Mechanics(lopsided, 9.81), world.state()
    seconds = 0.03
    world.advance(round(seconds / FINE.dt_s))
    after = world.state()
    change = mechanics.velocity_m_s(after) - mechanics.velocity_m_s(before)
    np.testing.assert_allclose(change, [0.0, 0.0, -9.81 * seconds], atol=1e-5)
    travel = mechanics.centre_of_mass_m(after) - mechanics.centre_of_mass_m(before)
    start = mechanics.velocity_m_s(before)
    np.testing.assert_allclose(travel[[0, 2]], [start[0] * seconds, start[2] * seconds - 4.905 * seconds**2], atol=1e-6)
    assert spin(mechanics, after) == pytest.approx(spin(mechanics, before), rel=1e-5)
    energies = [mechanics.energies(state).total_j for state in (before, after)]
    assert energies[1] == pytest.approx(energies[0], rel=1e-5)
    assert abs(after.leg_rad - before.leg_rad) > 0.3


def spin(mechanics: Mechanics, state: State) -> float:
    """Return the angular momentum about y through the centre of mass."""
    arm = state.com_m - mechanics.centre_of_mass_m(state)
    swung = mechanics.mass_kg @ np.cross(arm, state.velocity_m_s)[:, 1]
    return float(swung + mechanics.inertia_kg_m2[:, 1, 1] @ state.angular_rad_s[:, 1])


def test_energy_error_falls_with_the_square_of_the_step(lopsided: Robot) -> None:
    errors = []
    for rate in (1000, 2000, 4000):
        settings = replace_damping(Settings(dt_s=1 / rate))
        world = world_at(lopsided, moving(model_of(lopsided), -0.5), settings)
        start = kernel.energy(world.model, world.moment)
        world.advance(rate // 40)
        errors.append(abs(kernel.energy(world.model, world.moment) - start))
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0


def test_without_friction_or_damping_only_the_ground_takes_nothing(kenan: Robot) -> None:
    """On ice: no forward push, and all of the springs' energy is still there."""
    ice = replace_damping(FINE.model_copy(update={"ground_friction": 0.0}))
    world = PlanarWorld(kenan, ice)
    start = kernel.energy(world.model, world.moment)
    found = world.push_off()
    world.go_to(found.moment)
    velocity = Mechanics(kenan, 9.81).velocity_m_s(world.state())
    assert found.flown
    assert abs(velocity[0]) < 1e-6 < 0.5 < velocity[2]
    assert kernel.energy(world.model, found.moment) == pytest.approx(start, rel=1e-5)


@pytest.mark.parametrize("friction", [0.3, 1.5])
def test_what_is_lost_is_accounted_for(kenan: Robot, friction: float) -> None:
    """Energy falls by the work of damping, pins, slip and impact, and by nothing else."""
    world = PlanarWorld(rubbing(kenan, friction, pin=0.25), replace_damping(FINE, 0.001))
    found = world.push_off()
    lost = kernel.energy(world.model, world.moment) - kernel.energy(world.model, found.moment)
    losses = found.moment.losses
    assert sum(losses) == pytest.approx(lost, rel=2e-4)
    assert losses.damping_j > 0.1 * kenan.spring.energy_j
    assert min(losses) > -1e-5 * kenan.spring.energy_j
    slips = losses.slip_j > 0.01 * kenan.spring.energy_j
    assert slips == (friction == 0.3)


def test_what_damping_takes_in_the_air_is_what_is_missing(either: Robot) -> None:
    """Of links of any lengths: each joint of leg, front link and ankle takes by its own rate."""
    settings = replace_damping(FINE, 0.002)
    world = world_at(either, moving(model_of(either), -0.5), settings)
    energy = kernel.energy(world.model, world.moment)
    world.advance(round(0.02 / FINE.dt_s))
    lost, losses = energy - kernel.energy(world.model, world.moment), world.moment.losses
    assert losses.damping_j == pytest.approx(lost, rel=1e-3)
    assert lost > 0.05 * either.spring.energy_j
    assert sum(losses) == losses.damping_j


@pytest.mark.parametrize("leg_rad", [-0.6, -0.2, 0.1])
def test_dry_friction_of_a_joint_acts_by_its_rate(either: Robot, leg_rad: float) -> None:
    """Virtual work of 4 mN·m at leg, front link and ankle, whose angles change as those of the linkage's poses do."""
    model = model_of(either, FINE.model_copy(update={"joint_friction_nm": 0.004}))
    links, speed = kernel.links_at(model, leg_rad), PlanarMotion(0j, 0.0, 1.0)
    torque = kernel.pin_torque(model, links, Stance(0.5j, 1.0 + 0j, 1e-4), speed, speed, NO_CONTACT)
    near = Linkage(either.design).pose([leg_rad - 1e-6, leg_rad + 1e-6])
    turned = sum(abs(float(np.ptp(angle))) for angle in (near.leg_rad, near.front_rad, near.ankle_rad)) / 2e-6
    assert torque - model.pins_nm == pytest.approx(0.004 * turned, rel=1e-6)


def test_a_one_sided_spring_does_not_pull_back(kenan: Robot) -> None:
    """Same push-off; beyond rest the leg goes on without springs."""
    both, one = (PlanarWorld(robot, FINE) for robot in (kenan, one_sided(kenan)))
    assert one.push_off().moment.speed.ankle == pytest.approx(both.push_off().moment.speed.ankle, rel=1e-12)
    assert one.model.one_sided_spring
    assert kernel.spring_torque(one.model, 0.1) == 0.0
    assert kernel.spring_torque(one.model, -0.1) == kernel.spring_torque(both.model, -0.1) > 0.0
    reach = []
    for world in (both, one):
        world.go_to(world.push_off().moment)
        reach.append(max(world.advance(1) for _ in range(round(0.03 / FINE.dt_s))))
    assert reach[1] > 1.2 * reach[0] > 0.0


@pytest.mark.parametrize("preload_rad", [0.0, 0.1])
def test_springs_push_by_hooke_from_where_they_are_relaxed(kenan: Robot, preload_rad: float) -> None:
    """Torque k·(preload - angle), energy half of that times the angle; one that only pushes has none beyond."""
    pulling = replace(kenan, spring=replace(kenan.spring, preload_rad=preload_rad))
    pushing, stiffness = one_sided(kenan, preload_rad), kenan.spring.stiffness_nm_per_rad
    for robot, pulls in ((pulling, True), (pushing, False)):
        model = model_of(robot)
        for angle in (-0.6, 0.0, preload_rad - 0.01, preload_rad + 0.2):
            left = preload_rad - angle if pulls else max(preload_rad - angle, 0.0)
            assert kernel.spring_torque(model, angle) == pytest.approx(stiffness * left)
            still = moving(model, angle)._replace(speed=PlanarMotion(0j, 0.0, 0.0))
            slack = model._replace(stiffness_nm_per_rad=0.0)
            held = kernel.energy(model, still) - kernel.energy(slack, still)
            assert held == pytest.approx(0.5 * stiffness * left**2, abs=1e-12)


def test_a_stop_holds_the_leg_and_keeps_momentum(kenan: Robot) -> None:
    """In the air: the pad takes the leg's energy, ½·k·x² = ½·I·v², but no momentum and no spin of the robot."""
    seconds, robot = 0.02, stopped(one_sided(kenan))
    world = world_at(robot, moving(model_of(kenan), -0.05), replace_damping(FINE))
    mechanics, before = Mechanics(kenan, 9.81), world.state()
    energy = kernel.energy(world.model, world.moment)
    path = [(world.advance(1), world.moment.speed.leg) for _ in range(round(seconds / FINE.dt_s))]
    after = world.state()
    speed = next(rate for leg, rate in path if leg > STOP_RAD)
    give = speed * math.sqrt(leg_inertia_kg_m2(kenan, STOP_RAD) / PAD_NM_PER_RAD)
    assert world.moment.speed.leg == pytest.approx(0.0, abs=0.02 * speed)
    assert max(leg for leg, _ in path) == pytest.approx(STOP_RAD + give, abs=0.1 * give)
    assert path[-1][0] == pytest.approx(STOP_RAD + give, abs=0.2 * give)
    change = mechanics.velocity_m_s(after) - mechanics.velocity_m_s(before)
    np.testing.assert_allclose(change, [0.0, 0.0, -9.81 * seconds], atol=5e-4)
    assert spin(mechanics, after) == pytest.approx(spin(mechanics, before), rel=1e-3)
    lost = energy - kernel.energy(world.model, world.moment)
    assert world.moment.losses.stop_j == pytest.approx(lost, rel=0.01)
    assert lost > 0.001


def test_a_stop_lets_the_leg_go_back(kenan: Robot) -> None:
    """The pad pushes and does not hold: springs that pull back turn the leg home as if there were no stop."""
    robot = stopped(kenan)
    leaving = moving(model_of(kenan), STOP_RAD + 0.02)._replace(speed=PlanarMotion(0j, 0.0, -0.5))
    held, free = (world_at(one, leaving, replace_damping(FINE)) for one in (robot, kenan))
    for world in (held, free):
        world.advance(round(0.01 / FINE.dt_s))
    assert held.moment.leg_rad == free.moment.leg_rad < STOP_RAD
    assert held.moment.losses.stop_j == 0.0


def test_a_stop_met_on_the_ground_lifts_the_robot(kenan: Robot) -> None:
    """Undamped, the robot stands until its leg is past rest; a stop at rest takes it off the ground there."""
    held, free = (PlanarWorld(robot, replace_damping(FINE)).push_off() for robot in (stopped(kenan, 0.0, 1e5), kenan))
    assert free.moment.leg_rad > math.radians(0.3)
    assert held.moment.leg_rad == pytest.approx(0.0, abs=math.radians(0.1))
    assert held.flown
    assert held.moment.losses.stop_j > 0.01 * kenan.spring.energy_j


def test_a_turning_leg_at_release_brings_its_energy(kenan: Robot) -> None:
    plain, turning = (PlanarWorld(let_go(kenan, 1.0, rate), replace_damping(FINE)) for rate in (0.0, 3.0))
    more = kernel.energy(turning.model, turning.moment) - kernel.energy(plain.model, plain.moment)
    assert more == pytest.approx(Mechanics(kenan, 9.81).energies(turning.state()).kinetic_j)
    assert more > 0.005 * kenan.spring.energy_j
    speeds = [abs(world.push_off().moment.speed.ankle) for world in (plain, turning)]
    assert speeds[1] > speeds[0]


def test_a_robot_that_stands_weighs_its_weight(kenan: Robot) -> None:
    """Held by thick oil in its joints: the ground's two forces are the weight, under the centre of mass."""
    dt = 1e-6
    model = model_of(kenan, replace_damping(FINE, 5.0))
    upright = kernel.released(model, 0.0, 0.0, complex(0.0, kenan.foot_depth_m))
    contact = kernel.advance(model, upright, dt, 200).contact
    assert contact.mode == kernel.STICK
    assert (contact.first_ns + contact.second_ns) / dt == pytest.approx(9.81 * kenan.mass_kg, rel=1e-4)
    arms = [model.sole_m[index].real for index in (contact.first, contact.second)]
    borne = (arms[0] * contact.first_ns + arms[1] * contact.second_ns) / (contact.first_ns + contact.second_ns)
    centre = Mechanics(kenan, 9.81).centre_of_mass_m(world_at(kenan, upright).state())[0]
    assert borne == pytest.approx(centre, abs=1e-4)


def mass_matrix(inertia: Inertia) -> Array:
    """The mass matrix (4, 4) of the coordinates ankle x, ankle z, foot, leg, from its closed form."""
    to_foot, to_leg, mass = inertia.by_foot, inertia.by_leg, inertia.mass
    full = np.diag([mass, mass, inertia.foot + abs(to_foot) ** 2 / mass, inertia.leg + abs(to_leg) ** 2 / mass])
    full[2, 3] = full[3, 2] = inertia.both + (to_foot.conjugate() * to_leg).real / mass
    full[0, 2], full[1, 2], full[0, 3], full[1, 3] = to_foot.real, to_foot.imag, to_leg.real, to_leg.imag
    full[2:, :2] = full[:2, 2:].T
    return full


def vector(speed: PlanarMotion) -> Array:
    return np.array([speed.ankle.real, speed.ankle.imag, speed.foot, speed.leg])


@pytest.mark.parametrize("held", [False, True])
def test_a_step_on_the_ground_obeys_the_laws_of_contact(either: Robot, held: bool) -> None:
    """Impulses change the velocities by the mass matrix. The ground pushes and does not pull; no sphere goes below it;

    the foot sticks with less than the full friction, or slides against all of it. A leg that is held stands still.
    """
    model, rng, modes = model_of(either), np.random.default_rng(7), set()
    for _ in range(150):
        angle, leg_rad = rng.choice([0.0, rng.uniform(-0.15, 0.15)]), rng.uniform(-0.7, 0.1)
        turn = complex(math.cos(angle), -math.sin(angle))
        lowest = min((at * turn).imag - radius for at, radius in zip(model.sole_m, model.sole_radius_m, strict=True))
        ground = Stance(complex(0.0, -lowest + rng.choice([0.0, 1e-4])), turn, 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, leg_rad), turn)
        free = PlanarMotion(
            complex(rng.normal(0.0, 1.0), rng.normal(-0.5, 1.0)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0)
        )
        after, contact, hold = kernel.settle(model, ground, kernel.gains_of(inertia), free, NO_CONTACT, held)
        arms = [(at * turn).real for at in model.sole_m]
        up, height = contact.first_ns + contact.second_ns, ground.ankle_m.imag
        turning = -height * contact.along_ns - sum(
            arms[index] * push
            for index, push in ((contact.first, contact.first_ns), (contact.second, contact.second_ns))
            if index >= 0
        )
        impulse = mass_matrix(inertia) @ (vector(after) - vector(free))
        np.testing.assert_allclose(impulse, [contact.along_ns, up, turning, hold], atol=1e-12)
        assert min(contact.first_ns, contact.second_ns) >= -1e-12
        for index, arm in enumerate(arms):
            rate = after.ankle.imag - arm * after.foot
            gap = (ground.ankle_m + model.sole_m[index] * turn).imag - model.sole_radius_m[index]
            assert rate >= -max(gap, 0.0) / ground.half_s - 1e-9
            if index in (contact.first, contact.second):
                assert rate == pytest.approx(-max(gap, 0.0) / ground.half_s, abs=1e-9)
        slip = after.ankle.real - height * after.foot
        assert abs(contact.along_ns) <= model.friction * up + 1e-12
        if up > 0.0 and abs(slip) > 1e-9:
            assert contact.along_ns == pytest.approx(-math.copysign(model.friction * up, slip))
        if held:
            assert after.leg == pytest.approx(0.0, abs=1e-9)
        else:
            assert hold == 0.0
        modes.add((contact.mode, contact.second >= 0))
    assert {mode for mode, _ in modes} == {kernel.SEPARATE, kernel.STICK, kernel.FORWARD, kernel.BACKWARD}
    assert len({mode for mode, _ in modes}) == 4
    assert {two for _, two in modes} == {False, True}


@pytest.mark.parametrize("sunk_m", [1e-6, 1e-4])
def test_a_foot_that_has_sunk_in_is_stopped_and_not_thrown_out(either: Robot, sunk_m: float) -> None:
    """Rounding, or another engine's state, may leave a sphere below the ground: it goes no deeper, and no faster up."""
    model, rng, stopped_feet = model_of(either), np.random.default_rng(5), 0
    for _ in range(40):
        ground = Stance(complex(0.0, either.foot_depth_m - sunk_m), 1.0 + 0j, 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, rng.uniform(-0.7, 0.1)), ground.turn)
        free = PlanarMotion(complex(rng.normal(), rng.normal(-0.5, 0.5)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0))
        after, contact, _ = kernel.settle(model, ground, kernel.gains_of(inertia), free, NO_CONTACT, False)
        for index in (contact.first, contact.second):
            if index >= 0:
                stopped_feet += 1
                assert after.ankle.imag - kernel.arm_m(model, ground, index) * after.foot == pytest.approx(0, abs=1e-9)
    assert stopped_feet > 20


def test_no_third_sphere_goes_below_the_ground_that_two_touch(lopsided: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """Spheres in a row, the middle one lower, level or higher: two of them carry, whatever pushes there are."""
    monkeypatch.setitem(sys.modules, "numba", None)  # compiling it for three spheres costs seconds
    spec = importlib.util.spec_from_file_location("plain_kernel", kernel.__file__)
    plain = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(plain)
    model, rng, pairs = model_of(lopsided), np.random.default_rng(11), set()
    for _ in range(200):
        low, high = (rng.choice([-1.0, 0.0, 1.0]) * 10.0 ** rng.uniform(-7.0, -3.5) for _ in range(2))
        spheres = 0.08 + 0j, complex(rng.uniform(-0.03, 0.05), low), complex(-0.07, high)
        sole = tuple(spheres[index] for index in rng.permutation(3))
        three = model._replace(sole_m=sole, sole_radius_m=(0.004, 0.004, 0.004))
        ground = Stance(complex(0.0, 0.004 - min(at.imag for at in sole)), 1.0 + 0j, 1e-4)
        inertia = plain.inertia_at(three, plain.links_at(three, rng.uniform(-0.7, 0.1)), ground.turn)
        free = PlanarMotion(
            complex(rng.normal(0.0, 1.0), rng.normal(-1.0, 1.0)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0)
        )
        after, contact, _ = plain.settle(three, ground, plain.gains_of(inertia), free, NO_CONTACT, False)
        assert min(contact.first_ns, contact.second_ns) >= -1e-12
        for at in sole:
            rate = after.ankle.imag - at.real * after.foot
            assert rate >= -(ground.ankle_m.imag + at.imag - 0.004) / ground.half_s - 1e-9
        pairs.add((contact.first, contact.second, contact.mode == plain.STICK))
    assert {pair for pair in pairs if pair[1] >= 0} >= {(one, two, True) for one, two in ((1, 0), (2, 0), (2, 1))}
    assert {pair[2] for pair in pairs if pair[1] >= 0} == {False, True}


@pytest.mark.parametrize("height_m", [None, 0.5])
def test_dry_friction_brakes_the_leg_or_holds_it(either: Robot, height_m: float | None) -> None:
    """All of it against a leg that turns; of one that would turn back, what it takes to stand still."""
    model, rng, held = model_of(either), np.random.default_rng(3), 0
    limit = 2e-4
    for _ in range(80):
        ankle = complex(0.0, either.foot_depth_m if height_m is None else height_m)
        ground = Stance(ankle, complex(1.0, 0.0), 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, rng.uniform(-0.6, 0.0)), ground.turn)
        free = PlanarMotion(complex(rng.normal(0.0, 0.2), -0.3), rng.normal(0.0, 2.0), rng.normal(0.0, 3.0))
        after, contact, friction = kernel.settle_with_friction(
            model, ground, kernel.gains_of(inertia), free, NO_CONTACT, limit
        )
        assert abs(friction) <= limit * (1.0 + 1e-9)
        if abs(after.leg) > 1e-9:
            assert friction == pytest.approx(-math.copysign(limit, after.leg))
        held += abs(after.leg) <= 1e-9
        impulse = mass_matrix(inertia) @ (vector(after) - vector(free))
        assert impulse[3] == pytest.approx(friction, abs=1e-12)
        assert impulse[0] == pytest.approx(contact.along_ns, abs=1e-12)
    assert 0 < held < 80


def test_what_a_flat_fall_takes_is_the_impact(kenan: Robot) -> None:
    """Both ends of the foot strike at once, the springs loaded: the energy that is missing is the impact's alone."""
    model = model_of(kenan, replace_damping(FINE))
    high = moving(model, -0.5)._replace(foot_rad=0.0, speed=PlanarMotion(0.0 - 0.8j, 0.0, 0.0))
    drop = 1j * (kernel.gap_m(model, high) - 1e-5)
    world = world_at(kenan, high._replace(ankle_m=high.ankle_m - drop), replace_damping(FINE))
    energy = kernel.energy(world.model, world.moment)
    world.advance(1)
    contact, losses = world.moment.contact, world.moment.losses
    assert min(contact.first_ns, contact.second_ns) > 0.0
    lost = energy - kernel.energy(world.model, world.moment)
    assert lost > 0.5 * kenan.mass_kg * 0.5**2
    assert losses.impact_j + losses.slip_j == pytest.approx(lost, rel=0.01)


def test_the_bodys_gap_and_rise_are_those_of_the_robot_in_space(either: Robot) -> None:
    """Its lowest sphere above the ground, sphere by sphere; the sign of the centre of mass's velocity."""
    model, mechanics = model_of(either), Mechanics(either, 9.81)
    body = either.bodies[BODY]
    for leg_rad, upward in ((-0.6, 1.3), (-0.2, -1.6), (0.1, -0.4)):
        moment = moving(model, leg_rad)._replace(speed=PlanarMotion(0.4 + 1j * upward, 2.1, 9.0))
        state, links = world_at(either, moment).state(), kernel.links_at(model, leg_rad)
        gap = min(
            float(state.com_m[0, 2] + state.rotation[0, 2] @ (contact.centre_m - body.com_m)) - contact.radius_m
            for contact in body.contacts
        )
        assert kernel._belly_gap_m(model, links, Stance(moment.ankle_m, turn_of(moment), 1e-4)) == pytest.approx(gap)
        assert kernel.gap_m(model, moment._replace(belly_gap_m=gap)) == pytest.approx(mechanics.clearance_m(state))
        assert kernel.gap_m(model, moment._replace(belly_gap_m=0.001)) == 0.001  # a body below its foot
        for faster in np.linspace(-3.0, 3.0, 61):
            moment = moment._replace(speed=PlanarMotion(0.4 + 1j * faster, 2.1, 9.0))
            state = world_at(either, moment).state()
            assert kernel.rising(model, moment) == (mechanics.velocity_m_s(state)[2] > 0.0)


@pytest.mark.parametrize(("more_s", "flown"), [(0.0035, False), (0.0045, True)])
def test_a_robot_flies_once_it_has_been_in_the_air_for_4_ms(kenan: Robot, more_s: float, flown: bool) -> None:
    """A simulation that ends before has not seen it fly."""
    settings = replace_damping(FINE.model_copy(update={"takeoff_clearance_m": 0.0}))
    left_s = PlanarWorld(kenan, settings).push_off().steps * settings.dt_s
    until = settings.model_copy(update={"max_time_s": left_s + more_s})
    assert PlanarWorld(kenan, until).push_off().flown == flown


@pytest.mark.parametrize("within_s", [0.002, 0.004])
def test_who_has_not_flown_for_a_while_after_its_springs_came_to_rest_does_not_jump(
    kenan: Robot, within_s: float
) -> None:
    """Counted from the first step past rest; here from a robot of which more time in the air is asked than it has."""
    world = PlanarWorld(kenan, FINE)
    moment, steps = world.moment, 0
    while moment.leg_rad < 0.0:
        moment, steps = kernel.advance(world.model, moment, FINE.dt_s, 1), steps + 1
    found = kernel.push_off(world.model, world.moment, FINE.dt_s, 0.1, 0.0, within_s, FINE.max_time_s, 16)
    assert not found.flown
    assert (found.steps - steps) * FINE.dt_s == pytest.approx(within_s, abs=1.5 * FINE.dt_s)


def test_the_energy_at_take_off_is_audited_however_seldom_others_are(kenan: Robot) -> None:
    """It is what damping, impact and slip have left of the springs'."""
    world = PlanarWorld(kenan, FINE)
    found = kernel.push_off(world.model, world.moment, FINE.dt_s, 0.004, 0.0, 0.1, FINE.max_time_s, 10**9)
    assert found.flown
    change = kernel.energy(world.model, found.moment) - kernel.energy(world.model, world.moment)
    assert found.worst_gain_j == pytest.approx(change, abs=1e-12)
    assert -0.5 * kenan.spring.energy_j < found.worst_gain_j < 0.0


def test_a_robot_whose_leg_stops_before_its_springs_are_at_rest_flies(kenan: Robot) -> None:
    """Against a hard stop 0.1 rad before rest: the leg extends no further, and the springs push on nothing else."""
    world = PlanarWorld(stopped(kenan, -0.1, 1e4), replace_damping(FINE))
    found = world.push_off()
    assert found.flown
    world.go_to(found.moment)
    world.advance(round(0.004 / FINE.dt_s))
    assert -0.11 < world.moment.leg_rad < -0.05
    assert not world.loaded()
    assert kernel.rising(world.model, world.moment)


def test_a_push_off_tells_how_near_the_body_came_to_the_ground(kenan: Robot) -> None:
    """The least of all steps up to take-off: nearer than it is at the end."""
    world = PlanarWorld(kenan, FINE)
    found, moment, gaps = world.push_off(), world.moment, []
    for _ in range(found.steps):
        moment = kernel.advance(world.model, moment, FINE.dt_s, 1)
        gaps.append(moment.belly_gap_m)
    assert found.belly_gap_m == pytest.approx(min(gaps), rel=1e-12)
    assert found.belly_gap_m < 0.8 * found.moment.belly_gap_m
    assert found.moment == moment  # it leaves after as many steps
