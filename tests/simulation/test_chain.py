"""Chains of hinges: closed forms of a one-link and of a two-link jumper, the five-bar of another engine, energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from support import needs
from support.places import ROOT

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Body, ContactSphere, Friction, Joint, Loop, Mechanism, Multibody, Spring, Surface
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.robot_file import load_robot

G = 9.81
FRICTION = Friction(2.0, 0.5)
pytestmark = pytest.mark.usefixtures("mujoco_there")


@pytest.fixture
def mujoco_there() -> None:
    needs.package("mujoco")


def body(name: str, mass: float, com_x: float, inertia: float, feet: tuple[float, ...] = ()) -> Body:
    surface: Surface = "foot" if name == "foot" else "body"
    contacts = tuple(ContactSphere(f"{x}", np.array([x, 0.0, 0.0]), 0.001, surface) for x in feet)
    return Body(mass, np.array([com_x, 0.0, 0.0]), inertia * np.eye(3), name, contacts)


def hinge(name: str, parent: str, child: str, x: float, rest_deg: float, loaded_deg: float | None = None) -> Joint:
    rest, loaded = math.radians(rest_deg), None if loaded_deg is None else math.radians(loaded_deg)
    return Joint(name, parent, child, np.array([x, 0.0, 0.0]), rest, -math.inf, math.inf, 0.0, 1.0, loaded_rad=loaded)


def test_one_link_jumper_is_its_closed_form() -> None:
    """A rod swings up on a foot that does not tip, and lifts it by centrifugal force; energy gives its rate."""
    foot, mass, radius, inertia, stiffness, wind = 0.08, 0.01, 0.04, 6e-6, 0.05, 1.2
    whole = inertia + mass * radius**2

    def rate2(angle: float) -> float:
        springs = stiffness * (wind**2 - angle**2)
        return (springs - 2.0 * mass * G * radius * (math.cos(angle) - math.cos(wind))) / whole

    def force(angle: float) -> float:  # from the ground; the rod leans by `angle`
        acceleration = (-stiffness * angle + mass * G * radius * math.sin(angle)) / whole
        vertical = -radius * (math.sin(angle) * acceleration + math.cos(angle) * rate2(angle))
        return (foot + mass) * G + mass * vertical

    leaves = brentq(force, 0.0, wind)
    rod = body("rod", mass, radius, inertia)
    chain = Multibody(
        "one", {"foot": body("foot", foot, 0.0, 1.0, (-0.3, 0.3)), "rod": rod},
        (hinge("pin", "foot", "rod", 0.0, -90.0, -math.degrees(wind)),), (), (Spring("pin", stiffness, 0.0),),
        friction=Friction(50.0, 0.5),
    )  # fmt: skip
    jump = simulate(chain, engine="mujoco")
    speed = mass * radius * math.sqrt(rate2(leaves)) / (foot + mass)
    assert jump.takeoff_speed_m_s == pytest.approx(speed, rel=0.01)
    assert jump.takeoff_angle_deg == pytest.approx(math.degrees(leaves), abs=0.3)


def two_link(link_kg: float, carried: float = 0.02, foot: float = 0.002, stiffness: float = 0.03) -> Multibody:
    """A body on two legs of two links each, loaded from 75° to 20° above the ground; its springs relax at 80°."""
    links = {name: body(name, link_kg, 0.02, link_kg * 1e-4) for name in ("a1", "a2", "b1", "b2")}
    return Multibody(
        "two",
        {"foot": body("foot", foot, 0.0, 1e-6, (-0.02, 0.02)), **links,
         "body": body("body", carried, 0.0, 3e-6, (0.0,))},
        (
            hinge("a", "foot", "a1", 0.0, -105.0, -55.0), hinge("a knee", "a1", "a2", 0.04, 30.0, 110.0),
            hinge("hip", "a2", "body", 0.04, 75.0), hinge("b", "foot", "b1", 0.0, -75.0, 55.0),
            hinge("b knee", "b1", "b2", 0.04, -30.0, -110.0),
        ),
        (Loop("b2", np.array([0.04, 0.0, 0.0]), "body", np.zeros(3)),),
        tuple(Spring(f"{side} knee", stiffness, 0.0, math.radians(free)) for side, free in (("a", -10), ("b", 10))),
        friction=FRICTION,
    )  # fmt: skip


def test_two_link_jumper_is_its_closed_form() -> None:
    """With links of nearly no mass: the foot leaves where the springs, past their rest, pull it up."""
    length, carried, foot, stiffness = 0.04, 0.02, 0.002, 0.03
    rest, loaded = math.radians(80.0), math.radians(20.0)

    def stored(rise: float) -> float:
        return 4.0 * stiffness * (rest - rise) ** 2  # two springs, each turned by 2·(rest - rise)

    def pushes(rise: float) -> float:
        return 4.0 * stiffness * (rest - rise) / (length * math.cos(rise))

    leaves = brentq(lambda rise: pushes(rise) + foot * G, rest, rest + 0.1)
    height = 2.0 * length * (math.sin(leaves) - math.sin(loaded))
    speed = math.sqrt(2.0 * (stored(loaded) - stored(leaves)) / carried - 2.0 * G * height)
    jump = simulate(two_link(1e-6), engine="mujoco")
    assert jump.takeoff_speed_m_s == pytest.approx(carried * speed / (carried + foot), rel=0.003)
    assert jump.takeoff_angle_deg == pytest.approx(90.0, abs=0.5)


def test_energy_is_kept_where_nothing_rubs() -> None:
    """Heavy links, no friction in pins, a foot that cannot slip by symmetry: all that was wound is at take-off."""
    jump = simulate(two_link(1e-3), engine="mujoco")
    assert jump.takeoff_energy_ratio == pytest.approx(1.0, abs=0.003)
    assert sum(jump.energy_account_j.values()) == pytest.approx(jump.spring_energy_j)


def test_a_five_bar_as_a_chain_jumps_like_the_five_bar_in_another_engine() -> None:
    robot = load_robot(ROOT / "examples" / "light_jumper.toml")
    assert isinstance(robot, Mechanism)
    wound = {"leg": -robot.spring.wind_rad}
    joints = tuple(replace(joint, loaded_rad=wound.get(joint.name)) for joint in robot.joints)
    chain = Multibody("five-bar", robot.bodies, joints, robot.loops, robot.springs, friction=robot.friction)
    jump, other = simulate(chain, Settings(flight="simulated", trajectory=True)), simulate(robot, engine="planar")
    assert jump.takeoff_speed_m_s == pytest.approx(other.takeoff_speed_m_s, rel=0.001)
    assert jump.com_rise_m == pytest.approx(other.com_rise_m, rel=0.002)
    assert jump.takeoff_time_s == pytest.approx(other.takeoff_time_s, abs=2e-4)
    assert jump.touchdown_distance_m == pytest.approx(other.touchdown_distance_m, rel=0.003)
    assert jump.turn_deg == pytest.approx(other.turn_deg, rel=0.02)  # nearly five times around
    left = [one.touchdown_pitch_deg - one.turn_deg for one in (jump, other)]  # pitch at take-off, and whole turns
    assert math.remainder(left[0] - left[1], 360.0) == pytest.approx(0.0, abs=1.0)
    assert jump.trajectory.time_s[-1] == pytest.approx(jump.takeoff_time_s + jump.air_time_s)
    assert jump.clears_bar_mm == pytest.approx(other.clears_bar_mm, rel=0.002)


def test_a_dyad_of_no_mass_makes_a_six_bar_that_jumps_alike() -> None:
    """Two more links between body and right shank close a second loop, and change nothing that moves."""
    plain = two_link(1e-3)
    dyad = {name: body(name, 1e-9, 0.015, 1e-13) for name in ("c1", "c2")}
    hinges = (hinge("c", "body", "c1", 0.0, 60.0), hinge("c knee", "c1", "c2", 0.05, 90.0))
    six = replace(
        plain, bodies=plain.bodies | dyad, joints=(*plain.joints, *hinges),
        loops=(*plain.loops, Loop("c2", np.array([0.05, 0.0, 0.0]), "b1", np.array([0.02, 0.0, 0.0]))),
    )  # fmt: skip
    jumps = [simulate(one, engine="mujoco") for one in (plain, six)]
    assert jumps[1].takeoff_speed_m_s == pytest.approx(jumps[0].takeoff_speed_m_s, rel=0.005)


def test_only_mujoco_simulates_a_chain() -> None:
    for engine in ("pybullet", "planar"):
        with pytest.raises(JumpcadError, match=f"--engine {engine}: two is a chain of hinges, which only MuJoCo"):
            simulate(two_link(1e-4), engine=engine)


def test_a_chain_takes_settings_or_refuses_them() -> None:
    """Half the springs' energy; what is not simulated is not left out silently."""
    half = simulate(two_link(1e-3), Settings(spring_efficiency=0.5), "mujoco")
    assert half.spring_energy_j == pytest.approx(0.5 * two_link(1e-3).spring_energy_j)
    with pytest.raises(JumpcadError, match=r"pin_friction = 0.3: a chain of hinges is simulated without it"):
        simulate(two_link(1e-4), Settings(pin_friction=0.3), "mujoco")


def test_a_weak_chain_stays_on_the_ground() -> None:
    assert simulate(two_link(1e-4, stiffness=2e-4), engine="mujoco").verdict == "no_takeoff"
