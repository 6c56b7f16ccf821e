"""The visible things of a robot: each copy of each part once, where its mass is."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.mechanism.mass import combined
from jumpcad.robot import Robot
from jumpcad.scene.visuals import BOUGHT_COLOURS, PRINTED_COLOURS, STEEL, visuals
from jumpcad.solids.tube import DrawnWire


def test_each_copy_is_seen_once_under_a_name_of_its_own(small_robot: Robot) -> None:
    seen = visuals(small_robot)
    assert len({thing.name for thing in seen}) == len(seen)
    count = Counter(thing.mesh_name for thing in seen)
    assert count == {
        **{part.name: part.quantity for part in small_robot.parts},
        **{item.name: 1 for item in small_robot.hardware},
    }
    assert {thing.name for thing in seen if thing.mesh_name == "ring"} == {f"ring_{n}" for n in range(1, 5)}


@pytest.mark.parametrize("body", ["body", "main_leg", "foot", "front_link"])
def test_things_are_seen_where_the_body_has_its_mass(small_robot: Robot, body: str) -> None:
    things = [thing for thing in visuals(small_robot) if thing.body == body]
    whole = combined([
        thing.source.mass.placed(thing.T_body_mesh) if hasattr(thing.source, "placements") else thing.source.mass
        for thing in things
    ])  # fmt: skip
    assert whole.mass_kg == pytest.approx(small_robot.bodies[body].mass_kg)
    assert whole.com_m == pytest.approx(small_robot.bodies[body].com_m, abs=1e-9)
    points = np.concatenate([
        thing.mesh.vertices / 1000.0 @ thing.T_body_mesh[:3, :3].T + thing.T_body_mesh[:3, 3] for thing in things
    ])  # fmt: skip
    assert (points.min(axis=0) < whole.com_m).all()
    assert (whole.com_m < points.max(axis=0)).all()


def test_colours_tell_roles_and_articles_apart(small_robot: Robot) -> None:
    strange = replace(small_robot.hardware[0], name="antenna", article="whip")
    colours = {
        thing.name: thing.colour for thing in visuals(replace(small_robot, hardware=(*small_robot.hardware, strange)))
    }
    assert colours["main_leg"] == colours["foot"] == PRINTED_COLOURS["links"] != colours["body_plate_left"]
    assert colours["battery"] == BOUGHT_COLOURS["battery"]
    assert colours["roller"] == BOUGHT_COLOURS["bearing"]
    assert colours["antenna"] == STEEL


def test_what_is_bent_of_wire_has_the_wire_s_shape_and_all_else_its_own(small_robot: Robot) -> None:
    wire = DrawnWire(np.array([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0], [5.0, 15.0, 0.0]]), 1.2)
    bent, *others = small_robot.hardware
    shapes = {one.name: one.shape for one in visuals(replace(small_robot, hardware=(bent.seen_as(wire), *others)))}
    assert shapes[bent.name] is wire
    assert all(shapes[one.name] is one.shape for one in others)
    assert all(shapes[part.name] is part.drawing.shape for part in small_robot.parts if part.quantity == 1)
