"""The parts that are red are those that a violated limit is about."""

from support.built import built, checked, geared

from jumpcad.files import read_toml, templates_folder
from jumpcad.scene.visuals import visuals

LIMITS_OF, _ = read_toml(templates_folder() / "texts" / "parts_of_limits.toml")
ELSEWHERE = {
    "foot_clearance", "leg_bar_strength", "leg_socket_strength", "leg_bar_bond", "leg_bar_flex", "front_bar_buckling",
    "toe_bar_strength", "toe_joint_strength", "spring_rate", "idler_axle_strength", "stop_creep",
}  # fmt: skip
"""Limits that best-bo has only with other legs, toes, springs, gears."""


def test_every_part_and_limit_exists() -> None:
    parts = {one.mesh_name for robot in (built("best-bo"), geared()) for one in visuals(robot)}
    limits = {one.name for one in checked("best-bo")}
    assert {part for parts in LIMITS_OF for part in parts.split()} <= parts
    named = [limit for limits in LIMITS_OF.values() for limit in limits]
    assert len(named) == len(set(named))
    assert set(named) - ELSEWHERE <= limits


def test_strengths_of_a_robot_have_a_part() -> None:
    named = {limit for limits in LIMITS_OF.values() for limit in limits}
    strengths = {one.name for one in checked("best-bo") if one.unit == "MPa"}
    assert strengths <= named
