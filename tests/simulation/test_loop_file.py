"""The file beside a URDF: what is written is read, and what no robot has is rejected."""

import json
from typing import Any

import pytest
from support.each import each
from support.machines import machine, rubbing

from jumpcad.errors import JumpcadError
from jumpcad.exporters.urdf import write_loop
from jumpcad.robot import Robot
from jumpcad.simulation.loop_file import LoopFile


def test_what_is_written_is_what_is_read(kenan: Robot) -> None:
    read = LoopFile.of(json.loads(write_loop(kenan)))
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
        LoopFile.of(json.loads(write_loop(kenan)) | change)


@each(
    ("section", "key", "holds", "refused"),
    [
        ("spring", "rest_rad", [0.0], [-0.1, 0.1]),  # the leg's angle is counted from there
        ("spring", "wind_rad", [0.02, 3.14], [0.0, -0.5, 3.15]),
        ("spring", "preload_rad", [0.0, 3.14], [-0.01, 3.15]),
        ("spring", "stiffness_nm_per_rad", [0.001, 500.0], [0.0, -1.0, 2000.0]),
        ("stop", "angle_rad", [0.0, 3.14], [-0.01, 3.15]),
        ("stop", "stiffness_nm_per_rad", [0.001, 1e5], [0.0, 1e7]),
        ("roller_off", "leg_rad", [0.0, -3.14], [0.01, -3.15]),
        ("roller_off", "leg_rad_s", [0.0, 500.0], [-0.1, 1e5]),  # the springs have begun to open the leg
        ("roller_off", "energy_ratio", [0.01, 1.0], [0.0, 1.02]),  # a cam gives no energy
        ("friction", "foot", [0.001, 2.0], [0.0, 2.1]),
        ("friction", "body", [0.001, 2.0], [0.0, 2.1]),
        ("friction", "pin", [0.0, 2.0], [-0.01, 2.1]),
        ("friction", "pin_radius_m", [[0.0, 0.1, 0.0, 0.1]], [[0.002, 0.002, 0.002, 0.11], [-0.001] * 4]),
    ],
)
def test_each_figure_has_the_range_that_robots_and_workshops_have(
    kenan: Robot, section: str, key: str, holds: list[Any], refused: list[Any]
) -> None:
    """Friction from a thousandth to 2, and in pins from none; angles up to half a turn, each on its own side of 0."""
    written = json.loads(write_loop(rubbing(machine(kenan))))

    def read(value: Any) -> Any:
        again = LoopFile.of(written | {section: written[section] | {key: value}})
        return getattr(getattr(again, section), key)

    assert [read(value) for value in holds] == [tuple(one) if isinstance(one, list) else one for one in holds]
    for value in refused:
        with pytest.raises(JumpcadError, match=rf"{section}\.{key}.* must be"):
            read(value)


def test_a_list_is_no_table(kenan: Robot) -> None:
    with pytest.raises(JumpcadError, match="is not a table of values"):
        LoopFile.of([])
