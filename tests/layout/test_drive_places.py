"""Places of spring pin, motor and idler, with nothing in the way and with something."""

import math

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.errors import CannotBuildError
from jumpcad.layout.drive_places import (
    require_gear_room,
    spring_arm,
    spring_pin_place,
    train_obstacles,
    train_places,
)
from jumpcad.layout.room import EVERYWHERE, disc

HUB, INSIDE = np.array([-40.0, 0.0]), (-20.0, 20.0)


def bearing_deg(place: np.ndarray, centre: np.ndarray) -> float:
    return math.degrees(math.atan2(place[1] - centre[1], place[0] - centre[0]))


def test_the_spring_pin_is_in_front_of_the_hub_unless_something_is_there() -> None:
    free = spring_pin_place([], HUB, 14.0, INSIDE)
    assert bearing_deg(free, HUB) == pytest.approx(40.0, abs=1e-4)
    cam = disc("cam", HUB + 14.0 * np.array([math.cos(math.radians(40)), math.sin(math.radians(40))]), 6.0, EVERYWHERE)
    beside = spring_pin_place([cam], HUB, 14.0, INSIDE)
    assert math.dist(beside, HUB) == pytest.approx(14.0, abs=1e-5)
    assert math.dist(beside, cam.points_mm[0]) >= 6.0 + 1.5 - 1e-6


def test_a_gap_of_a_few_degrees_is_enough_for_the_spring_pin() -> None:
    """Obstacles in all directions except 62.5°; places 5° apart would miss it."""
    angles = np.radians([*range(0, 57, 2), *range(69, 150, 2)])
    things = [disc("leg", HUB + 30.0 * np.array([math.cos(a), math.sin(a)]), 1.0, EVERYWHERE) for a in angles]
    place = spring_pin_place(things, HUB, 30.0, INSIDE)
    assert 60.0 < bearing_deg(place, HUB) < 65.0
    with pytest.raises(CannotBuildError, match=r"no room for the spring pin: .* beside the ring: lower stiffness"):
        spring_pin_place([disc("ring", HUB, 40.0, EVERYWHERE)], HUB, 30.0, INSIDE)


def test_the_springs_arm_ends_a_little_beyond_its_pin() -> None:
    pin = HUB + np.array([0.0, 14.0])
    reach = spring_arm(HUB, pin, 14.0, INSIDE).points_mm[:, 1].max()
    assert reach == pytest.approx(16.0)


def test_a_cam_gear_must_clear_the_hub() -> None:
    axle = disc("leg axle", HUB, 4.0, EVERYWHERE)
    require_gear_room([axle], HUB + np.array([0.0, 30.0]), 26.0, (0.0, 5.0))
    with pytest.raises(CannotBuildError, match=r"cam gear's tip radius of 27\.0 mm is 1\.0 mm too large"):
        require_gear_room([axle], HUB + np.array([0.0, 30.0]), 27.0, (0.0, 5.0))


@pytest.mark.parametrize("stages", [1, 2])
def test_gears_mesh_and_the_motor_is_as_near_to_the_pivots_as_they_allow(stages: int) -> None:
    layout = (built("kenan-2.0") if stages == 1 else geared()).layout
    drive, axis = layout.drive, layout.cam_axis_mm
    assert len(drive.train.stages) == stages
    idler, motor, angle = train_places([], drive, layout.lateral, axis)
    if idler is None:
        assert math.dist(motor, axis) == pytest.approx(drive.train.stages[0].centre_distance_mm, abs=1e-5)
        nearest = abs(math.dist(axis, (0.0, 14.0)) - drive.train.stages[0].centre_distance_mm)
        assert math.dist(motor, (0.0, 14.0)) == pytest.approx(nearest, abs=0.1)  # on a ring of 72 places
    else:
        assert math.dist(motor, idler) == pytest.approx(drive.train.stages[0].centre_distance_mm, abs=1e-5)
        assert math.dist(idler, axis) == pytest.approx(drive.train.stages[-1].centre_distance_mm, abs=1e-5)
    names = [thing.name for thing in train_obstacles(motor, angle, idler, drive, layout.lateral)]
    assert names == ["motor", "pinion"] if idler is None else {"idler wheel", "idler axle"} < set(names)
