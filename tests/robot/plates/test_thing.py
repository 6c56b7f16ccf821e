"""A name with letters that cannot be engraved is a warning that shows them."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from support.built import built, cut, placed, region
from support.fits import LOOSE, N20_SHAFT, RUNNING, TOLERANCE_MM, measured

from jumpcad.drive.motor import window_mm
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Face
from jumpcad.robot.plates.outline import pin_hole
from jumpcad.robot.plates.thing import _openings, engraving_findings, plates
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import disc


@pytest.mark.parametrize(("name", "lacking"), [("Käfer-机器人", "机器人"), ("🐸\t", "🐸\t"), ("人人", "人")])
def test_letters_that_the_font_lacks_are_said(kenan: Robot, name: str, lacking: str) -> None:
    """The engraving's font has Latin letters, but neither Chinese nor emoji nor control characters."""
    [finding] = engraving_findings(replace(kenan, name=name))
    assert (finding.severity, finding.margin) == ("warning", -len(lacking))
    assert repr(lacking) in finding.message


def test_greek_and_cyrillic_can_be_engraved(kenan: Robot) -> None:
    assert list(engraving_findings(replace(kenan, name="Жук αβ"))) == []


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_motors_shaft_and_the_sensors_switch_pass_the_left_plate(name: str) -> None:
    """A shaft of 3 mm with 0.3 mm around it, the switch's case with 0.4 mm; both reach through the whole plate."""
    layout = built(name).layout
    sensor, (low, high) = layout.sensor, layout.lateral.left_plate
    half = np.array(sensor.needs.case_mm) / 2.0 + 0.38
    case = shapely.affinity.rotate(shapely.box(*-half, *half), sensor.turn_rad, origin=(0.0, 0.0), use_radians=True)
    opened = shapely.affinity.translate(case.buffer(-0.8).buffer(0.78), *sensor.place_mm)
    shaft = shapely.Point(*layout.motor_mm).buffer(1.5 + 0.28, 32)
    mesh = placed(built(name), "body_plate_left")
    for y in (low + 0.5, (low + high) / 2.0, high - 0.05):
        plate = region(cut(mesh, y))
        assert plate.intersection(shaft).area < 1e-3, y
        assert plate.intersection(opened).area < 1e-3, y
        assert plate.intersection(shaft.buffer(0.5)).area > 0.5, y
        assert plate.intersection(opened.buffer(0.5)).area > 5.0, y


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_legs_pin_goes_in_through_the_left_plate_alone(name: str) -> None:
    """A slot as wide as the hole from where the pin is at rest to where it is at the stop; 2 mm of plate around it."""
    robot = built(name)
    layout = robot.layout
    way = shapely.LineString([layout.pin_hole.rest_mm, layout.pin_hole.stop_mm])
    left = region(cut(placed(robot, "body_plate_left"), sum(layout.lateral.left_plate) / 2.0))
    slot = way.buffer(layout.pin_hole.diameter_mm / 2.0, 64)
    assert left.intersection(slot.buffer(-0.02)).area < 1e-3
    assert slot.buffer(1.98).difference(slot.buffer(0.03)).difference(left).area < 0.01
    holes = HoleSizes.of(robot.workshop, layout.hub_bearing)
    whole = pin_hole(layout, layout.pin_hole.diameter_mm)
    assert (_openings(layout, holes, "right") ^ whole).area() < 0.5 * whole.area()


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_right_plate_is_open_behind_the_motors_terminals(name: str) -> None:
    """Through its whole thickness, its closed bores' floor too: the middle of the motor's rear, turned as it is."""
    layout = built(name).layout
    half, (low, high) = np.array(window_mm(layout.drive.train.motor)) / 2.0 - 0.05, layout.lateral.right_plate
    window = shapely.affinity.rotate(
        shapely.box(*-half, *half), layout.motor_angle_rad, origin=(0.0, 0.0), use_radians=True
    )
    window = shapely.affinity.translate(window.buffer(-1.0).buffer(0.9), *layout.motor_mm)
    mesh = placed(built(name), "body_plate_right")
    assert window.area > 10.0
    for y in (low + 0.5, (low + high) / 2.0, high - 0.1):
        assert region(cut(mesh, y)).intersection(window).area < 1e-3, y


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_motors_socket_has_a_floor_under_it_and_a_sliding_fit_around_it(name: str) -> None:
    """The floor keeps 1 mm of the case's end on every side of its window; walls end 0.2 mm before the motor does."""
    robot = built(name)
    layout, motor, (rear, front) = robot.layout, robot.layout.drive.train.motor, robot.layout.lateral.motor
    half = np.array([motor.width_mm, motor.height_mm]) / 2.0
    box = shapely.affinity.rotate(shapely.box(*-half, *half), layout.motor_angle_rad, (0.0, 0.0), use_radians=True)
    case = shapely.affinity.translate(box, *layout.motor_mm)
    mesh = placed(robot, "body_plate_right")
    for y in (rear + 0.05, (rear + front) / 2.0, front - 0.25):
        walls = region(cut(mesh, y))
        assert walls.distance(case) == pytest.approx(robot.workshop.fits.sliding_mm, abs=0.01), y
        assert case.buffer(1.5, join_style="mitre").difference(case.buffer(0.21, join_style="mitre")).difference(
            walls
        ).area == pytest.approx(0.0, abs=0.05)
    floor = region(cut(mesh, rear - 0.05)).intersection(case)
    window = case.buffer(-1.0, join_style="mitre")
    assert floor.symmetric_difference(case.difference(window)).area < 0.05
    assert mesh.bounds[1, 1] == pytest.approx(front - 0.2, abs=1e-3)


@pytest.mark.parametrize("name", ["body_plate_left", "body_plate_right"])
def test_plates(kenan: Robot, name: str) -> None:
    layout = kenan.layout
    y = sum(layout.lateral.left_plate if name.endswith("left") else layout.lateral.right_plate) / 2.0
    expected = [(place, RUNNING) for place in layout.axles.values()]
    expected += [(place, 3.4) for place in layout.standoffs_mm]
    expected.append((layout.spring_pin_mm, RUNNING))
    if name.endswith("left"):
        expected.append((layout.motor_mm, N20_SHAFT + 2 * LOOSE))
    for place, diameter in expected:
        assert measured(kenan, name, y, place) == pytest.approx(diameter, abs=TOLERANCE_MM)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_the_stops_tabs_are_pressed_into_slots(name: str, side: str) -> None:
    """A tab of 5 x 4 mm with the press fit's 0.1 mm all around it, as the stop is turned."""
    layout = built(name).layout
    plate, stop = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate, layout.stop
    section = region(cut(placed(built(name), f"body_plate_{side}"), sum(plate) / 2.0))
    rings = [ring for one in getattr(section, "geoms", [section]) for ring in one.interiors]
    slot = min(rings, key=lambda ring: ring.centroid.distance(shapely.Point(*stop.tab_mm)))
    corners = [
        stop.tab_mm + a * 2.6 * stop.along + b * 2.1 * stop.behind for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]
    assert shapely.Polygon(slot).symmetric_difference(shapely.Polygon(corners)).area < 0.02


def test_the_springs_pin_stands_in_a_boss_of_the_right_plate(kenan: Robot) -> None:
    """Up to 0.5 mm beside the spring, at most 4 mm: then, with the plate's bore, nearly two diameters deep."""
    layout = kenan.layout
    plate, spring = layout.lateral.right_plate, layout.lateral.spring_right
    assert layout.spring_boss_mm == min(4.0, spring[0] - 0.5 - plate[1])
    assert measured(kenan, "body_plate_right", plate[1] + 3.9, layout.spring_pin_mm) == pytest.approx(
        RUNNING, abs=TOLERANCE_MM
    )
    beside = placed(kenan, "body_plate_right")
    wall = layout.spring_pin_mm + np.array([0.0, 1.7 + 0.9])
    ends, _, _ = beside.ray.intersects_location([[wall[0], plate[0] - 1.0, wall[1]]], [[0.0, 1.0, 0.0]])
    assert ends[:, 1].max() == pytest.approx(plate[1] + 4.0, abs=1e-3)


@pytest.mark.parametrize(("retention", "closed"), [("plates", True), ("nuts", False), ("clips", False)])
@pytest.mark.parametrize("side", ["left", "right"])
def test_bores_are_closed_outside_where_plates_keep_the_axles(
    kenan: Robot, retention: str, closed: bool, side: Face
) -> None:
    """By four layers of 0.2 mm; nuts and clips are outside the plates, whose seat of the leg's axle is not thicker."""
    layout = replace(kenan.layout, retention=retention)
    left, right = plates(layout, kenan.workshop)
    drawing, plate = (left, layout.lateral.left_plate) if side == "left" else (right, layout.lateral.right_plate)
    at = np.linalg.inv(drawing.placements[0].T_body_part)
    thick = plate[1] - plate[0]
    outside, inside, seat = drawing.shape.regions_at(np.array([0.75, 0.85, thick + 0.6]))
    for x, z in (*layout.axles.values(), layout.spring_pin_mm):
        pin = disc(3.0, (at @ [x, 0.0, z, 1.0])[:2])
        assert (inside ^ pin).area() < 1e-6
        assert (outside ^ pin).area() == pytest.approx(pin.area() if closed else 0.0, abs=1e-6)
    ring = disc(6.0, (at @ [layout.hub_mm[0], 0.0, layout.hub_mm[1], 1.0])[:2])
    assert ((seat ^ ring).area() > 1.0) == closed


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_tabs_of_trays_slide_into_slots_at_both_ends(name: str, side: str) -> None:
    """What of a tray is in the plate's thickness: a sliding fit all around, 10 mm long, 1 mm before the tray's end."""
    robot = built(name)
    plate, fit = getattr(robot.layout.lateral, f"{side}_plate"), robot.workshop.fits.sliding_mm
    middle = sum(plate) / 2.0
    around = region(cut(placed(robot, f"body_plate_{side}"), middle))
    ends = robot.layout.electronics.length_mm / 2.0 - 1.0
    for tray in ("electronics_tray_lower", "electronics_tray_upper"):
        tabs = shapely.get_parts(region(cut(placed(robot, tray), middle)))
        reach = sorted(tab.bounds[0] - robot.layout.tray_mm[0] for tab in tabs)
        assert reach == pytest.approx([-ends, ends - 10.0][-len(tabs) :], abs=0.01)
        for tab in tabs:
            assert tab.distance(around) == pytest.approx(fit, abs=0.01)
            slot = tab.buffer(fit, join_style="mitre")
            assert slot.intersection(around).area < 0.01
            assert slot.buffer(0.05, join_style="mitre").difference(slot).difference(around).area < 0.05
