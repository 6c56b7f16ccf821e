"""Robots that PyBullet itself loads from URDF files, stepped by the evaluator."""

import math
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.bullet import BulletEngine, BulletWorld
from jumpcad.simulation.bullet_robot import BulletRobot
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.simulation.run import Run


class LoadedRobot(BulletRobot):
    """A robot that PyBullet made from a URDF file; inertial frames are PyBullet's own."""

    urdf: Path

    def _create(self, robot, bodies, release):  # type: ignore[no-untyped-def]
        bullet, client = self.bullet, self.client
        bullet.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=client)
        half = release.body_pitch_rad / 2
        body = bullet.loadURDF(
            str(self.urdf),
            release.body_position_m.tolist(),
            [0.0, math.sin(half), 0.0, math.cos(half)],
            flags=bullet.URDF_USE_INERTIA_FROM_FILE,
            physicsClientId=client,
        )
        info = [bullet.getDynamicsInfo(body, link, physicsClientId=client) for link in range(-1, 3)]
        self._moments = np.array([link[2] for link in info])
        self.axes = Rotation.from_quat([link[4] for link in info]).as_matrix()
        return body


def loaded_range_m(urdf: Path) -> float:
    """Return the ballistic range of a robot that PyBullet loads; its masses, for the centre of mass, are read by us."""
    engine, settings, robot = BulletEngine(), Settings(), robot_from_urdf(urdf)
    loaded = type("Loaded", (LoadedRobot,), {"urdf": urdf})
    with engine._lock:
        engine._prepare(settings, coefficients(robot, settings).ground)
        made = loaded(engine._bullet, engine._client, robot, settings)
        run = Run(BulletWorld(made, engine._ground, robot, settings), robot, settings)
        run.go()
    assert run.takeoff is not None
    return run.takeoff.ballistics.range_m
