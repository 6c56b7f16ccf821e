"""The order of assembly: every thing on the robot is put on once."""

import math
import re
from collections import Counter
from dataclasses import replace
from functools import lru_cache
from types import SimpleNamespace

import numpy as np
import pytest
from support.built import LONG_TOES, built, geared
from support.built import placed as placed_mesh

from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.mechanism.poses import body_poses
from jumpcad.parts.part import Part
from jumpcad.robot import Robot
from jumpcad.scene.assembly_order import ORDER
from jumpcad.scene.assembly_order.plan import HEX_AXLE, HEX_M3, NUT_M3, Move, Plan, Words
from jumpcad.scene.assembly_steps import REST, SIDES, Step, _texts, assembly_steps, travel
from jumpcad.scene.step_views import step_views
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import pose_about_y, pose_about_z
from jumpcad.workshop import load_workshop


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def test_every_thing_is_put_on_once_and_none_is_left_over(robot: Robot) -> None:
    steps = assembly_steps(robot)
    assert Counter(thing.name for step in steps for thing in step.added) == Counter(
        thing.name for thing in visuals(robot)
    )
    assert all(step.title != REST for step in steps)


RETENTIONS = ({}, {"retention": "clips", "axle": "silver-steel"}, {"retention": "nuts"})
"""Plates keep the axles, or clips in their grooves, or they are screws with nuts."""


@lru_cache
def _retained(retention: str) -> Robot:
    """Return Kenan 2.0 with another retention of its axles."""
    (changed,) = (one for one in RETENTIONS if one.get("retention", "") == retention)
    shop = load_workshop("default")
    bought = shop.bought.model_copy(update=changed)
    return (
        build(load_design("kenan-2.0"), shop.model_copy(update={"bought": bought})) if changed else built("kenan-2.0")
    )


@pytest.mark.parametrize("retention", ["clips", "nuts"])
def test_axles_of_any_kind_are_put_on_once_with_what_keeps_them_each_from_its_end(retention: str) -> None:
    """Hexagons of 2.5 mm in cylinder heads M3 (ISO 4762); clips are at both ends, a nut or split pin at the right."""
    robot = _retained(retention)
    steps = assembly_steps(robot)
    added = [thing for step in steps for thing in step.added]
    assert Counter(thing.name for thing in added) == Counter(thing.name for thing in visuals(robot))
    assert all(step.title != REST for step in steps)
    y = {thing.name: float((thing.T_body_mesh @ np.append(thing.mesh.centroid / 1000.0, 1.0))[1]) for thing in added}
    tools = {r"screw M3 .* ISO 4762": "hex key 2.5 mm", "lock nut M3": "nut driver 5.5 mm", "E-clip": "clip applicator",
             "split pin": "needle-nose pliers"}  # fmt: skip
    seen = Counter[str]()
    for placed in (placed for step in steps for placed in step.placed if not placed.move.brings):
        for thing in placed.things:
            if thing.name == "leg_spring_pin_clip_2":  # it goes in with its pin
                continue
            for article, tool in tools.items():
                if re.match(article, getattr(thing.source, "article", "")):
                    assert placed.move.tool is not None, thing.name
                    assert placed.move.tool.name.startswith(tool), thing.name
                    seen[article] += 1
            end = re.fullmatch(r"(.*(?:axle|pin))_(?:nut|clip_\d|split_pin)", thing.name)
            if end:
                ways = [SIDES[way][1] for way in (placed.move.along, placed.move.reach) if way in SIDES]
                assert all((y[thing.name] - y[end[1]]) * way <= 0.0 for way in ways), thing.name
                seen["at its end"] += any(ways)
    # leg, front and cam axle and the springs' pin; the pins of ankle, front eye and leg have clips or split pins too,
    # and the roller's screw a nut
    assert seen == (
        {"E-clip": 2 * 4 + 2 * 2 + 1, "at its end": 2 * 4 + 2 * 2, "lock nut M3": 1}
        if retention == "clips"
        else {"screw M3 .* ISO 4762": 4, "lock nut M3": 4 + 1, "split pin": 3, "at its end": 4 + 2}
    )


def test_an_assembly_begins_with_its_largest_printed_part(robot: Robot) -> None:
    """Onto which the others are put: by volume, on the bench as in the robot."""
    begun = set()
    for step in assembly_steps(robot):
        if step.onto in begun:
            continue
        begun.add(step.onto)
        printed = [thing for placed in step.placed for thing in placed.things if isinstance(thing.source, Part)]
        assert printed[0] == max(printed, key=lambda thing: thing.mesh.volume), step.key
        assert step.placed[0].things[0] == printed[0], step.key
    assert begun >= {"robot", "leg", "foot", "rest stop", "lower tray", "upper tray", "left plate"}


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
    placed = [thing for step in assembly_steps(robot) for one in step.placed for thing in one.things]
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
    for tool, across_mm in ((HEX_M3, 2.0), (HEX_AXLE, 2.5), (NUT_M3, 5.5)):
        assert f" {across_mm:g} mm" in tool.name
        corners_mm = across_mm / math.cos(math.radians(30.0))
        assert corners_mm - 0.05 < tool.diameter_mm < corners_mm + 3.0, tool.name
    assert HEX_M3.length_mm == 50.0


REFERENCES = {
    "stays out until step {step_arm}": "leg_spring_pin",
    "come onto the foot in step {step_feet}": "toe_left",
    "strapped in for good in step {step_trays}": "Now strap it in",
    "stay free until step {step_left}": "sensor",
    "under the screw's head in step {step_close}": "standoff_1_screw_left",
    "strap it in as in step {step_lower}": "strap_battery",
    "It comes off in step {step_close}": "Pull the strip of tape off the springs' pin",
    "The sensor's check of step {step_left}": "Pressed on the inside, the plunger clicks",
}
"""Where texts refer to other steps, and what is put on or said there."""


def test_steps_that_texts_refer_to_are_those_in_which_it_is_done() -> None:
    def words(*plans: Plan) -> str:
        return " ".join(one.text for plan in plans for one in (*plan.text, *plan.warnings, *plan.checks))

    keys = re.compile(r"\{step_(\w+)\}")
    plans, said = {plan.key: plan for plan in ORDER}, words(*ORDER)
    assert sorted(keys.findall(said)) == sorted(key for text in REFERENCES for key in keys.findall(text))
    for text, done in REFERENCES.items():
        assert said.count(text) == 1, text
        there = plans[keys.findall(text)[0]]
        put = any(re.fullmatch(move.parts, done) for move in there.moves)
        assert put or done in words(there), text


def test_what_no_step_knows_is_not_forgotten(small_robot: Robot) -> None:
    strange = replace(small_robot.hardware[0], name="antenna")
    last = assembly_steps(replace(small_robot, hardware=(*small_robot.hardware, strange)))[-1]
    assert last.title == REST
    assert "antenna" in {thing.name for thing in last.added}


def test_parts_move_to_their_places_from_where_the_step_says(robot: Robot) -> None:
    """Screws go in with their tips ahead: from the wider end of their mesh to the other. Toes come towards the foot."""
    poses, seen = body_poses(robot, 0.0), set()
    for step in assembly_steps(robot):
        for placed in step.placed:
            for thing in placed.things:
                pose = poses[thing.body]
                way = travel(robot, thing, placed.move, pose)
                assert np.linalg.norm(way) == pytest.approx(1.0)
                points = thing.mesh.vertices @ thing.T_body_mesh[:3, :3].T @ pose[:3, :3].T
                along = points @ way
                if placed.move.along == "head last" and "screw" in thing.name:
                    ends = [
                        points[np.abs(along - end) < 1e-4 * max(1.0, np.ptp(along))]
                        for end in (along.min(), along.max())
                    ]
                    behind, ahead = (np.ptp(end - np.outer(end @ way, way), axis=0).max() for end in ends)
                    assert behind > ahead, thing.name
                    seen.add("screw")
                elif placed.move.along == "from outside":
                    middle = (thing.T_body_mesh[:3, :3] @ thing.mesh.centroid + thing.T_body_mesh[:3, 3])[1]
                    assert (pose[:3, :3].T @ way)[1] * middle < 0.0, thing.name
                    seen.add("toe")
                elif placed.move.along == "from the leg":
                    seen.add("stop")
    assert seen == {"screw", "stop"} | ({"toe"} if robot.layout.toes_apart else set())


def test_what_comes_from_a_side_moves_away_from_it() -> None:
    """x forwards, y to the left, z up."""
    towards = {"left": (1, 1.0), "right": (1, -1.0), "above": (2, 1.0), "below": (2, -1.0)}
    towards |= {"the front": (0, 1.0), "behind": (0, -1.0)}
    for words, (axis, sign) in towards.items():
        side = next(way for name, way in SIDES.items() if name in (f"from {words}", f"from the {words}"))
        assert side[axis] == -sign
        assert np.abs(side).sum() == 1.0
    both = SIDES["from the front"] + SIDES["from below"]
    assert SIDES["from the front and below"] == pytest.approx(both / np.linalg.norm(both))
    assert len(SIDES) == len(towards) + 1


def test_each_screw_and_nut_is_turned_by_the_tool_of_its_size(robot: Robot) -> None:
    """Hexagons of 2 mm in M3 (ISO 7380-1), sockets T6 in M2 (ISO 14580), nuts M3 of 5.5 mm (DIN 985)."""
    sizes = {"screw M3": "hex key 2 mm", "screw M2": "screwdriver T6", "lock nut M3": "nut driver 5.5 mm"}
    turned = set()
    for step in assembly_steps(robot):
        for placed in step.placed:
            if placed.move.trial or placed.move.brings:  # only tried, or screwed together before
                continue
            for thing in placed.things:
                for size, tool in sizes.items():
                    if getattr(thing.source, "article", "").startswith(size):
                        assert placed.move.tool is not None, thing.name
                        assert placed.move.tool.name.startswith(tool), thing.name
                        turned.add(size)
    assert turned == set(sizes)


def test_a_nut_comes_from_the_other_side_than_its_screw(robot: Robot) -> None:
    """It moves towards the head of the screw on which it goes; its spanner comes the same way."""
    poses = body_poses(robot, 0.0)
    things = {thing.name: thing for step in assembly_steps(robot) for thing in step.added}

    def y(name: str) -> float:
        thing = things[name]
        return float((thing.T_body_mesh[:3, :3] @ thing.mesh.centroid / 1000.0 + thing.T_body_mesh[:3, 3])[1])

    moves = [placed for step in assembly_steps(robot) for placed in step.placed if placed.move.parts == "roller_nut"]
    assert moves
    for placed in moves:
        (nut,) = placed.things
        way = travel(robot, nut, placed.move, poses[nut.body])
        assert way[1] * (y("roller_screw") - y("roller_nut")) > 0.0
        assert np.allclose(SIDES[placed.move.reach], way)


def test_fasteners_have_their_heads_where_they_come_from_and_bearings_their_own_side(robot: Robot) -> None:
    """Of a screw or pin that comes from the left the wider end is on the left; y is to the left."""
    seen = set()
    for placed in (placed for step in assembly_steps(robot) for placed in step.placed):
        for thing in placed.things:
            side = {"from the left": 1.0, "from the right": -1.0}.get(placed.move.along)
            if side is None or placed.move.brings:
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


def test_warnings_come_as_warnings_and_checks_as_checks(robot: Robot) -> None:
    plans, found = {plan.key: plan for plan in ORDER}, Counter[str]()
    for step in assembly_steps(robot):
        for kind in ("text", "warnings", "checks"):
            ours, planned = getattr(step, kind), [words.text for words in getattr(plans[step.key], kind)]
            assert set(ours) <= set(planned), step.key
            found[kind] += len(ours)
    assert min(found.values()) > 3


def test_what_is_glued_together_is_listed_where_it_is_glued() -> None:
    """Bars come with the ends into which they are glued; the glued front link is put on as one piece."""
    steps = assembly_steps(built("kenan-2.0", leg="carbon-strip-3x6"))
    glued = {
        "main_leg_bar": {"main_leg", "main_leg_end"},
        "front_link_bar": {"front_link_1", "front_link_2"},
    }
    for bar, ends in glued.items():
        (step,) = (step for step in steps if bar in {thing.name for thing in step.added})
        assert ends <= {thing.name for thing in step.added}
        assert any("bar" in text and "glue" in text.lower() for text in step.text)
    (legs,) = (step for step in steps if step.key == "legs")
    assert {"leg", "front link"} <= {placed.move.brings for placed in legs.placed}
    assert "front" not in {step.key for step in assembly_steps(built("kenan-2.0"))}


FIGURES = {
    "after_ms": "stops # ms later", "ankle_pin": "where the toes meet and push # through from the left",
    "arm_n": r"right one's; # N at most|# N where an arm is \{wider\}° wider", "axle_length": "rods .* # mm long",
    "battery_v": "# V at rest", "block": "wood of # mm", "boards_a": r"shows # and \{free_a\} A",
    "boards_ma": "about # mA while the motor stands", "bushing_left": "RIGHT-HAND spring; the bushing of # mm",
    "bushing_right": "Leg axle: the bushing of # mm; over it the LEFT-HAND spring", "cam_left_tube": "tube [(]# mm",
    "cam_tube": "Cam axle: its tube [(]# mm", "cam_turn": "turn, # as seen from the left", "clamp": "above it [(]# mm",
    "contact": "solder them to COM and #", "divider_pin": "ground and #:", "divider_share": ": # of that",
    "divider_v": "of that [(]# V", "dog_play": "from jaw to jaw, by #°", "dry_s": "It winds in about # s and stops",
    "end_play": "moved along by # mm", "energy": "can be loaded: # J", "eye_drill": "drill (or reamer )?of # mm",
    "far": "# m free ahead", "foot_n": "pulled forward; # N", "free": "sensor, # where|unplugged: #; pressed",
    "free_a": "and # A", "free_ma": "# mA while it turns", "free_rpm": "shaft alone turns with about # rpm",
    "front_pin": "lugs of the nose, with #", "front_tubes": "Front axle: .* [(]#", "groove": "groove # mm wide",
    "high": "and # m above", "idler_tube": "Idler axle: its tube [(]# mm", "landing_s": "For # s after",
    "leg_pin": "Drop the pin [(]#", "lift": "over #° of its turn", "min_v": "at least # V", "motor_turn": "must turn #",
    "motor_wire": "motor's two wires first [(]# mm each", "nominal_v": "V at # V", "nutted_screws": "without thread: #",
    "peak_ma": "# mA at most", "pin_hole": "hole in the left plate, # mm wide", "preload": "springs are loaded by #°",
    "preload_n": r"right one's; # N, and \{arm_n|# N each", "press_n": "cut. # N at most", "pressed": "pressed, #",
    "push_ms": "set free within # ms", "range": "it jumps # mm far", "ready_deg": "clicks #° before",
    "release_ms": "let go at once, within # ms|leg falls within # ms", "rise": "and # mm high", "stroke": "it by #°",
    "state_off": "to # V of the multimeter", "strap": "Cut its strap to # mm", "torque_m3": "the washer .*: # N·m",
    "torque_m2": "two screws into the plastic(:|.*and no further:) # N·m", "wider": "#° wider than ordered",
    "torque_plastic": "(for good,|right plate.* from outside:|stubs from outside:) # N·m", "window": "window of # mm",
    "wind_j": "# J; do not connect", "wind_ma": "# mA from the battery on average", "wind_s": "in about # s. Of that",
    "wind_max": "motor that runs for # s and says|turns for # s at most",
}  # fmt: skip
"""What a text says of each figure that it has in braces."""


def test_every_figure_stands_where_its_words_are() -> None:
    texts = [one.text for plan in ORDER for kind in (plan.text, plan.warnings, plan.checks) for one in kind]
    for name, words in FIGURES.items():
        field = f"{{{name}}}"
        said, found = re.compile(words.replace("#", re.escape(field))), [text for text in texts if field in text]
        assert found, name
        for text in found:
            assert text.count(field) == len(said.findall(text)), text


@pytest.mark.parametrize("boss_mm", [0.0, 2.0])
def test_the_springs_pin_leans_on_a_boss_or_on_a_strip_of_tape(boss_mm: float) -> None:
    robot = built("kenan-2.0")
    steps = assembly_steps(replace(robot, layout=replace(robot.layout, spring_boss_mm=boss_mm)))
    words = " ".join(text for step in steps for text in step.text)
    tape = ("adhesive tape from it to the plate", "Pull the strip of tape off the springs' pin")
    found = [text in words for text in ("its boss on the plate holds it", *tape)]
    assert found == [boss_mm > 0.0, boss_mm == 0.0, boss_mm == 0.0]


@pytest.mark.parametrize("retention", ["", "clips", "nuts"])
def test_what_stands_in_open_bores_is_kept_from_falling_through(retention: str) -> None:
    """Tape closes the lower plate's bores where its mesh is open outside; it comes off before screws or clips go on."""
    robot = _retained(retention)
    outside = robot.layout.lateral.right_plate[0] + 0.3
    spot = [[robot.layout.hub_mm[0], outside, robot.layout.hub_mm[1]]]
    is_open = not placed_mesh(robot, "body_plate_right").contains(spot)[0]
    (legs,), (close,) = ([step for step in assembly_steps(robot) if step.key == key] for key in ("legs", "close"))
    (stands,) = (number for number, text in enumerate(legs.text) if text.startswith("Stand the axles"))
    closed = ["stick adhesive tape over those of the right plate, outside" in text for text in legs.text[:stands]]
    opened = [text.startswith("Pull the tape off the right plate's bores") for text in close.text]
    assert sum(closed) == sum(opened) == is_open == bool(retention)


TOLD = {
    "rods of their diameter": "nuts", "stick adhesive tape over those": "clips nuts", "turn the lock nuts on": "nuts",
    "closed bores of both plates hold the axles": "plates geared toes", "a clip into every groove": "clips",
    "their nuts touch the plate": "nuts", "at the springs' pin, the others are covered": "plates geared toes",
    "Idler axle: its tube": "geared", "Then the idler": "geared",
    "Bend the split pins' ends": "plates nuts geared toes",
    "Press the clips into the grooves": "clips", "cross hole points forwards": "plates nuts geared toes",
    "the groove at one end of the pin": "clips", "the groove at the pin's right end": "clips", "Screw the toes": "toes",
    "head is on the left, its split pin": "plates nuts geared toes", "both clips are in their grooves": "clips",
    "The toes, with their pads, come": "toes",
}  # fmt: skip
"""Which of five robots are told what; all, of what has other words for each."""


def test_a_robot_is_told_of_what_it_has_and_of_nothing_else() -> None:
    robots = {"plates": built("kenan-2.0"), "clips": _retained("clips"), "nuts": _retained("nuts"),
              "geared": geared(), "toes": built(LONG_TOES)}  # fmt: skip
    assert [name for name, robot in robots.items() if robot.layout.toes_apart] == ["toes"]
    for name, robot in robots.items():
        steps = assembly_steps(robot)
        said = " ".join(text for step in steps for kind in (step.text, step.warnings, step.checks) for text in kind)
        for words, told in TOLD.items():
            assert said.count(words) == (name in told.split()), (name, words)
        for words in (
            "Left plate and its screws for good",
            "The leg still swings freely",
            "The shaft alone turns with",
        ):
            assert said.count(words) == 1, (name, words)


def test_what_stands_out_of_a_plate_is_put_on_from_outside(robot: Robot) -> None:
    """The sensor with its mount and screws on the left one; what is inside the right one from inside, from its left."""
    poses, seen, lateral = body_poses(robot, 0.0), set(), robot.layout.lateral
    for step in (step for step in assembly_steps(robot) if step.key in ("left", "motor")):
        for placed in (placed for placed in step.placed if placed.move.way != "laid"):
            for thing in placed.things:
                y = (thing.mesh.vertices @ thing.T_body_mesh[:3, :3].T)[:, 1] + 1000.0 * thing.T_body_mesh[1, 3]
                out, inside = y.max() > lateral.left_plate[1] + 0.5, y.min() > lateral.right_plate[0] - 0.01
                if out if step.key == "left" else inside:
                    assert travel(robot, thing, placed.move, poses[thing.body])[1] < -0.99, thing.name
                    seen.add(thing.name)
    assert seen >= {"sensor", "sensor_mount", "sensor_screw_1", "motor", "motor_cap", "cap_screw_1", "standoff_1"}


@pytest.mark.parametrize("name", [LONG_TOES, "kenan-2.0"])
def test_pads_are_put_on_what_is_there(name: str) -> None:
    """From below; under toes that are parts of their own when these are on the foot."""
    robot, poses = built(name), body_poses(built(name))
    put = [(thing.name, placed.move, thing) for step in assembly_steps(robot) for placed in step.placed
           if not placed.move.brings for thing in placed.things]  # fmt: skip
    names = [one for one, *_ in put]
    pads = {f"toe_{side}_pad": f"toe_{side}" if robot.layout.toes_apart else "foot" for side in ("left", "right")}
    pads |= {one: "foot" for one in names if one.startswith("nose_pad")}
    assert len(pads) >= 4
    for pad, under in pads.items():
        assert names.index(under) < names.index(pad)
        _, move, thing = put[names.index(pad)]
        assert travel(robot, thing, move, poses[thing.body])[2] > 0.99, pad


@pytest.mark.parametrize("preload_rad", [0.0, 0.1])
def test_springs_with_a_preload_are_put_on_with_a_screwdriver(preload_rad: float) -> None:
    robot = built("kenan-2.0")
    layout = robot.layout
    drive = replace(layout.drive, spring=replace(layout.drive.spring, preload_rad=preload_rad))
    steps = assembly_steps(replace(robot, layout=replace(layout, drive=drive)))
    words = " ".join(text for step in steps for text in (*step.text, *step.warnings))
    for said, with_preload in (
        ("The springs are loaded by", True), ("On the stop, too, the springs are loaded", True),
        ("An arm may be up to", False),
    ):  # fmt: skip
        assert words.count(said) == (with_preload == (preload_rad > 0.0)), said


@pytest.mark.parametrize(
    ("key", "names", "said", "unsaid"),
    [
        ("foot", ("nose_pad_1",), ("Degrease the soles with alcohol. Cut the pads",), ("Roughen soles",)),
        ("foot", ("nose_pad_1", "printed_nose_pad_1"), ("Roughen soles and printed pads",), ("Cut the pads to size",)),
        ("foot", (), ("Open the eyes of the front link",), ("Degrease", "Roughen", "The toes, with their pads")),
        ("foot", ("front_link_bar",), ("The holes of the foot must let",), ("Open the eyes of the front link",)),
        ("stop", ("printed_stop_pad",), ("Glue the pad into its seat", "The pad is printed"), ()),
        ("stop", (), ("Glue the pad into its seat",), ("The pad is printed",)),
    ],
)
def test_pads_and_eyes_are_made_ready_as_they_are_made(
    key: str, names: tuple[str, ...], said: tuple[str, ...], unsaid: tuple[str, ...]
) -> None:
    """Pads that are cut and pressed on, or printed and glued, feet without; a front link whole or of a bar."""
    (plan,) = (plan for plan in ORDER if plan.key == key)
    words = " ".join(_texts(plan.text, list(names)))
    assert [words.count(one) for one in (*said, *unsaid)] == [1] * len(said) + [0] * len(unsaid)


@pytest.mark.parametrize(
    ("button", "regulator", "readable"),
    [("D9", "", True), ("", "s7v7f5", True), ("D9", "s7v7f5", True), ("", "", False)],
)
def test_the_current_is_read_where_the_battery_alone_feeds_the_driver(
    button: str, regulator: str, readable: bool
) -> None:
    """Without a button USB stays in, and feeds the driver too where no regulator is between."""
    robot, boards = built("kenan-2.0"), load_catalogue().boards
    assert "switch" in {thing.name for thing in visuals(robot)}
    held = robot.layout.electronics
    changed = replace(
        held,
        controller=held.controller.model_copy(update={"button": button}),
        regulator=boards[regulator] if regulator else None,
    )
    steps = assembly_steps(replace(robot, layout=replace(robot.layout, electronics=changed)))
    words = " ".join(text for step in steps for text in (*step.text, *step.checks))
    assert words.count("multimeter on its 10 A range") == words.count("the 10 A range shows") == readable
    assert words.count("reaches the board's button") == bool(button)


@pytest.mark.parametrize(
    ("needs", "lacks", "said"),
    [
        ("", "", True), ("gear_.*", "", True), ("idler", "", False), ("", "idler", True), ("", "gear_.*", False),
        ("gear_1", "idler", True), ("gear_1", "gear_2", False), ("idler", "toe", False), ("gear", "", False),
    ],
)  # fmt: skip
def test_words_are_said_of_a_robot_that_has_what_they_need_and_lacks_what_they_lack(
    needs: str, lacks: str, said: bool
) -> None:
    """Patterns of whole names."""
    assert _texts([Words("so", needs, lacks)], ["gear_1", "gear_2"]) == (("so",) if said else ())


def test_what_is_only_tried_or_brought_from_earlier_steps_is_not_added() -> None:
    def placed(thing: str, brings: str = "", trial: bool = False) -> SimpleNamespace:
        return SimpleNamespace(move=SimpleNamespace(brings=brings, trial=trial), things=(thing,))

    step = SimpleNamespace(placed=[placed("tried", trial=True), placed("brought", brings="gears"), placed("put on")])
    assert Step.added.fget(step) == ("put on",)  # type: ignore[attr-defined]
