"""What is bought for the electronics: boards and what holds them, the switch, ties, and wire by the metre."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, placed

from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.chosen import chosen_of
from jumpcad.electronics.nets import wiring_of
from jumpcad.parts.wired import electronics


def test_what_has_no_place_hangs_in_its_wires() -> None:
    """A switch that is not behind the plate, a sensor that is not over the cam gear."""
    robot, catalogue = built("kenan-2.0"), load_catalogue()
    layout, bought = robot.layout, robot.workshop.bought
    for changed, hanging in (
        ({"fittings": replace(layout.fittings, switch_mm=None)}, {"wiring_switch"}),
        ({"fittings": replace(layout.fittings, usb_mm=None)}, set()),
        ({"sensor": None}, {"wiring_sensor"}),
    ):
        names = {item.name for item in electronics(replace(layout, **changed), catalogue, bought)}
        assert names & {"wiring_switch", "wiring_sensor", "wiring_plug", "wiring_capacitor"} == hanging


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_battery_and_boards_lie_between_the_stops_of_their_trays(name: str) -> None:
    """The battery's ends are less than a millimetre from them; every stop of the upper tray stands along a board."""
    robot = built(name)
    along = {
        item.name: np.sort(item.T_body_part[0, 3] + item.shape.bounds_mm[:, 0] * item.T_body_part[0, 0])
        for item in robot.hardware
    }

    def stops(tray: str) -> np.ndarray:
        corners = placed(robot, f"electronics_tray_{tray}").vertices
        return corners[corners[:, 2] > corners[:, 2].min() + 2.0, 0]

    beside = [np.abs(stops("lower") - end).min() for end in along["battery"]]
    assert all(0.0 <= gap < 1.0 for gap in beside)
    for x in stops("upper"):
        assert any(low <= x <= high for low, high in (along["controller"], along["driver"]))


def test_the_switchs_screws_stand_in_the_holes_of_the_right_plate() -> None:
    """15 mm apart to either side of the switch, from the plate's outside inwards."""
    robot = built("kenan-2.0")
    x, z = robot.layout.fittings.switch_mm
    low, _ = robot.layout.lateral.outside
    (switch,) = (one for one in robot.hardware if one.name == "switch")
    box, inside = switch.look.copy().apply_transform(switch.T_body_part).bounds, robot.layout.lateral.inside[0]
    assert box.mean(axis=0)[[0, 2]] == pytest.approx([x, z], abs=1e-3)
    known = robot.layout.fittings.switch
    assert np.ptp(box, axis=0) == pytest.approx([known.length_mm, known.height_mm, known.width_mm], abs=1e-3)
    assert box[0, 1] == pytest.approx(inside, abs=1e-3)
    for number, side in ((1, -1.0), (2, 1.0)):
        (item,) = (one for one in robot.hardware if one.name == f"switch_screw_{number}")
        bounds = item.look.copy().apply_transform(item.T_body_part).bounds
        assert bounds.mean(axis=0)[[0, 2]] == pytest.approx([x + side * 7.5, z], abs=1e-3)
        assert bounds[0, 1] < low
        assert bounds[1, 1] >= inside + 0.5 - 1e-6  # through the switch's ear


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_resistors_are_ordered_with_what_the_wiring_needs(name: str) -> None:
    robot = built(name)
    bought = robot.workshop.bought
    needed = wiring_of(chosen_of(load_catalogue(), bought), bought.pins).resistors
    found = {item.name: item.article for item in robot.hardware if item.name.startswith("wiring_resistor_")}
    assert len(needed) >= 2
    assert len(found) == len(needed)
    for which, ohm in needed.items():
        said = found[f"wiring_resistor_{which.removesuffix(' resistor').replace('-', '_')}"]
        (thousands,) = re.findall(r"^resistor ([\d.]+) kOhm 0\.25 W, 1 %$", said)
        assert 1000.0 * float(thousands) == pytest.approx(ohm), which
