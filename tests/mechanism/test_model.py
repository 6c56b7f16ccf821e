"""The mechanism's joints, loop and spring against the design's own numbers."""

import math

import numpy as np
import pytest

from jumpcad.design import Design, load_design
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Body, ContactSphere, Mechanism, Spring, five_bar
from jumpcad.mechanism.variants import capsule_robot

NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"]


@pytest.fixture(params=NAMES)
def mechanism(request: pytest.FixtureRequest) -> Mechanism:
    return capsule_robot(load_design(request.param))


def test_joints_are_a_tree_from_the_body_to_the_foot(mechanism: Mechanism) -> None:
    assert [(joint.parent, joint.child) for joint in mechanism.joints] == [
        (BODY, MAIN_LEG), (BODY, FRONT_LINK), (MAIN_LEG, FOOT),
    ]  # fmt: skip
    assert [mechanism.joint(name).name for name in ("leg", "front", "ankle")] == ["leg", "front", "ankle"]
    assert all(joint.velocity_rad_s > 240.0 for joint in mechanism.joints)  # twice those of best-compact
    assert [joint.effort_nm for joint in mechanism.joints[1:]] == [0.0, 0.0]  # nothing drives them


def test_pivots_are_as_far_apart_as_the_links_are_long(mechanism: Mechanism) -> None:
    design = mechanism.design
    leg, front, ankle = (1000.0 * joint.origin_m for joint in mechanism.joints)
    assert np.linalg.norm(front - leg) == pytest.approx(design.l1_mm)
    assert np.linalg.norm(ankle) == pytest.approx(design.l2_mm)
    assert 1000.0 * np.linalg.norm(mechanism.loop.point_a_m) == pytest.approx(design.l3_mm)
    assert 1000.0 * np.linalg.norm(mechanism.loop.point_b_m) == pytest.approx(design.l4_mm)


def test_the_springs_hold_the_designs_energy(mechanism: Mechanism) -> None:
    turn, per_degree = math.degrees(mechanism.design.compression_rad), mechanism.design.stiffness_nmm_per_deg
    assert mechanism.spring.energy_j == pytest.approx(0.5 * per_degree * turn * math.radians(turn) / 1000.0)
    leg = mechanism.joint("leg")
    assert leg.effort_nm == pytest.approx(per_degree * turn / 1000.0)
    assert (leg.lower_rad, leg.upper_rad) == (-mechanism.spring.wind_rad, 0.0)


def test_an_open_loop_gives_its_joints_the_legs_range() -> None:
    design = load_design("kenan-2.0").model_copy(update={"c_coef": 1.2, "d_coef": 0.5, "compression_ratio": 0.9})
    joints, _, _ = five_bar(Linkage(design), (-1.0, 0.0))
    assert {(joint.lower_rad, joint.upper_rad) for joint in joints} == {(-1.0, 0.0)}


def test_the_linkage_is_made_once(mechanism: Mechanism) -> None:
    assert mechanism.linkage is mechanism.linkage
    assert mechanism.linkage.design is mechanism.design
    assert f"{1000.0 * mechanism.mass_kg:.1f} g" in repr(mechanism)


def test_a_joint_that_turns_back_keeps_its_furthest_angle() -> None:
    """Here the front link turns furthest between loaded springs and rest: both ends alone miss 0.13 rad of it."""
    design = Design.from_vector([189.773, 1.18, 0.864, 0.748, 0.655, 60.869, 14.361, 10.146])
    linkage = Linkage(design)
    turn = linkage.pose(np.linspace(-design.compression_rad, 0.0, 1000)).front_rad
    assert turn.min() < min(turn[0], turn[-1]) - 0.13
    _, front, _ = five_bar(linkage, (-design.compression_rad, 0.0))[0]
    assert front.upper_rad == pytest.approx(turn.max(), abs=1e-3)
    assert front.lower_rad == pytest.approx(turn.min(), abs=1e-3)


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_links_turned_by_their_joints_meet_in_the_loop(mechanism: Mechanism, share: float) -> None:
    """From the body, each joint turns its link about y, by its angle in the drawing and then by its coordinate."""
    pose = mechanism.linkage.pose(-share * mechanism.design.compression_rad)
    turns = {"leg": pose.leg_rad[0], "front": pose.front_rad[0], "ankle": pose.ankle_rad[0]}
    placed = {BODY: (np.zeros(2), 0.0)}
    for joint in mechanism.joints:
        (origin, angle), (x, _, z) = placed[joint.parent], joint.origin_m
        cos, sin = math.cos(angle), math.sin(angle)
        assert z == 0.0
        placed[joint.child] = origin + x * np.array([cos, -sin]), angle + joint.rest_angle_rad + turns[joint.name]
    loop, ends = mechanism.loop, []
    for body, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
        origin, angle = placed[body]
        ends.append(origin + point[0] * np.array([math.cos(angle), -math.sin(angle)]))
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-12)
    np.testing.assert_allclose(1000.0 * placed[FOOT][0], pose.ankle_mm[0], atol=1e-9)


@pytest.mark.parametrize("preload_rad", [0.0, 0.2])
@pytest.mark.parametrize("one_sided", [False, True])
def test_the_energy_of_springs_is_their_torque_over_the_angle(preload_rad: float, one_sided: bool) -> None:
    """By integration from any angle to rest; one-sided arms let go where they are free, 0.2 rad beyond it or there."""
    spring = Spring("leg", 1.5, 0.8, preload_rad, one_sided)
    for begin in (-0.8, -0.3, 0.1, 0.5):
        angles = np.linspace(begin, 0.0, 20_001)
        energy = np.trapezoid([spring.torque_nm(float(angle)) for angle in angles], angles)
        assert spring.stored_j(begin) == pytest.approx(float(energy), abs=1e-8)
    assert spring.energy_j == pytest.approx(spring.stored_j(-0.8))
    assert spring.peak_torque_nm == spring.torque_nm(-0.8) == pytest.approx(1.5 * (0.8 + preload_rad))


def test_a_body_with_a_sphere_of_the_foot_rubs_as_the_foot() -> None:
    """Whatever else may touch the ground; one without spheres is as the body is."""
    sole, side = (ContactSphere(name, np.zeros(3), 0.001, name) for name in ("foot", "body"))

    def surface(*contacts: ContactSphere) -> str:
        return Body(0.1, np.zeros(3), np.eye(3), "x", contacts).surface

    assert surface(sole) == surface(sole, side) == surface(side, sole) == "foot"
    assert surface(side) == surface(side, side) == surface() == "body"
