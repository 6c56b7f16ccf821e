"""Joints that mimic the leg's in ROS: the line through their angles, against numpy's polynomial fit."""

import numpy as np
import pytest

from jumpcad.design import load_design
from jumpcad.exporters.ros2 import mimicked
from jumpcad.mechanism.capsule import capsule_robot


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga"])
def test_dependent_joints_follow_the_leg_by_the_line_of_least_squares(name: str) -> None:
    """The error that the package's README states is the largest one over the travel."""
    robot = capsule_robot(load_design(name))
    leg = np.linspace(-robot.design.compression_rad, 0.0, 500)
    pose = robot.linkage.pose(leg)
    for joint, angle in (("front", pose.front_rad), ("ankle", pose.ankle_rad)):
        slope, offset = np.polyfit(leg, angle, 1)
        mimic = mimicked(robot)[joint]
        assert (mimic.slope, mimic.offset_rad) == pytest.approx((slope, offset), abs=0.005)
        assert np.abs(mimic.slope * leg + mimic.offset_rad - angle).max() == pytest.approx(mimic.error_rad, abs=1e-4)
