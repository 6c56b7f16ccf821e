"""Other springs and other lengths of the same robot."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from jumpcad.design import PARAMETERS, Design, limits_of, load_design
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, RollerOff
from jumpcad.mechanism.variants import capsule, capsule_robot, with_length_errors, with_lengths, with_spring_factor


def test_energy_goes_with_the_factor() -> None:
    robot = capsule_robot(load_design("kenan-2.0"))
    assert with_spring_factor(robot, 1.0) is robot
    assert with_spring_factor(robot, 0.8).spring.energy_j == pytest.approx(0.8 * robot.spring.energy_j)


def test_the_leg_leaves_the_cam_with_the_same_share_of_another_energy() -> None:
    """½·I·ω² over the springs' energy: four times as stiff, twice as fast."""
    robot = replace(capsule_robot(load_design("kenan-2.0")), roller_off=RollerOff(-0.5, 3.0, 0.98))
    stiff = with_spring_factor(robot, 4.0)
    assert (stiff.roller_off.leg_rad_s, stiff.roller_off.leg_rad) == pytest.approx((6.0, -0.5))
    shares = [one.roller_off.leg_rad_s**2 / one.spring.energy_j for one in (robot, stiff)]
    assert shares[0] == pytest.approx(shares[1])


def test_the_leg_leaves_the_cam_as_far_from_its_loaded_pose_with_other_angles() -> None:
    design = load_design("kenan-2.0")
    other = design.model_copy(update={"compression_ratio": design.compression_ratio + 0.01})
    robot = capsule_robot(design)
    robot = replace(robot, roller_off=RollerOff(0.03 - robot.spring.wind_rad, 3.0, 0.98))
    changed = with_lengths(robot, other)
    assert changed.spring.wind_rad > robot.spring.wind_rad
    assert changed.roller_off.leg_rad + changed.spring.wind_rad == pytest.approx(0.03)


def test_lengths_are_those_of_a_robot_made_with_them() -> None:
    """Joints, loop, travel and contacts of the capsules of another design; only their radius and masses stay."""
    design = load_design("kenan-1.0")
    longer = design.model_copy(update={"c_coef": design.c_coef + 0.004, "d_coef": design.d_coef - 0.003})
    moved, made = with_lengths(capsule_robot(design), longer), capsule_robot(longer)
    assert moved.spring.wind_rad == made.spring.wind_rad
    assert np.allclose(moved.loop.point_b_m, made.loop.point_b_m, atol=1e-15)
    for one, other in zip(moved.joints, made.joints, strict=True):
        assert np.allclose(one.origin_m, other.origin_m, atol=1e-15)
        assert one.rest_angle_rad == other.rest_angle_rad
    for name, body in moved.bodies.items():
        for one, other in zip(body.contacts, made.bodies[name].contacts, strict=True):
            assert np.allclose(one.centre_m, other.centre_m, atol=1e-15)
    assert moved.bodies[FOOT].mass_kg == capsule_robot(design).bodies[FOOT].mass_kg
    assert moved.linkage.l1 == made.linkage.l1


def test_toes_that_are_longer_reach_farther_back() -> None:
    """By their length times the cosine of their angle; the nose stays where it is."""
    design = load_design("kenan-2.0")
    longer = design.model_copy(update={"e_coef": design.e_coef + 0.01})
    robot = capsule_robot(design)
    more = (longer.l5_mm - design.l5_mm) * np.cos(np.radians(design.ground_link_angle_deg)) / 1000.0
    assert more > 5e-4
    for one, other in zip(robot.bodies[FOOT].contacts, with_lengths(robot, longer).bodies[FOOT].contacts, strict=True):
        moved = 0.0 if one.name == "front_eye" else -more
        assert other.centre_m - one.centre_m == pytest.approx([moved, 0.0, 0.0], abs=1e-12)


def test_a_leg_goes_on_into_its_stop_with_the_torque_of_its_own_springs() -> None:
    """Both are of the robot that was built: its stop, and springs that its design does not tell."""
    design = load_design("kenan-2.0")
    robot = capsule_robot(design)
    joints = tuple(replace(one, upper_rad=0.08, effort_nm=0.9) if one.name == "leg" else one for one in robot.joints)
    longer = design.model_copy(update={"c_coef": design.c_coef + 0.004})
    leg = with_lengths(replace(robot, joints=joints), longer).joint("leg")
    assert (leg.lower_rad, leg.upper_rad, leg.effort_nm) == (-longer.compression_rad, 0.08, 0.9)


def test_links_are_longer_by_their_errors_and_nothing_else_changes() -> None:
    design = load_design("kenan-2.0")
    changed = with_length_errors(design, np.array([0.2, -0.1, 0.15, 0.05]))
    found = [changed.l2_mm, changed.l3_mm, changed.l4_mm, changed.l5_mm]
    assert found == pytest.approx([design.l2_mm + 0.2, design.l3_mm - 0.1, design.l4_mm + 0.15, design.l5_mm + 0.05])
    assert changed.to_vector()[4:] == pytest.approx(design.to_vector()[4:])


def test_a_link_that_would_be_longer_than_a_design_may_be_is_as_long_as_it_may_be() -> None:
    """Errors of a print at either end of what a parameter may be: no jump of a scatter fails for them."""
    design = load_design("kenan-2.0")
    for name, end in (("c_coef", 0), ("c_coef", 1), ("e_coef", 0), ("e_coef", 1)):
        values = design.model_dump() | {name: limits_of(name)[end]}
        at_end = Design(**{key: values[key] for key in PARAMETERS})
        outwards = -0.2 if end == 0 else 0.2
        place = 1 if name == "c_coef" else 3
        errors = np.zeros(4)
        errors[place] = outwards
        assert getattr(with_length_errors(at_end, errors), name) == limits_of(name)[end]
        errors[place] = -outwards
        assert getattr(with_length_errors(at_end, errors), name) != limits_of(name)[end]


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
