"""What lies on the trays: sizes by hand from the catalogue, seats apart from each other."""

import itertools
from dataclasses import replace

import pytest
import shapely

from jumpcad.catalogue import load_catalogue
from jumpcad.dimensions import STRAP_EDGE_MM, STRAP_SLOT_MM, TRAY_LENGTH_MIN_MM
from jumpcad.layout import electronics
from jumpcad.layout.electronics import Electronics, Seat

CATALOGUE = load_catalogue()
CARRIED = Electronics(CATALOGUE.batteries["lipo-2s-180"], CATALOGUE.boards["xiao-esp32c3"], CATALOGUE.boards["drv8833"])
INSIDE = (-20.0, 20.0)
GAP_BETWEEN = {"controller": 1.0, "driver": -1.0}
"""The boards beside the gap, with the end that each turns towards it: the controller is behind."""


def test_sizes_are_those_of_what_lies_on_the_trays() -> None:
    """The longest of battery with stops and balance lead, and both boards in a row; trays of 1.6 mm, foam tape of 1 mm.

    The battery has 0.5 mm of play to stops of 1.2 mm at its ends, and 3.8 mm above it.
    Beside every board are 0.2 mm of play and a slot of 1.8 mm for its tie, 0.8 mm between slots and 1.6 mm at the ends.
    Across lies the battery between two straps of 2 mm, each in the middle of 3 mm, with an edge beyond.
    """
    battery, boards = CARRIED.battery, (CARRIED.controller, CARRIED.driver)
    row = boards[0].width_mm + boards[1].width_mm + 4 * (0.2 + 1.8) + 0.8 + 2 * 1.6
    lead = 4.0 + 2 * 1.6  # the slots of its tie, and the tray before and behind them
    assert CARRIED.length_mm == pytest.approx(max(battery.length_mm + 2 * (0.5 + 1.2) + lead, row, TRAY_LENGTH_MIN_MM))
    assert CARRIED.width_mm == battery.width_mm + 2.0 * (3.0 + STRAP_EDGE_MM)
    height = 1.6 + battery.height_mm + 3.8 + 1.6 + 1.0 + max(board.height_mm for board in boards)
    assert CARRIED.height_mm == pytest.approx(height)
    for high in (0, 1):  # either board may be the higher one, above all that is tied beside it
        raised = [
            board.model_copy(update={"height_mm": 30.0 if at == high else 5.0}) for at, board in enumerate(boards)
        ]
        assert Electronics(battery, *raised).height_mm == pytest.approx(
            1.6 + battery.height_mm + 3.8 + 1.6 + 1.0 + 30.0
        )
    long = CARRIED.battery.model_copy(update={"length_mm": 90.0})
    assert Electronics(long, *boards).length_mm == pytest.approx(90.0 + 2 * (0.5 + 1.2) + lead)
    assert CARRIED.battery_mm == pytest.approx(CARRIED.length_mm / 2 - battery.length_mm / 2 - 1.7 - lead)


@pytest.mark.parametrize(("wall_mm", "play_mm"), [(0.8, 0.2), (0.54, 0.14), (0.8, 0.35), (1.2, 0.2), (1.2, 0.5)])
def test_what_lies_on_a_tray_has_its_own_place_between_the_plates(wall_mm: float, play_mm: float) -> None:
    """And the tray, which is narrower by its play, has a printable wall around and between all slots."""
    parts = CATALOGUE.components
    full = replace(
        CARRIED, regulator=CATALOGUE.boards["s7v7f5"],
        plug=parts["jst-ph-2"], capacitor=parts["electrolytic-100uf"], wall_mm=wall_mm, play_mm=play_mm,
    )  # fmt: skip
    inside = (-full.width_mm / 2.0, full.width_mm / 2.0)
    boxes = {
        role: shapely.box(s.x_mm - s.size_mm[0] / 2, s.y_mm - s.size_mm[1] / 2, s.x_mm + s.size_mm[0] / 2,
                          s.y_mm + s.size_mm[1] / 2)
        for role, s in full.seats(inside).items()
    }  # fmt: skip
    slots = [shapely.box(x - w / 2, y - h / 2, x + w / 2, y + h / 2)
             for pairs in full.tie_slots(inside).values() for x, y, (w, h) in pairs]  # fmt: skip
    tray = shapely.box(-full.length_mm / 2, inside[0] + play_mm, full.length_mm / 2, inside[1] - play_mm)
    upper = [box for role, box in boxes.items() if role != "battery"]
    assert len(upper) == 5
    assert len(slots) == 10
    assert all(tray.covers(box) for box in boxes.values())
    assert all(tray.buffer(1e-6 - wall_mm).covers(slot) for slot in slots)
    assert all(one.distance(other) > wall_mm - 1e-6 for one, other in itertools.combinations(slots, 2))
    for one, other in itertools.combinations([*upper, *slots], 2):
        assert one.intersection(other).area < 1e-6


@pytest.mark.parametrize(("along", "across"), [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
def test_two_resistors_side_by_side_keep_off_what_lies_beside_them(along: float, across: float) -> None:
    """They take 2.3 mm to either side of their middle line, and a length of 7 mm across."""
    seat = Seat(3.0, -2.0, 0.0, (10.0, 8.0, 2.0))
    for gap, apart in ((0.001, True), (-0.001, False)):
        x = 3.0 + along * (5.0 + 2.3 + gap)
        y = -2.0 + across * (4.0 + 3.5 + gap)
        assert electronics._apart(seat, x, y - 3.5, 7.0) == apart


def test_a_strap_has_its_slots_and_a_wall_between_battery_and_plate() -> None:
    """Beside the plate a battery keeps off by 1.5 slots and an edge; with room it lies in the legs' plane."""
    off = 1.5 * STRAP_SLOT_MM[0] + STRAP_EDGE_MM
    half = CARRIED.battery.width_mm / 2.0
    for inside, place in (((-40.0, 40.0), 0.0), ((-half - 1.0, 40.0), off - 1.0), ((-40.0, half + 2.0), 2.0 - off)):
        assert CARRIED.seats(inside)["battery"].y_mm == pytest.approx(place)


@pytest.mark.parametrize(("half_mm", "longer_mm"), [(18.0, 0.0), (21.0, 0.0), (26.0, 30.0)])
def test_resistors_lie_two_by_two_apart_from_each_other_and_from_ties_and_boards(
    half_mm: float, longer_mm: float
) -> None:
    """Each takes 2.3 x 6.3 mm on the upper tray, between controller and driver; nearest to the controller first.

    A long capacitor reaches over the gap between the boards.
    """
    parts = CATALOGUE.components
    capacitor = parts["electrolytic-100uf"]
    assert capacitor.length_mm is not None
    capacitor = capacitor.model_copy(update={"length_mm": capacitor.length_mm + longer_mm})
    full = replace(CARRIED, plug=parts["jst-ph-2"], capacitor=capacitor)
    inside = (-half_mm, half_mm)
    small, seats = full.small_seats(inside), full.seats(inside)
    assert len(small) >= 4

    def box(seat: Seat) -> shapely.Polygon:
        x, y = seat.size_mm[0] / 2.0 - 1e-6, seat.size_mm[1] / 2.0 - 1e-6
        return shapely.box(seat.x_mm - x, seat.y_mm - y, seat.x_mm + x, seat.y_mm + y)

    slots = [
        shapely.box(x - w / 2, y - h / 2, x + w / 2, y + h / 2)
        for role in ("controller", "driver")
        for x, y, (w, h) in full.tie_slots(inside)[role]
    ]
    taken = [box(seats[role]) for role in ("controller", "driver", "plug", "capacitor")]
    for seat in small:
        assert seat.size_mm == (2.3, 6.3, 2.3)
        behind, ahead = (seats[role].x_mm + end * seats[role].size_mm[0] / 2.0 for role, end in GAP_BETWEEN.items())
        assert behind < seat.x_mm - 2.3 / 2.0 < seat.x_mm + 2.3 / 2.0 < ahead
        assert abs(seat.y_mm) + 6.3 / 2.0 <= half_mm - 1.0
        assert seat.bottom_mm == pytest.approx(full.upper_tray_mm + 1.6)
    for one, other in itertools.combinations(map(box, small), 2):
        assert not one.intersects(other)
    for seat in small:
        assert not any(box(seat).intersects(other) for other in (*slots, *taken))
    away = [abs(seat.y_mm - seats["controller"].y_mm) for seat in small]
    assert away == sorted(away)


@pytest.mark.parametrize("half_mm", [16.0, 19.3, 23.0, 30.0])
@pytest.mark.parametrize("regulator", [None, "s7v7f5"])
def test_no_more_resistors_have_room_between_the_boards(half_mm: float, regulator: str | None) -> None:
    """On a raster of 0.5 mm from the tray's edge, the next pair begins as soon as 6.3 mm and 0.2 mm beside are free.

    From the lowest place on each is taken that meets no tie of the two boards and no pair below; of these the ones that
    meet capacitor or plug are left out.
    """
    parts = CATALOGUE.components
    full = replace(
        CARRIED, regulator=None if regulator is None else CATALOGUE.boards[regulator],
        plug=parts["jst-ph-2"], capacitor=parts["electrolytic-100uf"],
    )  # fmt: skip
    inside = (-half_mm, half_mm)
    seats, ties = full.seats(inside), full.tie_slots(inside)
    taken = [(y - 2.0, y + 2.0) for role in ("controller", "driver") for _, y, _ in ties[role][:1]]
    x = seats["controller"].x_mm + full.controller.width_mm / 2.0 + 0.2 + 1.8 + 0.4
    starts, start = [], 1.0 - half_mm
    while start + 6.7 <= half_mm - 1.0 + 1e-9:
        if all(start >= high - 1e-9 or start + 6.7 <= low + 1e-9 for low, high in taken):
            taken.append((start, start + 6.7))
            starts.append(start)
        start += 0.5
    beside = [seats[role] for role in ("capacitor", "plug")]
    expected = [
        start + 3.35 for start in starts
        if all(abs(seat.x_mm - x) >= seat.size_mm[0] / 2.0 + 2.3
               or abs(seat.y_mm - start - 3.35) >= (seat.size_mm[1] + 6.7) / 2.0 for seat in beside)
    ]  # fmt: skip
    small = full.small_seats(inside)
    assert sorted({round(seat.y_mm, 6) for seat in small}) == pytest.approx(expected)
    assert sorted({round(seat.x_mm, 6) for seat in small}) == pytest.approx([x - 1.15, x + 1.15])
    assert len(small) == 2 * len(expected)


def test_the_balance_lead_has_its_tie_between_the_stop_and_the_trays_end() -> None:
    """1.6 mm of tray before and behind the slots of 4 mm, beyond a stop of 1.2 mm that is 0.5 mm from the battery.

    The stop's middle is half of its thickness before that; where the strap is longer than the battery it is the strap,
    11 mm, that the stop keeps 1.6 mm away from.
    """
    half = CARRIED.battery.length_mm / 2.0
    assert CARRIED.stop_mm == pytest.approx(half + 0.5 + 0.6)
    assert CARRIED.balance_mm == pytest.approx(half + 0.5 + 1.2 + 1.6 + 2.0)
    assert CARRIED.battery_mm + CARRIED.balance_mm + 2.0 + 1.6 == pytest.approx(CARRIED.length_mm / 2.0)
    short = replace(CARRIED, battery=CARRIED.battery.model_copy(update={"length_mm": 9.0}))
    assert short.stop_mm == pytest.approx(11.0 / 2.0 + 1.6 + 0.6)
    single = replace(CARRIED, battery=next(one for one in CATALOGUE.batteries.values() if one.cells == 1))
    assert (single.balanced, CARRIED.balanced) == (False, True)
    assert single.battery_mm == 0.0


def test_a_tray_is_never_too_short_for_its_two_tabs() -> None:
    """Of 10 mm each, 1 mm before the tray's ends and 8 mm apart, however small battery and boards are."""
    battery = CARRIED.battery.model_copy(update={"length_mm": 8.0, "cells": 1})
    boards = [board.model_copy(update={"width_mm": 5.0}) for board in (CARRIED.controller, CARRIED.driver)]
    assert Electronics(battery, *boards).length_mm == 2 * (1.0 + 10.0) + 8.0


def test_what_lies_on_the_trays_has_the_height_of_trays_tape_and_gap() -> None:
    """Bottoms above the lower tray's underside: battery on 1.6 mm; 3.8 mm over it the upper tray; tape of 1 mm.

    Controllers are 0.9 mm from a plate, others 0.6 mm; capacitor and plug beside them lie on the tray itself.
    """
    parts = CATALOGUE.components
    full = replace(CARRIED, plug=parts["jst-ph-2"], capacitor=parts["electrolytic-100uf"])
    inside = (-30.0, 26.0)
    seats, upper = full.seats(inside), 1.6 + full.battery.height_mm + 3.8
    assert full.upper_tray_mm == pytest.approx(upper)
    bottoms = {"battery": 1.6, "controller": upper + 2.6, "driver": upper + 2.6, "plug": upper + 1.6}
    bottoms["capacitor"] = upper + 1.6
    assert {role: seat.bottom_mm for role, seat in seats.items()} == pytest.approx(bottoms)
    assert seats["controller"].y_mm - full.controller.length_mm / 2.0 == pytest.approx(inside[0] + 0.9)
    assert seats["driver"].y_mm + full.driver.length_mm / 2.0 == pytest.approx(inside[1] - 0.6)
    row = full.controller.width_mm + full.driver.width_mm + 4.8
    assert seats["controller"].x_mm - full.controller.width_mm / 2.0 == pytest.approx(-row / 2.0)
    assert seats["driver"].x_mm + full.driver.width_mm / 2.0 == pytest.approx(row / 2.0)
    beside = seats["controller"].y_mm + full.controller.length_mm / 2.0 + 0.2 + 1.2 + 1.8
    assert seats["capacitor"].y_mm - parts["electrolytic-100uf"].width_mm / 2.0 == pytest.approx(beside)
    assert seats["capacitor"].x_mm == pytest.approx(seats["controller"].x_mm)
    beside = seats["driver"].y_mm - full.driver.length_mm / 2.0 - 0.2 - 1.2 - 1.8
    assert seats["plug"].y_mm + parts["jst-ph-2"].width_mm / 2.0 == pytest.approx(beside)
    assert seats["plug"].x_mm + parts["jst-ph-2"].length_mm / 2.0 == pytest.approx(full.length_mm / 2.0)
    across = full.controller.length_mm + 0.9 + 0.2 + 1.2 + 1.8 + parts["electrolytic-100uf"].width_mm + 1.8 + 1.0
    assert full.width_mm >= across
    wide = replace(full, controller=full.controller.model_copy(update={"length_mm": 60.0}))
    assert wide.width_mm == pytest.approx(across + 60.0 - full.controller.length_mm)
    tall = replace(full, capacitor=parts["electrolytic-100uf"].model_copy(update={"height_mm": 30.0}))
    assert tall.height_mm == pytest.approx(upper + 1.6 + 30.0)


def test_the_plug_lies_beside_the_foremost_board_and_opens_to_the_front() -> None:
    """Of two boards or of three: inwards of the board's rim and of its own tie's slot, at the tray's front end."""
    parts = CATALOGUE.components
    two = replace(CARRIED, plug=parts["jst-ph-2"], capacitor=parts["electrolytic-100uf"])
    for full, foremost in ((two, "driver"), (replace(two, regulator=CATALOGUE.boards["s7v7f5"]), "regulator")):
        seats = full.seats((-30.0, 26.0))
        board, plug = seats[foremost], seats["plug"]
        assert board.x_mm == max(seats[role].x_mm for role in full.boards)
        apart = board.y_mm - board.size_mm[1] / 2.0 - (plug.y_mm + plug.size_mm[1] / 2.0)
        assert apart == pytest.approx(0.2 + 1.2 + 1.8)
        assert plug.x_mm + plug.size_mm[0] / 2.0 == pytest.approx(full.length_mm / 2.0)


def test_ties_have_their_slots_on_both_sides_of_what_they_hold() -> None:
    """Of a board along the robot, 0.2 mm beside it; of capacitor and plug across, close to them."""
    parts = CATALOGUE.components
    full = replace(CARRIED, plug=parts["jst-ph-2"], capacitor=parts["electrolytic-100uf"])
    inside = (-30.0, 26.0)
    seats = full.seats(inside)
    for role, slots in full.tie_slots(inside).items():
        seat = seats[role]
        for side, (x, y, size) in zip((-1.0, 1.0), slots, strict=True):
            if role in full.boards:
                assert (x, y) == pytest.approx((seat.x_mm + side * (seat.size_mm[0] / 2.0 + 0.2 + 0.9), seat.y_mm))
                assert size == (1.8, 4.0)
            else:
                assert (x, y) == pytest.approx((seat.x_mm, seat.y_mm + side * (seat.size_mm[1] / 2.0 + 0.9)))
                assert size == (4.0, 1.8)
    assert set(full.tie_slots(inside)) == {"controller", "driver", "plug", "capacitor"}
