"""Openings of the plates for leads, switch and USB plug, as regions: sizes from data sheets, material around them."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from manifold3d import CrossSection
from support.built import built, cut, geared, hole_centres, placed, region

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import CannotBuildError
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.electronics.fittings import (
    electronics_obstacle,
    fitting_openings,
    fitting_pads,
    standoff_places,
    tray_place,
    wire_hole_mm,
)
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.room import EVERYWHERE, disc


def sizes(regions: list[CrossSection]) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Middle and size of every region."""
    boxes = [np.array(one.bounds()).reshape(2, 2) for one in regions]
    return [(tuple(box.mean(axis=0)), tuple(box[1] - box[0])) for box in boxes]


def test_the_plates_have_material_around_what_passes_them(kenan: Robot) -> None:
    """2.5 mm around the USB plug, 1.2 mm around the switch, 12 x 16 mm for a hole for leads with its tie."""
    fittings = kenan.layout.fittings
    assert fittings.switch is not None
    left, right, switch, usb = sizes(list(fitting_pads(fittings, 0.0)))
    for (middle, size), place in ((left, fittings.left_mm), (right, fittings.right_mm)):
        assert middle == pytest.approx(tuple(place), abs=2e-3)
        assert size == pytest.approx((12.0, 16.0), abs=2e-3)
    assert switch[0] == pytest.approx(tuple(fittings.switch_mm), abs=2e-3)
    assert switch[1] == pytest.approx((fittings.switch.length_mm + 2.4, fittings.switch.width_mm + 2.4), abs=2e-3)
    assert usb[0] == pytest.approx(tuple(fittings.usb_mm), abs=2e-3)
    assert usb[1] == pytest.approx((fittings.usb_size_mm[0] + 5.0, fittings.usb_size_mm[1] + 5.0), abs=2e-3)
    for (_, wide), (_, size) in zip(sizes(list(fitting_pads(fittings, 1.5))), (left, right, switch, usb), strict=True):
        assert wide == pytest.approx((size[0] + 3.0, size[1] + 3.0), abs=2e-3)


def test_openings_are_as_large_as_what_passes_them(kenan: Robot) -> None:
    """A knob's slot of 8 x 4.4 mm between screws 14.4 to 15 mm apart; two slots for a tie above the leads' hole."""
    fittings, holes = kenan.layout.fittings, HoleSizes.of(kenan.workshop, None)
    hole, one, other, *more = sizes(list(fitting_openings(fittings, holes, "left")))
    assert not more
    assert hole[0] == pytest.approx(wire_hole_mm(fittings.left_mm), abs=2e-3)
    for (middle, size), side in ((one, -1.0), (other, 1.0)):
        assert middle == pytest.approx((hole[0][0] + side * 2.6, hole[0][1] + 5.0), abs=2e-3)
        assert size == pytest.approx((1.8, 3.4), abs=2e-3)
    found = sizes(list(fitting_openings(fittings, holes, "right")))
    knob, *screws, usb = found[3:]
    x, z = fittings.switch_mm
    assert knob == (pytest.approx((x, z), abs=2e-3), pytest.approx((8.0, 4.4), abs=2e-3))
    m2_mm = kenan.workshop.fits.m2_clearance_mm  # screws pass the plate, wherever the ears' holes are
    for (middle, size), side in zip(screws, (-1.0, 1.0), strict=True):
        assert (middle[1], size[1]) == (pytest.approx(z, abs=2e-3), pytest.approx(m2_mm, abs=0.01))
        least, most = (side * (middle[0] - x) + end * (size[0] - m2_mm) / 2.0 for end in (-1.0, 1.0))
        assert least < 7.2 < 7.5 < most
    assert usb == (pytest.approx(tuple(fittings.usb_mm), abs=2e-3), pytest.approx(fittings.usb_size_mm, abs=2e-3))


def test_the_right_plate_is_open_for_what_there_is(kenan: Robot) -> None:
    """Without a switch behind it no knob and no screws, without a socket no plug; leads pass it always."""
    holes = HoleSizes.of(kenan.workshop, None)
    for missing, openings, pads in (({}, 7, 4), ({"switch_mm": None}, 4, 3), ({"usb_mm": None}, 6, 3)):
        fittings = replace(kenan.layout.fittings, **missing)
        assert len(list(fitting_openings(fittings, holes, "right"))) == openings
        assert len(list(fitting_pads(fittings, 0.0))) == pads


@pytest.mark.parametrize("side", ["left", "right"])
def test_leads_pass_inside_the_plates_room_for_them(kenan: Robot, side: str) -> None:
    """Hole and both slots of the tie lie within the room of 12 x 16 mm, and the plate has them."""
    fittings, lateral = kenan.layout.fittings, kenan.layout.lateral
    place = fittings.left_mm if side == "left" else fittings.right_mm
    room = shapely.box(place[0] - 6.0, place[1] - 8.0, place[0] + 6.0, place[1] + 8.0)
    plate = lateral.left_plate if side == "left" else lateral.right_plate
    segments = cut(placed(kenan, f"body_plate_{side}"), sum(plate) / 2.0)
    inside = [at for at in hole_centres(segments) if room.contains(shapely.Point(at))]
    assert len(inside) == 3
    lost = room.difference(region(segments))
    assert 10.0 < lost.area < 60.0
    assert room.buffer(-0.5).contains(lost.buffer(-0.3))


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


CATALOGUE = load_catalogue()
CARRIED = Electronics(CATALOGUE.batteries["lipo-2s-180"], CATALOGUE.boards["xiao-esp32c3"], CATALOGUE.boards["drv8833"])
INSIDE = (-20.0, 20.0)
"""The boards beside the gap, with the end that each turns towards it: the controller is behind."""


def test_with_nothing_in_the_way_the_trays_are_over_the_front_pivot() -> None:
    np.testing.assert_allclose(tray_place([], CARRIED, 40.0, INSIDE), [40.0, 0.0], atol=1.0)


def test_trays_give_way_to_what_is_there_and_stay_above_the_pivots() -> None:
    axle = disc("front axle", (40.0, 0.0), 4.0, EVERYWHERE)
    tray = tray_place([axle], CARRIED, 40.0, INSIDE)
    middle, half = CARRIED.middle_mm(tray), np.array(CARRIED.half_mm)
    beyond = np.maximum(np.abs(middle - [40.0, 0.0]) - half, 0.0)
    assert math.hypot(*beyond) >= 4.0
    assert tray[1] >= 0.0


def test_a_battery_that_is_too_long_is_refused() -> None:
    huge = Electronics(CARRIED.battery.model_copy(update={"length_mm": 400.0}), CARRIED.controller, CARRIED.driver)
    wall = disc("cam", (-60.0, 40.0), 60.0, EVERYWHERE)
    words = r"^no room for the battery and electronics: [\d.]+ mm too little beside the cam: .* smaller boards: lipo"
    with pytest.raises(CannotBuildError, match=words):
        tray_place([wall], huge, 40.0, INSIDE)


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
