"""GLB read back by trimesh: what is where, in which colour."""

import io

import numpy as np
import pytest
import trimesh

from jumpcad.exporters.glb import linear_light, write_glb
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals


def test_glb_holds_named_coloured_parts_on_posable_bodies_in_metres_y_up(kenan: Robot) -> None:
    glb = write_glb(kenan)
    scene = trimesh.load_scene(io.BytesIO(glb), file_type="glb")
    things = visuals(kenan)
    parents = scene.graph.transforms.parents
    assert {thing.name: parents[thing.name] for thing in things} == {
        thing.name: f"{thing.body}_frame" for thing in things
    }
    poses, points = body_poses(kenan), []
    for thing in things:
        pose = poses[thing.body] @ thing.T_body_mesh
        points.append(thing.mesh.vertices / 1000.0 @ pose[:3, :3].T + pose[:3, 3])
        x, y, z = pose[:3, 3]
        assert np.allclose(scene.graph.get(thing.name)[0][:3, 3], [x, z, -y], atol=1e-6)
        colour = scene.geometry[thing.mesh_name].visual.material.baseColorFactor[:3] / 255.0
        assert np.allclose(colour, [linear_light(part) for part in thing.colour], atol=0.5 / 255)
    low, high = np.concatenate(points).min(axis=0), np.concatenate(points).max(axis=0)
    assert np.allclose(scene.bounds, [[low[0], low[2], -high[1]], [high[0], high[2], -low[1]]], atol=1e-6)
    assert glb == write_glb(kenan)


def test_colours_are_linear_light() -> None:
    """IEC 61966-2-1: half of the code value is 21.4 % of the light, dark ones are in proportion, and the ends stay."""
    assert linear_light(0.5) == pytest.approx(0.214041, abs=1e-6)
    assert [linear_light(part) for part in (0.0, 1.0)] == [0.0, 1.0]
    assert linear_light(0.04045) == pytest.approx(0.0031308, rel=1e-4)
    assert [linear_light(part) for part in (0.05, 0.2, 0.4)] == pytest.approx([0.003936, 0.033105, 0.132868], abs=1e-6)
    assert linear_light(0.02) == pytest.approx(0.02 / 12.92)
