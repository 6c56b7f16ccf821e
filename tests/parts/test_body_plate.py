"""Body plates, measured on their meshes: bores, the motor's seat, and a name where there is material for all of it."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built, cut, hole_centres, inscribed_diameter, placed, region
from support.fits import LOOSE, N20_SHAFT, RUNNING, SLIDING, TOLERANCE_MM, measured

from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.design import Design, load_design
from jumpcad.dimensions import MOTOR_CAP_MM, MOTOR_CLAMP_MM
from jumpcad.drive.socket import socket_half_mm, window_mm
from jumpcad.parts.body_plate import (
    _apart,
    _covers,
    _drawing,
    _pads,
    ear_reach_mm,
    plates,
    socket_about_axis,
    tray_slots,
)
from jumpcad.parts.engraving import ENGRAVING_MM, TEXT_HEIGHTS_MM
from jumpcad.parts.fittings import fitting_pads
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Face
from jumpcad.parts.sensor import plate_pad
from jumpcad.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.text import engravable, text
from jumpcad.workshop import load_workshop


def engraved_mm2(name: str, label: str) -> dict[str, float]:
    """Return what a label takes from each plate's section, just above its chamfer."""
    plain, named = (build(load_design(name), name=label) for label in ("", label))

    def areas(robot: Robot) -> dict[str, float]:
        height = np.array([0.98 * ENGRAVING_MM])
        plates = [part for part in robot.parts if "plate" in part.name]
        return {part.name: part.drawing.shape.regions_at(height)[0].area() for part in plates}

    return {part: area - areas(named)[part] for part, area in areas(plain).items()}


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_motors_shaft_and_the_sensors_switch_pass_the_left_plate(name: str) -> None:
    """A shaft of 3 mm with 0.3 mm around it, the switch's case with 0.4 mm; both reach through the whole plate."""
    layout = built(name).layout
    sensor, (low, high) = layout.sensor, layout.lateral.left_plate
    half = np.array(sensor.case_mm) / 2.0 + 0.38
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


def test_a_thicker_shaft_has_a_wider_hole() -> None:
    """Of 4 mm, where axles have 3 mm: loose in a hole of 4.6 mm."""
    robot = built("kenan-2.0")
    layout, train = robot.layout, robot.layout.drive.train
    thick = replace(train, motor=train.motor.model_copy(update={"shaft_mm": 4.0}))
    layout = replace(layout, drive=replace(layout.drive, train=thick))
    left, _ = plates(layout, HoleSizes.of(robot.workshop, layout.hub_bearing), "")
    (section,) = left.shape.regions_at([1.2])
    at = left.placements[0].T_body_part
    found = []
    for points in section.to_polygons():
        x, _, z, _ = at @ [*points.mean(axis=0), 0.0, 1.0]
        if math.dist((x, z), layout.motor_mm) < 0.01:
            found += np.ptp(points, axis=0).tolist()
    assert found == pytest.approx([4.6, 4.6], abs=0.02)


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
def test_no_tab_of_a_tray_stands_in_the_opening_for_usb(name: str) -> None:
    """What of the printed trays is in the right plate's thickness lies beside the opening; three tabs hold there."""
    robot = built(name)
    fittings, (low, high) = robot.layout.fittings, robot.layout.lateral.right_plate
    assert fittings.usb_mm is not None
    tabs = 0
    for tray in ("electronics_tray_lower", "electronics_tray_upper"):
        segments = cut(placed(robot, tray), (low + high) / 2.0)
        for piece in shapely.get_parts(region(segments)):
            opening = shapely.box(*(fittings.usb_mm - np.array(fittings.usb_size_mm) / 2.0),
                                  *(fittings.usb_mm + np.array(fittings.usb_size_mm) / 2.0))  # fmt: skip
            assert piece.distance(opening) > 0.5
            tabs += 1
    assert tabs == 3


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"])
def test_the_whole_label_is_cut_from_the_plate(name: str) -> None:
    """What is lost is the letters' area: no letter hangs over a hole or an edge."""
    for part, lost in engraved_mm2(name, name).items():
        areas = [text(f"{name} {part.split('_')[-1][0].upper()}", height).area() for height in TEXT_HEIGHTS_MM]
        assert min(abs(lost / area - 1.0) for area in areas) < 1e-6


def test_a_label_that_finds_no_room_is_its_last_letter() -> None:
    lost = engraved_mm2("kenan-2.0", "a name that is far too long for any plate of a robot as small as this one")
    for part, letter in (("body_plate_left", "L"), ("body_plate_right", "R")):
        assert lost[part] == pytest.approx(text(letter, TEXT_HEIGHTS_MM[0]).area(), rel=1e-6)


@pytest.mark.parametrize(("name", "shown"), [("Käfer-机器人", "Käfer-"), ("机器人", "")])
def test_letters_that_the_font_lacks_are_left_out(name: str, shown: str) -> None:
    """The engraving's font has Latin letters, but no Chinese ones."""
    assert engravable(name) == shown
    for part, lost in engraved_mm2("kenan-2.0", name).items():
        areas = [text(f"{shown} {part.split('_')[-1][0].upper()}".strip(), height).area() for height in TEXT_HEIGHTS_MM]
        assert min(abs(lost / area - 1.0) for area in areas) < 1e-6


@pytest.fixture(scope="module")
def kenan() -> Robot:
    return built("kenan-2.0")


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


@pytest.mark.parametrize(("name", "side"), [("kenan-2.0", "right"), ("best-bo", "left")])
def test_ears_as_wide_as_the_axles_seat_lead_from_the_leg_to_the_stop(name: str, side: str) -> None:
    """Material of 3 mm around a 3 mm axle, from the leg's 16 mm forwards, and all of what lies between it and stop."""
    robot = built(name)
    layout = robot.layout
    plate = layout.lateral.left_plate if side == "left" else layout.lateral.right_plate
    section = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    filled = shapely.union_all([shapely.Polygon(one.exterior) for one in getattr(section, "geoms", [section])])
    seat = layout.axle_mm / 2.0 + 3.0 - 0.02
    base = [
        shapely.Point(*layout.hub_mm).buffer(seat),
        shapely.Point(*(layout.hub_mm + np.array([16.0 - 0.02, -seat]))),
    ]
    stop = shapely.Point(*layout.stop.tab_mm).buffer(2.0 + 2.5 - 0.05)
    ear = shapely.union_all([*base, stop]).convex_hull
    assert ear.difference(filled).area < 1e-3


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


def test_a_spring_close_to_the_plate_leaves_no_boss() -> None:
    assert built("best-bo").layout.spring_boss_mm == 0.0


def test_motor_seat(kenan: Robot) -> None:
    """The N20's gearbox is 10 by 12 mm; it slides into its socket, and M2 screws cut their thread beside it."""
    layout = kenan.layout
    segments = cut(placed(kenan, "body_plate_right"), layout.lateral.motor[1] - 2.0)
    assert inscribed_diameter(segments, layout.motor_mm) == pytest.approx(10.0 + 2 * SLIDING, abs=TOLERANCE_MM)
    across = np.array([-math.sin(layout.motor_angle_rad), math.cos(layout.motor_angle_rad)])
    inner = inscribed_diameter(segments, layout.motor_mm + 1.0 * across)
    assert inner == pytest.approx(10.0 + 2 * SLIDING, abs=TOLERANCE_MM)  # 1 mm along the long side: no corner yet
    ears = [centre for centre, width in hole_centres(segments).items() if width < 5.0]
    assert len(ears) == 2
    cap = cut(placed(kenan, "motor_cap"), layout.lateral.motor_cap[0] + 0.4)
    for ear in ears:
        assert inscribed_diameter(segments, np.array(ear)) == pytest.approx(1.6, abs=TOLERANCE_MM)
        assert inscribed_diameter(cap, np.array(ear)) == pytest.approx(2.4, abs=TOLERANCE_MM)


def pushed_mm3(robot: Robot, part: str, towards_left_mm: float) -> float:
    """Return what the motor's box, 1 um smaller on all sides, shares with a part when it is moved along its axis."""
    layout = robot.layout
    motor, (low, high) = layout.drive.train.motor, layout.lateral.motor
    box = trimesh.creation.box(np.array([motor.width_mm, high - low, motor.height_mm]) - 2e-3)
    box.apply_transform(trimesh.transformations.rotation_matrix(-layout.motor_angle_rad, (0.0, 1.0, 0.0)))
    x, z = layout.motor_mm
    box.apply_translation((x, (low + high) / 2.0 + towards_left_mm, z))
    both = box.intersection(placed(robot, part), engine="manifold")
    return 0.0 if both.is_empty else float(both.volume)


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"])
def test_the_socket_s_floor_and_the_cap_hold_the_motor(name: str) -> None:
    """The N20's can is a circle of 12 mm with flats 10 mm apart: its end has 7.9 mm2 within 1 mm of either flat.

    In its place the motor is free, and pushed to either side it meets at least that.
    """
    robot = built(name)
    for part, away in (("body_plate_right", -0.5), ("motor_cap", 0.5)):
        assert pushed_mm3(robot, part, 0.0) == 0.0
        assert pushed_mm3(robot, part, away) / 0.5 > 2 * 7.9
    assert placed(robot, "motor_cap").bounds[0, 1] - rim_mm(robot) == pytest.approx(0.2, abs=1e-3)


def rim_mm(robot: Robot) -> float:
    """Return the y at which the wall beside the motor's wider side ends."""
    layout = robot.layout
    side = layout.motor_mm + 6.0 * np.array([math.cos(layout.motor_angle_rad), math.sin(layout.motor_angle_rad)])
    ends, _, _ = placed(robot, "body_plate_right").ray.intersects_location(
        [[side[0], layout.lateral.right_plate[0] - 1.0, side[1]]], [[0.0, 1.0, 0.0]]
    )
    return float(ends[:, 1].max())


def test_the_gap_under_the_cap_can_be_closed_without_breaking_it() -> None:
    """A beam on the motor's edges, pulled down at both ears, strains by half of PLA's 2 % at yield."""
    for motor in load_catalogue().motors.values():
        half, arm, thick = motor.height_mm / 2.0, ear_reach_mm(motor.height_mm) - motor.height_mm / 2.0, MOTOR_CAP_MM
        strain = thick * MOTOR_CLAMP_MM / 2.0 / (arm * half + arm**2 / 3.0)
        across = socket_half_mm(motor)[0] * 2.0
        assert strain * across / (across - motor.boss_mm) < 0.011


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_strut_between_the_axles_has_3_mm_beside_their_bores(side: str) -> None:
    """A plate's material reaches from axle to axle with a wall of 3 mm on either side, where nothing is cut out."""
    robot = built("kenan-2.0")
    plate = robot.layout.lateral.left_plate if side == "left" else robot.layout.lateral.right_plate
    area = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0)).buffer(1e-3)
    filled = shapely.union_all([shapely.Polygon(one.exterior) for one in getattr(area, "geoms", [area])])
    strut = shapely.LineString([robot.layout.hub_mm, robot.layout.front_mm]).buffer(robot.layout.axle_mm / 2.0 + 2.95)
    pockets = [shapely.Polygon(ring) for one in getattr(area, "geoms", [area]) for ring in one.interiors]
    large = shapely.union_all([one for one in pockets if one.area > 60.0 and not one.contains(strut.centroid)])
    assert filled.buffer(0.05).contains(shapely.LineString([robot.layout.hub_mm, robot.layout.front_mm]))
    assert strut.intersection(large).area < 0.05


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_ribs_of_3_mm_hold_a_plate_together(name: str) -> None:
    """With all edges 1.5 mm farther in, it is still one piece; holes that its pads surround are not counted."""
    robot = built(name)
    section = region(cut(placed(robot, "body_plate_left"), sum(robot.layout.lateral.left_plate) / 2.0))
    assert section.geom_type == "Polygon"
    pockets = [pocket for ring in section.interiors if (pocket := shapely.Polygon(ring)).area > 30.0]
    web = shapely.Polygon(section.exterior).difference(shapely.union_all(pockets))
    assert len(pockets) > 4
    assert web.buffer(-1.49).geom_type == "Polygon"


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_label_is_read_from_outside_beside_what_covers_the_plate(side: Face) -> None:
    """Engraved 0.5 mm deep on the bed, where it is seen in a mirror, as near to the pivots' line as it finds room."""
    holes = HoleSizes.of(load_workshop(), None)
    plate, covered = rectangle((60.0, 40.0), (0.0, 12.0)), rectangle((70.0, 8.0), (0.0, 1.0))
    y0, y1 = (17.0, 20.0) if side == "left" else (-20.0, -17.0)
    depth = (y1 - 0.5, y1) if side == "left" else (y0, y0 + 0.5)
    for cover, low, high in ((None, -3.3, 3.3), (covered, 5.0, 13.0)):
        drawing = _drawing("plate", holes, [(y0, y1, plate)], depth, "Fy R", side, cover)
        outside, inside = drawing.shape.regions_at(np.array([0.45, 0.55]))
        letters, flat = inside - outside, text("Fy R", TEXT_HEIGHTS_MM[0]).mirror((1.0, 0.0))
        box, at = flat.bounds(), letters.bounds()
        assert low < at[1] < at[3] < high
        nearest = 0.0 if cover is None else math.ceil(5.0 + 0.8 + (box[3] - box[1]) / 2.0)
        assert [at[0] + at[2], at[1] + at[3]] == pytest.approx([0.0, 2.0 * nearest])  # on a raster of 1 mm
        moved = flat.translate((at[0] - box[0], at[1] - box[1]))
        assert (moved - letters).area() + (letters - moved).area() < 1e-3 * moved.area()


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


@pytest.mark.parametrize(("width", "height"), [(12.0, 10.0), (15.0, 24.0)])
def test_ears_of_5_6_mm_stand_beside_a_sockets_wall_of_1_6_mm(width: float, height: float) -> None:
    """Their screws are in the middle of the ears, which begin where the wall ends; 0.2 mm more are kept for the fit."""
    assert ear_reach_mm(height) == pytest.approx(height / 2.0 + 1.6 + 2.8)
    low_x, low_y, high_x, high_y = socket_about_axis(width, height).bounds()
    assert (-low_x, high_x) == pytest.approx([width / 2.0 + 1.8] * 2, abs=0.01)
    assert (-low_y, high_y) == pytest.approx([height / 2.0 + 1.6 + 5.6] * 2, abs=0.01)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_plates_have_material_around_what_they_hold(name: str, side: str) -> None:
    """3 mm around axles, 9 mm under standoffs' screws, 8 mm round the springs' pin, 2.5 mm around the trays' tabs."""
    robot = built(name)
    layout = robot.layout
    plate = getattr(layout.lateral, f"{side}_plate")
    section = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    kept = [(place, layout.axle_mm / 2.0 + 3.0, 1.75) for place in layout.axles.values()]
    kept += [(place, 4.5, 1.75) for place in layout.standoffs_mm] + [(layout.spring_pin_mm, 4.0, 1.75)]
    for place, radius, bore in kept:
        around = shapely.Point(*place).buffer(radius - 0.03, 64).difference(shapely.Point(*place).buffer(bore, 64))
        if side == "left":  # the sensor's opening and the shaft's hole may be beside them
            around = around.difference(shapely.Point(*layout.motor_mm).buffer(2.0))
        assert around.difference(section).area < 0.01
    for slots in tray_slots(layout, side):
        for place in slots:
            slot = shapely.box(place[0] - 5.2, place[1] - 1.0, place[0] + 5.2, place[1] + 1.0)
            outer = shapely.box(place[0] - 7.4, place[1] - 3.2, place[0] + 7.4, place[1] + 3.2).buffer(-1.0).buffer(1.0)
            assert outer.difference(slot).difference(section).area < 0.05


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_pockets_come_as_near_to_the_strut_as_3_mm_beside_a_bore(name: str) -> None:
    """And no nearer to the plate's edge than 3.2 mm; their corners have a radius of 1.5 mm."""
    layout = built(name).layout
    covers = _covers(layout, 0.8)
    pockets = shapely.union_all([shapely.Polygon(contour) for contour in covers.pockets.to_polygons()])
    line = shapely.LineString([layout.hub_mm, layout.front_mm])
    assert pockets.distance(line) == pytest.approx(layout.axle_mm / 2.0 + 3.0, abs=0.05)
    (edge,) = (shapely.Polygon(contour) for contour in covers.whole.to_polygons())
    assert pockets.distance(edge.exterior) == pytest.approx(3.2, abs=0.05)
    assert pockets.buffer(-1.45).buffer(1.45).symmetric_difference(pockets).area < 0.01 * pockets.area


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_ribs_join_every_pad_to_its_neighbours(name: str) -> None:
    """As Delaunay's triangles by GEOS join the pads' middles; where four are on one circle, either diagonal will do."""
    layout = built(name).layout
    assert layout.sensor is not None
    middles = [*layout.axles.values(), *layout.standoffs_mm, layout.spring_pin_mm, layout.motor_mm]
    middles += [np.array(place) for level in tray_slots(layout, "left") for place in level]
    rows = [pad.bounds() for pad in [*fitting_pads(layout.fittings, 0.0), plate_pad(layout.sensor)]]
    middles += [np.array([(row[0] + row[2]) / 2.0, (row[1] + row[3]) / 2.0]) for row in rows]
    pockets = shapely.union_all([shapely.Polygon(contour) for contour in _covers(layout, 0.8).pockets.to_polygons()])
    ribs = shapely.delaunay_triangles(shapely.MultiPoint(middles), only_edges=True).geoms
    broken = [rib for rib in ribs if rib.buffer(1.59, cap_style="flat").intersection(pockets).area > 0.05]
    assert len(ribs) > 20
    assert broken == []


@pytest.mark.parametrize("more_mm", [0.0, 1.5])
@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_pads_are_as_wide_as_what_they_hold_needs(name: str, more_mm: float) -> None:
    """3 mm around axles of 3 mm, 9 mm under standoffs, 8 mm round the springs' pin, 2.5 mm around tabs of trays."""
    layout, more = built(name).layout, 2.0 * more_mm
    pads = [pad.bounds() for pad in _pads(layout, more_mm)]
    found = [(*np.round([(row[0] + row[2]) / 2.0, (row[1] + row[3]) / 2.0], 2), row[2] - row[0], row[3] - row[1])
             for row in pads]  # fmt: skip
    expected = [(*place, 9.0, 9.0) for place in (*layout.axles.values(), *layout.standoffs_mm)]
    expected.append((*layout.spring_pin_mm, 8.0, 8.0))
    expected += [(*place, 10.0 + 5.0, 1.6 + 5.0) for level in tray_slots(layout, "left") for place in level]
    for row, (x, z, width, height) in zip(found, expected, strict=False):
        assert row == pytest.approx((x, z, width + more, height + more), abs=0.03)
    assert (
        len(found) == len(expected) + len([*fitting_pads(layout.fittings, 0.0)]) + 2
    )  # and the motor's and the sensor's


CLOSE_POCKETS = {
    "default": (154.0, 1.0734, 0.7499, 1.1942, 0.1128, 52.713, 18.552, 69.594),
    "fine": (152.3, 1.1982, 0.6581, 1.1508, 0.3104, 26.695, 29.477, 71.980),
    "light": (125.1, 0.9885, 0.8026, 0.9522, 0.5912, 50.586, 12.162, 36.483),
}
"""Robots that have pads side by side on which no rib ends, by workshop."""


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("workshop", CLOSE_POCKETS)
def test_a_printable_wall_is_between_all_openings_of_a_plate(workshop: str, side: str) -> None:
    shop = load_workshop(workshop)
    robot = build(Design.from_vector(CLOSE_POCKETS[workshop]), shop)
    plate = robot.layout.lateral.left_plate if side == "left" else robot.layout.lateral.right_plate
    area = region(cut(placed(robot, f"body_plate_{side}"), sum(plate) / 2.0))
    openings = [shapely.Polygon(ring) for ring in area.interiors]
    least = min(one.distance(other) for one, other in itertools.combinations(openings, 2))
    assert len(openings) > 12
    assert least > shop.fits.wall_min_mm - 0.02


def test_pockets_are_set_back_only_where_two_of_them_are_near() -> None:
    """An L, 0.4 mm beside a square; what stands into it from its border, and what lies far away, joins no two."""
    corner = (
        rectangle((20.0, 8.0), (10.0, 4.0)) + rectangle((8.0, 20.0), (4.0, 10.0)) - rectangle((0.5, 4.0), (4.0, 18.0))
    )
    pockets = corner + rectangle((6.0, 6.0), (23.4, 4.0)) + rectangle((6.0, 6.0), (40.0, 20.0))
    apart = _apart(pockets, 0.8)
    parts = sorted(apart.decompose(), key=lambda one: one.bounds()[0])
    assert parts[1].bounds()[0] - parts[0].bounds()[2] == pytest.approx(0.8, abs=0.05)
    elsewhere = rectangle((18.0, 30.0), (9.0, 10.0)) + rectangle((30.0, 30.0), (40.0, 10.0))
    assert ((pockets - apart) ^ elsewhere).area() == pytest.approx(0.0, abs=1e-6)
    assert (apart - pockets).area() == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("axle_mm", [2.0, 3.0, 4.0])
def test_plates_have_three_millimetres_around_axles_of_any_size(axle_mm: float) -> None:
    layout = replace(built("kenan-2.0").layout, axle_mm=axle_mm)
    boxes = [np.array(pad.bounds()).reshape(2, 2) for pad in _pads(layout)]
    for place in layout.axles.values():
        sizes = [np.ptp(box, axis=0) for box in boxes if np.allclose(box.mean(axis=0), place, atol=0.01)]
        assert any(size == pytest.approx([axle_mm + 6.0] * 2, abs=0.01) for size in sizes)
