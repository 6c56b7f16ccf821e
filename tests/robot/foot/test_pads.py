"""Pads on the meshes: between stop and leg, around the nose, and as large as is cut."""

import re

import numpy as np
import pytest
from support.built import built

from jumpcad.robot.robot import Robot


def points(robot: Robot, name: str) -> np.ndarray:
    item = next(one for one in robot.hardware if one.name == name)
    return item.shown_mesh.copy().apply_transform(item.T_body_part).vertices


def cut_mm(robot: Robot, name: str) -> tuple[float, float]:
    item = next(one for one in robot.hardware if one.name == name)
    return tuple(map(float, re.findall(r"cut ([\d.]+) x ([\d.]+) mm", item.article)[0]))  # type: ignore[return-value]


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_stops_pad_lies_between_its_seat_and_the_leg_at_the_stop(name: str) -> None:
    robot = built(name)
    stop, width = robot.layout.stop, robot.layout.sections.thickness_mm
    found = points(robot, "stop_pad")
    behind = found[:, ::2] @ stop.behind
    assert np.ptp(behind) == pytest.approx(stop.pad.thickness_mm, abs=1e-3)
    assert behind.min() == pytest.approx(float(np.dot(stop.face_mm, stop.behind)), abs=1e-3)
    along = (found[:, ::2] - stop.face_mm) @ np.array([-stop.behind[1], stop.behind[0]])
    assert (along.min(), along.max()) == pytest.approx((-4.0, 4.0), abs=1e-3)  # of 8 mm of strip
    assert (found[:, 1].min(), found[:, 1].max()) == pytest.approx((-width / 2.0, width / 2.0))
    assert cut_mm(robot, "stop_pad") == pytest.approx((width, 8.0), abs=0.051)
