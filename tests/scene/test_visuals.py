"""The visible things of a robot: each copy of each part once, where its mass is."""

from collections import Counter

import numpy as np
import pytest

from jumpcad.mechanism.mass import combined
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals


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
