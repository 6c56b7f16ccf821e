"""Main leg and front link, measured on their meshes."""

import math

import numpy as np
import pytest
import shapely
from support.built import LONG_TOES, built, cut, hole_centres, placed, region

from jumpcad.robot import Robot

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


def test_lever_and_leg_make_the_angle_of_the_cam(robot: Robot) -> None:
    """Of the four holes, the lever's lies as far from the hub as the cam's roller, in the direction that it needs."""
    cam, half = robot.layout.drive.cam, robot.layout.sections.thickness_mm / 2
    holes = np.array(list(hole_centres(cut(placed(robot, "main_leg"), half - 0.3))))
    lever = holes[holes[:, 0].argmin()]
    assert np.hypot(*lever) == pytest.approx(cam.lever_length_mm, abs=2e-3)
    seen_from_the_body = math.atan2(lever[1], lever[0]) - math.radians(robot.design.rest_angle_deg)
    turn = (seen_from_the_body - cam.lever_start_rad + math.pi) % (2 * math.pi) - math.pi
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


def test_the_hub_has_two_walls_around_its_bearing(robot: Robot) -> None:
    """All around the seat there is plastic: the wall of the workshop twice, as around every eye."""
    layout, fits = robot.layout, robot.workshop.fits
    hub = layout.hub_bearing
    assert hub is not None
    leg = region(cut(placed(robot, "main_leg"), layout.sections.thickness_mm / 2.0 - hub.width_mm / 2.0))
    seat = hub.outer_mm / 2.0 + fits.press_mm
    wall = shapely.Point(0.0, 0.0).buffer(seat + 2.0 * fits.wall_mm - 0.02) - shapely.Point(0.0, 0.0).buffer(
        seat + 0.05
    )
    assert wall.difference(leg).area < 0.01 * wall.area
