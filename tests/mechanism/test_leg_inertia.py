"""The inertia of the leg joint in flight, from poses alone."""

from dataclasses import replace

import numpy as np
import pytest
from support.each import each

from jumpcad.design import load_design
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.mechanism.poses import body_poses
from jumpcad.mechanism.variants import capsule_robot

STEP = 1e-5


@each("name", ["kenan-2.0", "best-ga", "best-printable"])
@each("loaded", [0.0, 0.6])
@each("aside_m", [0.0, 0.013])
def test_it_is_the_least_energy_of_a_robot_that_may_move_as_a_whole(name: str, loaded: float, aside_m: float) -> None:
    """½·I·q̇² is the kinetic energy of the links at momenta of zero: a least-squares problem over drift and spin."""
    robot = capsule_robot(load_design(name))
    aside = np.array([aside_m, 0.0, -0.5 * aside_m])
    bodies = {name: replace(body, com_m=body.com_m + aside) for name, body in robot.bodies.items()}
    robot = replace(robot, bodies=bodies)
    share = STEP / robot.spring.wind_rad
    near, here, far = (body_poses(robot, loaded + sign * share) for sign in (1.0, 0.0, -1.0))
    rows, right = [], []
    for body in robot.bodies.values():
        com = [(poses[body.name] @ [*body.com_m, 1.0])[[0, 2]] for poses in (near, here, far)]
        angle = [np.arctan2(-poses[body.name][2, 0], poses[body.name][0, 0]) for poses in (near, far)]
        mass, inertia = np.sqrt(body.mass_kg), np.sqrt(body.inertia_kg_m2[1, 1])
        x, z = com[1]
        rows += [[mass, 0.0, mass * z], [0.0, mass, -mass * x], [0.0, 0.0, inertia]]
        right += [*(mass * (com[2] - com[0]) / (2 * STEP)), inertia * (angle[1] - angle[0]) / (2 * STEP)]
    _, rest, _, _ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    assert leg_inertia_kg_m2(robot, -loaded * robot.spring.wind_rad) == pytest.approx(float(rest[0]), rel=1e-6)
