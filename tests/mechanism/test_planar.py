"""Bodies in a plane: momenta of a dumb-bell, and places by the law of cosines."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import body_in_plane, built
from support.each import each

from jumpcad.design import load_design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, FRONT_LINK, MAIN_LEG, Body, Spring, body_poses
from jumpcad.mechanism.planar import (
    ReflectedMass,
    about_common_centre,
    dot,
    leg_inertia_kg_m2,
    points,
    reflected_mass,
    seen_from_foot,
)
from jumpcad.mechanism.variants import capsule_robot


def test_a_dumb_bell_turns_about_its_middle() -> None:
    """Masses of 1 and 3 kg, 4 m apart: 3 m and 1 m from their centre; turning at 2 rad/s clockwise (below x)."""
    mass, inertia, rate = np.array([1.0, 3.0]), np.array([0.1, 0.2]), np.array([2.0, 2.0])
    place = np.array([5.0 + 1.0j, 9.0 + 1.0j])
    drift = 7.0 - 2.0j  # of the centre, which has no momentum about itself
    velocity = drift - 1j * 2.0 * (place - (8.0 + 1.0j))
    momentum, double, whole = about_common_centre(mass, inertia, place, velocity, rate)
    about = 1.0 * 9.0 + 3.0 * 1.0 + 0.3
    assert whole == pytest.approx(about)
    assert momentum == pytest.approx(2.0 * about)
    assert double == pytest.approx(4.0 * about)


def test_vectors_are_complex_numbers() -> None:
    assert points(np.array([[3.0, 4.0], [-1.0, 2.0]])).tolist() == [3.0 + 4.0j, -1.0 + 2.0j]
    assert dot(np.array(3.0 + 4.0j), np.array(-1.0 + 2.0j)) == 5.0


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0"])
@pytest.mark.parametrize("share", [0.0, 0.6, 1.0])
def test_bodies_are_where_the_law_of_cosines_puts_them(share: float, name: str) -> None:
    """Centres of mass, seen from the ankle along the foot: distances and angles of an independent solution.

    The foot of kenan-2.0 never turns; that of kenan-1.0 does.
    """
    robot = built(name)
    wind = share * robot.design.compression_rad
    place, turn = (row[0] for row in seen_from_foot(robot.bodies, robot.linkage, np.array([-wind])))
    foot = body_in_plane(robot, FOOT, wind)
    for name, found, angle in zip(BODY_NAMES, place, turn, strict=True):
        pose = np.linalg.inv(foot) @ body_in_plane(robot, name, wind)
        com = pose @ [*(1000.0 * robot.bodies[name].com_m[[0, 2]]), 1.0]
        assert (1000.0 * found.real, 1000.0 * found.imag) == pytest.approx((com[0], com[1]), abs=1e-6)
        assert math.remainder(angle + math.atan2(pose[1, 0], pose[0, 0]), 2.0 * math.pi) == pytest.approx(0, abs=1e-9)
    (alone,), _ = seen_from_foot(robot.bodies, robot.linkage, np.array([-wind]), (MAIN_LEG,))
    assert alone == pytest.approx(place[BODY_NAMES.index(MAIN_LEG)])


STILL = np.zeros((3, 3))


def bodies(mass_kg: float, com_m: tuple[float, float], inertia: float = 0.0) -> dict[str, Body]:
    """A body alone; its legs have no mass."""
    about_y = np.diag([0.0, inertia, 0.0])
    body = Body(mass_kg, np.array([com_m[0], 0.0, com_m[1]]), about_y, BODY)
    return {BODY: body} | {name: Body(0.0, np.zeros(3), STILL, name) for name in (MAIN_LEG, FRONT_LINK)}


def test_a_parallelogram_carries_its_body_on_a_circle() -> None:
    """kenan-2.0 has parallel legs: its body moves on a circle as large as they are, without turning."""
    design = load_design("kenan-2.0")
    found = reflected_mass(bodies(0.1, (0.01, 0.02), 1e-4), Linkage(design))
    length = design.l2_mm / 1000.0
    # slopes of a table are exact to the square of its step
    assert found.inertia_kg_m2 == pytest.approx(0.1 * length**2, rel=2e-3)
    rise = -0.1 * GRAVITY_M_S2 * length * np.cos(math.radians(design.rest_angle_deg) - found.wind_rad)
    assert found.weight_nm == pytest.approx(rise, abs=2e-4)


@pytest.mark.parametrize("name", [MAIN_LEG, FRONT_LINK])
def test_legs_add_what_turns_about_the_foot(name: str) -> None:
    """Norton, 10.12: a link that turns about a fixed end adds its inertia about that end; its middle rises half."""
    design = load_design("kenan-2.0")
    alone, length = bodies(0.1, (0.0, 0.0)), design.l2_mm / 1000.0
    link = Body(0.02, np.array([length / 2.0, 0.0, 0.0]), np.diag([0.0, 0.02 * length**2 / 12.0, 0.0]), name)
    more, less = (reflected_mass(alone | own, Linkage(design)) for own in ({name: link}, {}))
    assert more.inertia_kg_m2 - less.inertia_kg_m2 == pytest.approx(0.02 * length**2 / 3.0, rel=5e-3)
    rise = -0.02 * GRAVITY_M_S2 * length / 2.0 * np.cos(math.radians(design.rest_angle_deg) - more.wind_rad)
    assert more.weight_nm - less.weight_nm == pytest.approx(rise, abs=2e-5)


@pytest.mark.parametrize("past", [0.0, 0.1])
def test_without_weight_the_leg_is_an_oscillator(past: float) -> None:
    """A quarter of a period, pi/2·sqrt(I/k), and then on at the largest speed, wound·sqrt(k/I)."""
    spring, inertia = Spring("leg", 0.5, 0.7), 8e-4
    wind = np.linspace(0.0, 0.7, 33)
    level = ReflectedMass(wind, np.full(33, inertia), np.zeros(33), np.zeros(33))
    expected = math.pi / 2.0 * math.sqrt(inertia / 0.5) + past / (0.7 * math.sqrt(0.5 / inertia))
    assert level.push_off_s(spring, past) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("preload", [0.0, 0.2, 0.7])
def test_preloaded_springs_push_a_leg_through_a_part_of_their_oscillation(preload: float) -> None:
    """w + p = (w0 + p)·cos(t·sqrt(k/I)) until w = 0, and then on at the speed that the leg has there."""
    spring, inertia, rate = Spring("leg", 0.5, 0.7, preload_rad=preload), 8e-4, math.sqrt(0.5 / 8e-4)
    level = ReflectedMass(np.linspace(0.0, 0.7, 33), np.full(33, inertia), np.zeros(33), np.zeros(33))
    expected = math.acos(preload / (0.7 + preload)) / rate
    speed = rate * math.sqrt((0.7 + preload) ** 2 - preload**2)
    assert level.push_off_s(spring, 0.0) == pytest.approx(expected, rel=2e-3)
    assert level.push_off_s(spring, 0.1) == pytest.approx(expected + 0.1 / speed, rel=2e-3)


@pytest.mark.parametrize("weight_nm", [-0.06, 0.03, 0.09])
def test_a_steady_weight_acts_as_more_or_less_preload(weight_nm: float) -> None:
    """k·(w + p) + W = k·(w + p + W/k): the weight helps where the body rises as the leg is wound."""
    level = ReflectedMass(np.linspace(0.0, 0.7, 33), np.full(33, 8e-4), np.zeros(33), np.full(33, weight_nm))
    bare = replace(level, weight_nm=np.zeros(33))
    spring, other = (Spring("leg", 0.5, 0.7, preload_rad=0.2 + more) for more in (0.0, weight_nm / 0.5))
    assert level.push_off_s(spring, 0.1) == pytest.approx(bare.push_off_s(other, 0.1), rel=1e-9)


@pytest.mark.parametrize("name", ["kenan-1.0", "best-ga"])
def test_the_push_off_takes_as_long_as_one_stepped_in_time(name: str) -> None:
    robot = built(name)
    leg = reflected_mass(robot.bodies, robot.linkage)
    wind, rate, time, step = robot.spring.wind_rad, 0.0, 0.0, 2e-5
    while wind > 0.0:
        inertia, slope, weight = (float(value) for value in leg.at(np.array(wind)))
        rate -= step * (robot.spring.torque_nm(-wind) + weight + 0.5 * slope * rate**2) / inertia
        wind += step * rate
        time += step
    assert leg.push_off_s(robot.spring, 0.0) == pytest.approx(time, rel=0.02)


STEP = 1e-5


@each("name", ["kenan-2.0", "best-ga", "best-printable"])
@each("loaded", [0.0, 0.6])
@each("aside_m", [0.0, 0.013])
def test_it_is_the_least_energy_of_a_robot_that_may_move_as_a_whole(name: str, loaded: float, aside_m: float) -> None:
    """½·I·q̇² is the kinetic energy of the links at momenta of zero: a least-squares problem over drift and spin."""
    robot = capsule_robot(load_design(name))
    aside = np.array([aside_m, 0.0, -0.5 * aside_m])
    bodies = {name: replace(body, com_m=body.com_m + aside) for name, body in robot.bodies.items()}
    robot = replace(robot, bodies=bodies)
    share = STEP / robot.spring.wind_rad
    near, here, far = (body_poses(robot, loaded + sign * share) for sign in (1.0, 0.0, -1.0))
    rows, right = [], []
    for body in robot.bodies.values():
        com = [(poses[body.name] @ [*body.com_m, 1.0])[[0, 2]] for poses in (near, here, far)]
        angle = [np.arctan2(-poses[body.name][2, 0], poses[body.name][0, 0]) for poses in (near, far)]
        mass, inertia = np.sqrt(body.mass_kg), np.sqrt(body.inertia_kg_m2[1, 1])
        x, z = com[1]
        rows += [[mass, 0.0, mass * z], [0.0, mass, -mass * x], [0.0, 0.0, inertia]]
        right += [*(mass * (com[2] - com[0]) / (2 * STEP)), inertia * (angle[1] - angle[0]) / (2 * STEP)]
    _, rest, _, _ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    assert leg_inertia_kg_m2(robot, -loaded * robot.spring.wind_rad) == pytest.approx(float(rest[0]), rel=1e-6)
