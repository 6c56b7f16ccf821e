"""The run: audit, take-off, flight, trajectory, published quantities.

Take-off is found from ground and leg: a foot that chatters is on the ground, one that stays away has left.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.flights import Flight, com_x_m, make_lopsided
from support.machines import let_go, rubbing

from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Mechanism, body_poses, release_pose
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics, State, loaded_state
from jumpcad.simulation.run import Run

needs.package("pybullet")

DT_S = 0.0005
WITHIN_CONTACT_S, CONTACT_LOST_S = 0.003, 0.006
"""A foot of 10 g on a ground of 10 kN/m swings once in 6 ms, so that half a swing, the time off the ground in one
bounce, is 3 ms; a flight of 6 ms is more than that of any contact."""


class Scripted:
    """A robot that stands with its springs at rest and is off the ground at given times."""

    joint_damping_j = slip_j = 0.0

    def __init__(
        self,
        start: State,
        flights_s: list[tuple[float, float]],
        speed_m_s: float,
        opening_s: float = 0.0,
        hop_m: float = 0.0,
        end_rad: float = 0.0,
    ) -> None:
        self.flights_s, self.steps, self.start = flights_s, 0, start
        self.speed_m_s, self.opening_s, self.hop_m, self.end_rad = speed_m_s, opening_s, hop_m, end_rad

    def advance(self, steps: int) -> float:
        """Return the coordinate of a leg that opens by 1 rad/s, at 0 after `opening_s` if it does not rest before."""
        self.steps += steps
        return min(self.steps * DT_S - self.opening_s, self.end_rad)

    def loaded(self) -> bool:
        time = self.steps * DT_S
        return not any(begin - DT_S / 2 < time < end - DT_S / 2 for begin, end in self.flights_s)

    def state(self) -> State:
        if self.steps == 0:
            return self.start
        velocity = 0.0 * self.start.velocity_m_s
        velocity[:, 2] = self.speed_m_s
        com = self.start.com_m.copy()
        com[:, 2] += 0.0 if self.loaded() else self.hop_m
        return replace(self.start, com_m=com, velocity_m_s=velocity, spring_rad=(0.0,))


@contextmanager
def released(mechanism: Mechanism) -> Iterator[State]:
    with engine_named("pybullet").world(mechanism, Settings(dt_s=DT_S)) as world:
        yield world.state()


def takeoff_s(
    mechanism: Mechanism,
    flights_s: list[tuple[float, float]],
    speed_m_s: float = 0.1,
    opening_s: float = 0.0,
    hop_m: float = 0.0,
    end_rad: float = 0.0,
    **settings: float,
) -> float | None:
    """Return when a robot with these flights, of that height, is said to take off."""
    with released(mechanism) as start:
        world = Scripted(start, flights_s, speed_m_s, opening_s, hop_m, end_rad)
        run = Run(world, mechanism, Settings(dt_s=DT_S, **settings))
        run.go()
    return run.takeoff.time_s if run.takeoff else None


def test_audit_rejects_a_loop_that_comes_apart(jumping: list[Flight]) -> None:
    """One iteration of the solver at a coarse step cannot hold the loop of a strong robot together."""
    best = next(flight.robot for flight in jumping if flight.name == "ga-c")
    jump = simulate(best, Settings(dt_s=1 / 240, push_off_steps=0, solver_iterations=1))
    assert jump.verdict == "audit_loop"
    assert jump.fitness == 0.0
    assert jump.ballistic_range_m is None
    finding = jump.findings[-1]
    assert (finding.name, finding.severity) == ("audit_loop", "error")
    assert finding.limit == 0.5
    assert finding.value == pytest.approx(0.5 - finding.margin)
    assert f"came apart by up to {finding.value:.4f} mm" in finding.message
    assert "a smaller dt_s or more solver_iterations" in finding.remedy


@pytest.mark.parametrize("gravity_m_s2", [1.62, 9.81, 15.0])
def test_what_lifts_a_robot_becomes_height(kenan: Robot, gravity_m_s2: float) -> None:
    """On the Moon too: m·g·rise is the energy of its rising and what has lifted it before; it moves on meanwhile."""
    jump = simulate(kenan, Settings(gravity_m_s2=gravity_m_s2))
    assert jump.energy is not None
    weight = kenan.mass_kg * gravity_m_s2
    assert jump.com_rise_m == pytest.approx((jump.energy.upward_j + jump.energy.lift_j) / weight, rel=1e-6)
    up, forward = (math.sqrt(2.0 * one / kenan.mass_kg) for one in (jump.energy.upward_j, jump.energy.forward_j))
    flown = forward * (up + math.sqrt(2.0 * gravity_m_s2 * jump.com_rise_m)) / gravity_m_s2
    assert jump.ballistic_range_m == pytest.approx(flown, abs=0.05)  # and what it has moved on the ground


@pytest.mark.parametrize("engine", ["pybullet", "planar"])
def test_a_flight_is_simulated_up_to_its_touchdown_or_the_time_limit(kenan: Robot, engine: str) -> None:
    """What follows from the take-off is known anyway."""
    flown, cut = (simulate(kenan, Settings(flight="simulated", max_time_s=time_s), engine) for time_s in (3.0, 0.15))
    assert flown.takeoff_time_s < 0.15
    assert flown.touchdown_distance_m > 0.1
    assert cut.touchdown_distance_m == pytest.approx(flown.touchdown_distance_m, rel=0.01)  # in closed form
    assert cut.touchdown_gap_m == cut.ballistic_range_m - cut.touchdown_distance_m
    assert cut.ballistic_range_m == flown.ballistic_range_m


def test_audit_rejects_energy_from_nowhere(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine whose spring pushes twice as hard as the robot's."""
    from jumpcad.simulation.bullet import BulletWorld

    born = BulletWorld.__init__

    def stronger(world: BulletWorld, *arguments: object) -> None:
        born(world, *arguments)  # type: ignore[arg-type]
        world._spring = replace(world._spring, stiffness_nm_per_rad=2 * world._spring.stiffness_nm_per_rad)

    monkeypatch.setattr(BulletWorld, "__init__", stronger)
    jump = simulate(kenan)
    assert jump.verdict == "audit_energy"
    assert jump.findings[-2].margin < 0


def test_time_runs_out(kenan: Robot) -> None:
    assert simulate(kenan, Settings(max_time_s=0.01)).verdict == "no_takeoff"


def test_trajectory(kenan: Robot) -> None:
    settings = Settings(flight="simulated", trajectory=True, trajectory_rate_hz=500)
    jump = simulate(kenan, settings)
    path = jump.trajectory
    assert path is not None
    start = release_pose(kenan)
    body, foot = path.body_names.index(BODY), path.body_names.index(FOOT)
    np.testing.assert_allclose(np.diff(path.time_s)[:-1], 1 / 500)
    np.testing.assert_allclose(path.position_m[0, body], start.body_position_m, atol=1e-12)
    np.testing.assert_allclose(path.position_m[0, foot], [0, 0, kenan.foot_depth_m], atol=1e-9)
    assert np.ptp(com_x_m(kenan, path)[[0, -1]]) == pytest.approx(jump.touchdown_distance_m)
    assert path.spring_j[0] == pytest.approx(jump.spring_energy_j)
    total = path.kinetic_j + path.potential_j + path.spring_j
    assert np.all(np.diff(total) < 1e-4 * total[0]), "energy only falls"
    loop = kenan.loop
    ends = []
    for name, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
        index = path.body_names.index(name)
        ends.append(path.position_m[:, index] + Rotation.from_quat(path.quaternion_xyzw[:, index]).apply(point))
    np.testing.assert_allclose(ends[0], ends[1], atol=5e-5)
    assert {len(values) for values in path.columns().values()} == {len(path.time_s)}
    assert list(path.columns())[:2] == ["time_s", "body_x_m"]


def test_recording_and_flying_do_not_change_the_jump(kenan: Robot) -> None:
    for engine in ("pybullet", "planar"):
        plain = simulate(kenan, engine=engine)
        recorded = simulate(kenan, Settings(flight="simulated", trajectory=True, trajectory_rate_hz=300), engine)
        assert recorded.ballistic_range_m == plain.ballistic_range_m
        assert plain.trajectory is None


def test_lateral_symmetry(kenan: Robot) -> None:
    """A robot mirrored left to right jumps as far: its tensors' and centres' y components change sign."""
    flip = np.diag([1.0, -1.0, 1.0])
    right = make_lopsided(kenan)
    left = replace(
        right,
        bodies={
            name: replace(
                body,
                com_m=flip @ body.com_m,
                inertia_kg_m2=flip @ body.inertia_kg_m2 @ flip,
                contacts=tuple(replace(contact, centre_m=flip @ contact.centre_m) for contact in body.contacts),
            )
            for name, body in right.bodies.items()
        },
    )
    fine = Settings(dt_s=1 / 8000, solver_iterations=200)
    assert simulate(left, fine).ballistic_range_m == pytest.approx(simulate(right, fine).ballistic_range_m, rel=1e-3)


@pytest.mark.parametrize("engine", ["planar", "pybullet"])
def test_the_budget_of_a_slipping_robot_with_a_cam_adds_up(kenan: Robot, engine: str) -> None:
    """What is left for impacts and rounding, when all else has been measured by itself, is hardly anything.

    The foot slides, but does not fall: slip takes more than a hundredth of the springs' energy, impacts next to none.
    Energies forwards and upwards are those of a mass thrown with the take-off's speed and angle.
    """
    robot = let_go(kenan)
    jump = simulate(robot, Settings(ground_friction=0.4), engine)
    budget = jump.energy
    assert budget is not None
    assert sum(vars(budget).values()) == pytest.approx(robot.spring.energy_j, rel=1e-9)
    assert budget.slip_j > 0.01 * robot.spring.energy_j
    assert abs(budget.contact_j) < 0.02 * budget.slip_j
    assert jump.takeoff_speed_m_s is not None
    assert jump.takeoff_angle_deg is not None
    thrown, angle = 0.5 * robot.mass_kg * jump.takeoff_speed_m_s**2, np.radians(jump.takeoff_angle_deg)
    assert budget.forward_j == pytest.approx(thrown * np.cos(angle) ** 2, rel=1e-7)
    assert budget.upward_j == pytest.approx(thrown * np.sin(angle) ** 2, rel=1e-7)
    assert jump.energy_account_j is not None
    assert sum(jump.energy_account_j.values()) == pytest.approx(robot.spring.energy_j, rel=1e-9)


def test_distances_count_from_where_it_stood_with_loaded_springs(kenan: Robot) -> None:
    """Not from where the roller leaves the cam: there the body is further on by some millimetres."""
    robot = let_go(kenan)
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), "planar")
    path = jump.trajectory
    assert path is not None
    body, stood_m = path.body_names.index(BODY), body_poses(robot, 1.0)[BODY][0, 3]
    assert abs(path.position_m[0, body, 0] - stood_m) > 5e-4
    start_m = Mechanics(robot, 9.81).centre_of_mass_m(loaded_state(robot))[0]
    assert com_x_m(robot, path)[-1] - start_m == pytest.approx(jump.touchdown_distance_m)


@pytest.mark.parametrize(("engine", "asked"), [("planar", 1.0), ("pybullet", 1.0), ("planar", 3.0)])
def test_no_moment_is_recorded_twice(kenan: Robot, engine: str, asked: float) -> None:
    """Where every step is recorded the last one is too, and the end of the flight and of the run fall together.

    Of more moments than there are steps every step is one.
    """
    settings = Settings(flight="simulated", trajectory=True)
    every = settings.model_copy(update={"trajectory_rate_hz": asked / settings.dt_s})
    path = simulate(kenan, every, engine).trajectory
    assert path is not None
    assert np.diff(path.time_s) == pytest.approx(settings.dt_s)


def test_chatter_is_no_takeoff_and_a_hop_is(kenan: Mechanism) -> None:
    chatter, hop = (0.010, 0.010 + WITHIN_CONTACT_S), (0.020, 0.020 + CONTACT_LOST_S)
    assert takeoff_s(kenan, [chatter]) is None
    assert takeoff_s(kenan, [chatter, hop]) == pytest.approx(0.020)
    assert takeoff_s(kenan, [hop]) == pytest.approx(0.020)


def test_a_hop_while_the_springs_still_push_is_a_part_of_the_push_off(kenan: Mechanism) -> None:
    """The last contact before the leg is at rest counts, and a flight that goes on until then."""
    hop, flight = (0.010, 0.010 + CONTACT_LOST_S), (0.030, 0.060)
    assert takeoff_s(kenan, [hop, flight]) == pytest.approx(0.010)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.020) == pytest.approx(0.030)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.040) == pytest.approx(0.030)


def test_a_leg_that_rests_before_its_end_has_spent_its_springs(kenan: Mechanism) -> None:
    """Friction of its pins holds it there, and nothing drives the robot any more."""
    hop, flight = (0.010, 0.010 + CONTACT_LOST_S), (0.030, 0.060)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.022, end_rad=-0.002) == pytest.approx(0.030)


def test_a_printed_robot_clears_the_ground_by_a_millimetre(kenan: Mechanism) -> None:
    """A robot with friction of its own is a printed one; the study's capsules, and whoever asks, take any hop."""
    flight = [(0.020, 0.060)]
    printed = rubbing(kenan)
    assert takeoff_s(kenan, flight, hop_m=0.0005) == pytest.approx(0.020)
    assert takeoff_s(printed, flight, hop_m=0.0005) is None
    assert takeoff_s(printed, flight, hop_m=0.0015) == pytest.approx(0.020)
    assert takeoff_s(printed, flight, hop_m=0.0005, takeoff_clearance_m=0.0) == pytest.approx(0.020)
    assert takeoff_s(kenan, flight, hop_m=0.0005, takeoff_clearance_m=0.002) is None


class Thrown(Scripted):
    """It rises until a time and falls from then on, its leg still opening."""

    falls_s = 0.0

    def state(self) -> State:
        state = super().state()
        sign = 1.0 if self.steps * DT_S < self.falls_s else -1.0
        return replace(state, velocity_m_s=sign * np.abs(state.velocity_m_s))


@pytest.mark.parametrize(
    ("falls_s", "hop_m", "printed", "leaves"),
    [
        (0.042, 0.002, True, True),  # up to its highest point
        (0.042, 0.0005, True, False),  # not a millimetre
        (0.042, 0.002, False, False),  # the study's capsules leave with springs that are spent
        (0.200, 0.002, True, False),  # it rises all the time, and may still be pushed
        (0.010, 0.002, True, False),  # it only sinks
    ],
)
def test_a_robot_in_the_air_up_to_its_highest_point_has_left_though_its_leg_creeps_open(
    kenan: Mechanism, falls_s: float, hop_m: float, printed: bool, leaves: bool
) -> None:
    """Against dry friction of its pins; in the air from 20 ms to 60 ms, springs spent after 150 ms."""
    robot = rubbing(kenan) if printed else kenan
    with released(robot) as start:
        world = Thrown(start, [(0.020, 0.060)], 0.5, opening_s=0.150, hop_m=hop_m)
        world.falls_s = falls_s
        run = Run(world, robot, Settings(dt_s=DT_S, max_time_s=0.140))
        run.go()
    assert (run.takeoff is not None) == leaves
    if run.takeoff is not None:
        assert run.takeoff.time_s == pytest.approx(0.020)


def test_a_robot_that_sinks_has_not_taken_off(kenan: Mechanism) -> None:
    """Legs that fold faster than the robot falls lift the foot, and not the robot."""
    assert takeoff_s(kenan, [(0.010, 0.040)], speed_m_s=-0.1) is None


def test_who_stands_60_ms_after_the_springs_came_to_rest_does_not_jump(kenan: Mechanism) -> None:
    """The legs are at rest from the start here, and nothing drives the robot any more."""
    assert takeoff_s(kenan, [(0.050, 0.060)]) == pytest.approx(0.050)
    assert takeoff_s(kenan, [(0.080, 0.090)]) is None


@pytest.mark.parametrize(("speed_m_s", "enough"), [(0.2, False), (0.5, False), (5.0, True)])
def test_who_stays_on_the_ground_is_told_the_speed_that_leaves_it(
    kenan: Mechanism, speed_m_s: float, enough: bool
) -> None:
    """Froude number 1: the root of gravity times the height of the centre of mass; the margin is not positive."""
    with released(kenan) as start:
        world = Scripted(start, [], speed_m_s)
        run = Run(world, kenan, Settings(dt_s=DT_S))
        run.go()
    assert run.takeoff is None
    finding, masses = run.standing(), [kenan.bodies[name].mass_kg for name in BODY_NAMES]
    needed = (9.81 * float(np.dot(masses, start.com_m[:, 2])) / sum(masses)) ** 0.5
    assert (finding.name, finding.severity) == ("no_takeoff", "error")
    assert (finding.value, finding.limit) == pytest.approx((speed_m_s, needed))
    assert finding.margin == pytest.approx(0.0 if enough else speed_m_s - needed)


def test_the_speed_that_is_told_is_that_when_the_springs_are_spent(kenan: Mechanism) -> None:
    """After 20 ms here, with 0.3 m/s; the robot slows down by 4 m/s² until it is given up, 60 ms later."""

    class Slowing(Scripted):
        def state(self) -> State:
            state = super().state()
            return replace(state, velocity_m_s=state.velocity_m_s * (0.38 - 4.0 * self.steps * DT_S))

    with released(kenan) as start:
        run = Run(Slowing(start, [], 1.0, opening_s=0.020), kenan, Settings(dt_s=DT_S))
        run.go()
    assert run.takeoff is None
    assert run.standing().value == pytest.approx(0.3, abs=4.0 * 2.0 * DT_S)


DAMPING = 0.001


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_damping_takes_the_work_of_its_torque(kenan: Mechanism, engine: str) -> None:
    """Work of c·q' along q: c·∫ q'² dt of all three joints, from the leg's angle over time and the linkage."""
    if engine != "planar":
        needs.package(engine)
    settings = Settings(trajectory=True, trajectory_rate_hz=2000.0, joint_damping_nms_per_rad=DAMPING)
    jump = simulate(kenan, settings, engine)
    path, energy = jump.trajectory, jump.energy
    assert path is not None
    assert energy is not None
    assert jump.takeoff_time_s is not None
    until = path.time_s <= jump.takeoff_time_s
    stiffness = kenan.spring.stiffness_nm_per_rad
    leg = np.minimum(-np.sqrt(2.0 * path.spring_j[until] / stiffness), 0.0)
    pose = Linkage(kenan.design).pose(leg)
    speeds = [np.gradient(turn, path.time_s[until]) for turn in (leg, pose.front_rad, pose.ankle_rad)]
    taken = DAMPING * sum(float(np.trapezoid(speed**2, path.time_s[until])) for speed in speeds)
    assert energy.joint_damping_j == pytest.approx(taken, rel=0.05)
