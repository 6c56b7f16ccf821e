"""Outlines of body plates: material around what they hold, ribs, and pockets that leave printable walls."""

import itertools

import numpy as np
import pytest
import shapely
from support.built import built, cut, placed, region

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.robot.plates.outline import tray_slots
from jumpcad.workshop import load_workshop


@pytest.mark.parametrize(("name", "side"), [("kenan-2.0", "right"), ("best-bo", "left")])
def test_ears_as_wide_as_the_axles_seat_lead_from_the_leg_to_the_stop(name: str, side: str) -> None:
    """Material of 3 mm around a 3 mm axle, from the leg's 16 mm forwards, and all of what lies between it and stop."""
    robot = built(name)
    layout = robot.layout
    plate = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
    section = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    filled = shapely.union_all([shapely.Polygon(one.exterior) for one in getattr(section, "geoms", [section])])
    seat = layout.axle_mm / 2.0 + 3.0 - 0.02
    base = [
        shapely.Point(*layout.hub_mm).buffer(seat),
        shapely.Point(*(layout.hub_mm + np.array([16.0 - 0.02, -seat]))),
    ]
    stop = shapely.Point(*layout.stop.tab_mm).buffer(2.0 + 2.5 - 0.05)
    ear = shapely.union_all([*base, stop]).convex_hull
    assert ear.difference(filled).area < 1e-3


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_plates_have_material_around_what_they_hold(name: str, side: str) -> None:
    """3 mm around axles, 9 mm under standoffs' screws, 8 mm round the springs' pin, 2.5 mm around the trays' tabs."""
    robot = built(name)
    layout = robot.layout
    plate = getattr(layout.lateral, f"{side}_plate")
    section = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    kept = [(place, layout.axle_mm / 2.0 + 3.0, 1.75) for place in layout.axles.values()]
    kept += [(place, 4.5, 1.75) for place in layout.standoffs_mm] + [(layout.spring_pin_mm, 4.0, 1.75)]
    for place, radius, bore in kept:
        around = shapely.Point(*place).buffer(radius - 0.03, 64).difference(shapely.Point(*place).buffer(bore, 64))
        if side == "left":  # the sensor's opening and the shaft's hole may be beside them
            around = around.difference(shapely.Point(*layout.motor_mm).buffer(2.0))
        assert around.difference(section).area < 0.01
    for slots in tray_slots(layout, side):
        for place in slots:
            slot = shapely.box(place[0] - 5.2, place[1] - 1.0, place[0] + 5.2, place[1] + 1.0)
            outer = shapely.box(place[0] - 7.4, place[1] - 3.2, place[0] + 7.4, place[1] + 3.2).buffer(-1.0).buffer(1.0)
            assert outer.difference(slot).difference(section).area < 0.05


CLOSE_POCKETS = {
    "default": (154.0, 1.0734, 0.7499, 1.1942, 0.1128, 52.713, 18.552, 69.594),
    "fine": (152.3, 1.1982, 0.6581, 1.1508, 0.3104, 26.695, 29.477, 71.980),
    "light": (125.1, 0.9885, 0.8026, 0.9522, 0.5912, 50.586, 12.162, 36.483),
}
"""Robots that have pads side by side on which no rib ends, by workshop."""


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("workshop", CLOSE_POCKETS)
def test_a_printable_wall_is_between_all_openings_of_a_plate(workshop: str, side: str) -> None:
    shop = load_workshop(workshop)
    robot = build(Design.from_vector(CLOSE_POCKETS[workshop]), shop)
    plate = robot.layout.lateral.left_plate if side == "left" else robot.layout.lateral.right_plate
    area = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    openings = [shapely.Polygon(ring) for ring in area.interiors]
    least = min(one.distance(other) for one, other in itertools.combinations(openings, 2))
    assert len(openings) > 12
    assert shop.fits.wall_min_mm - 0.02 < least < shop.fits.wall_mm - 0.1  # and no recommended one
