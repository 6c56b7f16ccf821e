"""The flight in closed form, against flights that engines simulate."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built
from support.flights import Flight, base_distance_m

from jumpcad.building import build
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Jump, Settings, load_settings, simulate
from jumpcad.simulation.flight import obstacles
from jumpcad.workshop import load_workshop

NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"]
FLOWN = Settings(flight="simulated", trajectory=True, trajectory_rate_hz=2000.0, max_time_s=5.0)


def flown_deg(jump: Jump) -> tuple[float, float]:
    """Return the body's turn from its loaded pose to the first touch (°), and the time in the air (s), as simulated."""
    assert jump.trajectory is not None
    turns = Rotation.from_quat(jump.trajectory.quaternion_xyzw[:, 0]).as_matrix()
    pitch = np.degrees(np.unwrap(np.arctan2(turns[:, 0, 2], turns[:, 0, 0])))
    return float(pitch[-1] - pitch[0]), float(jump.trajectory.time_s[-1] - (jump.takeoff_time_s or 0.0))


def apart_deg(robot: Mechanism, engine: str, settings: Settings = FLOWN) -> float:
    """Return by how much the pitch at touchdown differs from that of the simulated flight."""
    jump = simulate(robot, settings, engine)
    if jump.verdict != "jump":
        return 0.0
    turn, air_s = flown_deg(jump)
    assert jump.air_time_s == pytest.approx(air_s, abs=0.004)
    alone = simulate(robot, settings.model_copy(update={"flight": "ballistic"}), engine)
    assert alone.touchdown_distance_m == pytest.approx(jump.touchdown_distance_m, rel=0.02)
    assert jump.touchdown_pitch_deg is not None
    assert -180.0 <= jump.touchdown_pitch_deg < 180.0
    return abs((jump.touchdown_pitch_deg - turn + 180.0) % 360.0 - 180.0)


@pytest.mark.parametrize("name", NAMES)
def test_templates_touch_down_as_their_simulated_flights_do(name: str) -> None:
    """Within 1°; PyBullet's bodies lose angular momentum in flight, so that what turns by 200° is 2° ahead of them."""
    pytest.importorskip("mujoco")
    robot = built(name)
    assert apart_deg(robot, "mujoco") < 1.0
    if name == "kenan-2.0":
        needs.package("pybullet")
        assert apart_deg(robot, "pybullet") < 1.0


def test_a_leg_that_swings_freely_touches_down_as_its_simulated_flight_does() -> None:
    """The study's capsules have no stop: Kenan 1.0's leg swings on by 12° and back, which lengthens its hop by 7 %."""
    pytest.importorskip("mujoco")
    for name in ("kenan-1.0", "best-printable"):
        assert apart_deg(capsule_robot(load_design(name)), "mujoco") < 2.0, name


def test_what_slips_and_leaves_with_spin_turns_as_its_simulated_flight_does() -> None:
    """On a floor of 0.3 the momentum of the whole robot turns it on while its leg swings to its stop, by up to 5°."""
    slippery = FLOWN.model_copy(update={"ground_friction": 0.3})
    for name in ("kenan-2.0", "best-ga", "best-printable"):
        assert apart_deg(built(name), "planar", slippery) < 0.5, name


def test_the_centre_of_mass_lies_beside_the_legs_plane_as_the_bodies_say() -> None:
    robot = built("kenan-2.0")
    moment = sum(body.mass_kg * body.com_m[1] for body in robot.bodies.values())
    jump = simulate(robot, engine="planar")
    assert jump.lateral_offset_mm == pytest.approx(1000.0 * moment / robot.mass_kg, abs=1e-9)


@pytest.mark.thorough
def test_random_robots_touch_down_within_2_degrees() -> None:
    """50 printed robots of the search's bounds, in MuJoCo; after 2 % of their way at most more or less."""
    pytest.importorskip("mujoco")
    rng, workshop, apart = np.random.default_rng(4), load_workshop("default"), list[float]()
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    while len(apart) < 50:
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        if errors(geometry_findings(design)):
            continue
        try:
            apart.append(apart_deg(build(design, workshop), "mujoco"))
        except CannotBuildError:
            continue
    assert max(apart) < 2.0


TIME_S = np.linspace(0.0, 2.0 * 3.0 / 9.81, 2000)
WAY_M, HEIGHT_M = 2.0 * TIME_S, 3.0 * TIME_S - 4.905 * TIME_S**2
TOP_M = 3.0**2 / (2.0 * 9.81)


def test_a_stone_passes_over_a_bar_as_high_as_its_apex_and_lands_on_a_step_as_high() -> None:
    bar_mm, bar_at_mm, step_mm, _ = obstacles((WAY_M + 1j * HEIGHT_M)[:, None], WAY_M, 0.0)
    half_way = 1000.0 * 2.0 * 3.0 / 9.81
    assert bar_mm == pytest.approx(1000.0 * TOP_M, rel=0.01)
    assert bar_at_mm == pytest.approx(half_way, rel=0.05)
    assert step_mm == pytest.approx(1000.0 * TOP_M, rel=0.02)


def test_two_stones_behind_each_other_clear_what_both_pass_and_land_where_both_are_above() -> None:
    """The second flies 0.1 m lower: it decides on the bar; the edge of a step must lie below both."""
    both = np.stack([WAY_M + 1j * HEIGHT_M, WAY_M - 0.3 + 1j * (HEIGHT_M - 0.1)], axis=1)[HEIGHT_M > 0.1]
    bar_mm, _, step_mm, _ = obstacles(both, both.real[:, 0] - 0.15, both[0, 0].real)
    assert bar_mm == pytest.approx(1000.0 * (TOP_M - 0.1), rel=0.02)
    assert step_mm <= 1000.0 * (TOP_M - 0.1) + 1.0


def test_what_does_not_fly_farther_than_it_is_long_clears_no_bar() -> None:
    both = np.stack([WAY_M + 1j * HEIGHT_M, WAY_M - 5.0 + 1j * HEIGHT_M], axis=1)
    assert obstacles(both, WAY_M - 2.5, float(WAY_M[0]))[0] == 0.0
    assert simulate(built("kenan-2.0"), engine="planar").clears_bar_mm == 0.0  # 0.19 m long, 0.17 m far


def test_what_flies_straight_up_passes_over_nothing() -> None:
    assert not any(obstacles((0.3 + 1j * HEIGHT_M)[:, None], np.full(len(TIME_S), 0.3), 0.3))


def test_a_robots_lowest_point_stays_below_its_centre_of_mass() -> None:
    jump = simulate(built("best-printable"), engine="planar")
    assert jump.com_rise_m is not None
    assert 0.5 < jump.clears_bar_mm / (1000.0 * jump.com_rise_m) < 1.05
    assert jump.bar_distance_mm > 0.0


SIMULATED = Settings(flight="simulated", trajectory=True)
FINE = load_settings("fine").model_copy(update={"flight": "simulated", "trajectory": True})


def test_verdicts(flights: list[Flight]) -> None:
    verdicts = {flight.name: simulate(flight.robot).verdict for flight in flights}
    weak_as_no_takeoff = {name: "no_takeoff" if v == "too_weak" else v for name, v in verdicts.items()}
    assert weak_as_no_takeoff == {flight.name: flight.verdict for flight in flights}


def test_jumps_at_the_default_step(jumping: list[Flight]) -> None:
    needs.package("pybullet")
    for flight in jumping:
        jump, table = simulate(flight.robot, SIMULATED), flight.values
        assert jump.mass_kg == pytest.approx(table["mass_kg"], rel=1e-12)
        assert jump.spring_energy_j == pytest.approx(table["spring_energy_j"], rel=1e-12)
        assert jump.ballistic_range_m == pytest.approx(table["ballistic_range_m"], rel=0.005), flight.name
        assert jump.com_rise_m == pytest.approx(table["com_rise_m"], rel=0.012), flight.name
        assert jump.takeoff_energy_ratio == pytest.approx(table["takeoff_energy_ratio"], abs=0.007), flight.name
        assert base_distance_m(jump) == pytest.approx(table["touchdown_distance_m"], abs=0.0045), flight.name


def test_screening_is_within_its_promise(jumping: list[Flight]) -> None:
    for flight in jumping:
        jump = simulate(flight.robot, load_settings("screening"))
        assert jump.ballistic_range_m == pytest.approx(flight.values["ballistic_range_m"], rel=0.012), flight.name


@pytest.mark.thorough
@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
def test_converged_jumps(jumping: list[Flight], engine: str) -> None:
    """At fine steps both engines, which share nothing but the robot, tell the table's jumps.

    MuJoCo takes more than a second for a jump, and does the shortest and the longest.
    """
    needs.package(engine)
    by_range = sorted(jumping, key=lambda flight: flight.values["ballistic_range_m"])
    for flight in jumping if engine == "pybullet" else (by_range[0], by_range[-1]):
        jump, table = simulate(flight.robot, FINE, engine), flight.values
        assert jump.ballistic_range_m == pytest.approx(table["ballistic_range_m"], rel=0.0025), flight.name
        assert jump.com_rise_m == pytest.approx(table["com_rise_m"], rel=0.001), flight.name
        assert jump.takeoff_energy_ratio == pytest.approx(table["takeoff_energy_ratio"], abs=0.004), flight.name
        assert base_distance_m(jump) == pytest.approx(table["touchdown_distance_m"], abs=0.002), flight.name


def test_range_converges_at_least_at_first_order(jumping: list[Flight]) -> None:
    """Halving the step may not leave the error where it was (the published recipe's grows)."""
    best = next(flight for flight in jumping if flight.name == "best-bo")
    errors = [
        abs(simulate(best.robot, Settings(dt_s=1 / rate, push_off_steps=0, solver_iterations=200)).ballistic_range_m
            / best.values["ballistic_range_m"] - 1)
        for rate in (1000, 2000, 4000, 8000)
    ]  # fmt: skip
    assert all(finer < 0.75 * coarser for coarser, finer in pairwise(errors)), errors
