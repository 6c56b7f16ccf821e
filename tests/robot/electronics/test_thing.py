"""The trays measured on their meshes: what carries battery and boards, and what holds them."""

from collections.abc import Callable

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built, geared, placed

from jumpcad.robot.robot import Robot


def level(mesh: trimesh.Trimesh, z_mm: float) -> shapely.Geometry:
    """The section of a part of the body at a height, in x and y."""
    lines = trimesh.intersections.mesh_plane(mesh, [0.0, 0.0, 1.0], [0.0, 0.0, z_mm])[:, :, :2]
    return shapely.union_all(trimesh.load_path(lines).polygons_full)


def box_of(robot: Robot, name: str) -> np.ndarray:
    item = next(one for one in robot.hardware if one.name == name)
    return item.shown_mesh.copy().apply_transform(item.T_body_part).bounds


@pytest.fixture(scope="module", params=[lambda: built("kenan-2.0"), geared], ids=["one cell", "two pairs"])
def robot(request: pytest.FixtureRequest) -> Robot:
    make: Callable[[], Robot] = request.param
    return make()


def shapes(robot: Robot, name: str) -> tuple[shapely.Geometry, shapely.Geometry, np.ndarray]:
    """A tray's floor, what stands on it, and its bounds."""
    mesh = placed(robot, name)
    bottom = mesh.bounds[0, 2]
    return level(mesh, bottom + 0.8), level(mesh, mesh.bounds[1, 2] - 0.3), mesh.bounds


def test_trays_are_as_long_as_was_planned_and_reach_through_both_plates(robot: Robot) -> None:
    """Floors of 1.6 mm between the plates with a sliding fit; tabs of 10 mm to the plates' outsides."""
    lateral, electronics = robot.layout.lateral, robot.layout.electronics
    for name in ("electronics_tray_lower", "electronics_tray_upper"):
        floor, _, bounds = shapes(robot, name)
        assert np.ptp(bounds[:, 0]) == pytest.approx(electronics.length_mm, abs=2e-3)
        assert bounds[:, 0].mean() == pytest.approx(robot.layout.tray_mm[0], abs=2e-3)
        assert (bounds[0, 1], bounds[1, 1]) == pytest.approx((lateral.outside[0], lateral.outside[1]), abs=2e-3)
        for y in (lateral.outside[0] + 0.5, lateral.outside[1] - 0.5):
            tabs = floor.intersection(shapely.LineString([(-300.0, y), (300.0, y)]))
            pieces = getattr(tabs, "geoms", [tabs])
            plugged = robot.layout.fittings.usb_mm is not None and y < 0.0 and name.endswith("upper")
            assert len(pieces) == (1 if plugged else 2)  # the USB plug is where the other would be
            for tab in pieces:
                assert tab.length == pytest.approx(10.0, abs=2e-3)
        inside = floor.intersection(shapely.box(-300.0, lateral.inside[0] + 0.05, 300.0, lateral.inside[1] - 0.05))
        beyond = floor.intersection(shapely.box(-300.0, lateral.inside[1] - 0.19, 300.0, lateral.inside[1] - 0.01))
        assert inside.area > 0.3 * electronics.length_mm * (lateral.inside[1] - lateral.inside[0])
        assert beyond.area < 0.19 * 25.0  # the tabs alone: 0.2 mm of play beside the floor


def test_the_battery_lies_between_two_stops_on_a_ledge(robot: Robot) -> None:
    """Half a millimetre of play, stops of 1.2 mm, 2 mm high; the window leaves 2 mm under its sides."""
    floor, stops, bounds = shapes(robot, "electronics_tray_lower")
    (x0, y0, z0), (x1, y1, _) = box_of(robot, "battery")
    assert z0 == pytest.approx(bounds[0, 2] + 1.6)
    assert bounds[1, 2] - z0 == pytest.approx(2.0, abs=2e-3)
    ends = sorted(stops.geoms, key=lambda one: one.centroid.x)
    assert len(ends) == 2
    assert x0 - ends[0].bounds[2] == pytest.approx(ends[1].bounds[0] - x1, abs=2e-3)
    assert x0 - ends[0].bounds[2] >= 0.5 - 1e-6
    for end in ends:
        assert np.ptp(np.array(end.bounds)[[0, 2]]) == pytest.approx(1.2, abs=2e-3)
        assert (end.bounds[1] + end.bounds[3]) / 2.0 == pytest.approx((y0 + y1) / 2.0, abs=2e-3)
        assert np.ptp(np.array(end.bounds)[[1, 3]]) == pytest.approx(max(0.6 * (y1 - y0), 4.0), abs=0.01)
        assert floor.buffer(2e-3).contains(end)
    holes = [shapely.Polygon(ring) for one in getattr(floor, "geoms", [floor]) for ring in one.interiors]
    under = [one for one in holes if one.contains(shapely.Point((x0 + x1) / 2.0, (y0 + y1) / 2.0))]
    assert len(under) == 1
    for window in under:
        assert np.ptp(np.array(window.bounds)[[1, 3]]) == pytest.approx(y1 - y0 - 4.0, abs=2e-3)
        assert window.bounds[0] > ends[0].bounds[2] + 0.9
        assert window.bounds[2] < ends[1].bounds[0] - 0.9
    straps = [one for one in holes if np.ptp(np.array(one.bounds)[[0, 2]]) == pytest.approx(11.0, abs=2e-3)]
    assert len(straps) == 2
    for strap in straps:
        assert np.ptp(np.array(strap.bounds)[[1, 3]]) == pytest.approx(2.0, abs=2e-3)
        assert strap.centroid.x == pytest.approx((x0 + x1) / 2.0, abs=2e-3)
        beside = max(y0 - strap.bounds[3], strap.bounds[1] - y1)
        assert beside == pytest.approx(1.0, abs=2e-3)
