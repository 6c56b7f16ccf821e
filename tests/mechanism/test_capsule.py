"""The capsule robot: handbook tensors, published masses."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule, capsule_robot
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG


def test_capsule_without_length_is_a_ball() -> None:
    ball = capsule(2.0, 0.1, [0.0, 0.0, 0.0], [1e-9, 0.0, 0.0])
    np.testing.assert_allclose(ball.inertia_kg_m2, 0.4 * 2.0 * 0.1**2 * np.eye(3), rtol=1e-6, atol=1e-12)


def test_long_capsule_is_a_rod() -> None:
    rod = capsule(3.0, 1e-6, [0.0, 0.0, 0.0], [0.0, 0.5, 0.0])
    np.testing.assert_allclose(np.diag(rod.inertia_kg_m2), [3 * 0.25 / 12, 0.0, 3 * 0.25 / 12], rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(rod.com_m, [0.0, 0.25, 0.0])


def test_capsule_agrees_with_integration_over_discs() -> None:
    """Volume, ½·r⁴ along and ¼·r⁴ + r²·z² across, summed over thin discs along the axis."""
    start, end, radius, mass = np.array([0.01, 0.02, 0.0]), np.array([0.05, -0.01, 0.03]), 0.008, 0.3
    half = float(np.linalg.norm(end - start)) / 2

    def square(z: float) -> float:
        return radius**2 - max(abs(z) - half, 0.0) ** 2

    def integral(function: Callable[[float], float]) -> float:
        return 2 * (quad(function, 0, half)[0] + quad(function, half, half + radius)[0])

    density = mass / integral(square)
    along = density * integral(lambda z: square(z) ** 2 / 2)
    across = density * integral(lambda z: square(z) ** 2 / 4 + square(z) * z**2)
    ours = capsule(mass, radius, start, end)
    axis = (end - start) / (2 * half)
    assert axis @ ours.inertia_kg_m2 @ axis == pytest.approx(along, rel=1e-9)
    np.testing.assert_allclose(np.linalg.eigvalsh(ours.inertia_kg_m2), sorted([along, across, across]), rtol=1e-9)
    np.testing.assert_allclose(ours.com_m, (start + end) / 2)


def test_masses_are_the_published_ones() -> None:
    design = load_design("kenan-1.0")
    robot = capsule_robot(design)
    radius = design.l_max_mm / 25_000
    per_metre = 1200 * math.pi * radius**2
    assert robot.bodies[BODY].mass_kg == 0.07
    assert robot.bodies[MAIN_LEG].mass_kg == pytest.approx(per_metre * design.l2_mm / 1000)
    assert robot.bodies[FRONT_LINK].mass_kg == pytest.approx(per_metre * design.l3_mm / 1000)
    assert robot.bodies[FOOT].mass_kg == pytest.approx(per_metre * (design.l4_mm + 2 * design.l5_mm) / 1000)


def test_foot_is_symmetric_and_its_toes_spread_by_twice_the_angle() -> None:
    design = load_design("kenan-2.0")
    foot = capsule_robot(design).bodies[FOOT]
    assert foot.com_m[1] == pytest.approx(0.0, abs=1e-15)
    eye, left, right = (contact.centre_m for contact in foot.contacts)
    assert eye[0] == pytest.approx(design.l4_mm / 1000)
    spread = left @ right / np.linalg.norm(left) / np.linalg.norm(right)
    assert math.degrees(math.acos(spread)) == pytest.approx(2 * design.ground_link_angle_deg)
    assert np.linalg.norm(left) == pytest.approx(design.l5_mm / 1000)
    assert left[0] < 0 < left[1]


@pytest.mark.parametrize("name", ["kenan-1.0", "best-bo"])
def test_the_ground_is_a_radius_below_the_feet(name: str) -> None:
    """Capsules have a radius of 1/25 of the longest link, so have the balls at their ends, on which the foot lies."""
    design = load_design(name)
    robot = capsule_robot(design)
    radius = max(design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm) / 25_000
    assert robot.foot_depth_m == pytest.approx(radius)
    balls = [ball for body in robot.bodies.values() for ball in body.contacts]
    assert [ball.radius_m for ball in balls] == pytest.approx(5 * [radius])
    assert {ball.centre_m[2] for ball in balls} == {0.0}
    pivots = [ball.centre_m.tolist() for ball in robot.bodies[BODY].contacts]
    half = design.l1_mm / 2000.0  # the body is the capsule between its pivots
    assert pivots == [pytest.approx([-half, 0.0, 0.0]), pytest.approx([half, 0.0, 0.0])]


def test_joints_have_their_own_ranges() -> None:
    """A parallelogram's front link turns as its main leg does, and its foot keeps the body's direction."""
    robot = capsule_robot(load_design("kenan-2.0"))
    wind = robot.spring.wind_rad
    leg, front, ankle = robot.joints
    assert (leg.lower_rad, leg.upper_rad) == pytest.approx((-wind, 0.0))
    assert (front.lower_rad, front.upper_rad) == pytest.approx((-wind, 0.0))
    assert (ankle.lower_rad, ankle.upper_rad) == pytest.approx((0.0, wind))
