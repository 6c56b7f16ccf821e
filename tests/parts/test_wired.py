"""What is bought for the electronics: boards and what holds them, the switch, ties, and wire by the metre."""

import itertools
import re
from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, placed

from jumpcad.bundle.wiring import wires
from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.chosen import chosen_of
from jumpcad.electronics.nets import wiring_of
from jumpcad.parts.fittings import wire_hole_mm
from jumpcad.parts.wired import _soldered, _switch, electronics
from jumpcad.workshop import load_workshop


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_what_has_its_place_is_not_weighed_among_the_wires_too(name: str) -> None:
    robot = built(name)
    names = [item.name for item in robot.hardware]
    placed = robot.layout.fittings.switch_mm is not None
    assert names.count("switch") == placed
    assert names.count("wiring_switch") == (not placed)
    assert names.count("wiring_sensor") == (robot.layout.sensor is None)


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


@pytest.mark.parametrize(
    ("pattern", "size", "grams"),
    [
        ("strap_battery", (10.0, 1.0), 0.8), ("tie_(driver|controller)", (2.5, 1.1), 0.3),
        ("tie_(plug|capacitor)", (2.5, 1.1), 0.3), ("tape_.*", (1.0,), None),
        ("wiring_resistor_.*", None, 0.2), ("wiring_heat_shrink", None, 0.4),
        ("tie_(sensor|motor)_leads", None, 0.3),
    ],
)  # fmt: skip
def test_small_things_have_the_size_and_mass_of_their_kind(
    pattern: str, size: tuple | None, grams: float | None
) -> None:
    """A strap of 10 mm, ties of 2.5 x 1.1 mm, foam tape of 1 mm and 0.5 g/cm³; a quarter watt resistor weighs 0.2 g."""
    robot = built("kenan-2.0")
    found = [item for item in robot.hardware if re.fullmatch(pattern, item.name)]
    assert found
    for item in found:
        extents = np.ptp(item.shape.bounds_mm, axis=0)
        for asked in size or ():
            assert np.abs(extents - asked).min() < 2e-3, item.name
        if grams is not None:
            assert 1000.0 * item.mass_kg == pytest.approx(grams), item.name
        elif pattern.startswith("tape"):
            assert 1e6 * item.mass_kg == pytest.approx(0.5 * np.prod(extents), rel=1e-3)


def test_wire_is_bought_in_tenths_of_a_metre_rounded_up() -> None:
    """By the lengths to cut; what is exactly so many tenths is not rounded up to one more."""
    robot = built("kenan-2.0")
    cut: dict[str, float] = defaultdict(float)
    for *_, colour, length in wires(robot):
        cut[colour] += length / 1000.0
    for colour, metres in cut.items():
        if metres:
            item = next(one for one in robot.hardware if one.name == f"wiring_wire_{colour}")
            ordered = float(re.findall(rf"{colour}, ([\d.]+) m$", item.article)[0])
            assert -1e-6 <= ordered - metres < 0.1 - 1e-9, colour
            assert ordered * 10.0 == pytest.approx(round(ordered * 10.0))
            wire = load_catalogue().components[robot.workshop.bought.wire]
            assert 1e3 * item.mass_kg == pytest.approx(1e3 * metres * wire.mass_g / wire.length_mm), colour


def test_a_switch_without_a_place_is_not_bought_with_screws() -> None:
    layout = built("kenan-2.0").layout
    for lacking in ({"switch_mm": None}, {"switch": None}):
        fittings = replace(layout.fittings, **lacking)
        assert list(_switch(replace(layout, fittings=fittings), load_catalogue())) == []


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


@pytest.mark.parametrize(("plate_mm", "screw_mm"), [(3.4, 4.0), (3.6, 5.0), (4.4, 5.0), (4.6, 6.0)])
def test_the_switchs_screws_are_the_shortest_that_reach_through_plate_and_ear(plate_mm: float, screw_mm: float) -> None:
    """ISO 14580 has M2 screws of 4, 5 and 6 mm; the ear takes 0.5 mm."""
    layout = built("kenan-2.0").layout
    inside = layout.lateral.inside[0]
    thick = replace(layout, lateral=replace(layout.lateral, right_plate=(inside - plate_mm, inside)))
    _, *screws = _switch(thick, load_catalogue())
    assert [screw.article for screw in screws] == [f"screw M2 x {screw_mm:g} ISO 14580"] * 2


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_what_holds_the_boards_lies_on_them_and_under_them(name: str) -> None:
    """Foam tape from tray to board, ties and strap on top, in the middle; leads lie flat under the tray."""
    robot = built(name)
    boxes = {item.name: item.look.copy().apply_transform(item.T_body_part).bounds for item in robot.hardware}
    electronics, (x, z) = robot.layout.electronics, robot.layout.tray_mm
    floor = z + electronics.upper_tray_mm + 1.6
    for role in electronics.boards:
        board, tape, tie = boxes[role], boxes[f"tape_{role}"], boxes[f"tie_{role}"]
        assert tape[:, 2] == pytest.approx([floor, board[0, 2]], abs=2e-3)
        assert tape[:, :2] == pytest.approx(board[:, :2], abs=2e-3)
        assert tie[0, 2] == pytest.approx(board[1, 2], abs=2e-3)
        assert tie.mean(axis=0)[:2] == pytest.approx(board.mean(axis=0)[:2], abs=2e-3)
        assert np.ptp(tie[:, 0]) == pytest.approx(np.ptp(board[:, 0]), abs=2e-3)
    for role in electronics.tied:
        part, tie = boxes[role], boxes[f"tie_{role}"]
        assert part[0, 2] == pytest.approx(floor, abs=2e-3)
        assert tie[0, 2] == pytest.approx(part[1, 2], abs=2e-3)
        assert tie.mean(axis=0)[:2] == pytest.approx(part.mean(axis=0)[:2], abs=2e-3)
        assert np.ptp(tie[:, 1]) == pytest.approx(np.ptp(part[:, 1]), abs=2e-3)
    strap, battery = boxes["strap_battery"], boxes["battery"]
    assert strap[0, 2] == pytest.approx(battery[1, 2], abs=2e-3)
    assert strap.mean(axis=0)[:2] == pytest.approx(battery.mean(axis=0)[:2], abs=2e-3)
    assert np.ptp(strap[:, 1]) == pytest.approx(np.ptp(battery[:, 1]), abs=2e-3)
    wires = sorted((one for item, one in boxes.items() if item.startswith("wiring_wire")), key=lambda one: one[0, 0])
    for wire in wires:
        assert battery[1, 2] < wire[0, 2] < wire[1, 2] < floor - 1.6
        assert (
            x - electronics.battery.length_mm / 2.0 <= wire[0, 0] < wire[1, 0] <= x + electronics.battery.length_mm / 2
        )
        assert wire[:, 1].mean() == pytest.approx(sum(robot.layout.lateral.inside) / 2.0, abs=2e-3)
        assert np.ptp(wire[:, 1]) == pytest.approx(np.ptp(battery[:, 1]) / 2.0, abs=2e-3)
    assert all(one[1, 0] < other[0, 0] for one, other in itertools.pairwise(wires))


def test_resistors_lie_on_their_seats_the_nearest_to_the_controller_first() -> None:
    """As they come; a robot with more of them than seats has the others in its wires."""
    robot = built("kenan-2.0")
    layout, (x, z) = robot.layout, robot.layout.tray_mm
    boxes = [
        item.look.copy().apply_transform(item.T_body_part).bounds
        for item in robot.hardware
        if item.name.startswith(("wiring_resistor", "wiring_diode"))
    ]
    seats = layout.electronics.small_seats(layout.lateral.inside)
    assert 0 < len(boxes) <= len(seats)
    for (low, high), seat in zip(boxes, seats, strict=False):
        assert (low + high)[:2] / 2.0 == pytest.approx([x + seat.x_mm, seat.y_mm], abs=2e-3)
        assert low[2] == pytest.approx(z + seat.bottom_mm, abs=2e-3)
        assert high - low == pytest.approx(seat.size_mm, abs=2e-3)


@pytest.mark.parametrize(("role", "outwards"), [("sensor", 1.0), ("motor", -1.0)])
def test_ties_of_leads_lie_on_the_plates_across_their_slots(role: str, outwards: float) -> None:
    """5 mm above the hole's middle, from slot to slot, 5.2 mm apart; outside the plate, 1.1 mm thick."""
    robot = built("kenan-2.0")
    fittings, outside = robot.layout.fittings, robot.layout.lateral.outside
    (item,) = (one for one in robot.hardware if one.name == f"tie_{role}_leads")
    low, high = item.look.copy().apply_transform(item.T_body_part).bounds
    x, z = wire_hole_mm(fittings.left_mm if role == "sensor" else fittings.right_mm)
    assert ((low + high) / 2.0)[[0, 2]] == pytest.approx([x, z + 5.0], abs=2e-3)
    assert (high - low) == pytest.approx([5.2, 1.1, 2.5], abs=2e-3)
    face = outside[1] if outwards > 0.0 else outside[0]
    assert min(low[1], high[1], key=lambda y: abs(y - face)) == pytest.approx(face, abs=2e-3)
    assert outwards * ((low + high)[1] / 2.0 - face) > 0.5


def test_the_balance_lead_of_two_cells_lies_under_its_tie_ahead_of_the_battery() -> None:
    """A tie of 2.5 x 1.1 mm across 10 mm, on a plug 6 mm high; a battery of one cell has no balance lead."""
    robot, catalogue = built("kenan-2.0"), load_catalogue()
    layout, chosen = robot.layout, robot.workshop.bought
    carried = replace(layout.electronics, battery=catalogue.batteries["lipo-2s-180"])
    found = {item.name: item for item in electronics(replace(layout, electronics=carried), catalogue, chosen)}
    tie, battery = (
        found[name].look.copy().apply_transform(found[name].T_body_part).bounds
        for name in ("tie_balance_lead", "battery")
    )
    middle = battery.mean(axis=0)
    assert tie.mean(axis=0)[:2] == pytest.approx([middle[0] + carried.balance_mm, middle[1]], abs=2e-3)
    assert tie[0, 2] == pytest.approx(battery[0, 2] + 6.0, abs=2e-3)
    assert np.ptp(tie, axis=0) == pytest.approx([2.5, 10.0, 1.1], abs=2e-3)
    assert tie[0, 0] > battery[1, 0]
    assert "tie_balance_lead" not in {item.name for item in robot.hardware}


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


def test_wire_of_which_no_length_is_known_weighs_as_for_half_a_metre() -> None:
    shop = load_workshop()
    wire = shop.catalogue.components[shop.bought.wire]
    weighed = []
    for length in (500.0, None, 1000.0):
        known = dict(shop.catalogue.components) | {wire.name: wire.model_copy(update={"length_mm": length})}
        catalogue = replace(shop.catalogue, components=known)
        soldered = _soldered(built("kenan-2.0").layout, catalogue, shop.bought, set())
        weighed.append(sum(grams for name, _, grams in soldered if name.startswith("wire_")))
    assert weighed[1] == pytest.approx(weighed[0])
    assert weighed[2] == pytest.approx(weighed[0] / 2.0)


@pytest.mark.parametrize("regulator", ["pololu", ""])
def test_a_diode_is_bought_where_there_is_a_regulator_before_it(regulator: str) -> None:
    """Whatever the workshop names; what else it names is there with its own mass."""
    shop = load_workshop()
    bought = shop.bought.model_copy(update=shop.catalogue.kits["strong-2s"].model_dump())
    bought = bought if regulator else bought.model_copy(update={"regulator": ""})
    found = {name: grams for name, _, grams in _soldered(built("kenan-2.0").layout, shop.catalogue, bought, {"plug"})}
    assert ("diode" in found) == bool(regulator)
    assert "plug" not in found
    for role in ("switch", "capacitor", "sensor"):
        assert found[role] == shop.catalogue.components[getattr(bought, role)].mass_g
