"""Places of spring pin, motor and idler, with nothing in the way and with something."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.dimensions import CLEAR_MM
from jumpcad.drive import TorsionSpring
from jumpcad.drive.spring import Arms
from jumpcad.errors import CannotBuildError
from jumpcad.robot.space.room import EVERYWHERE, disc
from jumpcad.robot.springs.place import NoPinRoomError, arm_line, spring_obstacles, spring_pin_place
from jumpcad.robot.train import place as drive_places
from jumpcad.robot.train.place import train_obstacles, train_places

HUB, INSIDE = np.array([-40.0, 0.0]), (-20.0, 20.0)


def bearing_deg(place: np.ndarray, centre: np.ndarray) -> float:
    return math.degrees(math.atan2(place[1] - centre[1], place[0] - centre[0]))


def spring_with(pin_radius_mm: float, plate_pin_deg: float = 40.0) -> TorsionSpring:
    """Return a spring whose pins are at a distance from the hub."""
    spring, arms = built("kenan-2.0").layout.drive.spring, Arms.to_pins(6.0, 1.2, 3.0, pin_radius_mm)
    return replace(spring, arms=arms, plate_pin_rad=math.radians(plate_pin_deg))


def test_the_spring_pin_is_where_the_springs_want_it() -> None:
    place = spring_pin_place([], HUB, spring_with(14.0, 55.0), INSIDE)
    assert bearing_deg(place, HUB) == pytest.approx(55.0, abs=1e-4)
    assert math.dist(place, HUB) == pytest.approx(14.0, abs=1e-5)


def test_the_springs_arm_is_a_tangent_that_ends_a_little_beyond_its_pin() -> None:
    spring = spring_with(14.0, 90.0)
    start, end = arm_line(HUB, spring, "plate")
    assert math.dist(start, HUB) == pytest.approx(3.0, abs=1e-5)
    assert np.dot(end - start, start - HUB) == pytest.approx(0.0, abs=1e-4)
    assert math.dist(start, end) == pytest.approx(math.sqrt(14.0**2 - 5.1**2) + 2.0, abs=1e-4)
    arm, pin = spring_obstacles(HUB, HUB + np.array([0.0, 14.0]), spring, INSIDE)
    assert np.linalg.norm(arm.points_mm - pin.points_mm, axis=1).min() >= 2.1 - 1e-4
    assert pin.radius_mm == pytest.approx(3.0 / 2.0 + CLEAR_MM)
    assert arm.radius_mm == pytest.approx(1.2 / 2.0 + CLEAR_MM)
    assert arm.y_mm == pin.y_mm == INSIDE
    assert pin.points_mm.tolist() == [[-40.0, 14.0]]


@pytest.mark.parametrize(("pin", "direction", "turned"), [("plate", (0.0, 1.0), -1.0), ("leg", (1.0, 0.0), 1.0)])
def test_each_arm_pushes_its_pin_outwards(pin: str, direction: tuple[float, float], turned: float) -> None:
    """The axis of the pin is half of wire and pin, 2.1 mm, outside the arm's line; the leg is turned about +y."""
    start, end = arm_line(HUB, spring_with(14.0, 90.0), pin)
    along, outwards = (end - start) / math.dist(start, end), (start - HUB) / 3.0
    from_start = HUB + 14.0 * np.array(direction) - start
    assert from_start @ outwards == pytest.approx(2.1, abs=1e-4)
    assert from_start @ along == pytest.approx(math.dist(start, end) - 2.0, abs=1e-4)
    about_y = direction[1] * outwards[0] - direction[0] * outwards[1]  # z·Fx - x·Fz
    assert math.copysign(1.0, about_y) == turned


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


def test_of_all_idlers_the_one_with_the_motor_nearest(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each idler alone: none brings motor and idler nearer to where they are wanted than the chosen one."""
    layout = geared().layout
    drive, axis, lateral = layout.drive, layout.cam_axis_mm, layout.lateral
    wanted, wall = np.array([0.0, 14.0]), disc("wall", axis + np.array([-9.0, 12.0]), 9.0, EVERYWHERE)
    places = drive_places._idler_places([wall], drive, lateral, axis)

    def cost(place: np.ndarray, motor: np.ndarray) -> float:
        return float(np.linalg.norm(place - wanted) + np.linalg.norm(motor - wanted))

    idler, motor, _ = train_places([wall], drive, lateral, axis)
    assert idler is not None
    costs = []
    for number in range(0, len(places), 2):
        monkeypatch.setattr(drive_places, "_idler_places", lambda *_, one=number: places[one : one + 1])
        try:
            alone, beside, _ = train_places([wall], drive, lateral, axis)
        except CannotBuildError:
            continue
        assert alone is not None
        costs.append(cost(alone, beside))
    assert len(costs) > 5
    assert cost(idler, motor) == min(costs)


def test_the_motors_pinion_keeps_clear_of_what_stands_in_its_own_plane() -> None:
    """With two stages that is the idler wheel's, farther out than the cam gear's; the motor's body ends before it."""
    layout = geared().layout
    drive, axis, lateral = layout.drive, layout.cam_axis_mm, layout.lateral
    _, usual, _ = train_places([], drive, lateral, axis)
    post = disc("post", usual, 2.0, lateral.gears[-1])
    idler, motor, _ = train_places([post], drive, lateral, axis)
    first = drive.train.stages[0]
    assert math.dist(motor, usual) >= first.pinion.tip_radius_mm + 2.0 - 1e-5
    assert math.dist(idler, usual) >= first.wheel.tip_radius_mm + 2.0 - 1e-5


@pytest.mark.parametrize(("gap_mm", "free"), [(0.02, True), (-0.02, False)])
def test_the_springs_pin_needs_room_for_all_of_its_width(gap_mm: float, free: bool) -> None:
    """Beside a disc of 2 mm, whichever side that is on."""
    spring = spring_with(14.0)
    place = spring_pin_place([], HUB, spring, INSIDE)
    for side in ([1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]):
        near = disc("near", place + (1.0 + spring.arms.pin_mm / 2.0 + gap_mm) * np.array(side), 1.0, INSIDE)
        if free:
            assert spring_pin_place([near], HUB, spring, INSIDE) == pytest.approx(place)
        else:
            with pytest.raises(NoPinRoomError):
                spring_pin_place([near], HUB, spring, INSIDE)
