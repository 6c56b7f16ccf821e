"""The rest stop's bar on its mesh: deepest where the leg hits, a seat for the pad, a tab in each plate."""

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built, cut, part, placed, region
from support.fits import chamfered, with_fits_apart

from jumpcad.parts.body_plate import _openings
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.stop import stop_slot
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def across(robot: Robot, height_mm: float) -> shapely.Geometry:
    """The bar's section at a height along the leg: x is the robot's left, y points towards the leg."""
    mesh = part(robot, "stop_bar").mesh
    return region(trimesh.intersections.mesh_plane(mesh, [0.0, 0.0, 1.0], [0.0, 0.0, height_mm])[:, :, :2])


def test_the_bar_fills_the_room_between_the_plates_and_is_deepest_in_its_middle(robot: Robot) -> None:
    """Beyond its tabs: from the face, where the pad has a seat of 0.6 mm with 0.2 mm of play, to the depth in the
    middle, and to 0.6 times that at either plate."""
    layout = robot.layout
    (low, high), depth, half = layout.lateral.inside, layout.stop.depth_mm, layout.sections.thickness_mm / 2.0 + 0.2
    seat = shapely.box(-half, -0.62, half, 0.0)
    outline = shapely.MultiPoint(
        [
            (low, 0.0),
            (high, 0.0),
            (low, -0.6 * depth),
            (high, -0.6 * depth),
            (-half - 0.6, -depth),
            (half + 0.6, -depth),
        ]
    ).convex_hull
    assert across(robot, 7.0).symmetric_difference(outline.difference(seat)).area < 0.01
    assert part(robot, "stop_bar").mesh.bounds[:, 2] == pytest.approx([0.0, 8.0])


def test_a_tab_of_5_by_4_mm_reaches_through_either_plate(robot: Robot) -> None:
    """Flush with the plates' outsides; its face is that of the bar."""
    (low, high), (outer_low, outer_high) = robot.layout.lateral.inside, robot.layout.lateral.outside
    tabs = across(robot, 2.5).difference(shapely.box(low, -100.0, high, 100.0))
    expected = [shapely.box(outer_low, -4.0, low, 0.0), shapely.box(high, -4.0, outer_high, 0.0)]
    assert tabs.symmetric_difference(shapely.union_all(expected)).area < 0.01
    assert across(robot, 5.05).difference(shapely.box(low, -100.0, high, 100.0)).area < 0.01


def test_tabs_stand_in_the_plates_slots(robot: Robot) -> None:
    """Pressed in: 0.1 mm on every side of the section."""
    for side, plate in (("left", robot.layout.lateral.left_plate), ("right", robot.layout.lateral.right_plate)):
        y = sum(plate) / 2.0
        tab, around = (region(cut(placed(robot, name), y)) for name in ("stop_bar", f"body_plate_{side}"))
        assert tab.intersection(around).area < 1e-3
        assert tab.buffer(robot.workshop.fits.press_mm + 0.01, join_style="mitre").intersection(around).length > 17.9


def test_the_slots_of_tabs_have_the_fit_of_tight_bores(robot: Robot) -> None:
    """0.05 mm on every side, where eyes and lying holes have more."""
    layout, stop = robot.layout, robot.layout.stop
    holes = HoleSizes.of(with_fits_apart(robot.workshop), layout.hub_bearing)
    for side in ("left", "right"):
        outlines = map(shapely.Polygon, _openings(layout, holes, side).to_polygons())
        (slot,) = (one for one in outlines if one.contains(shapely.Point(stop.tab_mm)))
        assert slot.area == pytest.approx(5.1 * 4.1, abs=1e-3)


@pytest.mark.parametrize("edge_mm", [0.0, 2.0])
def test_around_a_slot_the_plate_has_an_edge_on_all_four_sides(robot: Robot, edge_mm: float) -> None:
    """The slot has a tab's 5 x 4 mm with its play, turned as the bar is; the edge is as wide at its corners."""
    stop = robot.layout.stop
    (contour,) = stop_slot(robot.layout, 0.2, edge_mm).to_polygons()
    along, behind = np.array(stop.along), np.array(stop.behind)
    from_middle = np.asarray(contour) - stop.tab_mm
    assert np.abs(from_middle @ along) == pytest.approx(4 * [2.6 + edge_mm], abs=1e-6)
    assert np.abs(from_middle @ behind) == pytest.approx(4 * [2.1 + edge_mm], abs=1e-6)


def test_the_pad_lies_in_its_seat_before_the_bar(robot: Robot) -> None:
    """Glued to the seat's floor, 0.02 mm before it, it stands out towards the leg by its thickness less 0.6 mm."""
    bar = part(robot, "stop_bar")
    item = next(one for one in robot.hardware if one.name == "stop_pad")
    pad = item.look.copy().apply_transform(np.linalg.inv(bar.placements[0].T_body_part) @ item.T_body_part)
    thick = robot.layout.stop.pad.thickness_mm
    assert pad.bounds[:, 1] == pytest.approx([-0.6, thick - 0.6], abs=2e-3)
    assert pad.bounds[:, 2] == pytest.approx([0.0, 8.0], abs=2e-3)
    assert (pad.bounds[0, 0] + pad.bounds[1, 0]) / 2.0 == pytest.approx(0.0, abs=1e-3)


def test_the_bar_lies_on_chamfered_edges(robot: Robot) -> None:
    """Its tabs are pressed into slots."""
    assert chamfered(robot, "stop_bar")
