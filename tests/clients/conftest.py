"""Bundles for independent programs: of two templates, and of a robot of a few parts, asymmetric on purpose."""

from collections.abc import Callable
from pathlib import Path

import pytest
from support.built import built
from support.clients import Case

from jumpcad.bundle.export import export
from jumpcad.bundle.manifest import open_bundle
from jumpcad.robot.robot import Robot

TEMPLATES = ("kenan-2.0", "best-printable")
ON_BARS = "kenan-2.0 on carbon tubes"
"""Its legs are tubes with printed ends: more parts in a link, and hardware that turns with it."""


@pytest.fixture(scope="session", params=["lopsided", *TEMPLATES, ON_BARS])
def case(
    request: pytest.FixtureRequest,
    small_robot: Robot,
    bundle_of: Callable[[str], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> Case:
    """A robot with its bundle."""
    name = request.param
    if name in TEMPLATES:
        return Case(built(name), open_bundle(bundle_of(name)))
    robot = built("kenan-2.0", leg="carbon-tube-4x2") if name == ON_BARS else small_robot
    return Case(robot, export(robot, tmp_path_factory.mktemp("bundles") / robot.name, pictures=False))
