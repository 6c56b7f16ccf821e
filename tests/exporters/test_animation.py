"""The jump in a GLB file, read back by pygltflib: the robot stands, flies a parabola, and comes down."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built

from jumpcad.bundle.motion import jump_motion
from jumpcad.exporters.animation import animated
from jumpcad.exporters.glb import write_glb
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.mechanism.poses import body_poses

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
