"""The file beside a URDF: what is written is read, and what no robot has is rejected."""

import json
from typing import Any

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.exporters.urdf import write_loop
from jumpcad.robot import Robot
from jumpcad.simulation.loop_file import LoopFile


def test_what_is_written_is_what_is_read(kenan: Robot) -> None:
    read = LoopFile(**json.loads(write_loop(kenan)))
    assert read.spring.stiffness_nm_per_rad == kenan.spring.stiffness_nm_per_rad
    assert read.spring.wind_rad == kenan.spring.wind_rad
    assert (read.spring.one_sided, read.spring.preload_rad) == (kenan.spring.one_sided, kenan.spring.preload_rad)
    assert {read.loop.body_a, read.loop.body_b} == {kenan.loop.body_a, kenan.loop.body_b}
    assert read.loop.point_a_m == pytest.approx(kenan.loop.point_a_m)
    assert read.foot_depth_m == kenan.foot_depth_m
    assert set(read.travel_rad) == {joint.name for joint in kenan.joints}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"foot_depth_m": 0.0}, "foot_depth_m = 0.0: must be at least 1e-05"),
        ({"foot_depth_m": 2.0}, "foot_depth_m = 2.0: must be at most 1"),
        ({"travel_rad": {"leg": [0.0, 1.0]}}, "travel_rad"),
        ({"surfaces": {"toe": "ice"}}, "surfaces.toe = 'ice': must be 'foot' or 'body'"),
        ({"wings": 2}, "wings: unknown key"),
    ],
)
def test_what_no_robot_has_is_refused(kenan: Robot, change: dict[str, Any], message: str) -> None:
    with pytest.raises(JumpcadError, match=message):
        LoopFile(**json.loads(write_loop(kenan)) | change)
