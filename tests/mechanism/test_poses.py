"""Standing robots: feet flat on the ground, the loop closed, whatever the load of the springs."""

import math

import numpy as np
import pytest

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY, FOOT, Mechanism
from jumpcad.mechanism.poses import body_poses, release_pose, standing

NAMES = ["kenan-2.0", "best-ga", "best-bo"]


@pytest.fixture(params=NAMES)
def mechanism(request: pytest.FixtureRequest) -> Mechanism:
    return capsule_robot(load_design(request.param))


@pytest.mark.parametrize("loaded", [0.0, 0.3, 1.0])
def test_the_foot_lies_flat_with_the_ankle_above_the_origin(mechanism: Mechanism, loaded: float) -> None:
    foot = body_poses(mechanism, loaded)[FOOT]
    np.testing.assert_allclose(foot[:3, :3], np.eye(3), atol=1e-12)
    np.testing.assert_allclose(foot[:3, 3], [0.0, 0.0, mechanism.foot_depth_m], atol=1e-12)


@pytest.mark.parametrize("loaded", [0.0, 0.5, 1.0])
def test_the_loop_is_closed(mechanism: Mechanism, loaded: float) -> None:
    poses, loop = body_poses(mechanism, loaded), mechanism.loop
    ends = [poses[loop.body_a] @ [*loop.point_a_m, 1.0], poses[loop.body_b] @ [*loop.point_b_m, 1.0]]
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-12)


def test_release_is_where_the_springs_are_fully_loaded(mechanism: Mechanism) -> None:
    release = release_pose(mechanism)
    assert release.joint_rad["leg"] == -mechanism.spring.wind_rad
    half, rest = standing(mechanism, 0.5), standing(mechanism, 0.0)
    assert half.joint_rad["leg"] == pytest.approx(-mechanism.spring.wind_rad / 2.0)
    assert rest.joint_rad == pytest.approx({"leg": 0.0, "front": 0.0, "ankle": 0.0}, abs=1e-12)
    assert release.body_position_m[2] < half.body_position_m[2] < rest.body_position_m[2]


def test_the_body_at_rest_is_tilted_by_beta_nose_up() -> None:
    design = load_design("best-ga").model_copy(update={"c_coef": 1.1})
    pose = body_poses(capsule_robot(design))[BODY]
    assert math.asin(pose[2, 0]) == pytest.approx(design.beta_rad)  # how far the body's x axis points upwards
