"""Robots that are built once for all checks."""

import pytest
from support.built import built

from jumpcad.robot import Robot


@pytest.fixture(scope="session")
def kenan() -> Robot:
    """Kenan 2.0 from the default workshop, with nothing wrong."""
    return built("kenan-2.0")


@pytest.fixture(scope="session")
def strongest() -> Robot:
    """The best design of the Bayesian optimisation: the highest loads of the templates."""
    return built("best-bo")
