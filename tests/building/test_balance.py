"""Battery and boards on either side of the leg: the opening follows the socket, and which arrangement balances."""

import itertools

import pytest
from manifold3d import Manifold

from jumpcad.building import build
from jumpcad.bundle.guide.markdown import write_guide
from jumpcad.checks import check
from jumpcad.design import load_design
from jumpcad.findings import errors
from jumpcad.robot.foot.thing import sideways_findings
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop, varied


def built(name: str = "kenan-2.0", **values: float | str) -> Robot:
    keys = {key.replace("__", "."): value for key, value in values.items()}
    return build(load_design(name), varied(load_workshop(), keys), name)


@pytest.mark.thorough
def test_the_usb_plug_passes_the_plate_at_which_its_socket_is() -> None:
    """A plug of the USB Type-C specification, 12.35 x 6.5 mm, its middle 2.8 mm above the board's underside."""
    for boards, other in (("left", "right"), ("right", "left")):
        robot = built(seats__boards=boards)
        board = next(item for item in robot.hardware if item.name == "controller")
        low = (Manifold.transform(board.solid, board.T_body_part[:3])).bounding_box()
        x, y, z = (low[0] + low[3]) / 2.0, (low[1] + low[4]) / 2.0, low[2] + 2.8
        assert (y > 0.0) == (boards == "left")
        plug = Manifold.cube([12.35, 100.0, 6.5], True).translate([x, 0.0, z])
        for side, free in ((boards, True), (other, False)):
            plate = next(part for part in robot.parts if part.name == f"body_plate_{side}")
            solid = plate.solid.transform(plate.placements[0].T_body_part[:3])
            assert ((solid ^ plug).volume() < 1e-6) == free, (boards, side)
        assert f"USB socket to the {boards}" in "".join(write_guide(robot).values())


def test_the_centre_of_mass_moves_as_battery_and_plate_do() -> None:
    """By its mass times its way over the robot's mass: the battery's 8 g and its strap's 0.8 g."""
    left, right = built(seats__battery="left"), built(seats__battery="right")
    places = [next(item.mass.com_m[1] for item in one.hardware if item.name == "battery") for one in (left, right)]
    by_hand = 1000.0 * 0.0088 * (places[0] - places[1]) / left.mass_kg
    assert by_hand > 0.1
    assert left.lateral_offset_mm - right.lateral_offset_mm == pytest.approx(by_hand, rel=0.2)  # the tray's window too
    wider = built(seats__battery="right", body__right_mm=4.0)
    assert wider.layout.lateral.inside[0] == pytest.approx(right.layout.lateral.inside[0] - 4.0)
    assert wider.lateral_offset_mm < right.lateral_offset_mm - 0.5


def test_balance_is_the_arrangement_with_the_least_offset_of_all_that_fit() -> None:
    sides = itertools.product(("leg", "right", "left"), ("right", "left"))
    offsets = [abs(built(seats__battery=one, seats__boards=other).lateral_offset_mm) for one, other in sides]
    balanced = built(seats__battery="balance", seats__boards="balance")
    assert abs(balanced.lateral_offset_mm) == min(offsets)
    assert balanced.workshop.seats.battery == "balance"
    assert min(offsets) < abs(built().lateral_offset_mm) < max(offsets)


def test_a_limit_on_the_offset_is_checked_where_the_workshop_has_one() -> None:
    assert [one.name for one in sideways_findings(built())] == ["sideways_tipping"]
    for limit, severity in ((0.4, "error"), (0.5, "info")):
        robot = built(safety__lateral_offset_mm=limit)
        _, found = sideways_findings(robot)
        assert (found.name, found.severity) == ("lateral_balance", severity)
        assert found.margin == pytest.approx(limit - abs(robot.lateral_offset_mm))


@pytest.mark.thorough
def test_every_arrangement_keeps_what_the_usual_one_keeps() -> None:
    for name, kit in (("kenan-2.0", "light-1s"), ("best-ga", "strong-2s")):
        usual = {one.name for one in errors(check(built(name, bought__kit=kit)))}
        for values in ({"seats__boards": "left", "seats__battery": "left"}, {"body__right_mm": 8.0}):
            found = {one.name for one in errors(check(built(name, bought__kit=kit, **values)))}
            assert found <= usual, (name, kit, values)
