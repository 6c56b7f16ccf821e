"""Other springs and other lengths of the same robot."""

from dataclasses import replace

import numpy as np
import pytest

from jumpcad.design import PARAMETERS, Design, limits_of, load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import FOOT, RollerOff
from jumpcad.mechanism.variants import with_length_errors, with_lengths, with_spring_factor


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
