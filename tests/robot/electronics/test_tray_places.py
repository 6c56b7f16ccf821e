"""Where trays and standoffs lie, with nothing and with something in their way."""

import math

import numpy as np
import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import CannotBuildError
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.electronics.tray_places import electronics_obstacle, standoff_places, tray_place
from jumpcad.robot.space.room import EVERYWHERE, disc

CATALOGUE = load_catalogue()
CARRIED = Electronics(CATALOGUE.batteries["lipo-2s-180"], CATALOGUE.boards["xiao-esp32c3"], CATALOGUE.boards["drv8833"])
INSIDE = (-20.0, 20.0)
"""The boards beside the gap, with the end that each turns towards it: the controller is behind."""


def test_with_nothing_in_the_way_the_trays_are_over_the_front_pivot() -> None:
    np.testing.assert_allclose(tray_place([], CARRIED, 80.0, INSIDE), [40.0, 0.0], atol=1.0)


def test_trays_give_way_to_what_is_there_and_stay_above_the_pivots() -> None:
    axle = disc("front axle", (40.0, 0.0), 4.0, EVERYWHERE)
    tray = tray_place([axle], CARRIED, 80.0, INSIDE)
    middle, half = CARRIED.middle_mm(tray), np.array(CARRIED.half_mm)
    beyond = np.maximum(np.abs(middle - [40.0, 0.0]) - half, 0.0)
    assert math.hypot(*beyond) >= 4.0
    assert tray[1] >= 0.0


def test_a_battery_that_is_too_long_is_refused() -> None:
    huge = Electronics(CARRIED.battery.model_copy(update={"length_mm": 400.0}), CARRIED.controller, CARRIED.driver)
    wall = disc("cam", (-60.0, 40.0), 60.0, EVERYWHERE)
    words = r"^no room for the battery and electronics: [\d.]+ mm too little beside the cam: .* smaller boards: lipo"
    with pytest.raises(CannotBuildError, match=words):
        tray_place([wall], huge, 80.0, INSIDE)


def test_standoffs_are_above_the_boards_and_apart_from_each_other() -> None:
    """An M3 standoff reaches 3.2 mm from its middle; two keep 8 mm and the usual 0.8 mm between them."""
    tray, cam, front = np.array([40.0, 2.0]), np.array([-20.0, 25.0]), np.array([40.0, 0.0])
    boards = electronics_obstacle(CARRIED, tray, INSIDE)
    first, second = standoff_places([boards], cam, front, CARRIED, tray, INSIDE)
    assert math.dist(first, second) >= 3.2 + 3.2 + 0.8 + 8.0
    top = tray[1] + CARRIED.height_mm
    assert first[1] >= top or first[0] >= tray[0] + CARRIED.length_mm / 2.0 + 3.0
    assert second[0] < first[0]
    assert second[1] >= top
    ahead = np.array([tray[0] + CARRIED.length_mm, 0.0])  # a cam for which both would be at one place
    assert math.dist(*standoff_places([boards], ahead, front, CARRIED, tray, INSIDE)) >= 15.2
