"""GLB read back by trimesh: what is where, in which colour."""

import io

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built

from jumpcad.bundle.motion import jump_motion
from jumpcad.exporters.glb import animated, linear_light, write_glb
from jumpcad.mechanism.model import BODY_NAMES, body_poses
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


pygltflib = needs.package("pygltflib")


class Film:
    """Times (n,) and, by body, places (n, 3) and turns (n) of one animation, in the robot's frame, m."""

    def __init__(self, glb: bytes, name: str) -> None:
        self.file = pygltflib.GLTF2().load_from_bytes(glb)
        self.animation = next(one for one in self.file.animations if one.name == name)
        self.places, self.turns = {}, {}
        for channel in self.animation.channels:
            node = self.file.nodes[channel.target.node]
            assert node.matrix is None
            sampler = self.animation.samplers[channel.sampler]
            self.time_s = self.values(sampler.input, 1)[:, 0]
            body = node.name.removesuffix("_frame")
            if channel.target.path == "translation":
                self.places[body] = self.values(sampler.output, 3)
            else:
                self.quaternions = self.values(sampler.output, 4)
                assert ((self.quaternions[1:] * self.quaternions[:-1]).sum(axis=1) > 0.0).all()
                self.turns[body] = Rotation.from_quat(self.quaternions)

    def values(self, accessor: int, width: int) -> np.ndarray:
        read = self.file.accessors[accessor]
        view = self.file.bufferViews[read.bufferView]
        start = view.byteOffset
        data = self.file.binary_blob()[start : start + view.byteLength]
        return np.frombuffer(data, dtype="<f4").reshape(read.count, width).astype(float)


@pytest.fixture(scope="module")
def glb() -> bytes:
    robot = built("kenan-2.0")
    motion = jump_motion(robot)
    assert motion is not None
    return animated(write_glb(robot), motion)


def test_in_flight_the_centre_of_mass_falls_freely(glb: bytes) -> None:
    robot, film = built("kenan-2.0"), Film(glb, "jump")
    assert set(film.places) == set(film.turns) == set(BODY_NAMES)
    moment = sum(
        body.mass_kg * (film.turns[name].apply(body.com_m) + film.places[name]) for name, body in robot.bodies.items()
    )
    centre, last = moment / robot.mass_kg, 60
    time = film.time_s[-last:] - film.time_s[-last]
    forward, upward = np.polyfit(time, centre[-last:, 0], 1), np.polyfit(time, centre[-last:, 2], 2)
    assert upward[0] == pytest.approx(-9.81 / 2.0, rel=0.005)
    assert np.abs(np.polyval(forward, time) - centre[-last:, 0]).max() < 1e-4
    assert centre[-1, 0] - centre[0, 0] > 0.15


def test_it_starts_where_the_robot_stands_loaded(glb: bytes) -> None:
    robot, film = built("kenan-2.0"), Film(glb, "jump")
    for name, pose in body_poses(robot, 1.0).items():
        assert np.allclose(film.places[name][0], pose[:3, 3], atol=0.001)  # the roller is off the cam by then
        assert (Rotation.from_matrix(pose[:3, :3]).inv() * film.turns[name][0]).magnitude() < 0.01


def test_without_its_motion_the_robot_stands_at_rest(glb: bytes) -> None:
    still, moving = (pygltflib.GLTF2().load_from_bytes(data) for data in (write_glb(built("kenan-2.0")), glb))
    for name in BODY_NAMES:
        before, after = (next(n for n in file.nodes if n.name == f"{name}_frame") for file in (still, moving))
        matrix = np.array(before.matrix or np.eye(4).ravel()).reshape(4, 4).T
        np.testing.assert_allclose(after.translation, matrix[:3, 3], atol=1e-5)
        np.testing.assert_allclose(Rotation.from_quat(after.rotation).as_matrix(), matrix[:3, :3], atol=1e-5)
