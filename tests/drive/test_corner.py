"""The roller on the cam's corner, and the window in which its way is free, against shapely's distances."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import affinity
from support.built import built

from jumpcad.drive.cam import CamGeometry
from jumpcad.drive.corner import _crossing, _rounding, _window, clear_window_rad, roll_over
from jumpcad.transforms import turned_about_y

TEMPLATES = ("kenan-2.0", "best-ga")


def geometry(name: str) -> CamGeometry:
    return built(name).layout.drive.cam.geometry


def standing(name: str, cam_rad: float, radius_mm: float = 0.0) -> shapely.Geometry:
    """The cam's outline at a cam angle, seen from the hub; its convex corners rounded by a radius."""
    cam = built(name).layout.drive.cam
    outline = shapely.Polygon(cam.geometry.outline_mm(721)).buffer(-radius_mm, 64).buffer(radius_mm, 64)
    # a positive turn about +y is clockwise where x points right and z up
    turned = affinity.rotate(outline, -cam_rad, (0, 0), use_radians=True)
    return affinity.translate(turned, *cam.geometry.axis_mm)


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("rounding_mm", [0.0, 0.8])
def test_the_roller_touches_the_corner_all_the_way(name: str, rounding_mm: float) -> None:
    cam = geometry(name)
    path = roll_over(cam, rounding_mm)
    for index in range(0, len(path.cam_rad), 25):
        centre = shapely.Point(cam.roller_mm(path.wind_rad[index]))
        gap = standing(name, float(path.cam_rad[index]), rounding_mm).exterior.distance(centre)
        assert gap == pytest.approx(cam.roller_radius_mm, abs=0.02)


@pytest.mark.parametrize(
    ("name", "radius_mm"),
    [("kenan-2.0", 0.3), ("kenan-2.0", 1.0), ("kenan-2.0", 5.0), ("best-ga", 0.3), ("best-ga", 7.0)],
)
def test_a_rounding_touches_lift_and_drop_face_from_inside(name: str, radius_mm: float) -> None:
    """Its centre is a radius from where it begins and from the outline; the drop face is an arc about the hub."""
    cam = geometry(name)
    begin, centre = _rounding(cam, radius_mm)
    assert np.hypot(*(centre - cam.contact_mm(begin))) == pytest.approx(radius_mm, abs=1e-4)
    assert shapely.Polygon(cam.outline_mm(1441)).exterior.distance(shapely.Point(centre)) == pytest.approx(
        radius_mm, abs=2e-4
    )
    face = cam.lever_mm + cam.roller_radius_mm + cam.clearance_mm
    assert np.hypot(*cam.in_body(centre, cam.free_rad)) == pytest.approx(face + radius_mm, abs=1e-5)
    assert roll_over(cam, radius_mm).cam_rad[0] == begin < roll_over(cam).cam_rad[0] == cam.law.lift_rad


@pytest.mark.parametrize("name", TEMPLATES)
def test_slopes_are_those_of_the_path(name: str) -> None:
    path = roll_over(geometry(name))
    middle = slice(5, 200)
    assert path.slope[middle] == pytest.approx(np.gradient(path.wind_rad, path.cam_rad)[middle], abs=1e-3)
    bend = np.gradient(np.gradient(path.wind_rad, path.cam_rad), path.cam_rad)
    assert path.bend[middle] == pytest.approx(bend[middle], rel=0.02)
    assert path.wind_rad[0] == pytest.approx(geometry(name).law.compression_rad, abs=1e-9)
    assert path.slope[0] == pytest.approx(
        float(geometry(name).law.derivatives(geometry(name).law.lift_rad)[1]), rel=1e-6
    )


@pytest.mark.parametrize("turn_deg", [-150.0, -60.0, 45.0, 170.0])
def test_cam_and_leg_turned_about_the_hub_move_alike(turn_deg: float) -> None:
    """The path over the corner says nothing of directions: it is the same whichever way the axis lies."""
    cam = geometry("kenan-2.0")
    here = roll_over(cam, 0.5)
    there = roll_over(replace(cam, axis_rad=cam.axis_rad + math.radians(turn_deg)), 0.5)
    for name in ("cam_rad", "wind_rad", "slope", "arm_mm"):
        assert getattr(there, name) == pytest.approx(getattr(here, name), abs=1e-9)


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_window_is_where_the_roller_s_way_is_free(name: str) -> None:
    cam, law = geometry(name), geometry(name).law
    way = shapely.LineString(cam.roller_mm(np.linspace(-cam.overshoot_rad, law.compression_rad, 800)))
    begin, end = clear_window_rad(cam)

    def gap(turn: float) -> float:
        return standing(name, law.lift_rad + turn).distance(way) - cam.roller_radius_mm

    slack = math.radians(0.004)
    assert min(gap(turn) for turn in np.linspace(begin + slack, end - slack, 20)) > 0.0
    assert gap(begin - slack) < 0.0
    assert gap(end + slack) < 0.0


def test_a_cam_that_is_everywhere_leaves_no_window_and_one_that_is_nowhere_all_of_it() -> None:
    """A disc about its axis that reaches the roller's way, and one that does not, are in the way always or never."""
    cam = geometry("kenan-2.0")
    circle = np.column_stack([np.cos(np.linspace(0.0, 6.28, 721)), np.sin(np.linspace(0.0, 6.28, 721))])
    ways = cam.roller_mm(np.linspace(-cam.overshoot_rad, cam.law.compression_rad, 50))
    axis = cam.axis_distance_mm * np.array([math.cos(cam.axis_rad), math.sin(cam.axis_rad)])
    nearest = np.hypot(*(ways - axis).T).min()
    begin, end = _window(cam, nearest * circle)
    assert math.isnan(begin)
    assert math.isnan(end)
    small = (nearest - cam.roller_radius_mm - 0.1) * circle
    assert _window(cam, small) == pytest.approx((0.0, 2.0 * math.pi - cam.law.lift_rad))


@pytest.mark.parametrize("end", ["loaded", "past rest"])
def test_what_is_beyond_an_end_of_the_rollers_way_is_in_it_while_nearer_than_its_radius(end: str) -> None:
    """A point on the arc of the roller's centre, 0.15 rad beyond it at the end of the lift, and carried away."""
    cam = geometry("kenan-2.0")
    last = cam.law.compression_rad if end == "loaded" else -cam.overshoot_rad
    beyond = cam.roller_mm(last + math.copysign(0.15, last))
    lift, way = cam.law.lift_rad, np.linspace(-cam.overshoot_rad, cam.law.compression_rad, 800)
    point = turned_about_y(beyond - cam.axis_mm, -lift)
    begin, _ = _window(cam, point[None])
    carried = shapely.Point(cam.in_body(point, lift + begin))
    assert begin > 0.05
    assert shapely.LineString(cam.roller_mm(way)).distance(carried) == pytest.approx(cam.roller_radius_mm, abs=0.05)


@pytest.mark.parametrize("turned_deg", [90.0, 180.0, -90.0])
def test_what_is_as_far_from_the_hub_elsewhere_around_it_is_not_in_the_rollers_way(turned_deg: float) -> None:
    """Of a point that is turned about the hub, out of the middle of the way, the roller's end is far enough away."""
    cam = geometry("kenan-2.0")
    point = cam.roller_mm(cam.law.compression_rad / 2.0 + math.radians(turned_deg))
    begin, end = _window(cam, turned_about_y(point - cam.axis_mm, -cam.law.lift_rad)[None])
    whole = 2.0 * math.pi - cam.law.lift_rad
    assert begin == 0.0
    if abs(turned_deg) == 180.0:
        assert end == pytest.approx(whole)
    assert end > 0.1


def test_a_gap_opens_between_two_samples_by_a_straight_line() -> None:
    turns, gap = np.array([0.0, 0.1, 0.2, 0.3]), np.array([-0.3, 0.1, 0.2, -0.6])
    assert _crossing(turns, gap, 0, 1) == pytest.approx(0.075)
    assert _crossing(turns, gap, 3, 2) == pytest.approx(0.225)
    assert (_crossing(turns, gap, -1, 0), _crossing(turns, gap, 4, 3)) == (0.0, 0.3)


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_roller_falls_freely_when_the_corner_is_far_enough_from_the_hub(name: str) -> None:
    """By lever, roller and clearance; where it never is that far, there is no such angle."""
    cam = geometry(name)
    assert cam.free_rad > cam.law.lift_rad
    reach = cam.lever_mm + cam.roller_radius_mm + cam.clearance_mm
    assert np.hypot(*cam.in_body(cam.tip_mm, cam.free_rad)) == pytest.approx(reach)
    assert np.hypot(*cam.in_body(cam.tip_mm, cam.law.lift_rad)) < reach
    farthest = cam.axis_distance_mm + float(np.hypot(*cam.tip_mm)) - cam.lever_mm - cam.roller_radius_mm
    for more, never in ((-0.1, False), (0.1, True), (5.0, True), (200.0, True)):
        assert math.isnan(replace(cam, clearance_mm=farthest + more).free_rad) == never
