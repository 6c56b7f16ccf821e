"""Bundles for independent programs: those of all templates, and one made of a few parts, asymmetric on purpose."""

import pytest
from support.clients import Case
from support.robots import make_small_robot

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.design import load_design

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo")


@pytest.fixture(scope="session", params=["lopsided", *TEMPLATES])
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Case:
    """A robot with its bundle."""
    name = request.param
    robot = build(load_design(name), name=name) if name in TEMPLATES else make_small_robot("kenan-2.0")
    return Case(robot, export(robot, tmp_path_factory.mktemp("bundles") / robot.name, pictures=False))
