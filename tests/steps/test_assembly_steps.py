"""The order of assembly: every thing on the robot is put on once."""

import math
import re
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.built import LONG_TOES, built

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.steps.assembly_steps import REST, SIDES, TOOLS, Move, assembly_steps, travel
from jumpcad.steps.step_views import step_views
from jumpcad.transforms import pose_about_y, pose_about_z
from jumpcad.workshop import load_workshop
from jumpcad.workshop.varied import varied


def put_on(robot: Robot) -> list[tuple[str, Move, Visual]]:
    """Return the keys of the steps, their moves and what is moved, in order."""
    steps = assembly_steps(robot)
    return [(step.key, placed.move, thing) for step in steps for placed in step.placed for thing in placed.things]


def middle_y(thing: Visual) -> float:
    """Return where a thing's middle lies on its body, to the left (m)."""
    return float((thing.T_body_mesh @ np.append(thing.mesh.centroid / 1000.0, 1.0))[1])


def test_every_thing_is_put_on_once_and_none_is_left_over(robot: Robot) -> None:
    steps = assembly_steps(robot)
    assert Counter(thing.name for step in steps for thing in step.added) == Counter(
        thing.name for thing in visuals(robot)
    )
    assert all(step.title != REST for step in steps)


@pytest.mark.parametrize("retention", ["clips", "nuts"])
def test_axles_of_any_kind_are_put_on_once_with_what_keeps_them_each_from_its_end(retention: str) -> None:
    """Hexagons of 2.5 mm in cylinder heads M3 (ISO 4762); clips are at both ends, a nut or split pin at the right."""
    bought = {"bought.retention": retention} | ({"bought.axle": "silver-steel"} if retention == "clips" else {})
    robot = build(load_design("kenan-2.0"), varied(load_workshop(), bought))
    test_every_thing_is_put_on_once_and_none_is_left_over(robot)
    y = {thing.name: middle_y(thing) for thing in visuals(robot)}
    tools = {r"screw M3 .* ISO 4762": "hex key 2.5 mm", "lock nut M3": "nut driver 5.5 mm", "E-clip": "clip applicator",
             "split pin": "needle-nose pliers"}  # fmt: skip
    seen = Counter[str]()
    for _, move, thing in put_on(robot):
        if move.brings or thing.name == "leg_spring_pin_clip_2":  # it goes in with its pin
            continue
        for article, tool in tools.items():
            if re.match(article, getattr(thing.source, "article", "")):
                assert move.tool is not None, thing.name
                assert move.tool.name.startswith(tool), thing.name
                seen[article] += 1
        if end := re.fullmatch(r"(.*(?:axle|pin))_(?:nut|clip_\d|split_pin)", thing.name):
            ways = [SIDES[way][1] for way in (move.along, move.reach) if way in SIDES]
            assert all((y[thing.name] - y[end[1]]) * way <= 0.0 for way in ways), thing.name
            seen["at its end"] += any(ways)
    # leg, front and cam axle and the springs' pin; the pins of ankle, front eye and leg have clips or split pins too,
    # and the roller's screw a nut
    assert seen == (
        {"E-clip": 2 * 4 + 2 * 2 + 1, "at its end": 2 * 4 + 2 * 2, "lock nut M3": 1}
        if retention == "clips"
        else {"screw M3 .* ISO 4762": 4, "lock nut M3": 4 + 1, "split pin": 3, "at its end": 4 + 2}
    )


@pytest.mark.parametrize(
    "there",
    [
        ("spring_bushing_right", "main_leg", "spring_bushing_left"), ("spring_right", "main_leg", "spring_left"),
        ("front_spacer_right", "front_link", "front_spacer_left"), ("main_leg", "roller_washer", "roller"),
        ("cam_spacer_right", "cam", "cam_gear", "cam_spacer_left"),
    ],
)  # fmt: skip
def test_what_is_put_on_an_axle_lies_farther_left_than_what_was_there_before(
    robot: Robot, there: tuple[str, ...]
) -> None:
    """The robot lies on its right plate meanwhile, and the leg has its roller on the left."""
    placed = [thing for *_, thing in put_on(robot)]
    on_it = [thing for thing in placed if thing.name in there]
    if "roller" not in there:  # the last time: links are put on with what was put on them
        on_it = [thing for index, thing in enumerate(on_it) if thing not in on_it[index + 1 :]]
    y = [float((one.T_body_mesh @ np.append(one.mesh.bounds.mean(axis=0) / 1000.0, 1.0))[1]) for one in on_it]
    assert y[: len(there)] == sorted(y[: len(there)])
    assert [thing.name for thing in on_it][: len(there)] == [name for name in there if name in {t.name for t in placed}]


def test_the_springs_pin_of_the_leg_is_drawn_before_the_plate_through_whose_hole_it_goes(robot: Robot) -> None:
    """On the left of the left plate, which is there before; nothing else goes through a part."""
    (arm,) = step_views(robot)["arm"][:1]
    at = next(k for k, thing in enumerate(arm.things) if thing.name == "leg_spring_pin")
    low = (arm.things[at].mesh.bounds / 1000.0 @ arm.poses[at][:3, :3].T + arm.poses[at][:3, 3])[:, 1].min()
    assert low > robot.layout.lateral.left_plate[1] / 1000.0


def test_a_key_needs_the_room_of_its_hexagon_and_a_nut_driver_that_of_a_nut() -> None:
    """Across corners, the width across flats over cos 30°; long arms of keys of 2 mm have 50 mm (ISO 2936)."""
    for tool, across_mm in (("hex_m3", 2.0), ("hex_axle", 2.5), ("nut_m3", 5.5)):
        tool = TOOLS[tool]
        assert f" {across_mm:g} mm" in tool.name
        corners_mm = across_mm / math.cos(math.radians(30.0))
        assert corners_mm - 0.05 < tool.diameter_mm < corners_mm + 3.0, tool.name
    assert TOOLS["hex_m3"].length_mm == 50.0


def test_what_no_step_knows_is_not_forgotten(small_robot: Robot) -> None:
    strange = replace(small_robot.hardware[0], name="antenna")
    last = assembly_steps(replace(small_robot, hardware=(*small_robot.hardware, strange)))[-1]
    assert last.title == REST
    assert "antenna" in {thing.name for thing in last.added}


def test_parts_move_to_their_places_from_where_the_step_says(robot: Robot) -> None:
    """Screws go in with their tips ahead: from the wider end of their mesh to the other. Toes come towards the foot."""
    poses, seen = body_poses(robot, 0.0), set()
    for _, move, thing in put_on(robot):
        pose = poses[thing.body]
        way = travel(robot, thing, move, pose)
        assert np.linalg.norm(way) == pytest.approx(1.0)
        points = thing.mesh.vertices @ thing.T_body_mesh[:3, :3].T @ pose[:3, :3].T
        along = points @ way
        if move.along == "head last" and "screw" in thing.name:
            near = 1e-4 * max(1.0, np.ptp(along))
            ends = [points[np.abs(along - end) < near] for end in (along.min(), along.max())]
            behind, ahead = (np.ptp(end - np.outer(end @ way, way), axis=0).max() for end in ends)
            assert behind > ahead, thing.name
            seen.add("screw")
        elif move.along == "from outside":
            assert (pose[:3, :3].T @ way)[1] * middle_y(thing) < 0.0, thing.name
            seen.add("toe")
        elif move.along == "from the leg":
            seen.add("stop")
    assert seen == {"screw", "stop"} | ({"toe"} if robot.layout.toes_apart else set())


def test_each_screw_and_nut_is_turned_by_the_tool_of_its_size(robot: Robot) -> None:
    """Hexagons of 2 mm in M3 (ISO 7380-1), sockets T6 in M2 (ISO 14580), nuts M3 of 5.5 mm (DIN 985)."""
    sizes = {"screw M3": "hex key 2 mm", "screw M2": "screwdriver T6", "lock nut M3": "nut driver 5.5 mm"}
    turned = set()
    for _, move, thing in put_on(robot):
        for size, tool in sizes.items():
            if move.trial or move.brings or not getattr(thing.source, "article", "").startswith(size):
                continue  # only tried, or screwed together before
            assert move.tool is not None, thing.name
            assert move.tool.name.startswith(tool), thing.name
            turned.add(size)
    assert turned == set(sizes)


def test_a_nut_comes_from_the_other_side_than_its_screw(robot: Robot) -> None:
    """It moves towards the head of the screw on which it goes; its spanner comes the same way."""
    poses = body_poses(robot, 0.0)
    y = {thing.name: middle_y(thing) for thing in visuals(robot)}
    moves = [(move, thing) for _, move, thing in put_on(robot) if move.parts == "roller_nut"]
    assert moves
    for move, nut in moves:
        way = travel(robot, nut, move, poses[nut.body])
        assert way[1] * (y["roller_screw"] - y["roller_nut"]) > 0.0
        assert np.allclose(SIDES[move.reach], way)


def test_fasteners_have_their_heads_where_they_come_from_and_bearings_their_own_side(robot: Robot) -> None:
    """Of a screw or pin that comes from the left the wider end is on the left; y is to the left."""
    seen = set()
    for _, move, thing in put_on(robot):
        side = {"from the left": 1.0, "from the right": -1.0}.get(move.along)
        if side is None or move.brings:
            continue
        points = thing.mesh.vertices @ thing.T_body_mesh[:3, :3].T + 1000.0 * thing.T_body_mesh[:3, 3]
        ends = [points[np.abs(points[:, 1] - y) < 1e-3] for y in (points[:, 1].min(), points[:, 1].max())]
        low, high = (np.ptp(end, axis=0).max() for end in ends)
        if re.search("screw|_pin$", thing.name) and abs(high - low) > 0.01:
            assert (high - low) * side > 0.0, thing.name
            seen.add(thing.name)
        if thing.name.startswith("hub_bearing"):
            assert points[:, 1].mean() * side > 0.0, thing.name
    assert {"roller_screw", "cap_screw_1", "standoff_1_screw_left", "standoff_1_screw_right", "ankle_pin"} <= seen


@pytest.mark.parametrize(("name", "way"), [("toe_left", 1.0), ("toe_right", -1.0)])
def test_toes_come_along_their_own_width(name: str, way: float) -> None:
    """A toe is drawn along its own x, its width along y; the foot may be turned, and the toe in it."""
    turned, foot = pose_about_y(0.4, (0.0, 0.0)), pose_about_z(-0.7)
    thing = SimpleNamespace(name=name, T_body_mesh=foot)
    found = travel(built("kenan-2.0"), thing, Move("toe_left", "from outside"), turned)  # type: ignore[arg-type]
    np.testing.assert_allclose(found, way * turned[:3, :3] @ np.array([math.sin(0.7), math.cos(0.7), 0.0]), atol=1e-12)
    with pytest.raises(ValueError, match="no direction from nowhere"):
        travel(built("kenan-2.0"), thing, Move("toe_left", "from nowhere"), turned)  # type: ignore[arg-type]


def test_what_is_laid_on_a_tray_comes_square_to_it() -> None:
    """Straight down in the world, a battery would hit the stops of a tray that stands inclined with its robot."""
    turned = pose_about_y(0.4, (0.0, 0.0))
    found = travel(built("kenan-2.0"), SimpleNamespace(name="battery"), Move("battery", "from above"), turned)  # type: ignore[arg-type]
    np.testing.assert_allclose(turned[:3, :3].T @ found, [0.0, 0.0, -1.0], atol=1e-12)


def test_what_is_glued_together_is_listed_where_it_is_glued() -> None:
    """Bars come with the ends into which they are glued; the glued front link is put on as one piece."""
    steps = assembly_steps(built("kenan-2.0", leg="carbon-strip-3x6"))
    glued = {"main_leg_bar": {"main_leg", "main_leg_end"}, "front_link_bar": {"front_link_1", "front_link_2"}}
    for bar, ends in glued.items():
        (step,) = (step for step in steps if bar in {thing.name for thing in step.added})
        assert ends <= {thing.name for thing in step.added}
        (legs,) = (step for step in steps if step.key == "legs")
    assert {"leg", "front link"} <= {placed.move.brings for placed in legs.placed}
    assert "front" not in {step.key for step in assembly_steps(built("kenan-2.0"))}


def test_what_stands_out_of_a_plate_is_put_on_from_outside(robot: Robot) -> None:
    """The sensor with its mount and screws on the left one; what is inside the right one from inside, from its left."""
    poses, seen, lateral = body_poses(robot, 0.0), set(), robot.layout.lateral
    for key, move, thing in put_on(robot):
        if key not in ("left", "motor") or move.way == "laid":
            continue
        y = (thing.mesh.vertices @ thing.T_body_mesh[:3, :3].T)[:, 1] + 1000.0 * thing.T_body_mesh[1, 3]
        out, inside = y.max() > lateral.left_plate[1] + 0.5, y.min() > lateral.right_plate[0] - 0.01
        if out if key == "left" else inside:
            assert travel(robot, thing, move, poses[thing.body])[1] < -0.99, thing.name
            seen.add(thing.name)
    assert seen >= {"sensor", "sensor_mount", "sensor_screw_1", "motor", "motor_cap", "cap_screw_1", "standoff_1"}


@pytest.mark.parametrize("name", [LONG_TOES, "kenan-2.0"])
def test_pads_are_put_on_what_is_there(name: str) -> None:
    """From below; under toes that are parts of their own when these are on the foot."""
    robot, poses = built(name), body_poses(built(name))
    put = [(thing.name, move, thing) for _, move, thing in put_on(robot) if not move.brings]
    names = [one for one, *_ in put]
    pads = {f"toe_{side}_pad": f"toe_{side}" if robot.layout.toes_apart else "foot" for side in ("left", "right")}
    pads |= {one: "foot" for one in names if one.startswith("nose_pad")}
    assert len(pads) >= 4
    for pad, under in pads.items():
        assert names.index(under) < names.index(pad)
        _, move, thing = put[names.index(pad)]
        assert travel(robot, thing, move, poses[thing.body])[2] > 0.99, pad
