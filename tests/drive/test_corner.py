"""The roller on the cam's corner, and the window in which its way is free, against shapely's distances."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import affinity
from support.built import built

from jumpcad.drive.cam import CamGeometry
from jumpcad.drive.corner import _rounding, clear_window_rad, roll_over

TEMPLATES = ("kenan-2.0", "best-ga")


def geometry(name: str) -> CamGeometry:
    return built(name).layout.drive.cam.geometry


def standing(name: str, cam_rad: float, radius_mm: float = 0.0) -> shapely.Geometry:
    """The cam's outline at a cam angle, seen from the hub; its convex corners rounded by a radius."""
    cam = built(name).layout.drive.cam
    outline = shapely.Polygon(cam.geometry.outline_mm(721)).buffer(-radius_mm, 64).buffer(radius_mm, 64)
    # a positive turn about +y is clockwise where x points right and z up
    turned = affinity.rotate(outline, -cam_rad, (0, 0), use_radians=True)
    return affinity.translate(turned, *cam.cam_axis_mm)


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("rounding_mm", [0.0, 0.8])
def test_the_roller_touches_the_corner_all_the_way(name: str, rounding_mm: float) -> None:
    cam = geometry(name)
    path = roll_over(cam, rounding_mm)
    for index in range(0, len(path.cam_rad), 25):
        centre = shapely.Point(cam.roller_mm(path.wind_rad[index]))
        gap = standing(name, float(path.cam_rad[index]), rounding_mm).exterior.distance(centre)
        assert gap == pytest.approx(cam.roller_radius_mm, abs=0.02)


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("radius_mm", [0.3, 1.0])
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
