"""What printed robots have and the study's capsules do not: one-sided springs, stop, cam, friction, in every engine."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support import needs
from support.built import built
from support.machines import PAD_NM_PER_RAD, STOP_RAD, let_go, machine, one_sided, rubbing, stopped

from jumpcad.building import build
from jumpcad.design import Design, load_design
from jumpcad.mechanism.model import BODY_NAMES, FOOT, Mechanism
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Jump, Settings, load_settings, simulate
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import Array

ENGINES = ("pybullet", "mujoco", "planar")
FINE = load_settings("fine")


@pytest.fixture(params=ENGINES)
def engine(request: pytest.FixtureRequest) -> str:
    if request.param != "planar":
        needs.package(request.param)
    return str(request.param)


def robots() -> dict[str, Mechanism]:
    return {"capsules": machine(capsule_robot(load_design("best-bo"))), "printed": machine(built("kenan-2.0"))}


@pytest.mark.parametrize("name", ["capsules", "printed"])
def test_three_engines_agree(name: str) -> None:
    """With everything that a printed robot has, at converged steps."""
    robot = robots()[name]
    jumps = {}
    for engine in ENGINES:
        if engine != "planar":
            needs.package(engine)
        jumps[engine] = simulate(robot, FINE, engine)
    ranges = [jump.ballistic_range_m for jump in jumps.values()]
    assert {jump.verdict for jump in jumps.values()} == {"jump"}
    assert max(ranges) == pytest.approx(min(ranges), rel=0.004)
    ratios = [jump.takeoff_energy_ratio for jump in jumps.values()]
    assert max(ratios) == pytest.approx(min(ratios), abs=0.01)


def test_pins_take_their_torque_from_a_jump(engine: str) -> None:
    """Of one torque along the travel of the springs, which `test_planar_kernel` compares with the pins' forces."""
    robot = built("kenan-2.0")
    with_pins = simulate(robot, FINE, engine)
    without = simulate(robot, FINE.model_copy(update={"pin_friction": 0.0}), engine)
    assert 0.005 < 1.0 - with_pins.ballistic_range_m / without.ballistic_range_m < 0.05
    assert with_pins.energy.joint_damping_j == pytest.approx(
        pin_torque_nm(robot, 0.25) * robot.spring.wind_rad, rel=0.1
    )


def test_the_jump_begins_where_the_roller_leaves_with_the_foot_still(engine: str) -> None:
    robot = let_go(capsule_robot(load_design("best-printable")), leg_rad_s=6.0)
    loaded = replace(robot, roller_off=None)
    with engine_named(engine).world(robot, Settings()) as world:
        state = world.state()
    assert state.leg_rad == pytest.approx(-0.93 * robot.spring.wind_rad)
    assert np.abs(state.velocity_m_s).max() > 0.3
    foot = BODY_NAMES.index(FOOT)
    np.testing.assert_allclose(state.velocity_m_s[foot], 0.0, atol=1e-9)
    np.testing.assert_allclose(state.angular_rad_s[foot], 0.0, atol=1e-9)
    mechanics = Mechanics(robot, 9.81)
    here = mechanics.energies(state)
    with engine_named(engine).world(loaded, Settings()) as world:
        before = mechanics.energies(world.state())
    jump = simulate(robot, Settings(), engine)
    kept = 1.0 - (before.total_j - here.total_j) / robot.spring.energy_j
    assert jump.release_energy_ratio == pytest.approx(kept, rel=1e-9)
    assert here.spring_j == pytest.approx(0.93**2 * robot.spring.energy_j)
    assert simulate(loaded, Settings(), engine).release_energy_ratio == 1.0


def test_a_release_without_loss_changes_nothing(engine: str) -> None:
    """Begin a lossless push-off at 90 % of its travel with the rate that it has there: the same jump."""
    whole = capsule_robot(load_design("best-ga"))  # its foot stays flat so long; that of kenan-2.0 tilts from the start
    free = FINE.model_copy(update={"joint_damping_nms_per_rad": 0.0})
    with engine_named("planar").world(whole, free) as world:
        while world.advance(1) < -0.9 * whole.spring.wind_rad:
            pass
        leg, rate = world.moment.leg_rad, world.moment.speed.leg
    cut = simulate(let_go(whole, -leg / whole.spring.wind_rad, rate), free, engine)
    uncut = simulate(whole, free, engine)
    assert cut.release_energy_ratio == pytest.approx(1.0, abs=1e-6)
    assert cut.ballistic_range_m == pytest.approx(uncut.ballistic_range_m, rel=2e-3)
    assert cut.com_rise_m == pytest.approx(uncut.com_rise_m, rel=2e-3)


def motion(robot: Mechanism, settings: Settings, engine: str) -> tuple[Array, Array]:
    """Return leg angles and mechanical energies from the loaded springs' first half to well after take-off."""
    mechanics, path = Mechanics(robot, settings.gravity_m_s2), []
    with engine_named(engine).world(robot, settings) as world:
        for _ in range(round(0.09 / settings.dt_s)):
            world.advance(1)
            state = world.state()
            path.append((state.leg_rad, mechanics.energies(state).total_j))
    legs, energies = np.array(path).T
    return legs, energies


def test_the_stop_holds_the_leg_in_flight(kenan: Mechanism, engine: str) -> None:
    """Past its angle by no more than the pad gives, x = v·√(I/k), and energy only falls."""
    settings = FINE.model_copy(update={"joint_damping_nms_per_rad": 0.0})
    free, held = one_sided(kenan), stopped(one_sided(kenan))
    beyond, _ = motion(free, settings, engine)
    legs, energy = motion(held, settings, engine)
    met = int(np.argmax(legs > STOP_RAD))
    rate = (legs[met] - legs[met - 1]) / settings.dt_s
    give = rate * math.sqrt(leg_inertia_kg_m2(kenan, STOP_RAD) / PAD_NM_PER_RAD)
    assert max(beyond) > STOP_RAD + 2.0 * give
    assert STOP_RAD < max(legs) < STOP_RAD + 1.1 * give
    assert np.diff(legs[met:]).min() > -0.03 * rate * settings.dt_s, "thrown back by no more than 3 % of the speed"
    assert np.all(np.diff(energy) < 1e-3 * kenan.spring.energy_j)
    assert energy[met] - energy[-1] == pytest.approx(0.5 * leg_inertia_kg_m2(kenan, STOP_RAD) * rate**2, rel=0.15)


def test_a_stop_far_too_stiff_for_the_step_adds_no_energy(kenan: Mechanism, engine: str) -> None:
    robot = stopped(one_sided(kenan), stiffness=1e4)
    legs, energy = motion(robot, Settings(joint_damping_nms_per_rad=0.0), engine)
    assert STOP_RAD < max(legs) < STOP_RAD + math.radians(1.5)
    met = int(np.argmax(legs > STOP_RAD))
    assert np.all(np.diff(energy[met:]) < 1e-3 * kenan.spring.energy_j)
    assert energy[-1] < energy[met - 2] - 0.1 * kenan.spring.energy_j


@pytest.mark.parametrize(
    ("vector", "verdict"),
    [
        ([192.954, 1.199, 0.897, 1.16, 0.476, 57.004, 28.348, 43.695], "no_takeoff"),
        ([160.405, 0.923, 0.509, 1.054, 0.326, 58.811, 27.181, 34.163], "no_takeoff"),
        ([140.225, 0.813, 0.688, 1.133, 0.35, 66.2, 28.318, 12.023], "jump"),
    ],
)
def test_who_tips_over_the_nose_does_not_jump(vector: list[float], verdict: str, engine: str) -> None:
    """The stop ends the push-off, lifts the toes and presses the nose down; two robots go on over it, one leaves."""
    assert simulate(build(Design.from_vector(vector)), FINE, engine).verdict == verdict


def test_springs_that_only_push_leave_a_leg_beyond_rest_alone(kenan: Mechanism, engine: str) -> None:
    settings = FINE.model_copy(update={"joint_damping_nms_per_rad": 0.0})
    both, one = (motion(robot, settings, engine)[0].max() for robot in (kenan, one_sided(kenan)))
    assert one > 1.2 * both > 0.0


def test_preload_at_the_same_energy_jumps_as_far(kenan: Mechanism, engine: str) -> None:
    """Springs of the same energy, preloaded by 3°: softer, range nearly as before (machine.md, part 3)."""
    preload, wind = math.radians(3.0), kenan.spring.wind_rad
    softer = kenan.spring.stiffness_nm_per_rad * wind / (wind + 2.0 * preload)
    spring = replace(kenan.spring, stiffness_nm_per_rad=softer, preload_rad=preload, one_sided=True)
    robot = replace(kenan, springs=(spring,))
    assert spring.energy_j == pytest.approx(kenan.spring.energy_j)
    assert simulate(robot, FINE, engine).ballistic_range_m == pytest.approx(
        simulate(kenan, FINE, engine).ballistic_range_m, rel=0.03
    )


def accounts(jump: Jump) -> dict[str, float]:
    assert jump.energy_account_j is not None
    return {name: value / jump.spring_energy_j for name, value in jump.energy_account_j.items()}


@pytest.mark.parametrize("friction", [0.4, 1.5])
def test_the_energy_account_adds_up(kenan: Mechanism, engine: str, friction: float) -> None:
    """To what was wound; what friction takes from a foot that slips is what the planar engine finds."""
    robot = rubbing(machine(kenan), friction, pin=0.25)
    found, planar = (accounts(simulate(robot, FINE, name)) for name in (engine, "planar"))
    assert list(found) == ["useful", "internal", "springs", "release", "pins", "slip", "contact"]
    assert sum(found.values()) == pytest.approx(1.0, abs=1e-9)
    assert abs(found["contact"]) < 0.005
    assert found["slip"] == pytest.approx(planar["slip"], abs=0.004)
    assert (found["slip"] > 0.05) == (friction == 0.4)
    assert found["release"] > 0.05


def test_settings_follow_the_robot(kenan: Mechanism) -> None:
    """A printed robot rubs as its own pads and pins do, capsules as the study's; a file overrides it."""
    needs.package("pybullet")
    printed = built("best-ga")
    assert printed.friction is not None
    icy = replace(printed, friction=replace(printed.friction, foot=0.3))
    own = simulate(printed)
    assert simulate(icy).ballistic_range_m < 0.97 * own.ballistic_range_m
    same = Settings(ground_friction=0.8, body_friction=0.35 / 0.8, pin_friction=0.25, joint_damping_nms_per_rad=0.0)
    assert simulate(printed, same).ballistic_range_m == own.ballistic_range_m
    study = Settings(
        ground_friction=1.5, foot_friction=1.0, body_friction=0.5, pin_friction=0.0, joint_damping_nms_per_rad=0.001
    )
    assert simulate(kenan, study).ballistic_range_m == simulate(kenan).ballistic_range_m
