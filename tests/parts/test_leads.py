"""Lengths to which wires are cut, from the places of what they join."""

import math

import numpy as np
import pytest
from support.built import built

from jumpcad.bundle.wiring import wires
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import wiring_of
from jumpcad.parts.leads import _lead_mm, has_own_legs, metres_by_colour


@pytest.mark.parametrize(
    ("one", "other", "more_mm"),
    [("controller", "driver", 0.0), ("controller", "sensor", 40.0), ("switch", "plug", 40.0)],
)
def test_a_wire_is_as_long_as_its_way_with_slack_in_whole_centimetres(one: str, other: str, more_mm: float) -> None:
    """Outside straight from point to point, inside along x, y and z; 30 mm for bends and solder."""
    outside = [np.array([0.0, 0.0, 0.0]), np.array([3.0, 4.0, 0.0])]
    for apart in ([10.0, 0.0, 0.0], [10.0, 7.0, -6.0], [14.9, 0.0, 0.0], [15.1, 0.0, 0.0]):
        inside = [np.array([3.0, 4.0, 0.0]) + apart]
        length = 5.0 + np.abs(apart).sum() + 30.0 + more_mm
        assert _lead_mm({one: outside, other: inside}, one, other) == pytest.approx(10.0 * math.ceil(length / 10.0))
        assert _lead_mm({one: inside, other: outside}, one, other) == pytest.approx(
            10.0 * math.ceil((5.0 + np.abs(outside[-1] - inside[-1]).sum() + 30.0 + more_mm) / 10.0)
        )


def test_inside_a_wire_goes_from_where_one_lead_ends_to_where_the_other_does() -> None:
    """Wherever the trays are: 10 + 20 + 5 mm apart, and 30 mm of slack."""
    at = np.array([100.0, -50.0, 40.0])
    ways = {"controller": [at], "driver": [at + np.array([10.0, -20.0, 5.0])]}
    assert _lead_mm(ways, "controller", "driver") == _lead_mm(ways, "driver", "controller") == 70.0


@pytest.mark.parametrize(
    ("one", "other", "own"),
    [("diode", "controller", True), ("upper resistor", "controller", True), ("regulator", "diode", False),
     ("switch", "upper resistor", False), ("controller", "driver", False)],
)  # fmt: skip
def test_legs_reach_the_board_beside_them_and_no_other_part(one: str, other: str, own: bool) -> None:
    """A diode lies at the controller: from the regulator it takes a wire."""
    assert has_own_legs(one, other) == has_own_legs(other, one) == own


def test_no_wire_is_cut_for_legs_of_a_part_and_the_batterys_own_plug() -> None:
    far = {
        name: [np.array([100.0 * number, 0.0, 0.0])] for number, name in enumerate(("battery", "plug", "controller"))
    }
    assert _lead_mm(far, "battery", "plug") == _lead_mm(far, "plug", "battery") == 0.0
    assert _lead_mm(far, "battery", "controller") == 230.0


def test_wires_of_a_colour_are_all_that_are_cut_of_it() -> None:
    robot = built("kenan-2.0")
    cut = [(colour, length) for _, _, _, colour, length in wires(robot)]
    assert cut
    needed = {colour for colour, length in cut if length > 0.0}
    assert needed < {colour for colour, _ in cut}  # the pull-up resistor's own legs are all of the logic supply
    assert (
        metres_by_colour(robot.layout, wiring_of(chosen_parts(robot.workshop), robot.workshop.bought.pins)).keys()
        == needed
    )
    wiring = {colour: sum(length for one, length in cut if one == colour) / 1000.0 for colour, _ in cut}
    written = {item.article for item in robot.hardware if item.name.startswith("wiring_wire_")}
    for colour, metres in wiring.items():
        if metres > 0.0:
            metres = math.ceil(10.0 * metres - 1e-6) / 10.0
            assert any(article.endswith(f"{colour}, {metres:g} m") for article in written), colour
