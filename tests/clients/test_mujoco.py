"""MuJoCo reads MJCF and URDF, and the robot of the MJCF file jumps as far as PyBullet's."""

from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.clients import Case, same_tensor

from jumpcad.simulation import simulate

mujoco = needs.package("mujoco")


def files(case: Case) -> tuple[Path, Path]:
    return case.mjcf, case.bundle.urdf


def test_masses_and_axes(case: Case) -> None:
    for file in files(case):
        model = mujoco.MjModel.from_xml_path(str(file))
        assert model.body_subtreemass[0] == pytest.approx(case.robot.mass_kg, rel=1e-11)
        for name, body in case.robot.bodies.items():
            read = model.body(name)
            axes = np.zeros(9)
            mujoco.mju_quat2Mat(axes, read.iquat)
            axes = axes.reshape(3, 3)
            assert read.mass[0] == pytest.approx(body.mass_kg, rel=1e-11)
            assert np.allclose(read.ipos, body.com_m, rtol=1e-11, atol=1e-12)
            assert same_tensor(axes @ np.diag(read.inertia) @ axes.T, body.inertia_kg_m2)
        for joint in case.robot.joints:
            assert np.array_equal(model.joint(joint.name).axis, [0, 1, 0])


def test_stands_where_it_should(case: Case) -> None:
    model = mujoco.MjModel.from_xml_path(str(case.mjcf))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert np.allclose(data.subtree_com[0], case.com_m, atol=1e-12)
    assert np.allclose(data.site("front_link_loop").xpos, data.site("foot_loop").xpos, atol=1e-12)
    points = []
    for index in range(model.ngeom):
        if model.geom_type[index] == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = int(model.geom_dataid[index])
            start = model.mesh_vertadr[mesh]
            vertices = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
            points.append(vertices @ data.geom_xmat[index].reshape(3, 3).T + data.geom_xpos[index])
    everything = np.concatenate(points)
    assert np.allclose([everything.min(axis=0), everything.max(axis=0)], case.extents_m, atol=1e-6)


def jump_from_file(file: Path) -> float:
    """Return the range of the centre of mass, back to its height at release, of a stepped push-off."""
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
    mujoco.mj_forward(model, data)
    start = data.subtree_com[0].copy()
    mujoco.mj_resetDataKeyframe(model, data, model.nkey - 1)  # `released`, where the robot has a cam
    data.ctrl[:] = 0.0
    mujoco.mj_forward(model, data)
    force, airborne = np.zeros(6), 0
    while airborne * model.opt.timestep < 0.004:
        mujoco.mj_step(model, data)
        pushes = 0.0
        for index in range(data.ncon):
            mujoco.mj_contactForce(model, data, index, force)
            pushes += force[0]
        airborne = airborne + 1 if pushes == 0.0 else 0
        assert data.time < 1.0
    mujoco.mj_forward(model, data)
    mujoco.mj_subtreeVel(model, data)
    here, speed = data.subtree_com[0], data.subtree_linvel[0]
    gravity = -model.opt.gravity[2]
    time = (speed[2] + np.sqrt(speed[2] ** 2 + 2 * gravity * (here[2] - start[2]))) / gravity
    return float(here[0] - start[0] + speed[0] * time)


def test_jumps_as_far_as_in_pybullet(case: Case) -> None:
    needs.package("pybullet")
    there = simulate(case.robot).ballistic_range_m
    assert jump_from_file(case.scene) == pytest.approx(there, rel=0.01)
