"""What the tests of the simulation share: rows of the table of reference flights, and a robot without symmetry."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.robot import Robot


@dataclass(frozen=True)
class Flight:
    """One row of the table of reference flights."""

    name: str
    verdict: str
    robot: Robot
    values: dict[str, float]


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
