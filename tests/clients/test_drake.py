"""Drake reads the URDF with a free base."""

import numpy as np
import pytest
from support import needs
from support.clients import Case, same_tensor

from jumpcad.mechanism.model import BODY, body_poses

needs.package("pydrake")


def test_masses_centre_and_axes(case: Case) -> None:
    from pydrake.math import RigidTransform
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.0)
    (number,) = Parser(plant).AddModels(str(case.bundle.urdf))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    robot = case.robot
    assert plant.CalcTotalMass(context, [number]) == pytest.approx(robot.mass_kg, rel=1e-12)
    for name, body in robot.bodies.items():
        inertia = plant.GetBodyByName(name).CalcSpatialInertiaInBodyFrame(context)
        assert inertia.get_mass() == pytest.approx(body.mass_kg, rel=1e-12)
        assert np.allclose(inertia.get_com(), body.com_m, rtol=1e-12, atol=1e-18)
        central = inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
        assert same_tensor(central, body.inertia_kg_m2)
    for joint in robot.joints:
        assert np.array_equal(plant.GetJointByName(joint.name).revolute_axis(), [0, 1, 0])
    plant.SetFreeBodyPose(context, plant.GetBodyByName(BODY), RigidTransform(body_poses(robot)[BODY]))
    assert np.allclose(plant.CalcCenterOfMassPositionInWorld(context), case.com_m, atol=1e-12)
