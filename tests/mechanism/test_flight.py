"""The blow on the rest stop, against the planar engine without damping, and against momenta of simple bodies."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.each import each

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.mechanism import flight
from jumpcad.mechanism.flight import Blow, leg_blow
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.mechanism.planar import seen_from_foot
from jumpcad.settings import load_settings
from jumpcad.simulation.planar import PlanarEngine
from jumpcad.transforms import turned_about_y


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_the_leg_is_as_fast_as_in_an_engine_without_losses(name: str) -> None:
    """The engine integrates another model at another step: no damping, and friction that holds.

    Its foot, on a ground that gives, lifts within a degree of where the model's does.
    """
    robot = replace(built(name), roller_off=None)
    lossless = {"joint_damping_nms_per_rad": 0.0, "pin_friction": 0.0, "foot_friction": 50.0}
    settings = load_settings("default").model_copy(update=lossless)
    with PlanarEngine().world(robot, settings) as world:
        while world.moment.leg_rad <= 0.0:
            world.advance(1)
        leg, rate = world.moment.leg_rad, world.moment.speed.leg
        while world.loaded():
            world.advance(1)
        lifted = world.moment.leg_rad
    blow = leg_blow(robot.bodies, robot.linkage, robot.spring, leg)
    assert blow.stop_rad_s == pytest.approx(rate, rel=5e-3)
    far = leg_blow(robot.bodies, robot.linkage, robot.spring, math.radians(5.0))
    assert far.takeoff_rad == pytest.approx(lifted, abs=math.radians(1.0))


def test_damping_only_takes_from_the_blow() -> None:
    robot = built("best-bo")
    with PlanarEngine().world(robot, load_settings("default")) as world:
        while world.moment.leg_rad <= 0.0:
            world.advance(1)
        leg, rate = world.moment.leg_rad, world.moment.speed.leg
    assert leg_blow(robot.bodies, robot.linkage, robot.spring, leg).stop_rad_s > rate


def test_no_blow_has_more_energy_than_the_springs_held() -> None:
    """Weight takes from it while the leg opens; a leg that it presses back, or holds, does not come to the stop."""
    for robot in map(built, ("kenan-2.0", "best-bo")):
        for times in np.geomspace(0.03, 2.0, 10):
            spring = replace(robot.spring, stiffness_nm_per_rad=times * robot.spring.stiffness_nm_per_rad)
            blow = leg_blow(robot.bodies, robot.linkage, spring, robot.layout.stop.angle_rad)
            assert blow.energy_j < 0.15 * spring.energy_j, f"{robot.name}, {times:.2f} times as stiff"
            assert times > 0.1 or blow.energy_j == 0.0, f"{robot.name}, {times:.2f} times as stiff"


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_inertia_in_flight_is_what_is_left_without_momenta(name: str) -> None:
    """Least squares: of all motions of the body's frame, free flight takes the one with the least energy."""
    robot = built(name)
    stop, step = math.radians(3.0), 1e-5
    pose = robot.linkage.pose([stop - step, stop, stop + step])
    turns = {
        "body": np.zeros(3), "main_leg": robot.linkage.rest_rad + pose.leg_rad,
        "front_link": robot.linkage.rest_rad + pose.front_rad, "foot": pose.foot_rad,
    }  # fmt: skip
    starts = {
        "body": np.zeros((3, 2)), "main_leg": np.tile(robot.linkage.back_pivot_mm, (3, 1)),
        "front_link": np.tile(robot.linkage.front_pivot_mm, (3, 1)), "foot": pose.ankle_mm,
    }  # fmt: skip
    rows, right = [], []
    for body in BODY_NAMES:
        mass, inertia = robot.bodies[body].mass_kg, robot.bodies[body].inertia_kg_m2[1, 1]
        centre = starts[body] / 1000.0 + turned_about_y(robot.bodies[body].com_m[[0, 2]], turns[body])
        rate, turning = (centre[2] - centre[0]) / (2.0 * step), (turns[body][2] - turns[body][0]) / (2.0 * step)
        x, z = centre[1]
        weigh = math.sqrt(mass)
        rows += [[weigh, 0.0, weigh * z], [0.0, weigh, -weigh * x], [0.0, 0.0, math.sqrt(inertia)]]
        right += [-weigh * rate[0], -weigh * rate[1], -math.sqrt(inertia) * turning]
    solved = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    blow = leg_blow(robot.bodies, robot.linkage, robot.spring, stop)
    assert blow.inertia_kg_m2 == pytest.approx(float(solved[1][0]), rel=2e-3)


@each("rates", [(30.0, 0.0), (0.0, 12.0), (-25.0, 9.0)])
@each(
    ("name", "end", "slim"), [("kenan-2.0", 0, 1.0), ("best-bo", 1, 1.0), ("best-ga", 1, 30.0), ("best-ga", 0, 1000.0)]
)
def test_push_off_obeys_the_principle_of_virtual_power(
    name: str, end: int, slim: float, rates: tuple[float, float]
) -> None:
    """The bodies' accelerations, times how they move by each coordinate, are the power of springs and weight.

    The accelerations are those of places a moment before and after, while the foot rolls on one end's sphere. What all
    of them need from below is the ground's force. With inertias 30 or 1000 times as large the turning of the links
    counts too.
    """
    robot = built(name)
    bodies = {key: replace(body, inertia_kg_m2=slim * body.inertia_kg_m2) for key, body in robot.bodies.items()}
    chain, pivot = flight._Chain(bodies, robot.linkage, robot.spring, 0.1), bodies["foot"].contacts[end]
    start, speeds, gains = np.array([chain.leg[120], 0.15]), np.array(rates), np.array([900.0, -400.0])
    mass = np.array([bodies[key].mass_kg for key in BODY_NAMES])
    inertia = np.array([bodies[key].inertia_kg_m2[1, 1] for key in BODY_NAMES])

    def where(coordinates: np.ndarray) -> np.ndarray:
        """Return x, z and angle below x (3, 4) of the bodies."""
        leg, foot = coordinates
        place, turns = seen_from_foot(bodies, robot.linkage, np.array([leg]))
        arm = place[0] - complex(pivot.centre_m[0], pivot.centre_m[2])
        world = pivot.radius_m * (foot + 1j) + arm * np.exp(-1j * foot)
        return np.stack([world.real, world.imag, turns[0] + foot])

    step = 1e-5
    before, now, after = (where(start + t * speeds + 0.5 * t**2 * gains) for t in (-step, 0.0, step))
    x, z, turn = (before - 2.0 * now + after) / step**2
    needed = np.stack([mass * x, mass * (z + GRAVITY_M_S2), inertia * turn])
    by_each = [(where(start + one) - where(start - one)) / 2e-5 for one in 1e-5 * np.eye(2)]
    found = chain.equations(flight._State(*start, *rates, pivot))
    springs = robot.spring.torque_nm(start[0])
    for (one, other), torque, along, own in zip(
        ((found.leg, found.mixed), (found.mixed, found.foot)), (found.leg_nm, found.foot_nm), by_each, (springs, 0.0),
        strict=True,
    ):  # fmt: skip
        least = 2e-3 * np.abs(needed * along).sum()
        assert one * gains[0] + other * gains[1] - torque == pytest.approx((needed * along).sum() - own, abs=least)
    up = found.up_by_leg * gains[0] + found.up_by_foot * gains[1] + found.up
    assert up == pytest.approx(needed[1].sum(), abs=2e-3 * np.abs(needed[1]).sum())


class Rocking:
    """A foot that the leg's torque lifts off at the nose and, later, presses down again: constant inertias."""

    leg = np.array([0.0, 1.0])
    inertia = np.array([[2.0, 0.6], [0.6, 1.0]])

    def __init__(self) -> None:
        self.seen: list[tuple[float, ...]] = []
        self.pivots: list[str] = []

    def equations(self, state: flight._State) -> flight._Equations:
        self.seen.append(state[:4])
        self.pivots.append(state.pivot.name)
        foot_nm = -0.5 if state.leg_rad < 0.02 else 4.0
        (leg, mixed), (_, foot) = self.inertia
        return flight._Equations(leg, mixed, foot, 1.0, foot_nm, 0.0, 0.0, 1.0)


def test_a_foot_that_comes_down_flat_keeps_the_momentum_of_the_leg() -> None:
    """The ground's blow has no moment about the leg's joint: 2·w + 0.6·v before is 2·w after, and the foot stands."""
    chain, robot = Rocking(), built("kenan-2.0")
    flight._push_off(chain, robot.bodies["foot"].contacts)  # type: ignore[arg-type]
    assert chain.seen[0] == (0.0, 0.0, 0.0, 0.0), "it begins at rest"
    assert chain.pivots[0].endswith("toe"), "the nose lifts off"
    assert "front_eye" in chain.pivots, "whether the toes would lift off is tried too"
    seen = np.array(chain.seen)
    landed = next(i for i in range(1, len(seen)) if seen[i - 1, 1] != 0.0 and seen[i, 1] == 0.0)
    before, after = seen[landed - 1], seen[landed]
    assert before[3] != 0.0
    assert after[3] == 0.0
    assert 2.0 * after[2] == pytest.approx(2.0 * before[2] + 0.6 * before[3], rel=1e-9)


@pytest.mark.parametrize(("foot_nm", "stays", "turned"), [(0.1, "toe", -1.0), (0.5, "front_eye", 1.0)])
def test_the_end_of_the_foot_that_would_need_tension_lifts_off(foot_nm: float, stays: str, turned: float) -> None:
    """The leg's 1 N·m on its inertia of 2 passes 0.3 N·m on: with more a foot lifts its toes, with less its nose."""

    class Tilting(Rocking):
        def equations(self, state: flight._State) -> flight._Equations:
            return super().equations(state)._replace(foot_nm=foot_nm)

    chain = Tilting()
    chain.leg = np.array([0.0, 0.01])
    ends = built("kenan-2.0").bodies["foot"].contacts
    between = [replace(one, name="between", centre_m=share * one.centre_m) for one in ends for share in (0.1, 0.6)]
    lifted = flight._push_off(chain, (*between, *ends, *between))  # type: ignore[arg-type]
    assert lifted.leg_rad >= 0.01
    assert stays in lifted.pivot.name
    assert np.sign(lifted.foot_rad) == turned


def test_a_foot_that_presses_on_both_ends_stays_flat() -> None:
    """On its toes the nose would come down, on its nose the toes: the leg turns by 1 N·m over its own inertia alone."""

    class Standing(Rocking):
        def equations(self, state: flight._State) -> flight._Equations:
            return super().equations(state)._replace(foot_nm=0.5 if "toe" in state.pivot.name else 0.1)

    chain = Standing()
    chain.leg = np.array([0.0, 0.01])
    end = flight._push_off(chain, built("kenan-2.0").bodies["foot"].contacts)  # type: ignore[arg-type]
    assert (end.foot_rad, end.foot_rad_s) == (0.0, 0.0)
    assert end.leg_rad == pytest.approx(end.leg_rad_s**2 / (2.0 * 0.5))


def test_a_robot_that_stays_on_the_ground_stops_with_its_legs_travel() -> None:
    """The ground always pushes: of a travel of 0.03 rad not a step more is taken."""
    chain = Rocking()
    chain.leg = np.array([0.0, 0.03])
    stopped = flight._push_off(chain, built("kenan-2.0").bodies["foot"].contacts)  # type: ignore[arg-type]
    assert 0.03 <= stopped.leg_rad < 0.03 + 1.01 * stopped.leg_rad_s * flight.STEP_S


def test_the_energy_of_a_blow_is_that_of_a_turning_body() -> None:
    assert Blow(takeoff_rad=0.0, stop_rad_s=20.0, inertia_kg_m2=1e-4).energy_j == pytest.approx(0.02)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga"])
def test_springs_that_pull_back_beyond_rest_slow_the_leg(name: str) -> None:
    """By the energy stored up to the stop, ½·K·q²; up to take-off, less than 1° past rest, they are the same."""
    robot, stop = built(name), math.radians(8.0)
    kinds = [replace(robot.spring, one_sided=one_sided) for one_sided in (False, True)]
    slow, quick = (leg_blow(robot.bodies, robot.linkage, spring, stop) for spring in kinds)
    assert (robot.spring.preload_rad, slow.takeoff_rad) == (0.0, pytest.approx(quick.takeoff_rad, abs=1e-3))
    assert slow.takeoff_rad < math.radians(1.0)
    work = 0.5 * robot.spring.stiffness_nm_per_rad * stop**2
    assert quick.energy_j - slow.energy_j == pytest.approx(work, rel=0.02)


@pytest.mark.parametrize("name", ["kenan-1.0", "best-bo"])
def test_between_the_tables_angles_the_equations_go_on_without_a_step(name: str) -> None:
    """Just before an angle of the table and just behind it; midway they are between those of both its neighbours."""
    robot = built(name)
    chain = flight._Chain(robot.bodies, robot.linkage, robot.spring, 0.1)
    toe = robot.bodies["foot"].contacts[1]
    assert (chain.leg[0], chain.leg[-1]) == (-robot.design.compression_rad, 0.1)

    def at(leg_rad: float) -> np.ndarray:
        return np.array(chain.equations(flight._State(leg_rad, 0.02, 9.0, 2.0, toe)))

    number = len(chain.leg) // 3
    before, node, behind = chain.leg[number - 1 : number + 2]
    step = 1e-9
    scale = np.abs(at(node)) + 1e-9
    assert (np.abs(at(node + step) - at(node - step)) < 1e-5 * scale).all()
    for low, high in ((before, node), (node, behind)):
        middle, ends = at((low + high) / 2.0), np.array([at(low + step), at(high - step)])
        assert (np.abs(middle - ends.mean(axis=0)) < 0.02 * scale).all()


def test_between_two_positions_the_chain_is_what_lies_between_them() -> None:
    robot = built("kenan-2.0")
    chain = flight._Chain(robot.bodies, robot.linkage, robot.spring, math.radians(3.0))
    low, high = chain.leg[4:6]
    ends = chain.at(float(low)), chain.at(float(high))
    assert np.abs(ends[1] - ends[0]).max() > 1e-6
    assert chain.at(float(0.75 * low + 0.25 * high)) == pytest.approx(0.75 * ends[0] + 0.25 * ends[1])
