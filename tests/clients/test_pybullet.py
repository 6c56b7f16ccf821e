"""PyBullet reads the URDF as it was written, and the robot that it loads jumps as far as the one in memory."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.clients import Case, same_tensor
from support.loaded import loaded_range_m
from support.places import ROOT

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.exporters.urdf import urdf_files
from jumpcad.files import template_names
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.simulation.simulator import divided
from jumpcad.workshop import load_workshop, own_workshop

pybullet = needs.package("pybullet")


def test_reads_what_was_written(case: Case) -> None:
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=client)
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        number = pybullet.loadURDF(str(case.bundle.urdf), flags=flags, physicsClientId=client)
        joints = [pybullet.getJointInfo(number, link, physicsClientId=client) for link in range(3)]
        links = {-1: "body"} | {info[0]: info[12].decode() for info in joints}
        assert set(links.values()) == set(case.robot.bodies)
        for link, name in links.items():
            body = case.robot.bodies[name]
            mass, _, moments, place, turn = pybullet.getDynamicsInfo(number, link, physicsClientId=client)[:5]
            axes = Rotation.from_quat(turn).as_matrix()
            assert mass == pytest.approx(body.mass_kg, rel=1e-12)
            assert np.allclose(place, body.com_m, rtol=1e-12, atol=1e-18)
            assert same_tensor(axes @ np.diag(moments) @ axes.T, body.inertia_kg_m2)
        for info in joints:
            # PyBullet gives the axis in the principal axes of the child
            turn = pybullet.getDynamicsInfo(number, info[0], physicsClientId=client)[4]
            assert np.allclose(Rotation.from_quat(turn).apply(info[13]), [0, 1, 0], atol=1e-9)
        seen = pybullet.getVisualShapeData(number, physicsClientId=client)
        assert len(seen) == sum(part.quantity for part in case.robot.parts) + len(case.robot.hardware)
    finally:
        pybullet.disconnect(client)


def test_jumps_as_far_as_in_memory(case: Case) -> None:
    here, there = (simulate(robot) for robot in (case.robot, robot_from_urdf(case.bundle.urdf)))
    assert loaded_range_m(case.bundle.urdf) == pytest.approx(here.ballistic_range_m, rel=1e-9)
    assert there.ballistic_range_m == pytest.approx(here.ballistic_range_m, rel=1e-9)
    assert there.touchdown_distance_m == pytest.approx(here.touchdown_distance_m, abs=1e-5)


@pytest.mark.thorough
@pytest.mark.parametrize("name", template_names("robots"))
def test_the_program_of_the_docs_jumps_as_far(name: str, tmp_path: Path) -> None:
    """In a process of its own: it shares nothing with the engine but PyBullet, and the step that the page tells."""
    page = (ROOT / "docs" / "simulators.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```python\n(import json\nimport math\n.*?)assert [^\n]*\n```", page, re.S)
    robot = build(load_design(name), load_workshop(own_workshop(name)), name)
    for path, data in urdf_files(robot):
        (tmp_path / "exports" / name / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "exports" / name / path).write_bytes(data if isinstance(data, bytes) else data.encode())
    step = str(divided(robot, Settings()).dt_s)
    command = [sys.executable, "-c", program.replace("kenan-2.0", name).replace("1 / 2000", step) + "print(range_m)"]
    told = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    there = simulate(robot, engine="pybullet").ballistic_range_m
    assert float(told.split()[-1]) == pytest.approx(there, rel=0.01)
