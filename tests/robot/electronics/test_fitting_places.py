"""Openings of the plates keep apart from each other and from what the plates hold."""

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.robot.robot import Robot


@pytest.fixture(scope="module", params=[lambda: built("kenan-2.0"), lambda: built("best-bo"), geared])
def robot(request: pytest.FixtureRequest) -> Robot:
    return request.param()


def test_the_usb_plug_is_before_the_controllers_socket(robot: Robot) -> None:
    """Its opening's middle: the board's socket above the foam tape on the upper tray."""
    layout, electronics = robot.layout, robot.layout.electronics
    seat = electronics.seats(layout.lateral.inside)["controller"]
    board = electronics.controller
    up = electronics.upper_tray_mm + 1.6 + 1.0 + board.usb_height_mm
    if layout.fittings.usb_mm is not None:
        assert layout.fittings.usb_mm == pytest.approx(layout.tray_mm + np.array([seat.x_mm, up]), abs=1e-6)
        assert layout.fittings.usb_size_mm == board.usb_mm
