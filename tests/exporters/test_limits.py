"""The stop, one-sided springs and the released state in every format that can say them."""

import math
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.machines import STOP_RAD, machine, rubbing

from jumpcad.design import load_design
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.from_urdf import robot_from_urdf


@pytest.fixture(scope="module")
def robot() -> Mechanism:
    """Capsules with all that a printed robot has."""
    return rubbing(machine(capsule_robot(load_design("best-bo"))), 0.8, pin=0.25)


def leg(root: ET.Element) -> ET.Element:
    return next(node for node in root.iter("joint") if node.get("name") == "leg")


def test_the_leg_is_limited_at_the_stop(robot: Mechanism) -> None:
    """A quarter turn beyond its travel on the other side, and on both without a stop; URDF and SDF: `test_facts`."""
    lower, upper = map(float, leg(ET.fromstring(write_mjcf(robot))).get("range").split())
    assert (lower, upper) == (robot.joint("leg").lower_rad - math.pi / 2.0, STOP_RAD)
    free = capsule_robot(robot.design)
    assert float(leg(ET.fromstring(write_urdf(free))).find("limit").get("upper")) == math.pi / 2.0
    assert leg(ET.fromstring(write_mjcf(free))).get("range") is None


def test_the_keyframe_moves_as_the_robot_does(robot: Mechanism) -> None:
    """In `released` the loop is closed and the foot flat, both with all their velocities; `wound` stands still."""
    mujoco = needs.package("mujoco")
    model = mujoco.MjModel.from_xml_string(write_mjcf(robot))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("released").id)
    mujoco.mj_forward(model, data)
    for body in ("foot", "front_link"):
        velocity = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, model.site(f"{body}_loop").id, velocity, 0)
        np.testing.assert_allclose(velocity[3:], 0.0, atol=1e-9)
    assert data.joint("leg").qvel[0] == robot.roller_off.leg_rad_s
    assert data.joint("leg").qpos[0] == robot.roller_off.leg_rad
    mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
    assert not data.qvel.any()
    assert data.joint("leg").qpos[0] == -robot.spring.wind_rad
    assert "released" not in write_mjcf(capsule_robot(robot.design))


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_the_urdf_jumps_as_the_robot_in_memory(robot: Mechanism, engine: str, tmp_path: Path) -> None:
    if engine != "planar":
        needs.package(engine)
    path = tmp_path / "r.urdf"
    path.write_text(write_urdf(robot), encoding="utf-8")
    path.with_suffix(".loop.json").write_text(write_loop(robot), encoding="utf-8")
    again = robot_from_urdf(path)
    assert (again.spring, again.stop, again.roller_off, again.friction) == (
        robot.spring, robot.stop, robot.roller_off, robot.friction,
    )  # fmt: skip
    here, there = simulate(robot, Settings(), engine), simulate(again, Settings(), engine)
    assert there.ballistic_range_m == pytest.approx(here.ballistic_range_m, rel=1e-9)
    assert there.release_energy_ratio == pytest.approx(here.release_energy_ratio, rel=1e-9)
