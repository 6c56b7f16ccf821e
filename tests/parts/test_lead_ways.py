"""Ways of leads: through the plates' holes, clear of screws and of the opening for USB, no longer than they are cut."""

import itertools
import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, placed

from jumpcad.building import build
from jumpcad.bundle.lead_lines import _outer, leads_of
from jumpcad.bundle.wiring import wires
from jumpcad.design import load_design
from jumpcad.exporters.dxf import sheet
from jumpcad.parts import lead_ways
from jumpcad.parts.lead_ways import _beside, battery_way, corners, gap_mm, lead_way, outer_way, plate_of, way_words
from jumpcad.parts.leads import way_in
from jumpcad.robot import Robot
from jumpcad.solids.outline import contained
from jumpcad.workshop import load_workshop

SOLDERED_MM = 10.0
"""What both ends take at least."""


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


def test_every_lead_is_cut_long_enough_for_its_way(robot: Robot) -> None:
    for _, start, end, _, length in wires(robot):
        if length:
            way = lead_way(robot.layout, start.part, end.part)
            needed = np.linalg.norm(np.diff(way, axis=0), axis=1).sum() + SOLDERED_MM
            assert needed <= length, (start, end)


def test_between_two_boards_leads_cross_where_no_board_lies(robot: Robot) -> None:
    way, seats = lead_way(robot.layout, "controller", "driver"), robot.layout.electronics.seats((-100.0, 100.0))
    crossing = [a[0] for a, b in itertools.pairwise(way) if abs(b[1] - a[1]) > 1.0]
    assert len(crossing) == 1
    for role in robot.layout.electronics.boards:
        seat = seats[role]
        assert abs(crossing[0] - robot.layout.tray_mm[0] - seat.x_mm) > seat.size_mm[0] / 2.0


def test_of_two_gaps_a_lead_takes_the_one_nearer_to_where_it_starts() -> None:
    """Three boards from the back: controller, driver, regulator."""
    layout = _strong().layout
    seats = layout.electronics.seats(layout.lateral.inside)
    middles = [layout.tray_mm[0] + seats[role].x_mm for role in ("controller", "driver", "regulator")]
    back, front = gap_mm(layout, middles[0], middles[2]), gap_mm(layout, middles[2], middles[0])
    assert middles[0] < back < middles[1] < front < middles[2]
    assert way_words(layout, "controller", "regulator").endswith("across between controller and driver")
    assert way_words(layout, "regulator", "controller").endswith("across between driver and regulator")
    beside = (middles[1] - 1.0, middles[1] + 3.0)  # over one board: half way
    assert gap_mm(layout, *beside) == gap_mm(layout, *beside[::-1]) == pytest.approx(middles[1] + 1.0)


def test_words_say_plate_hole_and_side(robot: Robot) -> None:
    words = {(one, other): way_words(robot.layout, one, other) for _, (one, _), (other, _) in _ends(robot)}
    assert "left plate" in words["plug", "sensor"]
    assert "out through its wire hole" in words["plug", "sensor"]
    assert "right plate" in words["driver", "motor"]
    assert "below the standoff's screw" in words["driver", "motor"]
    assert "hole" not in words["plug", "switch"]
    assert words["controller", "pull-up resistor"] == "own legs"
    assert battery_way(robot.layout)[:, 0].max() > robot.layout.tray_mm[0] + robot.layout.electronics.length_mm / 2.0


@pytest.mark.parametrize("at", ["part", "corner", "hole", "inside", "nowhere"])
@pytest.mark.parametrize("screw", [0, 1])
def test_only_a_lead_with_a_corner_under_a_screw_passes_below_it(
    monkeypatch: pytest.MonkeyPatch, screw: int, at: str
) -> None:
    """A part or a hole right under a standoff's screw is no corner; nor is one beside the opening for USB."""
    layout = built("kenan-2.0").layout
    x = dict.fromkeys(("part", "corner", "hole", "inside"), 7.0) | {at: float(layout.standoffs_mm[screw][0])}
    way = [np.array([x["part"], 60.0, 30.0]), np.array([x["corner"], 60.0, 15.0])]
    way += [np.array([x["hole"], 60.0, 20.0]), np.array([x["inside"], 40.0, 20.0])]
    for points, has_corner in ((way, True), ([way[0], *way[2:]], False)):
        monkeypatch.setattr(lead_ways, "outer_way", lambda *_, points=points: points)
        said = "below the standoff's screw" in way_words(layout, "driver", "motor")
        assert said == (has_corner and at == "corner")


@pytest.mark.parametrize(("to_part", "said"), [(1.0, "forwards"), (-1.0, "backwards")])
def test_outside_a_lead_goes_to_the_front_or_to_the_back(
    monkeypatch: pytest.MonkeyPatch, to_part: float, said: str
) -> None:
    """From a hole 40 mm behind or before the part, at whichever side of the robot."""
    layout = built("kenan-2.0").layout
    for y in (-60.0, 60.0):
        way = np.array([[10.0, y, 20.0], [10.0 - 40.0 * to_part, y, 20.0], [10.0 - 40.0 * to_part, 0.6 * y, 20.0]])
        monkeypatch.setattr(lead_ways, "outer_way", lambda *_, way=way: way)
        assert f"outside it {said}" in way_words(layout, "driver", "motor")


def test_words_say_the_direction_in_which_the_lead_goes(robot: Robot) -> None:
    """Forwards is towards the nose, +x: inside from the board to the hole or switch, outside from the hole on."""
    said = 0
    for _, (one, _), (other, _) in _ends(robot):
        words = way_words(robot.layout, one, other)
        found = re.search(r"from the ([\w ]+) across the upper tray to the \w+ plate", words)
        if found is None:
            continue
        part = other if plate_of(robot.layout, other) else one
        board = one if part == other else other
        way, (low, high) = lead_way(robot.layout, board, part), robot.layout.lateral.inside
        inside = way[(way[:, 1] > low) & (way[:, 1] < high)]
        ahead = inside[-1, 0] - inside[0, 0]
        within = words.partition(" inside it")[0]
        assert ("forwards" in within) == (ahead > 2.0), words
        assert ("backwards" in within) == (ahead < -2.0), words
        if "outside it" in words:
            along = "forwards" if way[-1, 0] > inside[-1, 0] else "backwards"
            assert f"outside it {along}" in words
            outside = way[(way[:, 1] < robot.layout.lateral.outside[0]) | (way[:, 1] > robot.layout.lateral.outside[1])]
            screws = {float(x) for x, _ in robot.layout.standoffs_mm}
            assert ("below the standoff's screw" in words) == bool(screws & set(outside[:, 0].tolist())), words
        said += 1
    assert said >= 6


def test_what_is_soldered_beside_the_robot_has_longer_leads(robot: Robot) -> None:
    """Its leads have 40 mm more than the others have for bends and solder, at least 10 mm: room for both hands."""
    apart = {"sensor", "switch"}
    for _, start, end, _, length in wires(robot):
        if length and {start.part, end.part} & apart:
            way = lead_way(robot.layout, start.part, end.part)
            assert length - np.linalg.norm(np.diff(way, axis=0), axis=1).sum() >= 40.0 + SOLDERED_MM, (start, end)


def _ends(robot: Robot) -> list[tuple[str, tuple[str, str], tuple[str, str]]]:
    return [(net, (start.part, start.pin), (end.part, end.pin)) for net, start, end, *_ in wires(robot)]


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


def test_leads_lie_side_by_side_about_the_middle_of_their_part(robot: Robot) -> None:
    """Of all leads that end at a part the ends' mean is where the part's way begins, and no two are the same."""
    leads = leads_of(robot)
    for part in {part for lead in leads for part in lead.parts} - {"battery", "plug", "switch"}:
        ends = np.array([lead.points_mm[0 if lead.parts[0] == part else -1] for lead in leads if part in lead.parts])
        assert ends.mean(axis=0) == pytest.approx(outer_way(robot.layout, part)[0], abs=1e-6), part
        apart = [np.abs(a - b).max() for a, b in itertools.combinations(ends, 2)]
        assert min(apart, default=1.0) > 0.05, part
        seat = robot.layout.electronics.seats(robot.layout.lateral.inside).get(part)
        if seat is not None:  # 1.5 mm from the edges of what they are soldered to
            assert (np.ptp(ends, axis=0)[:2] <= np.array(seat.size_mm[:2]) - 3.0 + 1e-6).all(), part


@pytest.mark.parametrize("count", [2, 5, 40])
def test_few_leads_are_a_millimetre_apart_and_many_fill_their_part(count: int) -> None:
    """Forty are spread evenly, from 1.5 mm off the one edge to 1.5 mm off the other, along and across."""
    layout = built("kenan-2.0").layout
    for part in ("driver", "controller"):
        (middle,) = outer_way(layout, part)
        ends = np.concatenate([_outer(layout, part, at - (count - 1) / 2.0, count, 1) for at in range(count)])
        reach = np.array(layout.electronics.seats(layout.lateral.inside)[part].size_mm[:2]) - 3.0
        expected = reach if count == 40 else np.full(2, count - 1.0)
        assert np.ptp(ends, axis=0) == pytest.approx([*expected, 0.0])
        assert np.diff(ends, axis=0) == pytest.approx(np.tile([*expected / (count - 1), 0.0], (count - 1, 1)))
        assert ends.mean(axis=0) == pytest.approx(middle)
    assert _outer(layout, "driver", 0.0, 1, 1) == pytest.approx(outer_way(layout, "driver")[0][None])


def test_inside_a_lead_runs_along_the_plate_at_the_height_of_its_hole(robot: Robot) -> None:
    """Whichever end is at the plate, the corners at its side have its y, and the lead goes down beside the boards."""
    start, end = np.array([10.0, 15.0, 40.0]), np.array([60.0, 2.0, 20.0])
    there = np.array(corners(robot.layout, "sensor", "controller", start, end))
    back = np.array(corners(robot.layout, "controller", "sensor", end, start))
    expected = [[60.0, 15.0, 40.0], [60.0, 15.0, 20.0]]
    assert there.tolist() == expected
    assert back.tolist() == expected[::-1]


@pytest.mark.parametrize(("above_mm", "passes_mm"), [(20.0, []), (5.1, []), (4.9, [-5.0]), (-4.9, [-5.0]), (-5.1, [])])
def test_only_leads_near_a_screw_go_round_it_and_below(above_mm: float, passes_mm: list[float]) -> None:
    """Within 5 mm of a standoff's hole they pass 5 mm under it; farther up or down they stay straight."""
    layout = built("kenan-2.0").layout
    aside = np.array([2.0, 0.0, 0.0])
    for x, z in layout.standoffs_mm:
        start, end = (np.array([x + ahead, 30.0, z + above_mm]) for ahead in (-1.0, 1.0))
        for one, other in ((start, end), (end, start)):
            assert [point.tolist() for point in _beside(layout, "sensor", one, other)] == [
                pytest.approx([x, 30.0, z + under]) for under in passes_mm
            ]
        assert _beside(layout, "sensor", start + aside, end + aside) == []


def test_a_lead_along_both_screws_passes_them_one_after_the_other() -> None:
    layout = built("kenan-2.0").layout
    one, other = sorted((np.array([x, 30.0, z]) for x, z in layout.standoffs_mm), key=lambda screw: float(screw[0]))
    beyond = 0.1 * (other - one)
    for start, end in ((one - beyond, other + beyond), (other + beyond, one - beyond)):
        passed = [float(point[0]) for point in _beside(layout, "sensor", start, end)]
        assert passed == sorted((one[0], other[0]), reverse=bool(start[0] > end[0]))


@pytest.mark.parametrize(("above_mm", "side"), [(3.0, 1.0), (-3.0, -1.0)])
def test_leads_go_round_the_opening_for_usb_on_the_nearer_side(above_mm: float, side: float) -> None:
    layout = built("kenan-2.0").layout
    assert layout.fittings.usb_mm is not None
    (x, z), half = layout.fittings.usb_mm, layout.fittings.usb_size_mm[1] / 2.0 + 2.0
    start, end = (np.array([x + ahead, -30.0, z + above_mm]) for ahead in (-1.0, 1.0))
    (point,) = _beside(layout, "motor", start, end)
    assert point == pytest.approx([x, -30.0, z + side * half])
    assert _beside(layout, "sensor", start, end) == []  # the left plate has none


def test_leads_end_in_the_middle_of_their_part_within_its_height(robot: Robot) -> None:
    """Of battery, boards, plug and capacitor as they lie on the trays."""
    placed = {item.name: item for item in robot.hardware}
    ends = {end.part for _, *both, _, _ in wires(robot) for end in both} & {"battery", "plug", "capacitor"}
    for part in ends | set(robot.layout.electronics.boards):
        low, high = placed[part].look.copy().apply_transform(placed[part].T_body_part).bounds
        (x, y, z), *others = way_in(robot.layout, part)
        assert (x, y) == pytest.approx(((low + high) / 2.0)[:2], abs=0.02), part
        assert low[2] < z < high[2], part
        assert others == []


def test_a_switch_that_is_not_behind_the_plate_has_its_leads_at_the_controller() -> None:
    """Whatever the plate is open for besides."""
    layout = built("kenan-2.0").layout
    hanging = replace(layout, fittings=replace(layout.fittings, switch_mm=None))
    closed = replace(layout, fittings=replace(layout.fittings, usb_mm=None))
    assert np.array(way_in(hanging, "switch")).tolist() == np.array(way_in(hanging, "controller")).tolist()
    assert np.array(way_in(closed, "switch")).tolist() == np.array(way_in(layout, "switch")).tolist()
    assert [plate_of(one, "switch") for one in (hanging, closed, layout)] == ["", "right", "right"]


def test_leads_lie_2_mm_beside_the_plates_that_they_pass(robot: Robot) -> None:
    """From what they are soldered to, outside, to the hole in the plate, and through it; the switch's stay inside."""
    layout = robot.layout
    (low, high), (right, left) = layout.lateral.inside, layout.lateral.outside
    (x, z), (hole_x, hole_z) = layout.sensor.place_mm, layout.fittings.left_mm
    assert np.array(way_in(layout, "sensor")) == pytest.approx(
        np.array(
            [[x, left + layout.sensor.base_mm + 2.0, z], [hole_x, left + 2.0, hole_z], [hole_x, high - 2.0, hole_z]]
        )
    )
    (x, z), (hole_x, hole_z) = layout.motor_mm, layout.fittings.right_mm
    assert np.array(way_in(layout, "motor")) == pytest.approx(
        np.array([[x, right - 2.0, z], [hole_x, right - 2.0, hole_z], [hole_x, low + 2.0, hole_z]])
    )
    if layout.fittings.switch_mm is not None:
        x, z = layout.fittings.switch_mm
        assert np.array(way_in(layout, "switch")) == pytest.approx(np.array([[x, low + 2.0, z]]))
    seat = layout.electronics.seats(layout.lateral.inside)["driver"]
    at = [layout.tray_mm[0] + seat.x_mm, seat.y_mm, layout.tray_mm[1] + seat.bottom_mm + 1.6]
    assert np.array(way_in(layout, "driver")) == pytest.approx(np.array([at]))
