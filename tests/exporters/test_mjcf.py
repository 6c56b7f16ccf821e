"""MJCF: the model that MuJoCo compiles is the robot."""

import subprocess
import sys

import numpy as np
import pytest
from support.flights import make_lopsided

from jumpcad.design import load_design
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY_NAMES


def test_a_simulation_loads_no_format_but_its_own() -> None:
    others = {"ezdxf", "jumpcad.robot", "jumpcad.scene.visuals"}
    code = f"import sys, jumpcad.exporters.mjcf; print({others} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_mujoco_has_the_robots_inertia() -> None:
    lopsided = make_lopsided(capsule_robot(load_design("kenan-2.0")))
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_string(write_mjcf(lopsided))
    for name in BODY_NAMES:
        compiled, body, axes = model.body(name), lopsided.bodies[name], np.zeros(9)
        mujoco.mju_quat2Mat(axes, compiled.iquat)
        tensor = axes.reshape(3, 3) @ np.diag(compiled.inertia) @ axes.reshape(3, 3).T
        assert compiled.mass[0] == pytest.approx(body.mass_kg, rel=1e-12)
        np.testing.assert_allclose(compiled.ipos, body.com_m, rtol=1e-12)
        np.testing.assert_allclose(tensor, body.inertia_kg_m2, rtol=1e-9, atol=1e-15)
