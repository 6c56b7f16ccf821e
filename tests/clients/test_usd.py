"""USD by the converter of the Newton project, from the bundle's MJCF: bodies, articulation, loop, collision shapes."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from support.built import built
from support.clients import run

from jumpcad.mechanism.model import BODY_NAMES

NAME = "kenan-2.0"
RIGID = re.compile(
    r'def(?: Xform)? "(\w+)" \(\s*prepend apiSchemas = \["PhysicsRigidBodyAPI"[^)]*\)\s*\{(.*?)\n\s*\n', re.S
)


@pytest.fixture(scope="module")
def physics(bundle_of: Callable[[str], Path], tmp_path_factory: pytest.TempPathFactory) -> str:
    """The layer of physics, which is text."""
    folder = tmp_path_factory.mktemp("usd")
    run("mujoco_usd_converter", bundle_of(NAME) / "mjcf" / f"{NAME}.xml", folder)
    return (folder / "Payload" / "Physics.usda").read_text(encoding="utf-8")


def numbers(text: str, key: str) -> list[float]:
    """Return the numbers of an attribute."""
    (found,) = re.findall(rf"{key} = \(?([^)\n]*)", text)
    return [float(number) for number in found.split(",")]


def test_bodies_have_mass_centre_and_inertia(physics: str) -> None:
    robot, bodies = built(NAME), dict(RIGID.findall(physics))
    assert set(bodies) == set(BODY_NAMES)
    for name, text in bodies.items():
        body = robot.bodies[name]
        assert numbers(text, "physics:mass") == pytest.approx([body.mass_kg], rel=1e-6)
        assert numbers(text, "physics:centerOfMass") == pytest.approx(body.com_m.tolist(), abs=1e-8)
        principal = np.linalg.eigvalsh(body.inertia_kg_m2)
        assert sorted(numbers(text, "physics:diagonalInertia")) == pytest.approx(principal.tolist(), rel=1e-5)


def test_the_loop_closes_outside_one_articulation(physics: str) -> None:
    assert physics.count('"PhysicsArticulationRootAPI"') == 1
    assert len(re.findall(r"def PhysicsRevoluteJoint ", physics)) == 3
    (loop,) = re.findall(r'def PhysicsSphericalJoint "loop".*?\n\s*\}', physics, re.S)
    assert "physics:excludeFromArticulation = 1" in loop


def test_collision_shapes_and_springs_are_carried_over(physics: str) -> None:
    assert physics.count("PhysicsCollisionAPI") == 9  # four hulls, five spheres
    (springs,) = re.findall(r'def MjcTendon "springs".*?\n\s*\}', physics, re.S)
    assert numbers(springs, "mjc:stiffness") == pytest.approx([built(NAME).spring.stiffness_nm_per_rad], rel=1e-9)
