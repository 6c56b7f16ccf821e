"""The motor's socket, measured on meshes: its seat, its ears, and what holds the motor in it."""

import math

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built, cut, hole_centres, inscribed_diameter, placed, region
from support.fits import SLIDING, TOLERANCE_MM

from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.dimensions import CAP_EAR_MM, MOTOR_CAP_MM, MOTOR_CLAMP_MM
from jumpcad.drive.socket import socket_half_mm
from jumpcad.parts.motor_socket import ear_places, ear_reach_mm, socket_about_axis
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop


@pytest.fixture(scope="module")
def kenan() -> Robot:
    return built("kenan-2.0")


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
        half, thick = motor.height_mm / 2.0, MOTOR_CAP_MM
        arm = ear_reach_mm(motor.height_mm, CAP_EAR_MM) - half
        strain = thick * MOTOR_CLAMP_MM / 2.0 / (arm * half + arm**2 / 3.0)
        across = socket_half_mm(motor)[0] * 2.0
        assert strain * across / (across - motor.boss_mm) < 0.011


@pytest.mark.parametrize(("width", "height", "ear"), [(12.0, 10.0, 5.6), (15.0, 24.0, 5.6), (12.0, 10.0, 6.4)])
def test_ears_stand_beside_a_sockets_wall_of_1_6_mm(width: float, height: float, ear: float) -> None:
    """Their screws are in the middle of the ears, which begin where the wall ends; 0.2 mm more are kept for the fit."""
    assert ear_reach_mm(height, ear) == pytest.approx(height / 2.0 + 1.6 + ear / 2.0)
    low_x, low_y, high_x, high_y = socket_about_axis(width, height, ear).bounds()
    assert (-low_x, high_x) == pytest.approx([width / 2.0 + 1.8] * 2, abs=0.01)
    assert (-low_y, high_y) == pytest.approx([height / 2.0 + 1.6 + ear] * 2, abs=0.01)


def test_a_wide_nozzle_prints_the_walls_beside_the_heads_of_the_caps_screws() -> None:
    """Two lines of a 0.6 mm nozzle, 1.2 mm, stand outside a counterbore of 4 mm, and the socket has the same ears."""
    shop = load_workshop()
    fits = shop.fits.model_copy(update={"wall_min_mm": 1.2, "wall_mm": 1.8})
    robot = build(load_design("kenan-2.0"), shop.model_copy(update={"fits": fits}))
    cap = region(cut(placed(robot, "motor_cap"), robot.layout.lateral.motor_cap[1] - 0.4))
    for ear in ear_places(robot.layout):
        head = shapely.Point(*ear)
        assert cap.exterior.distance(head) == pytest.approx(2.0 + 1.2, abs=0.02)
        assert head.buffer(1.98).intersection(cap).area < 1e-3
        socket = region(cut(placed(robot, "body_plate_right"), robot.layout.lateral.motor[1] - 2.0))
        assert head.buffer(3.17).difference(shapely.union_all([shapely.Polygon(socket.exterior)])).area < 0.01
