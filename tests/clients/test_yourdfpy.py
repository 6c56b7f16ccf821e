"""yourdfpy reads the URDF with its meshes."""

import numpy as np
import pytest
from support.clients import Case, same_tensor

from jumpcad.mechanism.model import BODY, body_poses


def test_masses_axes_and_extents(case: Case) -> None:
    from yourdfpy import URDF

    model = URDF.load(str(case.bundle.urdf))
    assert model.validate()
    for link in model.robot.links:
        body = case.robot.bodies[link.name]
        assert link.inertial.mass == pytest.approx(body.mass_kg, rel=1e-12)
        assert np.allclose(link.inertial.origin[:3, 3], body.com_m, rtol=1e-12, atol=0)
        axes = link.inertial.origin[:3, :3]
        assert same_tensor(axes @ link.inertial.inertia @ axes.T, body.inertia_kg_m2, 1e-12)
    assert all(np.array_equal(joint.axis, [0, 1, 0]) for joint in model.robot.joints)
    standing = model.scene.copy()
    standing.apply_transform(body_poses(case.robot)[BODY])
    assert np.allclose(standing.bounds, case.extents_m, atol=1e-6)
