"""The parts that are red are those that a violated limit is about."""

import re

from support.built import built, checked, geared

from jumpcad.findings import bare
from jumpcad.scene.visuals import visuals
from jumpcad.studio.wrong_parts import LIMITS_OF, wrong_parts

ELSEWHERE = {
    "foot_clearance", "leg_bar_strength", "leg_socket_strength", "leg_bar_bond", "leg_bar_flex", "front_bar_buckling",
    "toe_bar_strength", "toe_joint_strength", "spring_rate", "idler_axle_strength",
}  # fmt: skip
"""Limits that best-bo has only with other legs, toes, springs, gears."""


def test_every_part_and_limit_exists() -> None:
    parts = {one.mesh_name for robot in (built("best-bo"), geared()) for one in visuals(robot)}
    limits = {one.name for one in checked("best-bo")}
    assert {part for parts in LIMITS_OF for part in parts} <= parts
    named = [limit for limits in LIMITS_OF.values() for limit in limits]
    assert len(named) == len(set(named))
    assert set(named) - ELSEWHERE <= limits


def test_strengths_of_a_robot_have_a_part() -> None:
    named = {limit for limits in LIMITS_OF.values() for limit in limits}
    strengths = {one.name for one in checked("best-bo") if one.unit == "MPa"}
    assert strengths <= named


def test_errors_alone_are_red() -> None:
    weak, strong = bare("leg_axle_strength", "error", -1.0, "MPa"), bare("plate_seat", "info", 1.0, "MPa")
    assert wrong_parts([weak, strong]) == {"leg_axle"}
    assert wrong_parts([]) == set()


def test_a_limit_that_is_named_after_a_part_is_about_it() -> None:
    """Axles, pins and screws by their strength, bearings and roller by their load; gears by their first word."""
    parts = {one.mesh_name for robot in (built("best-bo"), geared()) for one in visuals(robot)}
    named = {}
    for limit in (limit for limits in LIMITS_OF.values() for limit in limits):
        stem, _, what = limit.rpartition("_")
        stem = stem.removeprefix("cam_") if what == "load" else stem
        about = {part for part in parts if re.fullmatch(rf"{stem}(_\d)?", part)}
        if about and what in ("strength", "load"):
            named[limit] = about
    assert {"leg_axle_strength", "roller_screw_strength", "hub_bearing_load", "cam_roller_load"} <= named.keys()
    for limit, about in named.items():
        assert wrong_parts([bare(limit, "error", -1.0, "MPa")]) == about, limit
    for limit in ("gear_strength_1", "gear_mesh_1", "gear_blocked", "cam_gear_room"):
        assert wrong_parts([bare(limit, "error", -1.0, "")]) == {"cam_gear", "motor_pinion"}
