"""Robots that are built once for all checks."""

import pytest

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.robot import Robot


@pytest.fixture(scope="session")
def kenan() -> Robot:
    """Kenan 2.0 from the default workshop, with nothing wrong."""
    return build(load_design("kenan-2.0"))


@pytest.fixture(scope="session")
def strongest() -> Robot:
    """The best design of the Bayesian optimisation: the highest loads of the templates."""
    return build(load_design("best-bo"))
