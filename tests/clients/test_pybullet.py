"""PyBullet reads the URDF as it was written, and the robot that it loads jumps as far as the one in memory."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built
from support.clients import Case, same_tensor
from support.loaded import loaded_range_m
from support.places import ROOT

from jumpcad.simulation import simulate
from jumpcad.simulation.from_urdf import robot_from_urdf

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
    here = simulate(case.robot).ballistic_range_m
    assert loaded_range_m(case.bundle.urdf) == pytest.approx(here, rel=1e-9)
    assert simulate(robot_from_urdf(case.bundle.urdf)).ballistic_range_m == pytest.approx(here, rel=1e-9)


@pytest.mark.thorough
def test_the_program_of_the_docs_raises_a_tilted_robot_as_high(
    bundle_of: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its body leans by 7° where the springs are released: loaded upright, it rises 13 % too high."""
    page = (ROOT / "docs" / "simulators.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```python\n(import json\n.*?)assert [^\n]*\n```", page, re.S)
    (tmp_path / "exports").mkdir()
    (tmp_path / "exports" / "best-printable").symlink_to(bundle_of("best-printable"))
    monkeypatch.chdir(tmp_path)
    names: dict[str, float] = {}
    exec(program.replace("kenan-2.0", "best-printable"), names)
    rise_m = simulate(built("best-printable")).com_rise_m
    assert names["highest_m"] - names["stood_m"] == pytest.approx(rise_m, rel=0.02)
