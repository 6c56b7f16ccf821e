"""The five-bar against vectors, identities and the figures of the robot's description."""

import math

import numpy as np
import pytest

from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage, Pose, toe_tip_mm
from jumpcad.transforms import Array

LOWER, UPPER = np.array([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()]).T


def random_linkages(number: int) -> list[Linkage]:
    """Linkages of random designs in the search bounds whose loop closes over the travel."""
    rng = np.random.default_rng(8)
    linkages = (Linkage(Design.from_vector(rng.uniform(LOWER, UPPER))) for _ in range(2 * number))
    closing = [linkage for linkage in linkages if linkage.closing_margin_mm() > 0.5]
    assert len(closing) > number
    return closing[:number]


LINKAGES = [Linkage(load_design(name)) for name in ("kenan-1.0", "best-ga", "best-bo", "kenan-2.0")] + random_linkages(
    30
)


def test_a_linkage_shows_its_lengths() -> None:
    assert repr(Linkage(load_design("kenan-2.0"))) == "<Linkage l1…l4 = 83.3, 100, 100, 83.3 mm>"


def travel(linkage: Linkage, points: int = 25) -> Array:
    return np.linspace(*linkage.travel_rad, points)


def lengths(linkage: Linkage, pose: Pose) -> Array:
    """Measured lengths (n, 3) of main leg, front link and foot."""
    vectors = (
        pose.ankle_mm - linkage.back_pivot_mm,
        pose.front_eye_mm - linkage.front_pivot_mm,
        pose.front_eye_mm - pose.ankle_mm,
    )
    return np.stack([np.linalg.norm(vector, axis=-1) for vector in vectors], axis=-1)


@pytest.mark.parametrize("other_branch", [False, True])
def test_links_keep_their_lengths_on_both_branches(other_branch: bool) -> None:
    for linkage in LINKAGES:
        pose = linkage.pose(travel(linkage), other_branch)
        expected = np.broadcast_to([linkage.l2, linkage.l3, linkage.l4], (25, 3))
        np.testing.assert_allclose(lengths(linkage, pose), expected, rtol=1e-12)


def test_joint_coordinates_point_the_links_where_the_points_are() -> None:
    """Ankle and eye are reached by turning the links one after the other, as in a robot's joint tree."""
    for linkage in LINKAGES:
        pose = linkage.pose(travel(linkage))
        leg = linkage.rest_rad + pose.leg_rad
        foot = leg + linkage.beta_rad - linkage.rest_rad + pose.ankle_rad
        front = linkage.rest_rad + pose.front_rad
        ankle = linkage.back_pivot_mm + linkage.l2 * np.stack([np.cos(leg), -np.sin(leg)], axis=-1)
        by_foot = ankle + linkage.l4 * np.stack([np.cos(foot), -np.sin(foot)], axis=-1)
        by_front = linkage.front_pivot_mm + linkage.l3 * np.stack([np.cos(front), -np.sin(front)], axis=-1)
        np.testing.assert_allclose(by_foot, by_front, atol=1e-9)
        np.testing.assert_allclose(by_foot, pose.front_eye_mm, atol=1e-9)


def test_the_loop_closes_until_foot_and_front_link_lie_in_one_line() -> None:
    """Turned until front pivot and ankle are a ten-thousandth of a millimetre nearer than both links are long."""
    stretched = 0
    for linkage in LINKAGES:
        cosine = (linkage.l1**2 + linkage.l2**2 - (linkage.l3 + linkage.l4 - 1e-4) ** 2) / 2.0 / linkage.l1 / linkage.l2
        if not -0.95 < cosine < 1.0:
            continue  # no turn of the leg stretches both
        turned = math.acos(cosine) - linkage.rest_rad
        pose = linkage.pose([turned])
        assert math.dist(pose.front_eye_mm[0], linkage.front_pivot_mm) == pytest.approx(linkage.l3)
        with pytest.raises(CannotBuildError, match="does not close"):
            linkage.pose([turned + 1e-4])
        stretched += 1
    assert stretched > 10


def test_assembled_pose_has_parallel_legs_and_all_joints_at_zero() -> None:
    for linkage in LINKAGES:
        pose = linkage.pose(0.0)
        for angle in (pose.leg_rad, pose.front_rad, pose.ankle_rad, pose.foot_rad - linkage.beta_rad):
            np.testing.assert_allclose(angle, 0.0, atol=1e-9)


def test_branches_are_continuous_and_mirror_images_in_the_diagonal() -> None:
    for linkage in LINKAGES:
        leg = travel(linkage, 400)
        pose, other = linkage.pose(leg), linkage.pose(leg, other_branch=True)
        chord = linkage.front_pivot_mm - pose.ankle_mm
        middle = (pose.front_eye_mm + other.front_eye_mm) / 2 - pose.ankle_mm
        cross = chord[:, 0] * middle[:, 1] - chord[:, 1] * middle[:, 0]
        np.testing.assert_allclose(cross, 0.0, atol=1e-8)
        steps = np.linalg.norm(np.diff(pose.front_eye_mm, axis=0), axis=1)
        apart = np.linalg.norm(pose.front_eye_mm - other.front_eye_mm, axis=1)
        assert (steps < np.maximum(apart[1:], apart[:-1])).all()


def test_equal_legs_make_a_parallelogram() -> None:
    linkage = Linkage(load_design("kenan-2.0"))
    leg = travel(linkage)
    pose = linkage.pose(leg)
    angle = linkage.rest_rad + leg
    np.testing.assert_allclose(pose.foot_rad, 0.0, atol=1e-9)
    np.testing.assert_allclose(linkage.height_of_body_mm(leg), np.tile(100.0 * np.sin(angle), (2, 1)).T, rtol=1e-9)


def test_freudenstein_equation_holds() -> None:
    """K1·cos(out) - K2·cos(in) + K3 = cos(in - out), with the body as ground (Freudenstein 1955)."""
    for linkage in LINKAGES:
        pose = linkage.pose(travel(linkage))
        driven, driving = linkage.rest_rad + pose.front_rad, linkage.rest_rad + pose.leg_rad
        d, a, b, c = linkage.l1, linkage.l2, linkage.l4, linkage.l3
        k1, k2, k3 = d / a, d / c, (a**2 - b**2 + c**2 + d**2) / (2 * a * c)
        left = k1 * np.cos(driven) - k2 * np.cos(driving) + k3
        np.testing.assert_allclose(left, np.cos(driving - driven), atol=1e-10)


@pytest.mark.parametrize(
    ("name", "height_mm", "ahead_mm"),
    [("best-bo", 29.5, 95.0), ("kenan-2.0", 73.7, 67.0)],
    ids=["best-bo", "kenan-2.0"],
)
def test_loaded_pose_of_the_description(name: str, height_mm: float, ahead_mm: float) -> None:
    linkage = Linkage(load_design(name))
    loaded = -linkage.design.compression_rad
    pose = linkage.pose(loaded)
    assert linkage.height_of_body_mm(loaded) == pytest.approx(height_mm, abs=0.06)
    along = np.array([math.cos(pose.foot_rad[0]), -math.sin(pose.foot_rad[0])])
    assert (pose.ankle_mm[0] - linkage.back_pivot_mm) @ along == pytest.approx(ahead_mm, abs=0.8)


def test_height_of_body_is_the_distance_of_pivots_from_the_foot_line() -> None:
    for linkage in LINKAGES:
        pose = linkage.pose(travel(linkage))
        foot = pose.front_eye_mm - pose.ankle_mm
        for index, pivot in enumerate((linkage.back_pivot_mm, linkage.front_pivot_mm)):
            to_pivot = pivot - pose.ankle_mm
            height = (foot[:, 0] * to_pivot[:, 1] - foot[:, 1] * to_pivot[:, 0]) / np.linalg.norm(foot, axis=1)
            np.testing.assert_allclose(linkage.height_of_body_mm(travel(linkage))[:, index], height, atol=1e-9)


def test_open_loop_is_refused_with_the_angle() -> None:
    design = load_design("kenan-2.0").model_copy(update={"c_coef": 1.2, "d_coef": 0.5, "compression_ratio": 0.9})
    linkage = Linkage(design)
    assert linkage.closing_margin_mm() < 0
    with pytest.raises(CannotBuildError, match=r"does not close with the leg turned by -\d+\.\d° from rest"):
        linkage.pose(travel(linkage))


def test_toes_spread_by_twice_their_angle_behind_the_ankle() -> None:
    """With 60° from the foot's centre line a toe of 93.4 mm reaches 46.7 mm back and 80.9 mm to its side."""
    design = load_design("kenan-2.0").model_copy(update={"ground_link_angle_deg": 60.0})
    np.testing.assert_allclose(toe_tip_mm(design), [-46.7, 80.887], atol=1e-3)


def test_rates_of_the_closed_loop_equal_central_differences() -> None:
    """Foot and front joint per leg angle, and the ankle's way as a complex number with z as its imaginary part."""
    for linkage in LINKAGES:
        step = 1e-6
        for leg in travel(linkage, 5)[1:-1]:
            ahead, behind = linkage.pose(leg + step), linkage.pose(leg - step)
            foot, front, ankle = linkage.rates(leg)
            by_leg = [
                float((getattr(ahead, name) - getattr(behind, name))[0]) / (2 * step)
                for name in ("foot_rad", "front_rad")
            ]
            assert [foot, front] == pytest.approx(by_leg, rel=1e-5, abs=1e-5)
            x, z = (ahead.ankle_mm - behind.ankle_mm)[0] / (2 * step)
            assert ankle == pytest.approx(complex(x, z), rel=1e-5)


def test_the_loop_is_nearest_to_parting_at_an_end_of_the_travel_or_where_the_leg_crosses_the_body() -> None:
    """Of the triangle inequality at a thousand angles, for legs that are loaded beyond the body's line too.

    Upright legs beside a short body, of which one is much shorter, are nearest to it stretched, at rest.
    """
    rng, beyond, stretched = np.random.default_rng(3), 0, 0
    for number, vector in enumerate(rng.uniform(LOWER, UPPER, (80, len(LOWER)))):
        change = {
            "compression_ratio": 0.99,
            "c_coef": rng.uniform(0.95, 1.3),
            "rest_angle_deg": rng.uniform(10.0, 50.0),
        }
        if number % 4 == 3:
            shorter = rng.uniform(0.3, 0.5)
            change = {"compression_ratio": 0.1, "c_coef": 1.0 - shorter, "rest_angle_deg": 85.0, "d_coef": shorter}
        design = Design.from_vector(vector).model_copy(update=change)
        if design.assembly_margin_mm <= 0.0:
            continue
        linkage = Linkage(design)
        diagonal = linkage.diagonal_mm(np.linspace(-design.compression_rad, 0.0, 2001))
        margin = min(diagonal.min() - abs(linkage.l3 - linkage.l4), linkage.l3 + linkage.l4 - diagonal.max())
        assert linkage.closing_margin_mm() == pytest.approx(margin, abs=1e-3)
        beyond += design.compression_rad > linkage.rest_rad + 0.1
        stretched += margin < diagonal.min() - abs(linkage.l3 - linkage.l4)
    assert min(beyond, stretched) > 5
