"""What is bought for the electronics: boards and what holds them, the switch, ties, and wire by the metre."""

import re
from dataclasses import replace

import pytest
from support.built import built

from jumpcad import build, load_design
from jumpcad.bundle.drawings.lead_lines import pads_of
from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.nets import Terminal, wiring_of
from jumpcad.electronics.supply import chosen_of
from jumpcad.robot.electronics.thing import electronics
from jumpcad.workshop import load_workshop


def test_what_has_no_place_hangs_in_its_wires() -> None:
    """A switch that is not behind the plate, a sensor that is not over the cam gear."""
    robot = built("kenan-2.0")
    layout = robot.layout
    for changed, hanging in (
        ({"fittings": replace(layout.fittings, switch_mm=None)}, {"wiring_switch"}),
        ({"fittings": replace(layout.fittings, usb_mm=None)}, set()),
        ({"sensor": None}, {"wiring_sensor"}),
    ):
        names = {item.name for item in electronics(replace(layout, **changed), robot.workshop)}
        assert names & {"wiring_switch", "wiring_sensor", "wiring_plug", "wiring_capacitor"} == hanging


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


def test_small_parts_lie_along_the_controllers_row_as_their_pads_do() -> None:
    """The divider's pad and the pull-up's: bodies in their order, so that no leg crosses another."""
    for name in ("kenan-2.0", "first-robot"):
        robot = build(load_design(name), load_workshop(name) if name == "first-robot" else None)
        pads, pins = pads_of(robot), robot.wiring.pins
        at = {item.name: item.T_body_part[1, 3] for item in robot.hardware if item.name.startswith("wiring_resistor")}
        apart = pads[Terminal("controller", pins["ready"])] - pads[Terminal("controller", pins["battery"])]
        bodies = [at["wiring_resistor_pull_up"] - at[f"wiring_resistor_{one}"] for one in ("upper", "lower")]
        assert min(apart[1] * body for body in bodies) >= 0.0, name
        assert any(bodies), name
