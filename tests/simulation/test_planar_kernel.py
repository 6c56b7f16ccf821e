"""The planar mechanism against rigid bodies that pins hold together, and against the laws of motion."""

import importlib.util
import json
import math
import os
import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.machines import PAD_NM_PER_RAD, PINS_M, STOP_RAD, one_sided, rubbing, stopped
from support.planar import FINE, NO_CONTACT, model_of, moving, turn_of, with_damping, world_at

from jumpcad.design import load_design
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.mechanics import Mechanics, State
from jumpcad.simulation.planar import PlanarWorld
from jumpcad.simulation.planar_kernel import compiled
from jumpcad.simulation.planar_model import Contact, Inertia, PlanarMotion, Stance
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import Array

PINS = ((BODY, MAIN_LEG), (BODY, FRONT_LINK), (MAIN_LEG, FOOT), (FRONT_LINK, FOOT))
"""The bodies of the pins leg, front, ankle and eye."""


@pytest.mark.parametrize("leg_deg", [-40.0, -20.0, 0.0, 8.0])
def test_the_loop_is_that_of_the_linkage(either: Robot, leg_deg: float) -> None:
    """Joint rates by the velocity analysis of `Linkage`, places by its poses."""
    leg_rad, linkage = math.radians(leg_deg), Linkage(either.design)
    links, pose = kernel.links_at(model_of(either), leg_rad), linkage.pose(leg_rad)
    assert links.closed
    assert np.angle(links.pitch) == pytest.approx(pose.foot_rad[0], abs=1e-12)
    assert links.turn1[0] == pytest.approx(-linkage.rates(leg_rad)[0], rel=1e-9)
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
    moment, settings = moving(model_of(lopsided), -0.35), with_damping(FINE)
    world = world_at(lopsided, moment, settings)
    mechanics, state = Mechanics(lopsided, 9.81), world.state()
    assert mechanics.energies(state).total_j == pytest.approx(kernel.energy(world.model, moment), rel=1e-12)
    assert mechanics.loop_gap_m(state) < 1e-15
    later = world_at(lopsided, kernel.advance(world.model, moment, 1e-6, 1), settings).state()
    np.testing.assert_allclose((later.com_m - state.com_m) / 1e-6, state.velocity_m_s, atol=2e-3)
    turned = later.rotation @ state.rotation.transpose(0, 2, 1)
    np.testing.assert_allclose(turned[:, 0, 2] / 1e-6, state.angular_rad_s[:, 1], atol=2e-3)


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
def test_accelerations_are_those_of_pinned_bodies(either: Robot, leg_rad: float, pushes: tuple[float, ...]) -> None:
    """In the air, and with the ground's forces (N) on one or two spheres of the sole."""
    settings = Settings(joint_damping_nms_per_rad=0.001)
    moment, dt = moving(model_of(either), leg_rad), 1e-4
    state, along = world_at(either, moment).state(), -0.7 if pushes else 0.0
    body, place = either.bodies[FOOT], BODY_NAMES.index(FOOT)
    spheres = [contact for contact in body.contacts if contact.surface == "foot"][:: len(body.contacts) - 1]
    places = [float(state.com_m[place, 0] + state.rotation[place, 0] @ (one.centre_m - body.com_m)) for one in spheres]
    ground_n = ((0.0, complex(along)), *((x, 1j * push) for x, push in zip(places, pushes, strict=False)))
    accelerations, _ = pinned_bodies(either, state, settings, ground_n)
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


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"])
def test_the_pins_torque_at_the_leg_does_the_work_of_their_forces(name: str) -> None:
    """Up to take-off, coefficient times radius times force along the turn of each; the engine has one torque."""
    settings = Settings(joint_damping_nms_per_rad=0.001)
    robot = rubbing(capsule_robot(load_design(name)), pin=0.25)
    world, work = PlanarWorld(robot, settings), 0.0
    for _ in range(world.push_off().steps):
        world.advance(1)
        moment, touching = world.moment, world.moment.contact
        places = [(moment.ankle_m + one * turn_of(moment)).real for one in world.model.sole_m]
        ground_n = [(0.0, complex(touching.along_ns / settings.dt_s))]
        for index, push in ((touching.first, touching.first_ns), (touching.second, touching.second_ns)):
            ground_n.append((places[index], 1j * push / settings.dt_s))
        _, pin_n = pinned_bodies(robot, world.state(), settings, tuple(ground_n))
        turned = np.abs(kernel.links_at(world.model, moment.leg_rad).pin1) * moment.speed.leg * settings.dt_s
        work += 0.25 * float(np.array(PINS_M) * np.linalg.norm(pin_n, axis=1) @ turned)
    assert pin_torque_nm(robot, 0.25) * robot.spring.wind_rad == pytest.approx(work, rel=0.2)
    assert 0.01 < work / robot.spring.energy_j < 0.05


def test_flight_keeps_momenta_and_energy(lopsided: Robot) -> None:
    """Springs and inertia at work inside: a parabola, a constant spin about the centre of mass, no energy lost."""
    world = world_at(lopsided, moving(model_of(lopsided), -0.5), with_damping(FINE))
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
        settings = with_damping(Settings(dt_s=1 / rate))
        world = world_at(lopsided, moving(model_of(lopsided), -0.5), settings)
        start = kernel.energy(world.model, world.moment)
        world.advance(rate // 40)
        errors.append(abs(kernel.energy(world.model, world.moment) - start))
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0


def test_what_damping_takes_in_the_air_is_what_is_missing(either: Robot) -> None:
    """Of links of any lengths: each joint of leg, front link and ankle takes by its own rate."""
    settings = with_damping(FINE, 0.002)
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
    torque = kernel.dry_torque(model, kernel.links_at(model, leg_rad))
    near = Linkage(either.design).pose([leg_rad - 1e-6, leg_rad + 1e-6])
    turned = sum(abs(float(np.ptp(angle))) for angle in (near.leg_rad, near.front_rad, near.ankle_rad)) / 2e-6
    assert torque - model.pins_nm == pytest.approx(0.004 * turned, rel=1e-6)


@pytest.mark.parametrize("preload_rad", [0.0, 0.1])
def test_springs_push_by_hooke_from_where_they_are_relaxed(kenan: Robot, preload_rad: float) -> None:
    """Torque k·(preload - angle), energy half of that times the angle; one that only pushes has none beyond."""
    pulling = replace(kenan, springs=(replace(kenan.spring, preload_rad=preload_rad),))
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
    world = world_at(robot, moving(model_of(kenan), -0.05), with_damping(FINE))
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
    held, free = (world_at(one, leaving, with_damping(FINE)) for one in (robot, kenan))
    for world in (held, free):
        world.advance(round(0.01 / FINE.dt_s))
    assert held.moment.leg_rad == free.moment.leg_rad < STOP_RAD
    assert held.moment.losses.stop_j == 0.0


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


WITHOUT_NUMBA = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
PROGRAM = """
import json
from jumpcad import Settings, capsule_robot, load_design, simulate
said = []
for name in ("kenan-2.0", "best-bo"):
    for friction in (0.3, 1.5):
        jump = simulate(capsule_robot(load_design(name)), Settings(ground_friction=friction), "planar").to_dict()
        said.append([jump["verdict"], jump["ballistic_range_m"], jump["com_rise_m"], jump["takeoff_time_s"],
                     *jump["energy"].values()])
"""


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_compiled_and_plain_give_the_same_numbers() -> None:
    assert hasattr(kernel.response, "py_func"), "compiled in this process"
    here: dict[str, Any] = {}
    exec(PROGRAM, here)
    printing = f"{PROGRAM}print(json.dumps(said))"
    run = subprocess.run(
        [sys.executable, "-c", printing], capture_output=True, text=True, check=True, env=WITHOUT_NUMBA
    )
    compiled, plain = here["said"], json.loads(run.stdout)
    assert len(compiled) == 4
    for one, other in zip(compiled, plain, strict=True):
        assert one[0] == other[0] == "jump"
        assert one[1:] == pytest.approx(other[1:], rel=1e-9, abs=1e-12)


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_what_is_compiled_is_kept_for_the_next_process_and_divides_as_a_processor_does() -> None:
    """By zero it says infinite or no number, which ends a push-off as lost, and raises nothing."""
    assert kernel.response.stats.cache_path  # type: ignore[attr-defined]
    assert not math.isfinite(kernel.response(Inertia(1.0, 0j, 0j, 0.0, 0.0, 0.0), 0j, 1.0, 0.0).foot)


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason="numba is not installed")
def test_where_no_folder_can_be_written_it_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("numba.core.caching.CacheImpl._locator_classes", [])
    twice = compiled(lambda number: 2.0 * number)
    assert hasattr(twice, "py_func")
    assert twice(1.5) == 3.0


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_where_the_disk_is_full_it_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_given: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("numba.core.caching.IndexDataCacheFile.save", full)
    assert compiled(thrice)(1.5) == 4.5


def thrice(number: float) -> float:
    return 3.0 * number


def test_a_missing_compiler_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)

    def twice(number: float) -> float:
        return 2.0 * number

    assert compiled(twice) is twice
