"""Main leg and front link, measured on their meshes."""

import math

import numpy as np
import pytest
import shapely
from support.built import LONG_TOES, built, cut, hole_centres, placed, region

from jumpcad.robot.robot import Robot

NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", LONG_TOES]


@pytest.fixture(params=NAMES)
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def test_eyes_of_the_main_leg_are_one_link_apart(robot: Robot) -> None:
    holes = np.array(list(hole_centres(cut(placed(robot, "main_leg"), robot.layout.sections.thickness_mm / 2 - 0.3))))
    hub = holes[np.hypot(*holes.T).argmin()]
    ankle = holes[holes[:, 0].argmax()]
    np.testing.assert_allclose(hub, 0.0, atol=2e-3)
    np.testing.assert_allclose(ankle, [robot.design.l2_mm, 0.0], atol=2e-3)


def test_eyes_of_the_front_link_are_one_link_apart(robot: Robot) -> None:
    holes = np.array(sorted(hole_centres(cut(placed(robot, "front_link"), 0.5))))
    np.testing.assert_allclose(holes, [[0.0, 0.0], [robot.design.l3_mm, 0.0]], atol=2e-3)


def test_pins_turn_in_the_ankle_and_are_pressed_in_elsewhere(robot: Robot) -> None:
    """Hole by hole, from the workshop's fits: the foot's pin has little play, the springs' pin has 0.1 mm a side."""
    layout, fits = robot.layout, robot.workshop.fits
    leg, link = (
        {round(x): width for (x, z), width in hole_centres(cut(placed(robot, name), 0.01)).items() if abs(z) < 0.01}
        for name in ("main_leg", "front_link")
    )
    eye = layout.axle_mm + 2.0 * fits.eye_mm
    assert leg[round(robot.design.l2_mm)] == pytest.approx(eye, abs=0.01)
    assert [link[0], link[round(robot.design.l3_mm)]] == pytest.approx([eye, eye], abs=0.01)
    assert leg[round(layout.leg_pin_mm)] == pytest.approx(layout.axle_mm + 2.0 * fits.press_mm, abs=0.01)
    assert fits.m3_clearance_mm in [pytest.approx(width, abs=0.01) for width in hole_centres(
        cut(placed(robot, "main_leg"), 0.01)).values()]  # fmt: skip


def test_lever_and_leg_make_the_angle_of_the_cam(robot: Robot) -> None:
    """Of the four holes, the lever's lies as far from the hub as the cam's roller, in the direction that it needs."""
    cam, half = robot.layout.drive.cam, robot.layout.sections.thickness_mm / 2
    holes = np.array(list(hole_centres(cut(placed(robot, "main_leg"), half - 0.3))))
    lever = holes[holes[:, 0].argmin()]
    assert np.hypot(*lever) == pytest.approx(cam.geometry.lever_mm, abs=2e-3)
    seen_from_the_body = math.atan2(lever[1], lever[0]) - math.radians(robot.design.rest_angle_deg)
    turn = (seen_from_the_body - cam.geometry.lever_start_rad + math.pi) % (2 * math.pi) - math.pi
    assert turn == pytest.approx(0.0, abs=1e-4)


def test_leg_tapers_with_the_moment_that_it_carries() -> None:
    """Between hub and ankle the bar's height falls linearly, and is the sized one at the root."""
    robot = built("best-bo")
    sections, l2 = robot.layout.sections, robot.design.l2_mm
    mesh = placed(robot, "main_leg")
    x = np.array([0.45, 0.6, 0.75]) * l2
    heights = [
        np.ptp(mesh.slice_plane([v, 0, 0], [1, 0, 0]).slice_plane([v + 0.2, 0, 0], [-1, 0, 0]).bounds[:, 2]) for v in x
    ]
    expected = sections.leg_root_mm + (x + 0.1) / l2 * (sections.leg_tip_mm - sections.leg_root_mm)
    np.testing.assert_allclose(heights, expected, atol=0.15)


def test_the_leg_has_material_around_all_its_holes_and_a_flat_heel(robot: Robot) -> None:
    """Ankle by its eye, lever 4.5 mm, springs' pin as high as the beam; a heel 0.5 mm longer than the pad at each end.

    Corners between them are filled to a radius of 3 mm: a smaller disc touches all along them, a larger one does not.
    """
    layout, cam = robot.layout, robot.layout.drive.cam
    sections, stop = layout.sections, layout.stop
    leg = region(cut(placed(robot, "main_leg"), 0.01))
    filled = shapely.Polygon(leg.exterior)
    turn = cam.geometry.lever_start_rad + math.radians(robot.design.rest_angle_deg)
    lever = (cam.geometry.lever_mm * math.cos(turn), cam.geometry.lever_mm * math.sin(turn))
    pin = max(sections.leg_root_mm / 2.0, sections.eye_radius_mm)
    eyes = [((robot.design.l2_mm, 0.0), sections.eye_radius_mm), (lever, 4.5), ((layout.leg_pin_mm, 0.0), pin)]
    for place, radius in eyes:
        assert shapely.Point(*place).buffer(radius - 0.02).difference(filled).area < 1e-3
    assert filled.exterior.distance(shapely.Point(robot.design.l2_mm, 0.0)) == pytest.approx(
        max(sections.eye_radius_mm, sections.leg_tip_mm / 2.0), abs=0.05
    )
    assert filled.exterior.distance(shapely.Point(*lever)) == pytest.approx(4.5, abs=0.05)
    seat = layout.hub_bearing.outer_mm / 2.0 + robot.workshop.fits.press_mm + 2.0 * robot.workshop.fits.wall_mm
    around = max(seat, sections.lever_root_mm / 2.0, sections.leg_root_mm / 2.0)
    assert filled.exterior.distance(shapely.Point(0.0, 0.0)) == pytest.approx(around, abs=0.05)
    assert filled.exterior.distance(shapely.Point(layout.leg_pin_mm, 0.0)) == pytest.approx(pin, abs=0.3)
    ends = [(0.0, 0.0, sections.lever_root_mm / 2.0), (*lever, 4.5)]
    arm = shapely.union_all([shapely.Point(x, z).buffer(radius - 0.02, 64) for x, z, radius in ends]).convex_hull
    assert arm.difference(filled).area < 1e-3
    heel = shapely.box(stop.radius_mm - 4.5, -stop.heel_mm, stop.radius_mm + 4.5, 0.0)
    assert heel.difference(filled).area < 0.05
    face = filled.intersection(shapely.box(stop.radius_mm - 4.0, -100.0, stop.radius_mm + 4.0, 0.0))
    assert face.bounds[1] == pytest.approx(-stop.heel_mm, abs=0.01)
    beside = shapely.box(stop.radius_mm - 6.0, -stop.heel_mm - 0.1, stop.radius_mm + 6.0, 0.01 - stop.heel_mm)
    low_x, _, high_x, _ = filled.intersection(beside).bounds
    assert (low_x, high_x) == pytest.approx((stop.radius_mm - 4.5, stop.radius_mm + 4.5), abs=0.06)
    smaller, larger = (filled.buffer(radius).buffer(-radius).difference(filled).area for radius in (2.8, 3.6))
    assert smaller < 0.1 < larger


def test_the_front_link_is_a_straight_bar_between_equal_eyes(robot: Robot) -> None:
    sections, length = robot.layout.sections, robot.design.l3_mm
    link = shapely.Polygon(region(cut(placed(robot, "front_link"), 0.5)).exterior)
    for x in (0.0, length):
        assert link.exterior.distance(shapely.Point(x, 0.0)) == pytest.approx(sections.eye_radius_mm, abs=0.02)
    middle = link.intersection(shapely.box(length / 2.0 - 1.0, -50.0, length / 2.0 + 1.0, 50.0))
    half = sections.front_mm / 2.0
    assert middle.bounds[1::2] == pytest.approx((-half, half), abs=0.02)
    assert link.buffer(2.95).buffer(-2.95).difference(link).area < 0.05
    mesh = placed(robot, "front_link")
    assert mesh.bounds[:, 1] == pytest.approx([-sections.thickness_mm / 2.0, sections.thickness_mm / 2.0])
