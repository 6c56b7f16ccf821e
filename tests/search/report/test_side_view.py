"""The drawn linkage has the design's lengths and angles."""

import math

import numpy as np
import pytest

from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.search.report.side_view import box_mm, joints_mm

DESIGN = Design.from_vector([100.0, 0.9, 0.8, 0.7, 0.6, 50.0, 20.0, 30.0])


def angle(vector):
    return math.atan2(vector[1], vector[0])


@pytest.mark.parametrize("design", [DESIGN, load_design("kenan-2.0"), load_design("best-printable")])
def test_links_have_their_lengths_and_the_foot_is_flat(design):
    for joints in joints_mm(design).values():
        at = {name: np.array(place) for name, place in joints.items()}
        lengths = {
            ("ankle", "back pivot"): design.l2_mm,
            ("front eye", "front pivot"): design.l3_mm,
            ("ankle", "front eye"): design.l4_mm,
            ("back pivot", "front pivot"): design.l1_mm,
            ("toe tip", "ankle"): design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg)),
        }
        for (one, other), length in lengths.items():
            assert np.hypot(*(at[one] - at[other])) == pytest.approx(length, abs=0.15)
        assert [at[name][1] for name in ("toe tip", "ankle", "front eye")] == [0.0] * 3
        assert at["toe tip"][0] < at["ankle"][0] == 0.0 < at["front eye"][0]


def test_legs_are_parallel_at_rest_and_turn_by_the_loaded_angle():
    poses = {name: {point: np.array(at) for point, at in pose.items()} for name, pose in joints_mm(DESIGN).items()}
    rest, loaded = poses["rest"], poses["loaded"]
    front, back = (rest[f"{end} pivot"] - rest[joint] for end, joint in (("front", "front eye"), ("back", "ankle")))
    assert angle(front) == pytest.approx(angle(back), abs=0.003)
    turned = [
        angle(at["front pivot"] - at["back pivot"]) - angle(at["ankle"] - at["back pivot"]) for at in (rest, loaded)
    ]
    assert turned[0] == pytest.approx(math.radians(50.0), abs=0.003)
    assert turned[0] - turned[1] == pytest.approx(DESIGN.compression_rad, abs=0.004)


def test_all_points_of_both_poses_lie_in_the_box():
    designs = [DESIGN, load_design("kenan-2.0")]
    left, low, right, high = box_mm(designs)
    for design in designs:
        for pose in joints_mm(design).values():
            assert all(left < x < right and low < z < high for x, z in pose.values())


def test_a_design_without_a_pose_leaves_the_box_to_others():
    impossible = Design.from_vector([100.0, 1.4, 0.2, 0.7, 0.6, 80.0, 20.0, 30.0])
    with pytest.raises(CannotBuildError, match="no assembled pose"):
        joints_mm(impossible)
    assert box_mm([impossible, DESIGN]) == box_mm([DESIGN])
