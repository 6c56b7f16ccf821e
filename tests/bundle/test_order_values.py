"""What is ordered and cut: figures of shops, norms and data sheets."""

import re
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from support.built import built

from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.drawings.wiring import wires
from jumpcad.bundle.guide.order_values import _screw_axles, order_values, strap_mm
from jumpcad.exporters.threemf import plate_files
from jumpcad.robot.electronics.thing import _switch
from jumpcad.robot.leg.place import END_PLAY_MM
from jumpcad.robot.robot import Robot


def order(robot: Robot) -> dict[str, Any]:
    return order_values(robot, bill_of_materials(robot))


def with_article(robot: Robot, pattern: str, replacement: str) -> Robot:
    hardware = tuple(replace(item, article=re.sub(pattern, replacement, item.article)) for item in robot.hardware)
    return replace(robot, hardware=hardware)


def test_a_standoff_is_cut_from_the_next_longer_one() -> None:
    """Shops have 20 to 50 mm in steps of 5 mm, and 60 mm; a longer one is made."""
    for cut, stock in ((20.0, 20), (20.1, 25), (32.9, 35), (45.5, 50), (51.0, 60), (60.0, 60), (71.2, 72)):
        robot = with_article(built("kenan-2.0"), r"(standoff \S+ x )[\d.]+( mm)", rf"\g<1>{cut}\2")
        assert order(robot)["standoffs"] == [("M3", 2, stock, cut)]


def test_a_rod_is_cut_into_its_pieces_with_a_cut_after_each() -> None:
    """Four pieces, 2 mm lost at each; shops have rods of 0.33, 0.5 and 1 m, longer needs are whole metres."""
    for length, metres in (
        (80.5, 0.33), (80.6, 0.5), (123.0, 0.5), (123.1, 1.0), (248.0, 1.0), (248.1, 2.0), (600.0, 3.0)
    ):  # fmt: skip
        robot = with_article(built("kenan-2.0"), r"(spring steel rod \S+ x )[\d.]+( mm)", rf"\g<1>{length}\2")
        (rod,) = order(robot)["rods"]
        assert (rod["cut"], rod["from_m"]) == ([(4, length)], metres), length


@pytest.mark.thorough
def test_tubes_are_not_ground_and_aluminium_gives_no_sparks() -> None:
    """2.8 g/cm³ is no steel."""
    for axle, steel, tube in (
        ("spring-steel", True, False), ("aluminium-7075", False, False), ("steel-tube", True, True)
    ):  # fmt: skip
        for rod in order(built("kenan-2.0", axle=axle))["rods"]:
            assert (rod["steel"], rod["tube"]) == (steel, tube), axle


def test_a_strip_gives_its_pieces_one_behind_the_other() -> None:
    """Toes' pads: 2 x (10.4 + 2) + 2 x (9.5 + 2) = 47.8 mm; the stop's: 8 + 2 = 10 mm."""
    robot = with_article(built("kenan-2.0"), r"(polyurethane.*, cut )4\.0 x 10\.\d( mm)", r"\g<1>4.0 x 10.4\2")
    toes, stop = order(robot)["strips"]
    assert (stop["cut"], stop["long_mm"], stop["wide_mm"]) == ([(1, 6.0, 8.0)], 10.0, 6.0)
    assert (toes["cut"], toes["long_mm"], toes["wide_mm"]) == ([(2, 4.0, 10.4), (2, 5.0, 9.5)], 50.0, 5.0)


def test_wire_is_ordered_by_colour() -> None:
    robot, total = built("kenan-2.0"), Counter[str]()
    for *_, colour, length in wires(robot):
        total[colour] += length / 1000.0
    billed = [re.fullmatch(r"silicone wire.*, (\w+), ([\d.]+) m", line.name) for line in bill_of_materials(robot).items]
    ordered = {found[1]: float(found[2]) for found in billed if found}
    assert ordered.keys() == {colour for colour, metres in total.items() if metres}
    assert all(total[colour] <= metres < total[colour] + 0.1 for colour, metres in ordered.items())


@pytest.mark.thorough
def test_plates_that_are_named_are_files_of_the_bundle() -> None:
    robot = built("kenan-2.0")
    files = [path for path, _ in plate_files(robot.parts, robot.workshop) if path.endswith(".3mf")]
    assert [f"print/{name}.3mf" for name in order(robot)["plates"]] == files


def test_the_strap_goes_once_around_battery_and_tray() -> None:
    assert strap_mm(built("kenan-2.0")) == 85.0  # 2 x (20 + 2 x 2 and 6 + 1.6) + 20, in whole 5 mm


def test_bearings_have_their_norms_sizes() -> None:
    """ISO 15 and makers: 623 is 3 x 10 x 4 mm; MR63 3 x 6 x 2.5 mm; 683 without shields would be 2 mm wide."""
    names = {line.name for line in bill_of_materials(built("kenan-2.0")).items}
    assert {"ball bearing 623 ZZ, 3 x 10 x 4 mm", "ball bearing MR63 ZZ, 3 x 6 x 2.5 mm"} <= names


@pytest.mark.thorough
def test_the_grooves_of_clips_are_ordered_where_the_rods_have_them() -> None:
    """Between the inner edges as on the rods' meshes; seven pieces of four lengths are cut from one rod."""
    robot = built("kenan-2.0", retention="clips", axle="silver-steel")
    (rod,) = order(robot)["rods"]
    assert sum(count for count, _ in rod["cut"]) == 7
    needed = sum(count * (length + 2.0) for count, length in rod["cut"]) / 1000.0
    assert rod["from_m"] == min(one for one in (0.33, 0.5, 1.0) if one >= needed)
    assert rod["groove_mm"] == (2.3, 0.64)
    assert rod["groove_off_mm"] == 0.2  # half of the play of 0.2 mm that each clip has along the rod
    found = Counter[float]()
    for item in (item for item in robot.hardware if ", grooves " in item.article):
        points = item.shown_mesh.vertices
        bottom = points[np.abs(np.hypot(points[:, 0], points[:, 1]) - 1.15) < 0.02, 2]
        middle = (points[:, 2].min() + points[:, 2].max()) / 2.0
        found[round(float(bottom[bottom > middle].min() - bottom[bottom < middle].max()), 1)] += 1
    assert {round(mm, 1): count for count, mm in rod["apart"]} == found
    assert not order(built("kenan-2.0"))["rods"][0]["grooves"]


@pytest.mark.thorough
def test_bars_of_legs_are_glued_to_the_designs_lengths() -> None:
    """Two pieces and two cuts of 2 mm; a bar that is too long fills the play at an end, and fits."""
    robot = built("kenan-2.0", leg="carbon-strip-3x6")
    bars = order(robot)["bars"]
    lengths = {round(float(np.ptp(item.shown_mesh.vertices, axis=0).max()), 1) for item in robot.hardware
               if item.name.endswith("_bar")}  # fmt: skip
    assert {length for _, length in bars["cut"]} == lengths
    assert 0.0 <= bars["long_mm"] - sum(lengths) - 2 * 2.0 < 10.0
    assert bars["off_mm"][0] <= END_PLAY_MM < bars["off_mm"][1]
    design = robot.design
    assert bars["eyes_mm"] == pytest.approx((design.carrying_link_mm, design.carrying_link_mm * design.c_coef))
    for length, enough in ((97.9, 200.0), (98.0, 200.0), (98.1, 210.0)):
        own = with_article(robot, r"(, cut )[\d.]+( mm long)", rf"\g<1>{length}\2")
        assert order(own)["bars"]["long_mm"] == enough


@pytest.mark.thorough
def test_leg_and_front_link_turn_on_the_smooth_part_of_their_screws() -> None:
    """ISO 4762 M3 x 45: 18 mm of thread and 2.5 mm of run-out leave 24.5 mm; of 50 mm cut to 45 mm they leave 29.5 mm.

    Two pairs of gears need more room between the head and the leg.
    """
    for motors, longer in (((), None), (("n20-75",), 50.0)):
        robot = built("kenan-1.0", retention="nuts", **({"motors": motors} if motors else {}))
        left, leg = robot.layout.lateral.left_plate[1], robot.layout.lateral.leg[0]
        assert (left - leg > 45.0 - 20.5) == (longer is not None)
        found = _screw_axles(robot)
        screws = [item for item in robot.hardware if item.article.endswith("ISO 4762 - 12.9")]
        low, high = robot.layout.lateral.outside
        assert (found["rods"], found["rod_mm"]) == (len(screws), high - low), "one for each screw"
        assert (found["longer_mm"], found["length_mm"]) == (longer, pytest.approx(45.0))
        stock = robot.workshop.catalogue.screws["M3 long"].model_copy(update={"lengths_mm": [35.0, 40.0, 45.0, 70.0]})
        apart = replace(robot, workshop=SimpleNamespace(catalogue=SimpleNamespace(screws={"M3 long": stock})))
        assert _screw_axles(apart)["longer_mm"] is None  # the nut of an M3 x 70 would stand on smooth shank


def test_thick_plates_need_longer_screws_and_sliders() -> None:
    """Plate, an ear of 0.5 mm and a nut of 1.6 mm (ISO 4032); the switch's slider is 5 mm, 1.5 are needed."""
    robot = built("kenan-2.0")
    lateral, catalogue = robot.layout.lateral, robot.workshop.catalogue
    for plate_mm, screw, reaches in ((2.4, "M2 x 5", True), (3.6, "M2 x 6", False), (4.0, "M2 x 8", False)):
        plate = (lateral.inside[0] - plate_mm, lateral.inside[0])
        layout = replace(robot.layout, lateral=replace(lateral, right_plate=plate))
        articles = Counter(item.article for item in _switch(layout, catalogue))
        assert articles[f"screw {screw} ISO 14580"] == articles["nut M2 ISO 4032"] == 2
        assert order(replace(robot, layout=layout))["slide_switch"]["reaches"] is reaches, plate_mm
    for gone in ({"switch": None}, {"switch_mm": None}):
        fittings = replace(robot.layout.fittings, **gone)
        assert order(replace(robot, layout=replace(robot.layout, fittings=fittings)))["slide_switch"] is None


def test_a_rod_for_the_springs_pin_passes_its_hole() -> None:
    """In halves of a millimetre, half a millimetre thinner than the hole or a little more."""
    robot = built("kenan-2.0")
    for hole_mm in (3.2, 3.4, 3.5, 3.9, 4.1):
        through = replace(robot.layout.pin_hole, diameter_mm=hole_mm)
        rod = order(replace(robot, layout=replace(robot.layout, pin_hole=through)))["pin_rod_mm"]
        assert hole_mm - 1.0 < rod <= hole_mm - 0.5 + 1e-9
        assert 2.0 * rod % 1.0 == 0.0
