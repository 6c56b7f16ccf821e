"""Pinocchio reads the URDF with a free base."""

import numpy as np
import pytest
from support import needs
from support.clients import Case, same_tensor

from jumpcad.mechanism.model import BODY, body_poses

pinocchio = needs.package("pinocchio")


def test_masses_centre_and_axes(case: Case) -> None:
    model = pinocchio.buildModelFromUrdf(str(case.bundle.urdf), pinocchio.JointModelFreeFlyer())
    robot = case.robot
    assert pinocchio.computeTotalMass(model) == pytest.approx(robot.mass_kg, rel=1e-12)
    carried = {BODY: model.inertias[1]} | {j.child: model.inertias[model.getJointId(j.name)] for j in robot.joints}
    for name, inertia in carried.items():
        body = robot.bodies[name]
        assert inertia.mass == pytest.approx(body.mass_kg, rel=1e-12)
        assert np.allclose(inertia.lever, body.com_m, rtol=1e-12, atol=1e-18)
        assert same_tensor(inertia.inertia, body.inertia_kg_m2)
    for joint in robot.joints:
        assert model.joints[model.getJointId(joint.name)].shortname() == "JointModelRY"
    data = model.createData()
    base = pinocchio.SE3(body_poses(robot)[BODY])
    position = np.concatenate([pinocchio.SE3ToXYZQUAT(base), np.zeros(3)])
    assert np.allclose(pinocchio.centerOfMass(model, data, position), case.com_m, atol=1e-12)
