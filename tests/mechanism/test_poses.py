"""Standing robots: feet flat on the ground, the loop closed, whatever the load of the springs."""

import math
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.design import load_design
from jumpcad.mechanism.model import BODY, FOOT, Mechanism, ReleasePose, RollerOff, body_poses, release_pose, standing
from jumpcad.mechanism.variants import capsule_robot

NAMES = ["kenan-2.0", "best-ga", "best-bo", "best-printable"]


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
    assert {*release.joint_rad_s.values(), *release.body_m_s, release.body_rad_s} == {0.0}, "released instantly"
    half, rest = standing(mechanism, 0.5), standing(mechanism, 0.0)
    assert half.joint_rad["leg"] == pytest.approx(-mechanism.spring.wind_rad / 2.0)
    assert rest.joint_rad == pytest.approx({"leg": 0.0, "front": 0.0, "ankle": 0.0}, abs=1e-12)
    assert release.body_position_m[2] < half.body_position_m[2] < rest.body_position_m[2]


def test_the_body_at_rest_is_tilted_by_beta_nose_up() -> None:
    design = load_design("best-ga").model_copy(update={"c_coef": 1.1})
    pose = body_poses(capsule_robot(design))[BODY]
    assert math.asin(pose[2, 0]) == pytest.approx(design.beta_rad)  # how far the body's x axis points upwards


def test_rates_at_release_are_those_of_the_poses(mechanism: Mechanism) -> None:
    """Where the roller leaves: rates of joints and body against poses a little before and after."""
    step, rate = 1e-6, 5.0

    def off(leg_rad: float) -> ReleasePose:
        return release_pose(replace(mechanism, roller_off=RollerOff(leg_rad, rate, 1.0)))

    leg_rad = -0.9 * mechanism.spring.wind_rad
    before, here, after = (off(leg_rad + move) for move in (-step, 0.0, step))
    seconds = 2.0 * step / rate
    assert here.joint_rad["leg"] == leg_rad
    for name, joint_rate in here.joint_rad_s.items():
        assert joint_rate == pytest.approx((after.joint_rad[name] - before.joint_rad[name]) / seconds, rel=1e-6)
    velocity = (after.body_position_m - before.body_position_m) / seconds
    np.testing.assert_allclose(here.body_m_s, velocity, atol=1e-6)
    assert here.body_rad_s == pytest.approx((after.body_pitch_rad - before.body_pitch_rad) / seconds, abs=1e-6)
