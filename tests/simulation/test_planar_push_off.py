"""Push-offs of the planar engine: what they lose, and when a robot flies."""

import math

import pytest
from support.machines import let_go, one_sided, rubbing, stopped
from support.planar import FINE, with_damping

from jumpcad.robot.robot import Robot
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.mechanics import Mechanics
from jumpcad.simulation.planar import PlanarWorld


@pytest.mark.parametrize(("more_s", "flown"), [(0.0035, False), (0.0045, True)])
def test_a_robot_flies_once_it_has_been_in_the_air_for_4_ms(kenan: Robot, more_s: float, flown: bool) -> None:
    """A simulation that ends before has not seen it fly."""
    settings = with_damping(FINE.model_copy(update={"takeoff_clearance_m": 0.0}))
    left_s = PlanarWorld(kenan, settings).push_off().steps * settings.dt_s
    until = settings.model_copy(update={"max_time_s": left_s + more_s})
    assert PlanarWorld(kenan, until).push_off().flown == flown


def test_a_robot_whose_leg_stops_before_its_springs_are_at_rest_flies(kenan: Robot) -> None:
    """Against a hard stop 0.1 rad before rest: the leg extends no further, and the springs push on nothing else."""
    world = PlanarWorld(stopped(kenan, -0.1, 1e4), with_damping(FINE))
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


def test_without_friction_or_damping_only_the_ground_takes_nothing(kenan: Robot) -> None:
    """On ice: no forward push, and all of the springs' energy is still there."""
    ice = with_damping(FINE.model_copy(update={"ground_friction": 0.0}))
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
    world = PlanarWorld(rubbing(kenan, friction, pin=0.25), with_damping(FINE, 0.001))
    found = world.push_off()
    lost = kernel.energy(world.model, world.moment) - kernel.energy(world.model, found.moment)
    losses = found.moment.losses
    assert sum(losses) == pytest.approx(lost, rel=2e-4)
    assert losses.damping_j > 0.1 * kenan.spring.energy_j
    assert min(losses) > -1e-5 * kenan.spring.energy_j
    slips = losses.slip_j > 0.01 * kenan.spring.energy_j
    assert slips == (friction == 0.3)


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


def test_a_stop_met_on_the_ground_lifts_the_robot(kenan: Robot) -> None:
    """Undamped, the robot stands until its leg is past rest; a stop at rest takes it off the ground there."""
    held, free = (PlanarWorld(robot, with_damping(FINE)).push_off() for robot in (stopped(kenan, 0.0, 1e5), kenan))
    assert free.moment.leg_rad > math.radians(0.3)
    assert held.moment.leg_rad == pytest.approx(0.0, abs=math.radians(0.1))
    assert held.flown
    assert held.moment.losses.stop_j > 0.01 * kenan.spring.energy_j


def test_a_turning_leg_at_release_brings_its_energy(kenan: Robot) -> None:
    plain, turning = (PlanarWorld(let_go(kenan, 1.0, rate), with_damping(FINE)) for rate in (0.0, 3.0))
    more = kernel.energy(turning.model, turning.moment) - kernel.energy(plain.model, plain.moment)
    assert more == pytest.approx(Mechanics(kenan, 9.81).energies(turning.state()).kinetic_j)
    assert more > 0.005 * kenan.spring.energy_j
    speeds = [abs(world.push_off().moment.speed.ankle) for world in (plain, turning)]
    assert speeds[1] > speeds[0]
