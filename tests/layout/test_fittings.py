"""Openings of the plates keep apart from each other and from what the plates hold."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
import shapely
from support.built import built, geared

from jumpcad.layout.fittings import fittings_of, switch_half_mm
from jumpcad.layout.room import disc
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=[lambda: built("kenan-2.0"), lambda: built("best-bo"), geared])
def robot(request: pytest.FixtureRequest) -> Robot:
    return request.param()


def box(place: np.ndarray, half: tuple[float, float]) -> shapely.Polygon:
    return shapely.box(place[0] - half[0], place[1] - half[1], place[0] + half[0], place[1] + half[1])


def test_rooms_in_the_right_plate_are_apart(robot: Robot) -> None:
    """Of the hole for leads, the USB plug with 2.5 mm around it, and the switch; all above the pivots' line."""
    fittings = robot.layout.fittings
    rooms = [box(fittings.right_mm, (6.0, 8.0))]
    if fittings.usb_mm is not None:
        width, height = fittings.usb_size_mm
        rooms.append(box(fittings.usb_mm, (width / 2.0 + 2.5, height / 2.0 + 2.5)))
    if fittings.switch is not None:
        half = switch_half_mm(fittings.switch)
        assert half == (fittings.switch.length_mm / 2.0 + 1.2, fittings.switch.width_mm / 2.0 + 1.2)
        rooms.append(box(fittings.switch_mm, half))
    for one, other in itertools.combinations(rooms, 2):
        assert one.intersection(other).area < 1e-6
    for room in rooms:
        assert room.bounds[1] >= -0.5


def test_holes_for_leads_keep_off_the_axles_seats(robot: Robot) -> None:
    """An axle's seat has 3 mm around its bore; the sensor keeps off it too."""
    layout = robot.layout
    sensor = layout.sensor
    turned = box(np.zeros(2), (sensor.half_mm[0], sensor.half_mm[1]))
    turned = shapely.affinity.rotate(turned, sensor.turn_rad, origin=(0.0, 0.0), use_radians=True)
    case = shapely.affinity.translate(turned, *sensor.place_mm)
    for name, place in layout.axles.items():
        seat = shapely.Point(*place).buffer(layout.axle_mm / 2.0 + 3.0, 64)
        for hole in (layout.fittings.left_mm, layout.fittings.right_mm):
            assert box(hole, (6.0, 8.0)).intersection(seat).area < 0.01, name
        assert case.intersection(seat).area < 0.01, name


def test_the_usb_plug_is_before_the_controllers_socket(robot: Robot) -> None:
    """Its opening's middle: the board's socket above the foam tape on the upper tray."""
    layout, electronics = robot.layout, robot.layout.electronics
    seat = electronics.seats(layout.lateral.inside)["controller"]
    board = electronics.controller
    up = electronics.upper_tray_mm + 1.6 + 1.0 + board.usb_height_mm
    if layout.fittings.usb_mm is not None:
        assert layout.fittings.usb_mm == pytest.approx(layout.tray_mm + np.array([seat.x_mm, up]), abs=1e-6)
        assert layout.fittings.usb_size_mm == board.usb_mm


@pytest.mark.parametrize("seat_mm", [4.5, 4.9, 5.3, 5.7, 6.1, 10.0])
def test_openings_lie_as_near_to_the_boards_as_a_seat_amid_them_lets_them(seat_mm: float) -> None:
    """Around it they keep its radius and 0.4 mm; places are 2 mm apart, so none is 2.9 mm farther than it need be.

    Without a seat the holes for leads are in the boards' middle, on that raster, but for what has its room beside it.
    """
    layout = built("kenan-2.0").layout
    middle = layout.electronics.middle_mm(layout.tray_mm)
    given = (layout.lateral, layout.electronics, layout.tray_mm, layout.fittings.switch)
    free, kept = fittings_of([], *given, [], seat_mm), fittings_of([], *given, [middle], seat_mm)
    assert np.abs(free.left_mm - middle).max() <= 1.0 + 1e-6
    seat = shapely.Point(*middle).buffer(seat_mm, 64)
    assert seat_mm + 0.4 - 0.01 < box(kept.left_mm, (6.0, 8.0)).distance(shapely.Point(*middle)) < seat_mm + 0.4 + 2.9
    for fittings in (free, kept):
        rooms = [box(fittings.right_mm, (6.0, 8.0)), box(fittings.switch_mm, switch_half_mm(fittings.switch))]
        width, height = fittings.usb_size_mm
        rooms.append(box(fittings.usb_mm, (width / 2.0 + 2.5, height / 2.0 + 2.5)))
        for one, other in itertools.combinations(rooms, 2):
            assert one.distance(other) >= 0.4 - 0.05  # half of the usual 0.8 mm, from points 1 mm thick
        assert fittings is free or all(room.intersection(seat).area < 0.01 for room in rooms[:2])
        assert all(room.bounds[1] >= -0.5 for room in rooms[:2])


def test_a_wall_is_left_around_a_switch_whatever_it_says_of_its_size(robot: Robot) -> None:
    switch = robot.layout.fittings.switch
    assert switch is not None
    wall = switch_half_mm(switch.model_copy(update={"length_mm": 9.0, "width_mm": None}))[1]
    assert 0.8 < wall < 2.0
    assert switch_half_mm(switch.model_copy(update={"length_mm": 9.0, "width_mm": 4.0})) == (4.5 + wall, 2.0 + wall)
    assert switch_half_mm(switch.model_copy(update={"length_mm": None, "width_mm": 4.0})) == (wall, 2.0 + wall)


def test_without_a_socket_or_a_known_switch_there_is_no_opening_for_them() -> None:
    layout = built("kenan-2.0").layout
    board = layout.electronics.controller.model_copy(update={"usb_mm": None})
    carried = replace(layout.electronics, controller=board)
    switch = layout.fittings.switch.model_copy(update={"length_mm": None})
    for given in (switch, None):
        found = fittings_of([], layout.lateral, carried, layout.tray_mm, given, [], 4.5)
        assert (found.usb_mm, found.usb_size_mm, found.switch, found.switch_mm) == (None, (0.0, 0.0), None, None)


def test_openings_lie_above_the_pivots_line_however_low_the_boards_are() -> None:
    """With all of their room, since the plates end below it."""
    layout = built("kenan-2.0").layout
    low = layout.tray_mm - np.array([0.0, layout.tray_mm[1] + 30.0])
    found = fittings_of([], layout.lateral, layout.electronics, low, layout.fittings.switch, [], 4.5)
    assert layout.electronics.middle_mm(low)[1] < 0.0
    halves = (8.0, 8.0, switch_half_mm(layout.fittings.switch)[1])
    for place, half in zip((found.left_mm, found.right_mm, found.switch_mm), halves, strict=True):
        assert place[1] > half


@pytest.mark.parametrize(("behind_mm", "stays"), [(5.1, True), (4.9, False)])
def test_5_mm_behind_the_switch_are_for_its_wires(behind_mm: float, stays: bool) -> None:
    layout = built("kenan-2.0").layout
    switch = layout.fittings.switch
    given = (layout.lateral, layout.electronics, layout.tray_mm, switch, [], 4.5)
    free = fittings_of([], *given)
    assert switch is not None
    assert free.switch_mm is not None
    start = layout.lateral.inside[0] + switch.height_mm + behind_mm
    moved = fittings_of([disc("post", free.switch_mm, 1.0, (start, start + 3.0))], *given)
    assert np.array_equal(moved.switch_mm, free.switch_mm) == stays


@pytest.mark.parametrize("away_mm", [-20.0, -1.0, 0.1, 1.0])
@pytest.mark.parametrize("opening", ["left_mm", "right_mm", "switch_mm"])
def test_openings_keep_off_what_stands_beside_their_own_plate_inside_and_outside(opening: str, away_mm: float) -> None:
    """A post of half a millimetre beside either face of a plate, but not one amid the robot beside the other plate."""
    layout = built("kenan-2.0").layout
    given = (layout.lateral, layout.electronics, layout.tray_mm, layout.fittings.switch, [], 4.5)
    free, (low, high) = fittings_of([], *given), layout.lateral.inside
    inwards, face = (-1.0, high) if opening == "left_mm" else (1.0, low)
    at = face - inwards * away_mm
    post = disc("post", getattr(free, opening), 1.0, (min(at, at + 0.5), max(at, at + 0.5)))
    moved = fittings_of([post], *given)
    stays = np.array_equal(getattr(moved, opening), getattr(free, opening))
    assert stays == (away_mm == -20.0)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_openings_of_the_right_plate_are_as_near_to_the_boards_as_the_usb_plug_lets_them(name: str) -> None:
    """On a raster of 2 mm about the boards' middle, the nearest place with 0.4 mm to the rooms of the others.

    Rooms are points 1 mm apart or less, with a radius: a place may be another one by 0.1 mm.
    """
    layout = built(name).layout
    middle, switch = layout.electronics.middle_mm(layout.tray_mm), layout.fittings.switch
    assert switch is not None
    found = fittings_of([], layout.lateral, layout.electronics, layout.tray_mm, switch, [], 4.5)
    assert found.usb_mm is not None
    rooms = [box(found.usb_mm, tuple(size / 2.0 + 2.5 for size in found.usb_size_mm))]
    steps = np.arange(-45.0, 45.1, 2.0)
    places = middle + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    for place, half in ((found.right_mm, (6.0, 8.0)), (found.switch_mm, switch_half_mm(switch))):
        above = places[places[:, 1] > half[1]]
        free = [one for one in above if all(box(one, half).distance(room) >= 0.4 - 0.1 for room in rooms)]
        clear = [one for one in above if all(box(one, half).distance(room) >= 0.4 + 0.1 for room in rooms)]
        nearest, enough = (min(np.linalg.norm(one - middle) for one in ones) for ones in (free, clear))
        assert nearest - 1e-6 <= np.linalg.norm(place - middle) <= enough + 1e-6
        rooms.append(box(place, half))
