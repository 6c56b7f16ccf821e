"""Openings of the plates keep apart from each other and from what the plates hold."""

import itertools

import numpy as np
import pytest
import shapely
from support.built import built, geared

from jumpcad.layout.fittings import switch_half_mm
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
