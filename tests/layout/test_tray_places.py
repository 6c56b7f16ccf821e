"""Where trays and standoffs lie, with nothing and with something in their way."""

import math

import numpy as np
import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import CannotBuildError
from jumpcad.layout.electronics import Electronics
from jumpcad.layout.room import EVERYWHERE, box_obstacle, disc
from jumpcad.layout.tray_places import electronics_obstacle, standoff_places, tray_place

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
    with pytest.raises(CannotBuildError, match=r"no room for the battery and electronics: .* beside the cam"):
        tray_place([wall], huge, 80.0, INSIDE)


def test_the_trays_middle_is_never_behind_the_legs_axle() -> None:
    """That is half the body's length behind its middle; where only less than that is free there is no room."""
    half = CARRIED.length_mm / 2.0
    for edge, fits in ((-40.0 + half + 2.0, True), (-40.0 + half - 2.0, False)):
        wall = box_obstacle("wall", (edge + 200.0, 0.0), (200.0, 200.0), 0.0, EVERYWHERE)
        if fits:
            assert -40.0 <= tray_place([wall], CARRIED, 80.0, INSIDE)[0] <= edge - half
        else:
            with pytest.raises(CannotBuildError, match=r"no room for the battery and electronics: .* beside the wall"):
                tray_place([wall], CARRIED, 80.0, INSIDE)


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


def test_the_obstacle_of_trays_and_boards_is_an_upright_box_around_all() -> None:
    tray = np.array([30.0, 5.0])
    found = electronics_obstacle(CARRIED, tray, INSIDE)
    low, high = found.points_mm.min(axis=0) - found.radius_mm, found.points_mm.max(axis=0) + found.radius_mm
    np.testing.assert_allclose(low, [30.0 - CARRIED.length_mm / 2.0, 5.0], atol=1e-6)
    np.testing.assert_allclose(high, [30.0 + CARRIED.length_mm / 2.0, 5.0 + CARRIED.height_mm], atol=1e-6)
    assert found.y_mm == INSIDE


def test_standoffs_are_wanted_at_the_boards_front_and_between_cam_and_boards() -> None:
    """Just above the boards: a standoff's 3.2 mm and a gap of 0.5 mm; above a higher cam's axis where that is higher.

    With nothing else there each is within half a raster of 2 mm, and the clearance of 0.8 mm, of where it is wanted.
    """
    tray, front = np.array([40.0, 2.0]), np.array([40.0, 0.0])
    boards = electronics_obstacle(CARRIED, tray, INSIDE)
    top = tray[1] + CARRIED.height_mm + 3.2 + 0.5
    for cam in (np.array([-20.0, 5.0]), np.array([-20.0, 70.0])):
        first, second = standoff_places([boards], cam, front, CARRIED, tray, INSIDE)
        assert first == pytest.approx([tray[0] + CARRIED.length_mm / 2.0, top], abs=2.0)
        assert second == pytest.approx([(cam[0] + tray[0]) / 2.0, max(top, cam[1])], abs=2.0)


def test_standoffs_follow_trays_that_lie_far_ahead_of_the_front_pivot() -> None:
    tray, front, cam = np.array([160.0, 2.0]), np.array([40.0, 0.0]), np.array([-20.0, 5.0])
    first, _ = standoff_places([], cam, front, CARRIED, tray, INSIDE)
    wanted = [tray[0] + CARRIED.length_mm / 2.0, tray[1] + CARRIED.height_mm + 3.2 + 0.5]
    assert first == pytest.approx(wanted, abs=1.0 + 1e-6)


@pytest.mark.parametrize(("aside_mm", "high_mm", "over"), [(40.0, 36.0, False), (40.0, 30.0, True)])
def test_a_millimetre_up_costs_trays_as_much_as_1_2_mm_along(aside_mm: float, high_mm: float, over: bool) -> None:
    """Before a wall that reaches in from the front they stand 40 mm farther back, or on top of it."""
    edge = 40.0 + CARRIED.length_mm / 2.0 - aside_mm
    wall = box_obstacle("wall", (edge + 100.0, high_mm / 2.0 - 50.0), (100.0, high_mm / 2.0 + 50.0), 0.0, EVERYWHERE)
    place = (40.0, high_mm) if over else (40.0 - aside_mm, 0.0)
    assert tray_place([wall], CARRIED, 80.0, INSIDE) == pytest.approx(place, abs=2.0)
