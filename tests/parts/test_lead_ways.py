"""Ways of leads: through the plates' holes, clear of screws and of the opening for USB, no longer than they are cut."""

import itertools

import numpy as np
import pytest
from support.built import built, placed

from jumpcad.building import build
from jumpcad.bundle.drawings.lead_lines import leads_of
from jumpcad.design import load_design
from jumpcad.exporters.dxf import sheet
from jumpcad.parts.lead_ways import battery_way, lead_way
from jumpcad.robot import Robot
from jumpcad.solids.outline import contained
from jumpcad.workshop import load_workshop


def _strong() -> Robot:
    shop = load_workshop()
    parts = shop.catalogue.kits["strong-2s"].model_dump() | {"kit": "strong-2s"}
    return build(load_design("best-bo"), shop.model_copy(update={"bought": shop.bought.model_copy(update=parts)}), "b")


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built("kenan-2.0") if request.param == "light-1s" else _strong()


def _outside(robot: Robot, part: str) -> np.ndarray:
    """Return the corners (n, 3) of a lead that are outside the plates."""
    way = lead_way(robot.layout, "controller", part)
    low, high = robot.layout.lateral.outside
    return way[(way[:, 1] > high) | (way[:, 1] < low)]


@pytest.mark.parametrize(("part", "side", "mirror"), [("sensor", "left", -1.0), ("motor", "right", 1.0)])
def test_leads_pass_the_plate_where_it_has_a_hole(robot: Robot, part: str, side: str, mirror: float) -> None:
    """What is cut from the plate: at the hole's middle, and 2 mm around it, there is no material."""
    plate = next(one for one in robot.parts if one.name == f"body_plate_{side}")
    low, high = robot.layout.lateral.left_plate if side == "left" else robot.layout.lateral.right_plate
    region, way = sheet(plate, high - low)[0], lead_way(robot.layout, "controller", part)
    crossed = [
        (start, end)
        for start, end in itertools.pairwise(way)
        if (start[1] - low) * (end[1] - low) < 0.0 or (start[1] - high) * (end[1] - high) < 0.0
    ]
    assert len(crossed) == 1
    (start, end) = crossed[0]
    assert start[[0, 2]] == pytest.approx(end[[0, 2]])
    around = np.array([[0.0, 0.0], [2.0, 0.0], [-2.0, 0.0], [0.0, 2.0], [0.0, -2.0]])
    assert not contained(region, np.array([mirror * start[0], start[2]]) + around).any()


def test_outside_they_pass_below_the_screws_of_the_standoffs(robot: Robot) -> None:
    """A head of M3 ISO 7380-1 has 5.7 mm; the lead's insulation 0.6 mm to either side."""
    for part in ("sensor", "motor"):
        for start, end in itertools.pairwise(_outside(robot, part)[:, [0, 2]]):
            for screw in robot.layout.standoffs_mm:
                share = np.clip(np.dot(screw - start, end - start) / np.dot(end - start, end - start), 0.0, 1.0)
                assert np.hypot(*(start + share * (end - start) - screw)) > 5.7 / 2.0 + 0.6


def test_motor_leads_leave_the_opening_for_usb_free(robot: Robot) -> None:
    fittings, way = robot.layout.fittings, _outside(robot, "motor")[:, [0, 2]]
    assert fittings.usb_mm is not None
    for start, end in itertools.pairwise(way):
        points = start + np.linspace(0.0, 1.0, 200)[:, None] * (end - start)
        apart = np.abs(points - fittings.usb_mm) - np.array(fittings.usb_size_mm) / 2.0
        assert (apart > 0.0).any(axis=1).all()


def test_between_two_boards_leads_cross_where_no_board_lies(robot: Robot) -> None:
    way, seats = lead_way(robot.layout, "controller", "driver"), robot.layout.electronics.seats((-100.0, 100.0))
    crossing = [a[0] for a, b in itertools.pairwise(way) if abs(b[1] - a[1]) > 1.0]
    assert len(crossing) == 1
    for role in robot.layout.electronics.boards:
        seat = seats[role]
        assert abs(crossing[0] - robot.layout.tray_mm[0] - seat.x_mm) > seat.size_mm[0] / 2.0


def test_the_batterys_leads_go_from_its_front_end_around_the_trays_to_the_plug(robot: Robot) -> None:
    """Both ends in the middle of what they come out of, as it lies on the trays; ahead of all that is on them."""
    way = battery_way(robot.layout)
    for name, end in (("battery", way[0]), ("plug", way[-1])):
        item = next((one for one in robot.hardware if one.name == name), None)
        assert item is not None
        low, high = item.look.copy().apply_transform(item.T_body_part).bounds
        assert end == pytest.approx([high[0], (low[1] + high[1]) / 2.0, (low[2] + high[2]) / 2.0], abs=0.02), name
    assert np.ptp(way[1:4, 0]) == 0.0
    assert (np.count_nonzero(np.abs(np.diff(way, axis=0)) > 1e-9, axis=1) <= 1).all()  # one way at a time
    trays = placed(robot, "electronics_tray_upper")
    assert way[1, 0] == pytest.approx(trays.bounds[1, 0] + 3.0, abs=2e-3)
    drawn = [lead.points_mm - way for lead in leads_of(robot) if set(lead.parts) == {"battery", "plug"}]
    aside = [[[0.0, y, 0.0]] * 5 for y in (-0.5, 0.5)]  # two leads, a millimetre apart
    assert np.array(drawn) == pytest.approx(np.array(aside))
