"""What the tests of the simulation share: rows of the table of reference flights, and a robot without symmetry."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.mechanism.model import BODY, Mechanism
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array


@dataclass(frozen=True)
class Flight:
    """One row of the table of reference flights."""

    name: str
    verdict: str
    robot: Robot
    values: dict[str, float]


def base_distance_m(jump: Jump) -> float:
    """Return how far the body's frame is from where it stood at the end of a recorded flight, as the table has it."""
    assert jump.trajectory is not None
    way = jump.trajectory.position_m[:, jump.trajectory.body_names.index(BODY), 0]
    return float(way[-1] - way[0])


def com_x_m(robot: Mechanism, path: Trajectory) -> Array:
    """Return where the centre of mass is along the way (n,)."""
    bodies = [robot.bodies[name] for name in path.body_names]
    places = [
        path.position_m[:, index, 0] + Rotation.from_quat(path.quaternion_xyzw[:, index]).apply(body.com_m)[:, 0]
        for index, body in enumerate(bodies)
    ]
    return np.average(places, axis=0, weights=[body.mass_kg for body in bodies])


def make_lopsided(robot: Robot) -> Robot:
    """Return a robot with every body's mass moved aside and its tensor turned about an oblique axis."""
    turn = Rotation.from_rotvec([0.3, -0.5, 0.7]).as_matrix()
    bodies = {
        name: replace(
            body,
            com_m=body.com_m + np.array([0.003, 0.001, -0.002]),
            inertia_kg_m2=turn @ (body.inertia_kg_m2 + np.diag([1e-6, 2e-6, 2.5e-6])) @ turn.T,
        )
        for name, body in robot.bodies.items()
    }
    return replace(robot, bodies=bodies)
