"""Fixtures that several rooms' tests share."""

import pytest
from support.robots import make_small_robot

from jumpcad.robot import Robot


@pytest.fixture(scope="session")
def small_robot() -> Robot:
    """Kenan 2.0 made of a few parts."""
    return make_small_robot()
