"""Outlines of body plates: material around what they hold, ribs, and pockets that leave printable walls."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
import shapely
from support.built import built, cut, placed, region

from jumpcad.building import build
from jumpcad.design import Design
from jumpcad.parts.fittings import fitting_pads
from jumpcad.parts.motor_socket import socket_outline
from jumpcad.parts.part import Face
from jumpcad.parts.plate_outline import _apart, _pads, blank_of, outline, tray_slots
from jumpcad.parts.sensor import plate_pad
from jumpcad.solids.outline import rectangle
from jumpcad.workshop import load_workshop


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


@pytest.mark.parametrize("side", ["left", "right"])
def test_an_ear_is_the_hull_of_what_it_holds_and_fills_no_other_pocket(side: Face) -> None:
    """The leg's seat, 16 mm of the pivots' line, the stop's slot with 2.5 mm around it, at the left the pin's hole."""
    layout = built("kenan-2.0").layout
    blank, stop, pin, seat = blank_of(layout, 0.8), layout.stop, layout.pin_hole, layout.axle_mm / 2.0 + 3.0
    ends = [layout.hub_mm + np.array([x, z]) for x in (0.0, 16.0) for z in (-seat, seat)]
    slot = [stop.tab_mm + a * 3.0 * stop.along + b * 2.5 * stop.behind for a in (-1, 1) for b in (-1, 1)]
    held = [shapely.Point(*layout.hub_mm).buffer(seat, 64), shapely.MultiPoint(ends)]
    held.append(shapely.MultiPoint(slot).convex_hull.buffer(2.0, 64))
    if side == "left":
        held.append(shapely.LineString(pin.places_mm).buffer(pin.pad_mm / 2.0, 64))
    ear = shapely.union_all(held).convex_hull
    whole, found = (
        shapely.union_all([shapely.Polygon(contour) for contour in one.to_polygons()])
        for one in (blank.hull, blank.hull + outline(layout, blank, side))
    )
    assert found.symmetric_difference(whole.union(ear)).area < 0.5
    pockets = shapely.union_all([shapely.Polygon(contour) for contour in blank.pockets.to_polygons()])
    lost = blank.hull - outline(layout, blank, side)
    opened = shapely.union_all([shapely.Polygon(contour) for contour in lost.to_polygons()])
    assert opened.symmetric_difference(pockets.difference(ear)).area < 0.5


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
    blank = blank_of(layout, 0.8)
    pockets = shapely.union_all([shapely.Polygon(contour) for contour in blank.pockets.to_polygons()])
    line = shapely.LineString([layout.hub_mm, layout.front_mm])
    assert pockets.distance(line) == pytest.approx(layout.axle_mm / 2.0 + 3.0, abs=0.05)
    (edge,) = (shapely.Polygon(contour) for contour in blank.hull.to_polygons())
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
    pockets = shapely.union_all([shapely.Polygon(contour) for contour in blank_of(layout, 0.8).pockets.to_polygons()])
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
    others = [*fitting_pads(layout.fittings, 0.0), socket_outline(layout), plate_pad(layout.sensor)]
    assert len(found) == len(expected) + len(others)
    for pad, bare in zip(_pads(layout, more_mm)[len(expected) :], others, strict=True):
        bare_mm = shapely.union_all([shapely.Polygon(contour) for contour in bare.to_polygons()])
        grown = shapely.union_all([shapely.Polygon(contour) for contour in pad.to_polygons()])
        # a margin all around, and corners that are rounder by it
        assert grown.symmetric_difference(bare_mm.buffer(more_mm, 64)).area < 0.02 * bare_mm.length


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
    assert shop.fits.wall_min_mm - 0.02 < least < shop.fits.wall_mm - 0.1  # and no recommended one


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


@pytest.mark.parametrize("usb", [True, False])
@pytest.mark.parametrize("side", ["left", "right"])
def test_only_above_the_opening_for_a_usb_plug_has_a_plate_no_slot(side: Face, usb: bool) -> None:
    """It is in the right plate, behind: there the upper tray has its front tab alone. All other slots are pairs."""
    layout = built("kenan-2.0").layout
    assert layout.fittings.usb_mm is not None
    if not usb:
        layout = replace(layout, fittings=replace(layout.fittings, usb_mm=None))
    lower, upper = tray_slots(layout, side)
    behind, ahead = lower
    assert behind[0] < ahead[0]
    assert [x for x, _ in upper] == ([ahead[0]] if side == "right" and usb else [behind[0], ahead[0]])
