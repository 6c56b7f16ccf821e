"""The visible things of a robot: each copy of each part once, where its mass is."""

from collections import Counter

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.mechanism.mass import combined
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Piece, _corners_m, extent_m, seen, surface, visuals
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import in_metres


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


BIG, SMALL = rectangle((20.0, 20.0)), rectangle((10.0, 8.0))


def corners(piece: Piece) -> np.ndarray:
    vertices, triangles = piece
    return vertices[triangles]


def area_mm2(piece: Piece) -> float:
    a, b, c = corners(piece).swapaxes(0, 1)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


def volume_mm3(piece: Piece) -> float:
    """By the divergence theorem: right only if every triangle's front is outside."""
    a, b, c = corners(piece).swapaxes(0, 1)
    return float((a * np.cross(b, c)).sum() / 6.0)


@pytest.mark.parametrize(
    ("stack", "area", "volume"),
    [
        (Stack.of([(0.0, 2.0, BIG)]), 2 * 400 + 2 * 80, 800),
        (Stack.of([(0.0, 2.0, BIG), (2.0, 5.0, SMALL)]), 2 * 400 + 2 * 80 + 3 * 36, 800 + 240),  # a smaller one on top
        (Stack.of([(0.0, 2.0, SMALL), (2.0, 5.0, BIG)]), 2 * 400 + 3 * 80 + 2 * 36, 160 + 1200),  # it hangs over
        (Stack.of([(0.0, 2.0, BIG), (3.0, 5.0, SMALL)]), 2 * 400 + 2 * 80 + 2 * 80 + 2 * 36, 800 + 160),  # apart
        (Stack.of([(0.0, 2.0, BIG - SMALL)]), 2 * 320 + 2 * 80 + 2 * 36, 640),  # a hole
        (Stack.of([(0.0, 5.0, BIG)]).pocketed([(1.0, 4.0, SMALL)]), 2 * 400 + 5 * 80 + 2 * 80 + 3 * 36, 2000 - 240),
    ],
    ids=["box", "step", "overhang", "apart", "hole", "closed pocket"],
)
def test_only_what_lies_bare_is_there_and_faces_outwards(stack: Stack, area: float, volume: float) -> None:
    assert area_mm2(surface(stack)) == pytest.approx(area)
    assert volume_mm3(surface(stack)) == pytest.approx(volume)


def test_a_robots_parts_look_as_their_closed_solids(small_robot: Robot) -> None:
    """Within what outlines 0.02 mm off make of the smallest part, 2 mm thick."""
    for one in visuals(small_robot):
        if isinstance(one.shape, DrawnWire):
            continue
        solid, piece = one.shape.solid(), seen(one)
        assert [*piece[0].min(axis=0), *piece[0].max(axis=0)] == pytest.approx(solid.bounding_box(), abs=0.05)
        assert area_mm2(piece) == pytest.approx(solid.surface_area(), rel=0.02)
        assert volume_mm3(piece) == pytest.approx(solid.volume(), rel=0.02)


def test_the_extent_is_that_of_everything_on_the_robot() -> None:
    robot = built("kenan-2.0")
    poses = body_poses(robot)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for one in visuals(robot):
        pose = poses[one.body] @ one.T_body_mesh
        points = one.mesh.vertices / 1000.0 @ pose[:3, :3].T + pose[:3, 3]
        low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
    assert extent_m(robot) == pytest.approx(high - low, abs=2e-5)


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (30.0, 20.0, 10.0), (-140.0, 65.0, 200.0)])
def test_a_prism_turned_anyhow_has_the_box_of_its_mesh(turn: tuple[float, float, float]) -> None:
    """Of a part of several outlines the box contains the mesh."""
    robot, pose = built("kenan-2.0"), np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", turn, degrees=True).as_matrix()
    pose[:3, 3] = [40.0, -70.0, 25.0]
    exact = 0
    for part in robot.parts:
        points = part.mesh.vertices @ pose[:3, :3].T + pose[:3, 3]
        low, high = 1000.0 * _corners_m(part.shape, in_metres(pose))
        assert (low <= points.min(axis=0) + 0.02).all(), part.name
        assert (high >= points.max(axis=0) - 0.02).all(), part.name
        exact += np.allclose([low, high], [points.min(axis=0), points.max(axis=0)], atol=0.02)
    assert exact >= 3
