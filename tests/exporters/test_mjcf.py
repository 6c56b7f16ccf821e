"""MJCF: the model that MuJoCo compiles is the robot."""

import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from support import needs
from support.built import built

from jumpcad.design import load_design
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.mechanism.model import FOOT, body_poses
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.settings import Settings


def whole(robot: Robot) -> str:
    """Return the model for simulations by others without what is seen, whose meshes are files."""
    return write_robot(robot, visuals(robot), looks=False)


@pytest.mark.parametrize("dt_s", [0.0005, 0.002])
def test_contacts_and_the_loop_are_as_stiff_as_mujoco_allows(dt_s: float) -> None:
    """Its time constants are at least two of its steps ("solref", XML reference), here a quarter of the settings'."""
    root = ET.fromstring(write_mjcf(capsule_robot(load_design("kenan-2.0")), Settings(dt_s=dt_s)))
    option = root.find("option")
    assert option is not None
    step = float(option.attrib["timestep"])
    assert step == pytest.approx(dt_s / 4.0)
    soft = np.array([node.attrib["solref"].split() for node in root.iter() if "solref" in node.attrib], dtype=float)
    assert len(soft) > 2
    assert all("solref" in node.attrib for tag in ("connect", "pair") for node in root.iter(tag))
    assert soft == pytest.approx(np.tile([2.0 * step, 1.0], (len(soft), 1)))


def test_the_stop_is_as_stiff_as_the_robots() -> None:
    """A time constant T and a damping ratio of 1 are the stiffness I/T² ("solver parameters", MuJoCo's modeling)."""
    robot = built("kenan-2.0")
    assert robot.stop is not None
    root = ET.fromstring(write_mjcf(robot))
    (leg,) = (node for node in root.iter("joint") if node.get("name") == robot.spring.joint)
    time_s, ratio = map(float, leg.attrib["solreflimit"].split())
    inertia = leg_inertia_kg_m2(robot, robot.stop.angle_rad)
    assert inertia / time_s**2 == pytest.approx(robot.stop.stiffness_nm_per_rad, rel=1e-6)
    assert ratio == 1.0


def test_mujoco_slides_spins_and_rolls_as_the_settings_say() -> None:
    """A pair's friction is twice sliding, then spinning, then twice rolling (MuJoCo's XML reference).

    All of them are the ground's times another: of foot or body in sliding.
    """
    mujoco, robot = needs.package("mujoco"), capsule_robot(load_design("kenan-2.0"))
    settings = Settings(
        ground_friction=0.8, foot_friction=0.9, body_friction=0.4, rolling_friction_m=0.001, spinning_friction_m=0.003
    )
    model = mujoco.MjModel.from_xml_string(write_mjcf(robot, settings))
    assert set(model.pair_dim) == {6}
    assert len(model.pair_friction) == sum(len(body.contacts) for body in robot.bodies.values())
    for row, geom in zip(model.pair_friction.tolist(), model.pair_geom2, strict=True):
        name = model.body(model.geom_bodyid[geom]).name
        assert row[:2] == pytest.approx([0.8 * (0.9 if name == FOOT else 0.4)] * 2), name
        assert row[2:] == pytest.approx([0.8 * 0.003, 0.8 * 0.001, 0.8 * 0.001])


def test_spheres_lie_where_the_robot_touches_the_ground_and_touch_it_alone() -> None:
    """Each is paired with the floor; without pairs nothing would touch anything."""
    mujoco, robot = needs.package("mujoco"), built("kenan-2.0")
    model = mujoco.MjModel.from_xml_string(write_mjcf(robot))
    ground, spheres = model.geom("ground"), []
    assert mujoco.mjtGeom(int(ground.type[0])) == mujoco.mjtGeom.mjGEOM_PLANE
    for name, body in robot.bodies.items():
        for contact in body.contacts:
            sphere = model.geom(f"{name}_{contact.name}_contact")
            assert mujoco.mjtGeom(int(sphere.type[0])) == mujoco.mjtGeom.mjGEOM_SPHERE
            assert model.body(sphere.bodyid[0]).name == name
            assert sphere.pos == pytest.approx(contact.centre_m, abs=1e-9)
            assert sphere.size[0] == pytest.approx(contact.radius_m)
            spheres.append(sphere.id)
    assert sorted(spheres) == sorted(set(range(model.ngeom)) - {ground.id})
    pairs = list(zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True))
    assert sorted(pairs) == sorted((ground.id, sphere) for sphere in spheres)
    assert not np.any(model.geom_contype[:, None] & model.geom_conaffinity)


@pytest.mark.parametrize("write", [write_mjcf, whole])
@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0"])
def test_as_it_is_loaded_the_robot_stands_on_the_ground_at_rest(write: Callable[[Robot], str], name: str) -> None:
    """Without a key frame, every body is where its pose at rest has it; Kenan 1.0 stands with its body leaning."""
    mujoco, robot = needs.package("mujoco"), built(name)
    model = mujoco.MjModel.from_xml_string(write(robot))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for name, pose in body_poses(robot).items():
        np.testing.assert_allclose(data.body(name).xpos, pose[:3, 3], atol=1e-7)
        np.testing.assert_allclose(data.body(name).xmat.reshape(3, 3), pose[:3, :3], atol=1e-6)
    lowest = min(
        data.body(name).xpos[2] + (data.body(name).xmat.reshape(3, 3) @ contact.centre_m)[2] - contact.radius_m
        for name, body in robot.bodies.items()
        for contact in body.contacts
    )
    assert lowest == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("one_sided", [True, False])
def test_springs_push_by_hooke_from_where_they_are_relaxed(one_sided: bool) -> None:
    """MuJoCo's own passive torque on the leg, on both sides of there; springs that only push are slack beyond."""
    mujoco, robot = needs.package("mujoco"), capsule_robot(load_design("kenan-2.0"))
    for preload_rad in (0.0, 0.1):
        spring = replace(robot.spring, one_sided=one_sided, preload_rad=preload_rad)
        model = mujoco.MjModel.from_xml_string(write_mjcf(replace(robot, springs=(spring,))))
        data, at = mujoco.MjData(model), model.joint("leg")
        for angle in (-0.8, -0.1, 0.0, 0.06, 0.2, 1.0):
            mujoco.mj_resetData(model, data)
            data.qpos[at.qposadr[0]] = angle
            mujoco.mj_forward(model, data)
            hooke = spring.stiffness_nm_per_rad * (preload_rad - angle)
            expected = max(hooke, 0.0) if one_sided else hooke
            assert data.qfrc_passive[at.dofadr[0]] == pytest.approx(expected, abs=1e-12), (preload_rad, angle)
